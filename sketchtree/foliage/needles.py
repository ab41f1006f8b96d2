"""What does a twig with needles look like from the side?

Tuft coordinates: the twig starts at (0, 0) and the farthest needle ends near (0, 1). Needles are drawn
from back to front: those that point away are short and dark, those towards the eye short and bright.

    a needle at azimuth ψ about the twig, leaning at α, appears as  l (sin α sin ψ, cos α),
    its shade follows cos ψ (towards the eye)
"""

import numpy as np

from sketchtree.foliage.outline import Curve
from sketchtree.foliage.painting import Painting, paint_shoots
from sketchtree.foliage.venation import Vein

SPRUCE_NEEDLE, PINE_NEEDLE = 0.072, 0.46  # needle length, tuft lengths
_SIDE_SHOOTS = ((0.10, 0.34), (0.24, 0.38), (0.40, 0.34), (0.56, 0.26), (0.70, 0.17))  # foot and length, tuft lengths


def spruce_tuft() -> Painting:
    """The end of a branch: a shoot and its side shoots, with short stiff needles all round each."""
    rng = np.random.default_rng(3)
    axes = [_shoot((0.0, 0.0), 0.0, 0.95, 0.03)]
    for rank, (foot, length) in enumerate(_SIDE_SHOOTS):
        for side in (-1, 1):
            lean = np.radians(rng.normal(44.0, 4.0)) * side
            at = foot + 0.03 * side * (-1) ** rank
            axes.append(_shoot((0.0, at), lean, length * rng.uniform(0.85, 1.1), -0.05 * side))
    shoots = []
    for rank, axis in reversed(list(enumerate(axes))):
        count = int(330 * np.linalg.norm(axis[-1] - axis[0]))
        needles = _needles(axis, rng, count=count, length=SPRUCE_NEEDLE, lean=(62.0, 36.0), width=0.0082, bow=0.015, bare=0.0)
        shoots.append((Vein(axis, 0.013 if rank == 0 else 0.009, 0.005), needles))
    return paint_shoots(shoots)


def pine_tuft() -> Painting:
    """The end of a shoot with long needles in pairs, spreading forward like a brush."""
    rng = np.random.default_rng(5)
    axis = _shoot((0.0, 0.0), 0.0, 0.58, 0.006)
    needles = _needles(axis, rng, count=165, length=PINE_NEEDLE, lean=(62.0, 18.0), width=0.0135, bow=0.05, bare=0.06)
    return paint_shoots([(Vein(axis, 0.03, 0.015), needles)])


def _shoot(foot, lean, length, bow) -> Curve:
    """A slightly bent axis from `foot`, `lean` radians from upright (positive to the right)."""
    t = np.linspace(0, 1, 12)[:, None]
    along, side = np.array([np.sin(lean), np.cos(lean)]), np.array([np.cos(lean), -np.sin(lean)])
    return np.asarray(foot) + length * (t * along + 4 * bow * t * (1 - t) * side)


def _needles(axis: Curve, rng, *, count, length, lean, width, bow, bare) -> list[tuple[Vein, float]]:
    """Needles round an axis, from back to front; `lean` is their angle from it at its foot and end (degrees)."""
    along = np.sort(bare + (1 - bare) * rng.uniform(0, 1, count) ** 0.9)
    azimuth = 2 * np.pi * rng.uniform(0, 1, count)
    heading = np.arctan2(*np.diff(axis[[0, -1]], axis=0)[0])
    foot = np.stack([np.interp(along, np.linspace(0, 1, len(axis)), axis[:, k]) for k in (0, 1)], axis=1)
    order = np.argsort(np.cos(azimuth), kind="stable")
    return [_needle(foot[i], heading, along[i], azimuth[i], rng, length, lean, width, bow) for i in order]


def _needle(foot, heading, along, azimuth, rng, length, lean, width, bow) -> tuple[Vein, float]:
    angle = np.radians(lean[0] + (lean[1] - lean[0]) * along + rng.normal(0, 6))
    size = length * rng.uniform(0.8, 1.0) * (1.0 if along < 0.9 else 0.85)
    x, y = size * np.sin(angle) * np.sin(azimuth), size * np.cos(angle)
    reach = np.array([x * np.cos(heading) + y * np.sin(heading), y * np.cos(heading) - x * np.sin(heading)])
    t = np.linspace(0, 1, 6)[:, None]
    side = np.array([reach[1], -reach[0]]) * (bow * np.sign(np.sin(azimuth)))
    path = foot + t * reach - 4 * t * (1 - t) * side
    shade = 0.96 + 0.30 * np.cos(azimuth) + rng.normal(0, 0.08)
    return Vein(path, width, 0.45 * width), float(np.clip(shade, 0.5, 1.5))
