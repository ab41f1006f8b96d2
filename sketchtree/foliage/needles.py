"""What does a twig with needles look like from the side?

Tuft coordinates: the twig starts at (0, 0) and the farthest needle ends near (0, 1). Needles are drawn
from back to front: those that point away are short and dark, those towards the eye short and bright.

    a needle at azimuth ψ about the twig, leaning at α, appears as  l (sin α sin ψ, cos α),
    its shade follows cos ψ (towards the eye)
"""

import numpy as np

from sketchtree.foliage.painting import Painting, paint_needles
from sketchtree.foliage.venation import Vein

SPRUCE_NEEDLE, PINE_NEEDLE = 0.19, 0.46  # needle length, tuft lengths


def spruce_tuft() -> Painting:
    """A piece of twig with short stiff needles all round, parted a little below."""
    return _tuft(axis=0.86, count=300, length=SPRUCE_NEEDLE, lean=(62.0, 38.0), width=0.0165, bow=0.015, bare=0.0, twig=0.024, seed=3)


def pine_tuft() -> Painting:
    """The end of a shoot with long needles in pairs, spreading forward like a brush."""
    return _tuft(axis=0.58, count=150, length=PINE_NEEDLE, lean=(62.0, 18.0), width=0.0135, bow=0.05, bare=0.06, twig=0.03, seed=5)


def _tuft(*, axis, count, length, lean, width, bow, bare, twig, seed) -> Painting:
    """`axis` is the twig's length, `lean` the needles' angle from it at its foot and its end (degrees)."""
    rng = np.random.default_rng(seed)
    along = np.sort(bare + (1 - bare) * rng.uniform(0, 1, count) ** 0.9)
    azimuth = 2 * np.pi * rng.uniform(0, 1, count)
    order = np.argsort(np.cos(azimuth), kind="stable")
    needles = [_needle(along[i], azimuth[i], rng, axis, length, lean, width, bow) for i in order]
    y = np.linspace(0, axis, 12)
    stem = Vein(np.stack([0.006 * np.sin(5 * y), y], axis=1), twig, 0.5 * twig)
    return paint_needles([stem], needles)


def _needle(along, azimuth, rng, axis, length, lean, width, bow) -> tuple[Vein, float]:
    angle = np.radians(lean[0] + (lean[1] - lean[0]) * along + rng.normal(0, 6))
    size = length * rng.uniform(0.8, 1.0) * (1.0 if along < 0.9 else 0.85)
    reach = size * np.array([np.sin(angle) * np.sin(azimuth), np.cos(angle)])
    t = np.linspace(0, 1, 6)[:, None]
    side = np.array([reach[1], -reach[0]]) * (bow * np.sign(np.sin(azimuth)))
    path = np.array([0.0, along * axis]) + t * reach - 4 * t * (1 - t) * side
    shade = 0.96 + 0.30 * np.cos(azimuth) + rng.normal(0, 0.08)
    return Vein(path, width, 0.45 * width), float(np.clip(shade, 0.5, 1.5))
