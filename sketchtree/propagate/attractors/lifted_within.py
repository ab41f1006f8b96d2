"""Do the visible limbs stay within the crown's depth?

How far a limb comes forward is inferred from its angles and lengths, and of a few limbs may be said wrongly; a photo shows how wide the crown is, and as deep it is taken to be
(`revolved`). So a limb that would reach out of the foliage revolved, REACH times as deep, is laid flatter: its depths, counted from its foot, are all multiplied by the largest part
s ≤ 1 with which it stays within, or by that which comes nearest to it. What it bears goes with it; nothing moves on the page. (Ours.)
"""

import numpy as np
from jaxtyping import Float, Int

from sketchtree.axes import NULL
from sketchtree.propagate.attractors.revolved import Axes
from sketchtree.propagate.attractors.target import Target
from sketchtree.propagate.attractors.wood import Wood
from sketchtree.roots import without_roots
from sketchtree.skeleton import TreeSkeleton

REACH = 1.1
_PARTS = np.linspace(1.0, 0.0, 41)


def lifted_within(tree: TreeSkeleton, target: Target) -> TreeSkeleton:
    """The drawn limbs of one tree, none deeper than its crown."""
    above, _ = without_roots(tree)
    if len(above) == 0:
        return tree
    axes = Axes.about_crown(target.coarser(), Wood.of(above).trunk())
    tip, curve = tree.tip.copy(), tree.curve_points.copy()
    shift = np.zeros(len(tree))  # of each tip's depth, metres
    for rows in _limbs(tree):
        foot = tree.parent[rows[0]]
        if foot == NULL:
            continue
        points = np.concatenate([np.arange(tree.curve_start[row], tree.curve_start[row + 1]) for row in rows])
        line = np.concatenate([tree.tip[rows], tree.curve_points[points]])
        forward = line[:, 2] - tree.tip[foot, 2]
        start = tree.tip[foot, 2] + shift[foot]
        depth = start + _part(axes, line, forward, start) * forward
        shift[rows] = depth[: len(rows)] - tree.tip[rows, 2]
        tip[rows, 2], curve[points, 2] = depth[: len(rows)], depth[len(rows) :]
    return tree.replace(tip=tip, curve_points=curve)


def _limbs(tree: TreeSkeleton) -> list[Int[np.ndarray, " row"]]:
    """The rows of every limb from its foot on, each after the limb it grows from."""
    _, first, which = np.unique(tree.limb, return_index=True, return_inverse=True)
    rows = np.split(np.argsort(which, kind="stable"), np.cumsum(np.bincount(which))[:-1])
    return [rows[k] for k in np.argsort(first)]


def _part(axes: Axes, line: Float[np.ndarray, "point 3"], forward: Float[np.ndarray, " point"], start: float) -> float:
    """The largest part of a limb's depths with which it sticks out least."""
    flat = line * [1.0, 1.0, 0.0] + np.array([0.0, 0.0, 1.0]) * axes.depth_of_trunk(line[:, 1])[:, None]
    aside = np.abs(axes.outward(flat)[:, 0])
    ratio = axes.out(flat)
    seen = np.isfinite(ratio) & (ratio > 0)
    if not seen.any():
        return 1.0
    half = REACH * aside[seen] / ratio[seen]
    room = np.sqrt(np.maximum(half**2 - aside[seen] ** 2, 0.0))
    away = np.abs(start + _PARTS[:, None] * forward[None, seen] - flat[None, seen, 2])
    beyond = np.maximum(away - room, 0.0).max(axis=1)
    return float(_PARTS[np.flatnonzero(beyond <= beyond.min() + 1e-9)[0]])
