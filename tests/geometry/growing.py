"""Trees for the tests of the geometry room, grown from a seed or set down by hand."""

import numpy as np

from sketchtree.skeleton import Kind, TreeSkeleton


def stick(points, radius, **columns) -> TreeSkeleton:
    """One limb through the points, the first on the ground; `radius` one number or one a point."""
    points = np.asarray(points, float)
    count = len(points)
    return TreeSkeleton.from_columns(np.arange(count) - 1, points, np.broadcast_to(radius, count), **columns)


def fork(angle_deg: float, thickness: float, children: int = 1) -> TreeSkeleton:
    """A trunk of radius 0.1 m with laterals at one node, each `thickness` times as thick, evenly round it."""
    parent, tip, limb, order, radius = [-1, 0, 1, 2], [(0, 0, 0), (0, 1, 0), (0, 2, 0), (0, 3, 0)], [0] * 4, [0] * 4, [0.1, 0.1, 0.08, 0.05]
    angle = np.radians(angle_deg)
    for child in range(children):
        azimuth = 2 * np.pi * child / children + 0.3
        step = np.array([np.sin(angle) * np.cos(azimuth), np.cos(angle), np.sin(angle) * np.sin(azimuth)])
        for k in range(1, 4):
            parent.append(1 if k == 1 else len(parent) - 1)
            tip.append(tuple(np.array([0.0, 1.0, 0.0]) + 0.5 * k * step))
            limb.append(child + 1)
            order.append(1)
            radius.append(0.1 * thickness * (1.1 - 0.2 * k))
    return TreeSkeleton.from_columns(np.array(parent), np.array(tip, float), np.array(radius), limb=np.array(limb), order=np.array(order))


def drawn(seed: int = 3, points: int = 25) -> TreeSkeleton:
    """A drawn trunk with a trembling curve and two drawn laterals."""
    rng = np.random.default_rng(seed)
    parent, tip, limb, order, curves = [-1], [np.zeros(3)], [0], [0], [np.zeros((0, 3))]

    def draw(row, direction, steps, name, level):
        for _ in range(steps):
            start = tip[row]
            end = start + direction + rng.normal(0, 0.1, 3)
            share = np.linspace(0, 1, points + 2)[1:-1, None]
            curves.append(start + share * (end - start) + rng.normal(0, 0.004, (points, 3)) + 0.05 * np.sin(np.pi * share))
            parent.append(row)
            tip.append(end)
            limb.append(name)
            order.append(level)
            row = len(parent) - 1
        return row

    draw(0, np.array([0.05, 1.0, 0.0]), 4, 0, 0)
    draw(2, np.array([0.7, 0.5, 0.2]), 3, 1, 1)
    draw(3, np.array([-0.6, 0.5, -0.3]), 2, 2, 1)
    count = np.array([len(curve) for curve in curves])
    return TreeSkeleton.from_columns(
        np.array(parent),
        np.array(tip),
        0.12 / (1.0 + np.arange(len(parent))),
        limb=np.array(limb),
        order=np.array(order),
        kind=np.full(len(parent), int(Kind.DRAWN)),
        curve_points=np.concatenate(curves),
        curve_start=np.r_[0, np.cumsum(count)],
    )


def bushy(seed: int = 0, levels: int = 3, height: float = 6.0) -> TreeSkeleton:
    """A decurrent tree of some hundred to some thousand rows."""
    rng = np.random.default_rng(seed)
    parent, tip, order, limb = [-1], [np.zeros(3)], [0], [0]

    def grow(row, direction, length, level, name, nodes):
        here = []
        for _ in range(nodes):
            direction = direction + rng.normal(0, 0.14, 3) + [0, 0.05, 0]
            direction = direction / np.linalg.norm(direction)
            parent.append(row)
            tip.append(tip[row] + direction * length / nodes)
            order.append(level)
            limb.append(name)
            row = len(parent) - 1
            here.append((row, direction))
        if level < levels:
            for rank, (node, along) in enumerate(here[2 * (level == 0) : -1]):
                azimuth, angle = rng.uniform(0, 2 * np.pi), np.radians(rng.uniform(30, 70))
                side = np.cross(along, [np.cos(azimuth), 0.3, np.sin(azimuth)])
                turned = along * np.cos(angle) + side / np.linalg.norm(side) * np.sin(angle)
                grow(node, turned, length * rng.uniform(0.35, 0.6) * (1 - 0.5 * rank / nodes), level + 1, len(parent) + 7, max(3, nodes - 1))

    grow(0, np.array([0.0, 1.0, 0.0]), height, 0, 0, 8)
    return TreeSkeleton.from_columns(np.array(parent), np.array(tip), np.full(len(parent), 0.01), order=np.array(order), limb=np.array(limb))
