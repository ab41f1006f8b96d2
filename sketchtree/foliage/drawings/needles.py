"""Which conifers bear needles, and what does a twig of theirs look like from the side?

Tuft coordinates: the twig starts at (0, 0) and the farthest needle ends near (0, 1). Needles are drawn
from back to front: those that point away are short and dark, those towards the eye short and bright.

    a needle at azimuth ψ about the twig, leaning at α, appears as  l (sin α sin ψ, cos α),
    its shade follows cos ψ (towards the eye)
"""

import numpy as np

from sketchtree.foliage.outline import Curve
from sketchtree.foliage.painting import Painting, paint_shoots
from sketchtree.foliage.venation import Vein

SPRUCE_NEEDLE, PINE_NEEDLE, STONE_PINE_NEEDLE, WHITE_PINE_NEEDLE = 0.072, 0.46, 0.62, 0.54  # needle length, tuft lengths
FIR_NEEDLE, LARCH_NEEDLE, CEDAR_NEEDLE = 0.085, 0.15, 0.13
_SIDE_SHOOTS = ((0.10, 0.34), (0.24, 0.38), (0.40, 0.34), (0.56, 0.26), (0.70, 0.17))  # foot and length, tuft lengths
_FIR_SHOOTS = ((0.16, 0.42), (0.36, 0.37), (0.55, 0.28), (0.72, 0.17))


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


def fir_spray() -> Painting:
    """Abies alba: a flat spray; the blunt needles of each shoot are combed to its two sides."""
    rng = np.random.default_rng(6)
    axes = [_shoot((0.0, 0.0), 0.0, 0.93, 0.02)]
    for rank, (foot, length) in enumerate(_FIR_SHOOTS):
        for side in (-1, 1):
            lean = np.radians(rng.normal(50.0, 3.0)) * side
            axes.append(_shoot((0.0, foot + 0.008 * side), lean, length * rng.uniform(0.92, 1.06), -0.03 * side))
    return paint_shoots([(Vein(axis, 0.012 if rank == 0 else 0.008, 0.005), _comb(axis, rng)) for rank, axis in reversed(list(enumerate(axes)))])


def pine_tuft() -> Painting:
    """Pinus sylvestris: the end of a shoot with needles in twos, spreading forward like a brush."""
    return _brush(5, count=82, together=2, length=PINE_NEEDLE, axis=0.58, width=0.0135, lean=(62.0, 18.0), bow=0.05)


def stone_pine_tuft() -> Painting:
    """Pinus pinea: long needles in twos, in loose tufts at the ends of otherwise bare shoots."""
    return _brush(7, count=66, together=2, length=STONE_PINE_NEEDLE, axis=0.40, width=0.0115, lean=(66.0, 14.0), bow=0.07)


def white_pine_tuft() -> Painting:
    """Pinus strobus: slender, soft needles in fives."""
    return _brush(8, count=44, together=5, length=WHITE_PINE_NEEDLE, axis=0.48, width=0.0075, lean=(56.0, 16.0), bow=0.09)


def larch_twig() -> Painting:
    """Larix decidua: a thin twig with soft rosettes of thirty to forty needles, each on its own short knob."""
    return _rosettes(9, count=11, needles=34, length=LARCH_NEEDLE, width=0.0085, open_to=88.0, axis=0.84)


def cedar_twig() -> Painting:
    """Cedrus: a stout twig with dense, stiff, upstanding rosettes."""
    return _rosettes(10, count=13, needles=40, length=CEDAR_NEEDLE, width=0.0115, open_to=78.0, axis=0.86)


def _brush(seed: int, *, count: int, together: int, length: float, axis: float, width: float, lean, bow: float) -> Painting:
    """`count` bundles of needles, `together` in each, round the end of a shoot `axis` long."""
    rng = np.random.default_rng(seed)
    stem = _shoot((0.0, 0.0), 0.0, axis, 0.006)
    needles = _needles(stem, rng, count=count, length=length, lean=lean, width=width, bow=bow, bare=0.06, together=together)
    return paint_shoots([(Vein(stem, 0.03, 0.015), needles)])


def _comb(axis: Curve, rng) -> list[tuple[Vein, float]]:
    """Needles to the left and right of an axis, all in its plane, hardly shorter towards its end."""
    count = int(105 * np.linalg.norm(axis[-1] - axis[0]))
    heading = np.arctan2(*(axis[-1] - axis[0]))
    found = []
    for along in np.sort(rng.uniform(0.02, 1.0, count)):
        for side in (-1, 1):
            turn = heading + side * np.radians(rng.normal(68.0 - 40.0 * along**4, 5.0))
            size = FIR_NEEDLE * rng.uniform(0.8, 1.0) * (1.0 - 0.15 * along)
            foot = np.array([np.interp(along, np.linspace(0, 1, len(axis)), axis[:, k]) for k in (0, 1)])
            path = foot + size * np.linspace(0, 1, 4)[:, None] * [np.sin(turn), np.cos(turn)]
            found.append((Vein(path, 0.0105, 0.008), float(np.clip(rng.normal(1.0, 0.10), 0.6, 1.4))))
    return found


def _rosettes(seed: int, *, count: int, needles: int, length: float, width: float, open_to: float, axis: float) -> Painting:
    """A twig with `count` rosettes; their needles open to `open_to` degrees from the knob they stand on."""
    rng = np.random.default_rng(seed)
    stem = _shoot((0.0, 0.0), 0.0, axis, 0.02)
    shoots = [(Vein(stem, 0.020, 0.012), [])]
    for rank, along in enumerate(np.r_[np.linspace(0.07, 0.93, count), 1.0]):
        foot = [np.interp(along, np.linspace(0, 1, len(stem)), stem[:, k]) for k in (0, 1)]
        side = 0.0 if along == 1.0 else rng.choice([-1, 1]) if rank % 3 == 2 else (-1) ** rank
        knob = _shoot(foot, np.radians(rng.normal(62.0, 8.0)) * side * (0.25 if rank % 3 == 2 else 1.0), 0.035, 0.0)
        tuft = _needles(knob, rng, count=needles, length=length, lean=(open_to, 6.0), width=width, bow=0.03, bare=0.0)
        shoots.append((Vein(knob, 0.016, 0.013), tuft))
    return paint_shoots(shoots)


def _shoot(foot, lean, length, bow) -> Curve:
    """A slightly bent axis from `foot`, `lean` radians from upright (positive to the right)."""
    t = np.linspace(0, 1, 12)[:, None]
    along, side = np.array([np.sin(lean), np.cos(lean)]), np.array([np.cos(lean), -np.sin(lean)])
    return np.asarray(foot) + length * (t * along + 4 * bow * t * (1 - t) * side)


def _needles(axis: Curve, rng, *, count, length, lean, width, bow, bare, together=1) -> list[tuple[Vein, float]]:
    """Needles round an axis, `together` from one foot, from back to front; `lean` is their angle from it at its foot and end (degrees)."""
    along = np.sort(bare + (1 - bare) * rng.uniform(0, 1, count) ** 0.9)
    azimuth = 2 * np.pi * rng.uniform(0, 1, count)
    if together > 1:
        along, azimuth = np.repeat(along, together), np.repeat(azimuth, together) + rng.normal(0, 0.22, count * together)
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
