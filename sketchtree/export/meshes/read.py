"""Meshes of OBJ, PLY and STL files. Metres and y up are taken for granted: the formats say neither."""

import os
from pathlib import Path

import numpy as np

from sketchtree.asset import Asset
from sketchtree.errors import ExportError
from sketchtree.export.meshes.read_obj import read_obj
from sketchtree.geometry.mesh import Material, Mesh

_UNREADABLE = "Give a mesh file that is whole, of triangles."


def read_meshes(path: str | os.PathLike) -> Asset:
    """All meshes of the file, one level of detail. Raises `ExportError` for what can't be read or holds no triangle."""
    path = Path(path)
    try:
        path.open("rb").close()
        meshes = read_obj(path) if path.suffix.lower() == ".obj" else [_plain(path)]
    except OSError as error:
        raise ExportError(f"{path} can't be read: {(error.strerror or 'a texture is damaged').lower()}.", remedy="Check the path.") from error
    except Exception as error:  # trimesh raises whatever its parsers meet
        raise ExportError(f"{path} is damaged, or no {path.suffix[1:].upper()} file.", remedy=_UNREADABLE) from error
    meshes = [mesh for mesh in meshes if len(mesh.triangle)]
    if not meshes:
        raise ExportError(f"{path} holds no triangle.", remedy=_UNREADABLE)
    return Asset.of(meshes)


def _plain(path: Path) -> Mesh:
    """The one mesh of a PLY or STL, with its colours."""
    import trimesh

    piece = trimesh.load_mesh(path, process=False)
    color = None
    if piece.visual.kind == "vertex":
        share = np.array(piece.visual.vertex_colors, float) / 255.0
        color = np.column_stack([share[:, :3] ** 2.2, share[:, 3]])
    normal = np.array(piece.vertex_normals, float)
    return Mesh("wood", np.array(piece.vertices, float), normal, np.zeros((len(normal), 2)), np.array(piece.faces, np.int64), Material("wood"), color)
