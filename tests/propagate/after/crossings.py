"""Small trees whose branches cross, for the tests of this room."""

import numpy as np

from sketchtree.skeleton import Kind, TreeSkeleton


def post_with(*limbs, height=6.0, radius=0.02, thick=0.05) -> TreeSkeleton:
    """A drawn post with a node every metre, and limbs on it: each (height of its node, its points, the kind of its rows)."""
    nodes = int(height)
    parent, tip, limb, order, kind = [-1, *range(nodes)], [[0, y, 0] for y in range(nodes + 1)], [1] * (nodes + 1), [0] * (nodes + 1), []
    kind = [int(Kind.DRAWN)] * (nodes + 1)
    for number, (at, points, of_kind) in enumerate(limbs):
        above = at
        for point in points:
            parent.append(above)
            above = len(parent) - 1
            tip.append(point)
            limb.append(100 + number)
            order.append(1)
            kind.append(int(of_kind))
    wood = np.where(np.array(order) == 0, thick, radius)
    stroke = np.where(np.array(kind) == Kind.PROPAGATED, -1, np.array(limb))
    return TreeSkeleton.from_columns(parent, np.array(tip, float), wood, limb=limb, order=order, kind=kind, stroke=stroke)


def twig(at, *points):
    """An undrawn limb."""
    return at, points, Kind.PROPAGATED


def drawn(at, *points):
    """A drawn limb."""
    return at, points, Kind.DRAWN


def crossing(depth=0.0, other=twig) -> TreeSkeleton:
    """A long limb straight out at 3 m, and a shorter one from 2 m that crosses it, `depth` metres behind."""
    return post_with(other(3, [1.2, 3, 0], [2, 3, 0], [3, 3, 0]), twig(2, [0.5, 2.4, depth], [1.5, 3.6, depth]))
