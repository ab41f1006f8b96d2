"""What collides, in files: as numbers, and as closed meshes that game engines know by their names.

A capsule of radius r from a to b is twelve-sided: half balls of three rings each, and the bar between them.
"""

from collections.abc import Sequence

import numpy as np

from sketchtree.asset import Capsules
from sketchtree.geometry.mesh import Material, Mesh

_SIDES, _RINGS = 12, 3
_PLAIN = Material("collision")


def capsules_as_json(capsules: Capsules) -> list[dict]:
    """One object a capsule: start, end, radius in metres, and the number of its joint (null: none)."""
    rows = zip(capsules.start.tolist(), capsules.end.tolist(), capsules.radius.tolist(), capsules.joint.tolist(), strict=True)
    return [{"start": start, "end": end, "radius": radius, "joint": None if joint < 0 else joint} for start, end, radius, joint in rows]


def capsules_from_json(rows: Sequence[dict]) -> Capsules:
    """What `capsules_as_json` wrote."""
    column = lambda name, shape: np.array([row[name] for row in rows], float).reshape(shape)  # noqa: E731
    joint = np.array([-1 if row["joint"] is None else row["joint"] for row in rows], np.int64)
    return Capsules(column("start", (-1, 3)), column("end", (-1, 3)), column("radius", -1), joint)


def capsule_meshes(capsules: Capsules | None, names: Sequence[str]) -> list[Mesh]:
    """A closed mesh a name, in the capsules' order; none without capsules."""
    if capsules is None:
        return []
    return [_mesh(name, *row) for name, row in zip(names, zip(capsules.start, capsules.end, capsules.radius, strict=True), strict=False)]


def _mesh(name: str, start, end, radius) -> Mesh:
    along = end - start
    length = np.linalg.norm(along)
    up = along / length if length > 0 else np.array([0.0, 1.0, 0.0])
    side = np.cross(up, np.eye(3)[np.argmin(np.abs(up))])
    side /= np.linalg.norm(side)
    turn = 2 * np.pi * np.arange(_SIDES) / _SIDES
    round_about = np.cos(turn)[:, None] * side + np.sin(turn)[:, None] * np.cross(up, side)
    rise = np.r_[-np.pi / 2 * np.arange(_RINGS - 1, -1, -1) / _RINGS, np.pi / 2 * np.arange(_RINGS) / _RINGS]
    normal = np.cos(rise)[:, None, None] * round_about + np.sin(rise)[:, None, None] * up
    middle = np.repeat([start, end], _RINGS, axis=0)[:, None]
    normal = np.concatenate([-up[None], normal.reshape(-1, 3), up[None]])
    position = np.concatenate([start[None] - radius * up, (middle + radius * normal[1:-1].reshape(2 * _RINGS, _SIDES, 3)).reshape(-1, 3), end[None] + radius * up])
    return Mesh(name, position, normal, np.zeros((len(position), 2)), _triangles(), _PLAIN)


def _triangles():
    """Counter-clockwise seen from outside: the cap below, the bands, the cap above."""
    here = np.arange(_SIDES)
    there, last = (here + 1) % _SIDES, 2 * _RINGS * _SIDES + 1
    below = np.stack([np.zeros_like(here), 1 + there, 1 + here], axis=1)
    ring = 1 + _SIDES * np.arange(2 * _RINGS - 1)[:, None]
    a, b, c, d = ring + here, ring + there, ring + there + _SIDES, ring + here + _SIDES
    bands = np.concatenate([np.stack([a, b, c], axis=2).reshape(-1, 3), np.stack([a, c, d], axis=2).reshape(-1, 3)])
    top = last - _SIDES
    above = np.stack([top + here, top + there, np.full_like(here, last)], axis=1)
    return np.concatenate([below, bands, above])
