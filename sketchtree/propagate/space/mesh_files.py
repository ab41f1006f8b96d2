"""What mesh is in this file?

Any file that trimesh reads (.glb .gltf .obj .ply .stl .off …). A scene of several meshes becomes one, every part where its
transforms put it. World frame: metres, y up, the trunk's root at the origin.
"""

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from sketchtree.errors import OptionError

if TYPE_CHECKING:
    import trimesh

_REMEDY = "Give a mesh file (.glb, .obj, .ply or .stl), in metres, y up, with the trunk's root at the origin."
_SHOWN = 100  # characters of another program's message


def read_mesh(path: str | Path) -> "trimesh.Trimesh":
    """The triangles of a file, corners that coincide made one; `metadata["name"]` is the file's name.

    Raises OptionError for a file that is missing, unreadable, without triangles or with coordinates that are not finite."""
    import trimesh

    path = Path(path)
    if not path.is_file():
        raise OptionError(f"There is no mesh file {path}.", remedy="Check the path.")
    try:
        parts = trimesh.load_scene(path, process=False).dump()
    except Exception as error:  # whatever a reader of a foreign format stumbles over
        said = " ".join(str(error).split())[:_SHOWN] or type(error).__name__
        raise OptionError(f"{path.name} can't be read as a mesh ({said}).", remedy=_REMEDY) from None
    meshes = [part for part in parts if isinstance(part, trimesh.Trimesh) and len(part.faces)]
    if not meshes:
        raise OptionError(f"{path.name} holds no triangles.", remedy=_REMEDY)
    return _joined(meshes, path.name)


def _joined(meshes, name: str) -> "trimesh.Trimesh":
    import trimesh

    first = np.cumsum([0] + [len(mesh.vertices) for mesh in meshes])
    point = np.concatenate([mesh.vertices for mesh in meshes])
    face = np.concatenate([mesh.faces + start for mesh, start in zip(meshes, first[:-1], strict=True)])
    if not np.isfinite(point[face]).all():
        raise OptionError(f"{name} has corners that are not finite numbers.", remedy="Export the mesh again, or repair it.")
    joined = trimesh.Trimesh(point, face, process=True)
    joined.metadata["name"] = name
    return joined
