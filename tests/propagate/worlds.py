"""Small drawn trees for the tests of this room."""

import numpy as np

from sketchtree import limb_ids
from sketchtree.axes import NULL
from sketchtree.parameters import GENERIC, Habit
from sketchtree.skeleton import Kind, TreeSkeleton

HABIT = Habit(height=10.0, lateral_spacing=0.4, twig_length=0.3, max_order=4)
THETA = GENERIC


def drawn_tree(limbs=6, seed=0, height=8.0, curved=True) -> TreeSkeleton:
    """A trunk of `height` metres with limbs up it, one more per `limbs`; limb i is the same whatever `limbs` is.

    Rows: the base, the trunk's segments from junction to junction, then two segments a limb.
    """
    rng = np.random.default_rng(seed)
    slots = 12
    levels = height * (0.35 + 0.6 * (np.arange(slots) + 0.5) / slots)
    azimuth = rng.uniform(0, 2 * np.pi, slots)
    length = rng.uniform(1.5, 3.0, slots)
    used = np.sort(rng.permutation(slots)[: min(limbs, slots)])
    parent, tip, order, limb, stroke, inner = [NULL], [[0, 0, 0]], [0], [_id("trunk")], [0], [[]]

    def add(above, point, its_order, name, number, between=()):
        parent.append(above)
        tip.append(point)
        order.append(its_order)
        limb.append(_id(name))
        stroke.append(number)
        inner.append(list(between))
        return len(parent) - 1

    at, junction = 0, {}
    for slot in used:
        at = add(at, [0.02 * slot, levels[slot], 0.01 * slot], 0, "trunk", 0)
        junction[slot] = at
    add(at, [0.2, height, 0.1], 0, "trunk", 0)
    for slot in used:
        out = np.array([np.cos(azimuth[slot]), 0.8, np.sin(azimuth[slot])])
        start = np.array(tip[junction[slot]])
        middle, end = start + 0.5 * length[slot] * out, start + length[slot] * out + [0, 0.3, 0]
        bow = [start + (middle - start) * t + [0, 0.1 * t * (1 - t), 0] for t in (0.25, 0.5, 0.75)] if curved else []
        row = add(junction[slot], middle, 1, f"limb {slot}", slot + 1, bow)
        add(row, end, 1, f"limb {slot}", slot + 1)
    points = [point for between in inner for point in between]
    return TreeSkeleton.from_columns(
        np.array(parent), np.array(tip, float), np.linspace(0.2, 0.02, len(parent)),
        order=np.array(order), limb=np.array(limb), stroke=np.array(stroke), kind=np.full(len(parent), int(Kind.DRAWN)),
        curve_points=np.array(points, float).reshape(-1, 3), curve_start=np.r_[0, np.cumsum([len(p) for p in inner])],
    )  # fmt: skip


def circle(x=0.0, y=5.5, radius=4.5, points=360):
    """A round outline on the page."""
    turn = np.linspace(0, 2 * np.pi, points, endpoint=False)
    return np.column_stack([x + radius * np.cos(turn), y + radius * np.sin(turn)])


def _id(name: str) -> int:
    return limb_ids.stroke_limb_id(name)
