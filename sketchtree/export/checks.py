"""Can these numbers stand in a file? Checked at the door of every writer."""

import re

import numpy as np

from sketchtree.asset import Armature, Asset
from sketchtree.axes import NULL
from sketchtree.errors import ExportError
from sketchtree.geometry.instances import Instances
from sketchtree.geometry.mesh import Mesh

_STRAY = "Check the skeleton it was made from for stray points."


def check_asset(asset: Asset) -> None:
    """Raises `ExportError` where a number of its parts or bones is not finite."""
    for level in asset.levels:
        for part in level.parts:
            check_mesh(part.mesh if isinstance(part, Instances) else part)
            if isinstance(part, Instances):
                check_places(part)
    if asset.armature is not None:
        check_bones(asset.armature)


def check_mesh(mesh: Mesh) -> None:
    """Raises `ExportError` where a number is not finite, or a column has a name that glTF does not know."""
    columns = {name: getattr(mesh, name) for name in ("position", "normal", "uv", "color")} | dict(mesh.extra)
    for name, column in columns.items():
        if not _finite(column):
            raise ExportError(f"The {name} of a vertex of mesh `{mesh.name}` is not a finite number.", remedy=_STRAY)
    for name in mesh.extra:
        if not re.fullmatch(r"(COLOR|TEXCOORD|JOINTS|WEIGHTS)_\d+|_[A-Z0-9_]+", name):
            raise ExportError(f"Mesh `{mesh.name}` has a column `{name}` that glTF has no name for.", remedy="Begin names of your own with `_`, in capitals.")


def check_places(places: Instances) -> None:
    """Raises `ExportError` where a number of a place is not finite."""
    for name in ("translation", "rotation", "scale", "color"):
        column = getattr(places, name)
        if not _finite(column):
            raise ExportError(f"The {name} of a place of `{places.name}` is not a finite number.", remedy=_STRAY)


def check_bones(bones: Armature) -> None:
    """Raises `ExportError` where a number is not finite, or a parent stands after its child."""
    if not all(_finite(column) for column in (bones.position, bones.rotation, bones.length)):
        raise ExportError("A bone's place, turn or length is not a finite number.", remedy=_STRAY)
    if len(bones) == 0 or bones.parent[0] != NULL or (bones.parent[1:] < 0).any() or (bones.parent >= np.arange(len(bones))).any():
        raise ExportError("The bones are no tree with one root that stands first.", remedy="Put every bone after its parent.")


def _finite(column) -> bool:
    """Are all its numbers finite? A finite sum says so at once."""
    return column is None or bool(np.isfinite(np.sum(column)) or np.isfinite(column).all())
