"""Small trees whose growth is known, and a larger one."""

from functools import cache

import numpy as np

from sketchtree.growth.grafting import Graft
from sketchtree.keys import root_key
from sketchtree.skeleton import Kind, TreeSkeleton


def trunk_and_branch(**columns) -> TreeSkeleton:
    """A trunk of three pieces of 1 m, and a thin branch of two from the first fork, to the right."""
    tip = [[0, 0, 0], [0, 1, 0], [0, 2, 0], [0, 3, 0], [1, 1, 0], [2, 1, 0]]
    radius = [0.1, 0.09, 0.06, 0.05, 0.02, 0.01]
    return TreeSkeleton.from_columns([-1, 0, 1, 2, 1, 4], np.array(tip, float), radius, **({"limb": [0, 0, 0, 0, 1, 1], "order": [0, 0, 0, 0, 1, 1]} | columns))


def curved() -> TreeSkeleton:
    """A drawn trunk with two drawn points between its ends, and a branch with one."""
    points = np.array([[0.1, 1, 0], [0.1, 2, 0], [0.5, 3.4, 0]])
    return TreeSkeleton.from_columns(
        [-1, 0, 1], np.array([[0, 0, 0], [0, 3, 0], [1, 3.5, 0.2]]), [0.1, 0.06, 0.02], limb=[0, 0, 1], order=[0, 0, 1],
        kind=np.full(3, int(Kind.DRAWN)), stroke=[0, 0, 1], curve_points=points, curve_start=[0, 0, 2, 3],
    )  # fmt: skip


def bare_trunk() -> TreeSkeleton:
    """A trunk of ten pieces that bears six limbs of five, as a skeleton of a photo would be."""
    parent, tip, radius, limb, order = [-1], [np.zeros(3)], [0.2], [0], [0]
    for k in range(10):
        parent.append(k), tip.append(np.array([0.05 * np.sin(k), 0.5 * (k + 1), 0.0])), radius.append(0.2 - 0.016 * k), limb.append(0), order.append(0)
    for k, node in enumerate((4, 5, 6, 7, 8, 9)):
        azimuth, at = 2.4 * k, node
        for j in range(5):
            way = np.array([np.cos(azimuth), 0.7 + 0.05 * j, np.sin(azimuth)])
            parent.append(at), tip.append(tip[at] + 0.35 * way / np.linalg.norm(way)), radius.append(0.06 - 0.009 * j), limb.append(k + 1), order.append(1)
            at = len(parent) - 1
    return TreeSkeleton.from_columns(parent, np.array(tip), radius, limb=limb, order=order, kind=np.full(len(parent), int(Kind.DRAWN)))


@cache
def crown(levels: int = 2, seed: int = 0) -> TreeSkeleton:
    """The bare trunk with branches grafted on."""
    return Graft(levels)(bare_trunk(), key=root_key(seed))


def same(one: TreeSkeleton, other: TreeSkeleton) -> bool:
    """All columns are the same to the last bit."""
    return all(np.array_equal(getattr(one, name), getattr(other, name), equal_nan=True) for name in one.__dataclass_fields__)
