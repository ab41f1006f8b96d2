"""Meshes for programs that read no glTF: OBJ with materials and textures, PLY with colours, STL, and 3MF for printing. Metres."""

import os
from collections.abc import Sequence
from pathlib import Path

from sketchtree.errors import ExportError
from sketchtree.export.checks import check_mesh
from sketchtree.export.files import check_extension, check_writable, write_set
from sketchtree.geometry.mesh import Mesh


def write_meshes(path: str | os.PathLike, meshes: Sequence[Mesh]) -> None:
    """Write the meshes as the extension says: `.obj`, `.ply`, `.stl` or `.3mf` (wood alone), all its files or none.

    Raises `ExportError` for another extension, where a file can't be written, and for all but `.obj` where there is no triangle.
    """
    check_extension(path, (".obj", ".ply", ".stl", ".3mf"))
    check_writable(path)
    write_set(mesh_files(Path(path), meshes))


def mesh_files(path: Path, meshes: Sequence[Mesh]) -> dict[Path, bytes]:
    """Every file that `write_meshes` writes, by its path."""
    from sketchtree.export.meshes.obj import obj_files
    from sketchtree.export.meshes.plain import plain_bytes
    from sketchtree.export.meshes.threemf import threemf_bytes

    suffix = path.suffix.lower()
    wanted = [mesh for mesh in meshes if len(mesh.triangle) and (suffix != ".3mf" or not mesh.name.startswith("leaf"))]
    for mesh in wanted:
        check_mesh(mesh)
    if not wanted and suffix != ".obj":
        raise ExportError(f"Can't write {path}: there is no triangle to write.", remedy="Build a tree that has at least one branch.")
    if suffix == ".obj":
        return obj_files(path, wanted)
    return {path: threemf_bytes(wanted) if suffix == ".3mf" else plain_bytes(wanted, suffix[1:])}
