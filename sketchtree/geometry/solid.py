"""What solid is a tree's wood?

Printers and physics want one surface that meets itself nowhere. The limbs' tubes, each closed, are united by manifold3d (Apache 2.0;
J. Smith, "Robust mesh Boolean", 2009, is the method it builds on): what lies inside another limb goes, and new vertices stand where
surfaces met. Position, normal and texture coordinates go along as columns of each vertex, and each triangle keeps its material.
"""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from sketchtree.errors import ExportError, OptionError
from sketchtree.geometry.mesh import Mesh


def require_solid() -> None:
    """Raises `OptionError` with the remedy where manifold3d is missing."""
    try:
        import manifold3d  # noqa: F401
    except ImportError:
        raise OptionError(
            "A solid needs the package `manifold3d`.", remedy="Install it with pip install 'sketchtree[solid]', or leave out `--solid`."
        ) from None


_CRUMB = 1e-4  # volume of what is left out where it touches nothing, / that of the largest piece


def united(meshes: Sequence[Mesh]) -> tuple[tuple[Mesh, ...], int]:
    """The union of meshes made of closed surfaces, in as many meshes (those of which nothing is left but the first are dropped), and
    how many crumbs that touch nothing were left out.

    Raises `OptionError` without manifold3d, `ExportError` where a surface is not closed."""
    require_solid()
    import manifold3d

    first = manifold3d.Manifold.reserve_ids(len(meshes))
    limbs = [limb for k, mesh in enumerate(meshes) if len(mesh.triangle) for limb in _manifold(mesh, first + k).decompose()]
    if not limbs:
        return tuple(meshes), 0
    pieces = manifold3d.Manifold.batch_boolean(limbs, manifold3d.OpType.Add).decompose()
    least = _CRUMB * max(piece.volume() for piece in pieces)
    kept = [piece for piece in pieces if piece.volume() >= least]
    whole = manifold3d.Manifold.compose(kept).to_mesh64()
    column, triangle = np.array(whole.vert_properties), np.array(whole.tri_verts, np.int64)
    runs = np.array(whole.run_index, np.int64) // 3
    of = np.repeat(np.array(whole.run_original_id, np.int64) - first, np.diff(runs))
    parts = [_part(mesh, column, triangle[of == k]) for k, mesh in enumerate(meshes)]
    return tuple(part for k, part in enumerate(parts) if k == 0 or len(part.triangle)), len(pieces) - len(kept)


def _manifold(mesh: Mesh, name: int):
    """The mesh's closed surfaces, its vertices joined where they stand twice for the sake of the texture."""
    import manifold3d

    columns = np.ascontiguousarray(np.hstack([mesh.position, mesh.normal, mesh.uv]))
    triangle = np.ascontiguousarray(mesh.triangle, np.uint64)
    runs = {"run_index": np.array([0, triangle.size], np.uint64), "run_original_id": np.array([name], np.uint32)}
    source = manifold3d.Mesh64(columns, triangle, **runs)
    source.merge()
    made = manifold3d.Manifold(source)
    if made.status() != manifold3d.Error.NoError:
        raise ExportError(f"The wood is no solid: {made.status().name}.", remedy="Leave out `--solid`, or draw limbs that do not coincide.")
    return made


def _part(mesh: Mesh, column, triangle) -> Mesh:
    used, corner = np.unique(triangle, return_inverse=True)
    normal = column[used, 3:6]
    normal = normal / np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), 1e-300)
    return replace(mesh, position=column[used, :3], normal=normal, uv=column[used, 6:8], triangle=corner.reshape(-1, 3))
