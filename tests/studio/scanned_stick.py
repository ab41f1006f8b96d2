"""Points of a trunk and two limbs, laid behind a page."""

import numpy as np

from sketchtree.clouds.cloud import PointCloud
from sketchtree.clouds.prepared.prepare import prepare
from sketchtree.editing.laid_cloud import LaidCloud, laid

LIMBS = (((0, 0, 0), (0, 6, 0), 0.15), ((0, 3.0, 0), (1.6, 4.6, 1.2), 0.06), ((0, 4.0, 0), (-1.2, 5.4, -1.5), 0.05))  # foot, tip, radius
_EACH = 700  # points


def points() -> np.ndarray:
    """On the bark of each limb, metres."""
    chance = np.random.default_rng(0)
    found = []
    for foot, tip, radius in LIMBS:
        foot, tip = np.array(foot, float), np.array(tip, float)
        way = (tip - foot) / np.linalg.norm(tip - foot)
        side = np.cross(way, (0.3, 0.2, 1.0))
        side /= np.linalg.norm(side)
        other, turn = np.cross(way, side), chance.uniform(0, 2 * np.pi, _EACH)
        found.append(foot + chance.random((_EACH, 1)) * (tip - foot) + radius * (np.cos(turn)[:, None] * side + np.sin(turn)[:, None] * other))
    return np.concatenate(found)


def stick() -> LaidCloud:
    """The same behind an empty page."""
    return laid(prepare(PointCloud(points()), up="y"))
