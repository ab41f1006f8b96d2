"""How do short shoots, the thin stems that bear leaves on old wood, become triangles? As three-sided tapering tubes in the texture's petiole."""

from typing import NamedTuple

import numpy as np
from jaxtyping import Float, Int

from sketchtree.foliage.card_shape import foot_of
from sketchtree.foliage.flowers.atlas import STEM
from sketchtree.foliage.leaves import Leaves
from sketchtree.foliage.models import leaf_painting
from sketchtree.foliage.twigs import level_side

_STEM = 0.018  # radius of a short shoot at its foot, leaf sizes
_TAPER = 0.4  # of it, at its tip
_J = np.arange(3)
_TURN = 2 * np.pi * _J / 3
SIDES = np.vstack([np.stack([_J, (_J + 1) % 3, (_J + 1) % 3 + 3], axis=1), np.stack([_J, (_J + 1) % 3 + 3, _J + 3], axis=1)])
"""Triangles of one tube: its foot's corners are 0-2, its tip's 3-5."""


class Stems(NamedTuple):
    """The tubes, six vertices and six triangles each."""

    position: Float[np.ndarray, "vertex 3"]
    normal: Float[np.ndarray, "vertex 3"]
    uv: Float[np.ndarray, "vertex 2"]
    triangle: Int[np.ndarray, "triangle 3"]


class StemFrames(NamedTuple):
    """Where each stands: a tube of length 1 and radius 1 along y, scaled by (radius, length, radius), turned and brought there."""

    start: Float[np.ndarray, "shoot 3"]
    axes: Float[np.ndarray, "shoot 3 3"]  # rows: what x, y and z of the unit tube become
    length: Float[np.ndarray, " shoot"]
    radius: float


def stem_frames(leaves: Leaves) -> StemFrames:
    """The short shoots' places."""
    start, span = leaves.shoot[:, 0], leaves.shoot[:, 1] - leaves.shoot[:, 0]
    length = np.linalg.norm(span, axis=1)
    along = span / np.maximum(length, 1e-12)[:, None]
    side = level_side(along)
    radius = _STEM * (float(np.median(leaves.size)) if len(leaves) else 0.0)
    return StemFrames(start, np.stack([side, along, np.cross(side, along)], axis=1), length, radius)


def unit_stem(model: str) -> Stems:
    """One tube along y, of length 1 and radius 1 at its foot."""
    ring = np.stack([np.cos(_TURN), np.zeros(3), -np.sin(_TURN)], axis=1)
    painting = leaf_painting(model)
    u = -painting.left / (painting.right - painting.left) + 0.002 * (np.tile(_J, 2) - 1)
    foot = (painting.top - foot_of(painting)) / (painting.top - painting.bottom)
    v = foot - np.repeat([0.012, 0.024], 3)
    position = np.vstack([ring, _TAPER * ring + [0, 1, 0]])
    return Stems(position, np.tile(ring, (2, 1)), np.stack([u, v], axis=1), SIDES)


def spike(model: str) -> Stems:
    """The tube in three triangles: as wide in the middle, thick at the foot and pointed at the tip."""
    tube = unit_stem(model)
    position = np.vstack([(1 + _TAPER) * tube.position[:3], [[0.0, 1.0, 0.0]]])
    normal = np.vstack([tube.normal[:3], [[0.0, 1.0, 0.0]]])
    return Stems(position, normal, np.vstack([tube.uv[:3], tube.uv[3:4]]), np.stack([_J, (_J + 1) % 3, np.full(3, 3)], axis=1))


def sliver(model: str) -> Stems:
    """The tube in one triangle: from a random side as wide as the tube on average, which is 2 / π of what it is from its own."""
    tube = unit_stem(model)
    wide = 0.5 * np.pi * (1 + _TAPER)
    position = np.array([[-wide, 0.0, 0.0], [wide, 0.0, 0.0], [0.0, 1.0, 0.0]])
    return Stems(position, np.tile([[0.0, 0.0, 1.0]], (3, 1)), tube.uv[[0, 1, 3]], np.array([[0, 1, 2]]))


STEMS = {6: unit_stem, 3: spike, 1: sliver}
"""Shapes of a stem by their triangles."""


def on_petals(stem: Stems) -> Stems:
    """The same in the stem's patch of a flower's texture (`flowers.atlas`)."""
    return stem._replace(uv=np.tile(STEM, (len(stem.uv), 1)))


def stems(leaves: Leaves, first: int, triangles: int = 6) -> Stems:
    """All stems, each of so many triangles (6, 3 or 1); `first` is the number of their first vertex."""
    one, at = STEMS[triangles](leaves.model), stem_frames(leaves)
    count, corners = len(at.start), len(one.position)
    scale = np.stack([np.full(count, at.radius), at.length, np.full(count, at.radius)], axis=1)
    position = at.start[:, None] + np.einsum("svi,sij->svj", scale[:, None] * one.position, at.axes)
    return Stems(
        position.reshape(-1, 3),
        np.einsum("vi,sij->svj", one.normal, at.axes).reshape(-1, 3),
        np.tile(one.uv, (count, 1)),
        (first + one.triangle[None] + corners * np.arange(count)[:, None, None]).reshape(-1, 3),
    )
