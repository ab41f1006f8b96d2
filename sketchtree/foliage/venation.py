"""Where do a leaf's veins run?

A vein is a polyline in blade coordinates with the width at its two ends. Laterals leave the midrib at an
angle and bend towards the tip until they meet the margin.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float

from sketchtree.foliage.outline import Curve, inside


@dataclass(frozen=True, eq=False)
class Vein:
    """One vein. Blade lengths; the width tapers evenly from `start_width` to `end_width`."""

    path: Float[np.ndarray, "point 2"]
    start_width: float
    end_width: float


def midrib(petiole: float, width: float) -> Vein:
    """The petiole and the midrib as one, from the wood to the tip."""
    y = np.linspace(-petiole, 0.97, 24)
    return Vein(np.stack([np.zeros_like(y), y], axis=1), width, 0.15 * width)


def pinnate(outline: Curve, pairs: int, *, first: float, last: float, angle: float, bend: float, width: float) -> list[Vein]:
    """Laterals in near-opposite pairs from `first` to `last` on the midrib (blade lengths), leaving at
    `angle` degrees and turning `bend` degrees towards the tip on their way to the margin."""
    veins = []
    for rank, y in enumerate(np.linspace(first, last, pairs)):
        for side, shift in ((1, 0.0), (-1, 0.4 * (last - first) / pairs)):
            lean = angle - 14.0 * rank / max(pairs - 1, 1)
            path = _to_margin(outline, (0.0, y + shift), side, lean, bend)
            if len(path) > 2:
                veins.append(Vein(path, width * (1 - 0.4 * rank / pairs), 0.25 * width))
    return veins


def reaching(ends: list[tuple[float, float, float]], width: float, *, bow: float = 0.06) -> list[Vein]:
    """Veins to given places, such as the tips of lobes: (y on the midrib, x, y of the end), and mirrored."""
    veins = []
    for start, x, y in ends:
        t = np.linspace(0, 1, 16)[:, None]
        for side in (1, -1):
            a, b = np.array([0.0, start]), np.array([side * x, y])
            normal = np.array([side * (b - a)[1], -side * (b - a)[0]])
            veins.append(Vein(a + t * (b - a) + 4 * bow * t * (1 - t) * normal, width, 0.25 * width))
    return veins


def branching(outline: Curve, vein: Vein, pairs: int, *, angle: float, width: float) -> list[Vein]:
    """Laterals on both sides of another vein: what fills the lobes of a palmate leaf."""
    veins = []
    heading = vein.path[-1] - vein.path[0]
    heading = np.arctan2(heading[0], heading[1])
    for t in np.linspace(0.25, 0.85, pairs):
        origin = vein.path[int(t * (len(vein.path) - 1))]
        for side in (1, -1):
            path = _to_margin(outline, origin, side, angle, 12.0, heading=heading)
            if len(path) > 2:
                veins.append(Vein(path, width, 0.3 * width))
    return veins


def parallel(count: int, half_width: float) -> list[Vein]:
    """Veins side by side from the joint to the tip, as in a palm's leaflet."""
    y = np.linspace(0, 1, 30)
    spread = np.sin(np.pi * np.clip(y, 0.02, 1.0) ** 0.7)
    offsets = np.linspace(-0.85, 0.85, count) * half_width
    return [Vein(np.stack([x * spread, y], axis=1), 0.003, 0.002) for x in offsets]


def _to_margin(outline, origin, side, angle, bend, *, heading=0.0) -> Curve:
    """The polyline from `origin` that leaves `heading` by `angle` degrees and stops short of the margin."""
    step = 0.015
    turn = heading + side * np.radians(angle - bend * np.linspace(0, 1, 60))
    path = np.asarray(origin) + np.cumsum(step * np.stack([np.sin(turn), np.cos(turn)], axis=1), axis=0)
    out = np.flatnonzero(~inside(path, outline))
    path = path[: out[0] if len(out) else len(path)]
    return np.vstack([origin, path[: max(1, int(0.96 * len(path)))]])
