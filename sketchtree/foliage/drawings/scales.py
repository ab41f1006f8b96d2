"""Which conifers bear scales? Sprays of cord-like shoots, tuft coordinates: the twig starts at (0, 0), the farthest shoot ends near (0, 1).

A shoot is a string of small rhombic scales; side shoots alternate, the lower ones longer and branched again.
"""

import numpy as np

from sketchtree.foliage.layers import Layer, line, paint_layers, placed
from sketchtree.foliage.outline import Curve
from sketchtree.foliage.painting import Painting

_SCALE = np.array([[0, -0.25], [0.5, 0.25], [0.32, 0.75], [0, 1.15], [-0.32, 0.75], [-0.5, 0.25]])


def cypress_spray() -> Painting:
    """Cupressus sempervirens: a plume of thin four-ranked cords, all held upright."""
    return _spray(51, side_shoots=17, lean=30.0, longest=0.42, thick=0.025, twigs=5)


def juniper_spray() -> Painting:
    """Juniperus chinensis: short blunt cords in dense, irregular clumps."""
    return _spray(52, side_shoots=17, lean=44.0, longest=0.40, thick=0.034, twigs=6)


def _spray(seed: int, *, side_shoots: int, lean: float, longest: float, thick: float, twigs: int) -> Painting:
    rng = np.random.default_rng(seed)
    stem = _bowed((0, 0), 0.0, 0.93, 0.02)
    layers: list[Layer] = [line(stem[: 2 * len(stem) // 3], 0.022, 0.012)]
    for rank, share in enumerate(np.linspace(0.05, 0.93, side_shoots)):
        side = (-1) ** rank
        length = longest * (1 - 0.62 * share) * rng.uniform(0.85, 1.15)
        shoot = _bowed(_at(stem, share), side * np.radians(rng.normal(lean, 5)), length, -0.05 * side)
        for twig, place in enumerate(np.linspace(0.25, 0.85, twigs)):
            turn = side * (-1) ** twig * np.radians(rng.normal(0.8 * lean, 6))
            heading = np.arctan2(*(shoot[-1] - shoot[0])) + turn
            layers += _cord(_bowed(_at(shoot, place), heading, length * (0.50 - 0.25 * place), -0.04 * side), 0.8 * thick, rng)
        layers += _cord(shoot, thick, rng)
    return paint_layers(layers + _cord(stem[len(stem) // 2 :], thick, rng))


def _cord(path: Curve, thick: float, rng) -> list[Layer]:
    """Overlapping scales along a path, from its foot to its tip."""
    count = max(3, int(np.linalg.norm(np.diff(path, axis=0), axis=1).sum() / (0.72 * thick)))
    heading = np.arctan2(*(path[-1] - path[0]))
    shade = rng.normal(1.0, 0.08)
    return [
        Layer(placed(_SCALE, _at(path, share), heading, thick * (1.25 - 0.45 * share)), "blade", float(np.clip(rng.normal(shade, 0.10), 0.6, 1.4)))
        for share in np.linspace(0, 1, count)
    ]


def _bowed(foot, heading: float, length: float, bow: float) -> Curve:
    t = np.linspace(0, 1, 12)
    return placed(np.stack([4 * bow * t * (1 - t), t], axis=1), foot, heading, length)


def _at(path: Curve, share: float) -> Curve:
    return np.array([np.interp(share, np.linspace(0, 1, len(path)), path[:, k]) for k in (0, 1)])
