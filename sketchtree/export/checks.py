"""Can these numbers stand in a file? Checked at the door of every writer."""

import re

import numpy as np

from sketchtree.asset import Animation, Armature, Asset, Keys, Morph
from sketchtree.axes import NULL
from sketchtree.errors import ExportError
from sketchtree.geometry.instances import Instances
from sketchtree.geometry.mesh import Mesh

_STRAY = "Check the skeleton it was made from for stray points."
_MADE = "Make the animation anew (`sketchtree grow`)."
_CHANNELS = {"translation": 3, "rotation": 4, "scale": 3}


def check_asset(asset: Asset) -> None:
    """Raises `ExportError` where a number of its parts or bones is not finite, or its animation can't be played."""
    for level in asset.levels:
        for part in level.parts:
            check_mesh(part.mesh if isinstance(part, Instances) else part)
            if isinstance(part, Instances):
                check_places(part)
    if asset.armature is not None:
        check_bones(asset.armature)
        for part in (part for level in asset.levels for part in level.parts if not isinstance(part, Instances)):
            _check_joints(part, len(asset.armature))
    if asset.animation is not None:
        check_animation(asset.animation, asset)


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


def check_animation(animation: Animation, asset: Asset) -> None:
    """Raises `ExportError` where it moves what is not there, its times don't rise, or a number is not finite."""
    if asset.armature is None:
        raise ExportError(f"The animation `{animation.name}` moves joints, and there are no bones.", remedy=_MADE)
    for path, channels in _CHANNELS.items():
        _check_keys(getattr(animation, path), path, channels, len(asset.armature))
    moved = [morph.part for morph in animation.morphs]
    for morph in animation.morphs:
        _check_morph(morph, asset.parts)
    if len(set(moved)) < len(moved):
        raise ExportError("A mesh has more than one morph.", remedy=_MADE)


def _check_joints(mesh: Mesh, bones: int) -> None:
    joint = mesh.extra.get("JOINTS_0")
    if joint is not None and joint.size and not 0 <= joint.min() <= joint.max() < bones:
        raise ExportError(f"A vertex of mesh `{mesh.name}` goes with a joint that is not among the {bones} bones.", remedy=_MADE)


def _check_keys(keys: Keys, path: str, channels: int, bones: int) -> None:
    tracks, count = len(keys.joint), len(keys.time)
    if len(keys.start) != tracks + 1 or keys.start[0] != 0 or keys.start[-1] != count or (np.diff(keys.start) < 1).any() or np.shape(keys.value) != (count, channels):
        raise ExportError(f"The tracks of the animation's {path} don't fit its {count:,} keys.", remedy=_MADE)
    if tracks and not 0 <= keys.joint.min() <= keys.joint.max() < bones:
        raise ExportError(f"The animation's {path} moves a joint that is not among the {bones} bones.", remedy=_MADE)
    if len(np.unique(keys.joint)) < tracks:
        raise ExportError(f"The animation's {path} has two tracks for one joint.", remedy=_MADE)
    if not (_finite(keys.time) and _finite(keys.value)):
        raise ExportError(f"A key of the animation's {path} is not a finite number.", remedy=_MADE)
    follows = np.ones(count, bool)
    follows[keys.start[:-1]] = False
    if (keys.time < 0).any() or (np.diff(keys.time, prepend=0.0)[follows] <= 0).any():
        raise ExportError(f"The times of the animation's {path} don't rise from 0 on.", remedy=_MADE)


def _check_morph(morph: Morph, parts: tuple) -> None:
    if not 0 <= morph.part < len(parts) or isinstance(parts[morph.part], Instances):
        raise ExportError(f"A morph is of part {morph.part}, and there is no such mesh.", remedy=_MADE)
    mesh = parts[morph.part]
    if np.shape(morph.offset) != mesh.position.shape:
        raise ExportError(f"The morph of mesh `{mesh.name}` moves {len(morph.offset):,} vertices, and there are {len(mesh.position):,}.", remedy=_MADE)
    if not (_finite(morph.offset) and _finite(morph.time) and _finite(morph.weight)):
        raise ExportError(f"A number of the morph of mesh `{mesh.name}` is not finite.", remedy=_MADE)
    if len(morph.time) == 0 or len(morph.time) != len(morph.weight) or morph.time[0] < 0 or (np.diff(morph.time) <= 0).any():
        raise ExportError(f"The times of the morph of mesh `{mesh.name}` don't rise from 0 on, a weight each.", remedy=_MADE)


def _finite(column) -> bool:
    """Are all its numbers finite? A finite sum says so at once."""
    return column is None or bool(np.isfinite(np.sum(column)) or np.isfinite(column).all())
