"""Drawings that the tests of inference share."""

import numpy as np

from sketchtree.sketch.graph import SketchGraph


def sketch(parent, xy, limb, *, tree=None, curve=None, width=None, crown=()) -> SketchGraph:
    """A sketch graph from its columns; `curve` is {row: points}."""
    n, limbs = len(parent), int(np.max(limb)) + 1
    pieces = [np.asarray((curve or {}).get(row, np.zeros((0, 2))), float) for row in range(n)]
    return SketchGraph(
        parent=np.array(parent),
        xy=np.array(xy, float),
        limb=np.array(limb),
        stroke=np.array(limb),
        tree=np.zeros(n, int) if tree is None else np.array(tree),
        width=np.full(n, np.nan) if width is None else np.array(width, float),
        joined=np.zeros(n, bool),
        curve_points=np.concatenate(pieces),
        curve_start=np.r_[0, np.cumsum([len(piece) for piece in pieces])],
        limb_id=np.arange(limbs) + 1000,
        stroke_ids=tuple(f"s{k}" for k in range(limbs)),
        crown=crown,
    )


def small_tree() -> SketchGraph:
    """A trunk of four segments, four limbs on it and one on a limb: 11 rows with a base."""
    parent = [-1, 0, 1, 2, 3, 1, 2, 2, 3, 5, 5]
    xy = [[0, 0], [1, 30], [-2, 60], [3, 85], [1, 100], [40, 60], [-35, 85], [30, 88], [-20, 105], [60, 75], [45, 85]]
    limb = [0, 0, 0, 0, 0, 1, 2, 3, 4, 1, 5]
    return sketch(parent, xy, limb)


def shrub() -> SketchGraph:
    """Four stems from the ground, a limb on one of them."""
    parent = [-1, -1, -1, -1, 0, 1, 2, 3, 5, 5, 7]
    xy = [[0, 0], [4, 1], [8, 0], [11, 0], [-30, 60], [-5, 80], [15, 85], [40, 55], [-10, 100], [10, 100], [60, 75]]
    return sketch(parent, xy, [0, 1, 2, 3, 0, 1, 2, 3, 1, 4, 3])


def lone_stroke() -> SketchGraph:
    """A zigzag without any lateral."""
    return sketch([-1, 0, 1, 2, 3], [[0, 0], [10, 30], [-10, 60], [12, 90], [-8, 120]], [0] * 5)


def random_tree(seed: int, limbs: int) -> SketchGraph:
    """A trunk and `limbs` limbs of two segments at random places."""
    rng = np.random.default_rng(seed)
    parent, xy, limb = [-1, *range(6)], [[0, 0], *([rng.normal(0, 2), 20 * k] for k in range(1, 7))], [0] * 7
    for k in range(limbs):
        at = int(rng.integers(1, len(parent)))
        start = np.array(xy[at])
        for _ in range(2):
            start = start + [rng.normal(0, 12), abs(rng.normal(8, 6))]
            xy.append(start.tolist())
            parent.append(at)
            limb.append(k + 1)
            at = len(parent) - 1
    return sketch(parent, xy, limb)
