"""How are catkins drawn? They hang from (0, 0) to (0, 1): the tuft's own direction, which gravity bends down, runs along them.

Each is a cord of bracts in close spirals, yellow anthers (veins) between brown bracts (blades).
"""

import numpy as np

from sketchtree.foliage.layers import Layer, disc, line, paint_layers, placed
from sketchtree.foliage.painting import Painting

_BRACT = np.array([[-0.6, 0.0], [0.6, 0.0], [0.75, 0.5], [0.0, 1.0], [-0.75, 0.5]])


def hazel_catkin() -> Painting:
    """Corylus: two to four limp yellow tassels."""
    return _bunch(71, [(-0.10, -7.0, 0.88), (0.09, 6.0, 0.95), (0.0, 0.0, 0.80)], thick=0.060, anthers=0.75)


def birch_catkin() -> Painting:
    """Betula: slender tassels in twos at the ends of twigs."""
    return _bunch(72, [(-0.05, -6.0, 0.92), (0.05, 5.0, 0.84)], thick=0.052, anthers=0.5)


def alder_catkin() -> Painting:
    """Alnus: three to five long purple-brown tassels, and beside them last year's small black cones."""
    return _bunch(73, [(-0.11, -8.0, 0.80), (0.10, 7.0, 0.93), (0.02, 1.0, 0.85)], thick=0.058, anthers=0.35, cones=3)


def willow_catkin() -> Painting:
    """Salix: short upright cylinders, bristling with anthers."""
    return _bunch(74, [(0.0, 0.0, 0.94)], thick=0.125, anthers=1.6)


def _bunch(seed: int, tassels, *, thick: float, anthers: float, cones: int = 0) -> Painting:
    """`tassels` are (offset of the foot, lean in degrees, length); `anthers` so many a bract."""
    rng = np.random.default_rng(seed)
    layers: list[Layer] = [line([(0, 0), (0, 0.04), (0, 0.1)], 0.022, 0.018)]
    for k in range(cones):
        x = (-1) ** k * (0.13 + 0.05 * k)
        layers += [line([(0, 0.02), (0.5 * x, 0.05), (x, 0.11)], 0.010, 0.008), disc((x, 0.15), 0.055, "stem", 0.55, 1.25)]
    for offset, lean, length in tassels:
        layers.append(line([(0, 0), (0.6 * offset, 0.03), (offset, 0.07)], 0.014, 0.012))
        layers += _tassel((offset, 0.07), np.radians(lean), length - 0.07, thick, anthers, rng)
    return paint_layers(layers)


def _tassel(foot, heading: float, length: float, thick: float, anthers: float, rng) -> list[Layer]:
    layers = []
    rows = int(length / (0.33 * thick))
    for row, share in enumerate(np.linspace(1, 0, rows)):
        wide = thick * np.clip(4 * min(share + 0.10, 1.06 - share), 0.3, 1) / 2
        for side in (-0.6, 0.6, 0.0) if row % 2 else (-0.85, 0.85, -0.3, 0.3):
            at = placed(np.array([[side * wide, share * length]]), foot, heading, 1.0)[0]
            layers.append(Layer(placed(_BRACT, at, heading + 0.6 * side, 0.36 * thick), "blade", float(rng.normal(1.0, 0.12))))
            for _ in range(rng.poisson(anthers)):
                out = at + thick * rng.normal(0, 0.10, 2) + [0.38 * anthers * side * wide, 0.0]
                layers.append(disc(out, 0.11 * thick, "vein", float(rng.normal(1.0, 0.1))))
    return layers
