"""Which leaves are made of leaflets? One function a species: the rachis runs from (0, 0) to the last leaflet's foot, the tip lies at (0, 1).

    pinnate     leaflets in pairs along the rachis and one at its end
    palmate     all from one point
    bipinnate   pinnae in pairs along the rachis, each with leaflets in pairs
"""

import numpy as np

from sketchtree.foliage.layers import blade, disc, line, paint_layers, placed
from sketchtree.foliage.outline import Curve, closed, serrate, smooth
from sketchtree.foliage.painting import Painting
from sketchtree.foliage.venation import Vein, midrib, pinnate


def horse_chestnut() -> Painting:
    """Aesculus hippocastanum: five to seven leaflets that widen towards their sudden points, from the end of a long petiole."""
    half = smooth([(0, 0), (0.022, 0.05), (0.065, 0.26), (0.145, 0.50), (0.205, 0.70), (0.185, 0.84), (0.08, 0.935), (0.02, 0.965), (0, 1)])
    outline = closed(serrate(half, 21, 0.014, double=0.3), serrate(half * [0.95, 1], 21, 0.014, double=0.3, phase=0.4))
    veins = [midrib(0.0, 0.020)] + pinnate(outline, 13, first=0.12, last=0.88, angle=52.0, bend=16.0, width=0.008)
    layers = []
    for turn, size, shade in ((118, 0.56, 0.93), (-122, 0.54, 0.95), (76, 0.76, 1.0), (-79, 0.78, 0.96), (37, 0.93, 1.03), (-39, 0.92, 1.0), (1, 1.0, 1.05)):
        layers += blade(outline, veins, (0, 0), np.radians(turn), size, shade)
    return paint_layers([*layers, line([(0, -0.62), (0, -0.3), (0, 0.03)], 0.036, 0.026), disc((0, 0), 0.026, "stem")], reticulation=0.8, seed=41)


def ash() -> Painting:
    """Fraxinus excelsior: nine to thirteen toothed lances without stalks."""
    leaflet = _leaflet(0.145, 0.42, teeth=17, depth=0.012, pairs=8)
    return _pinnate(leaflet, pairs=5, length=0.345, lean=(66.0, 44.0), rachis=0.70, petiole=0.22, seed=42, swell=(0.82, 1.0, 0.95))


def elder() -> Painting:
    """Sambucus nigra: five to seven broad, pointed, sharply toothed leaflets."""
    leaflet = _leaflet(0.235, 0.38, teeth=20, depth=0.020, pairs=7)
    return _pinnate(leaflet, pairs=2, length=0.46, lean=(66.0, 58.0), rachis=0.44, petiole=0.22, seed=43, swell=(0.85, 1.0, 1.0))


def sumac() -> Painting:
    """Rhus typhina: up to a dozen pairs of long toothed lances on a red, hairy rachis."""
    leaflet = _leaflet(0.125, 0.30, teeth=17, depth=0.016, pairs=9)
    return _pinnate(leaflet, pairs=9, length=0.29, lean=(72.0, 50.0), rachis=0.80, petiole=0.10, seed=44, swell=(0.72, 1.0, 0.72))


def rowan() -> Painting:
    """Sorbus aucuparia: six to eight pairs of oblong leaflets, toothed but for their feet."""
    leaflet = _leaflet(0.155, 0.5, teeth=13, depth=0.020, pairs=9)
    return _pinnate(leaflet, pairs=7, length=0.285, lean=(70.0, 52.0), rachis=0.76, petiole=0.14, seed=45, swell=(0.78, 1.0, 0.85))


def acacia() -> Painting:
    """Vachellia tortilis: twice pinnate, a feather of feathers, its leaflets a millimetre wide."""
    rng = np.random.default_rng(46)
    layers = []
    for rank, y in enumerate(np.linspace(0.10, 0.74, 6)):
        for side in (-1, 1):
            lean = np.radians(rng.normal(64 - 4 * rank, 3)) * side
            layers += _pinna((0, y + 0.01 * side), lean, 0.37 - 0.09 * abs(rank - 2.2) / 2.5, rng)
    layers += _pinna((0, 0.76), 0.04, 0.24, rng)
    return paint_layers([*layers, line([(0, -0.05), (0, 0.3), (0, 0.8)], 0.017, 0.010)])


def _pinna(foot, heading: float, length: float, rng) -> list:
    half = smooth([(0, 0), (0.13, 0.1), (0.20, 0.45), (0.15, 0.85), (0, 1)], 6)
    axis = placed(np.stack([0.05 * np.sin(np.linspace(0, 2, 8)), np.linspace(0, 1, 8)], axis=1), foot, heading, length)
    layers = [line(axis, 0.009, 0.005)]
    for share in np.linspace(0.10, 0.98, 13):
        at = np.array([np.interp(share, np.linspace(0, 1, 8), axis[:, k]) for k in (0, 1)])
        for side in (-1, 1):
            lean = heading + side * np.radians(rng.normal(66 - 22 * share, 4))
            layers += blade(closed(half), [], at, lean, 0.062 * (1 - 0.35 * abs(share - 0.5)), rng.normal(1.0, 0.06))
    return layers


def _leaflet(half_width: float, widest: float, *, teeth: int, depth: float, pairs: int) -> tuple[Curve, list[Vein]]:
    """A toothed, pointed leaflet, broadest at `widest`, with its veins."""
    w, m = half_width, widest
    half = smooth([(0, 0), (0.35 * w, 0.04), (0.8 * w, 0.5 * m), (w, m), (0.86 * w, m + 0.4 * (1 - m)), (0.36 * w, 0.5 + 0.37 * (1 + m) / 1.4), (0, 1)])
    outline = closed(serrate(half, teeth, depth), serrate(half * [0.94, 1], teeth, depth, phase=0.4))
    return outline, [midrib(0.0, 0.020)] + pinnate(outline, pairs, first=0.08, last=0.84, angle=54.0, bend=24.0, width=0.009)


def _pinnate(leaflet, *, pairs: int, length: float, lean, rachis: float, petiole: float, seed: int, swell) -> Painting:
    """`pairs` of leaflets, `length` long (times `swell` at the foot, middle and end of the rachis), leaning from `lean[0]` to `lean[1]` degrees."""
    rng = np.random.default_rng(seed)
    layers = []
    for share in np.linspace(0, 1, pairs):
        size, angle = length * np.interp(share, [0, 0.5, 1], swell), np.interp(share, [0, 1], lean)
        for side in (-1, 1):
            heading = side * np.radians(rng.normal(angle, 2.5))
            layers += blade(*leaflet, (0.004 * side, 0.94 * rachis * share + rng.normal(0, 0.006)), heading, size * rng.uniform(0.94, 1.04), rng.normal(1.0, 0.035))
    layers += blade(*leaflet, (0, rachis), rng.normal(0, 0.05), 1 - rachis, 1.03)
    return paint_layers([*layers, line([(0, -petiole), (0, 0), (0, 0.5 * rachis), (0, rachis)], 0.022, 0.010)], reticulation=0.7, seed=seed)
