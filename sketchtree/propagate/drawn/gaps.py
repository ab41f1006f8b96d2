"""Which sides of the tree did the page leave empty?

A sketch has few limbs, and seen from above they may leave whole sides bare. Where the azimuths of the limbs on a
trunk, drawn and new, leave a gap wider than `WIDEST`, drawn limbs are replicated into it: a lateral of the trunk,
turned about the vertical into the gap, with the angle and length that it was drawn with (Chen et al. 2008,
§6: the new branch inherits the angles of its block).
"""

import numpy as np
from jaxtyping import Array, Float, Key

from sketchtree import keys, limb_ids
from sketchtree.propagate.drawn.drawn_laterals import DrawnLaterals
from sketchtree.propagate.blocks.open_branch import OpenBranches, polar, turn
from sketchtree.skeleton import TreeSkeleton

WIDEST = np.radians(60.0)  # between neighbouring limbs, seen from above
_COUNTS = 0.6  # of the drawn limbs' median reach: shorter ones do not close a gap
_RANK = 1_000_000  # ranks of these limbs: above those of all nodes of a trunk
_SECTOR = np.radians(5.0)  # limbs in one sector have one rank


def into_gaps(
    tree: TreeSkeleton,
    frame: Float[np.ndarray, "segment 3 3"],
    drawn: DrawnLaterals,
    new: OpenBranches,
    key: Key[Array, ""] | np.uint64,
) -> OpenBranches:
    """Replicas of the drawn limbs of every trunk, turned into the gaps that they and the `new` ones leave.

    Needs two drawn limbs or more on a trunk; `frame` is that of every row."""
    found = new.select(slice(0, 0))
    for limb in np.unique(tree.limb[tree.order == 0]):
        mine = np.flatnonzero(tree.limb[drawn.node] == limb)
        if len(mine) >= 2:
            beside = new.select((tree.limb[new.row] == limb) & (new.order == 1))
            found = found.join(_of_trunk(tree, frame, drawn, mine, beside, limb, key))
    return found


def _of_trunk(tree, frame, drawn, mine, beside, limb, key):
    span = drawn.end[mine] - tree.tip[drawn.node[mine]]
    reach = np.hypot(span[:, 0], span[:, 2])
    counts = _COUNTS * np.median(reach)
    aside = beside.frame[:, :, 1] * beside.length[:, None]
    present = np.concatenate([span[reach >= counts], aside[np.hypot(aside[:, 0], aside[:, 2]) >= counts]])
    azimuth = _sides(np.arctan2(present[:, 2], present[:, 0]))
    rank = _RANK + np.floor((azimuth % (2 * np.pi)) / _SECTOR).astype(np.int64)
    ids = limb_ids.child_limb_id(np.full(len(rank), limb), rank)
    able = mine[reach >= counts]
    source = able[(keys.uniform(key, ids, 14) * len(able)).astype(np.int64)]

    node, way = drawn.node[source], drawn.heading[source]
    level = np.hypot(way[:, 0], way[:, 2])
    way = np.stack([level * np.cos(azimuth), way[:, 1], level * np.sin(azimuth)], axis=1)
    divergence, orientation = polar(np.einsum("bji,bj->bi", frame[node], way))
    length = drawn.length[source] * (0.8 + 0.25 * keys.uniform(key, ids, 15))
    return OpenBranches(
        row=node,
        origin=tree.tip[node],
        frame=turn(frame[node], divergence, orientation, np.zeros(len(node), bool)),
        limb=ids,
        order=tree.order[node] + 1,
        tree=tree.tree[node],
        length=length,
        grown=np.zeros(len(node)),
        node=np.zeros(len(node), np.int64),
        radius=np.minimum(tree.radius[node] * 0.5, 0.02 * length),
        bends=np.zeros(len(node), bool),
    )


def _sides(present: Float[np.ndarray, " limb"]) -> Float[np.ndarray, " branch"]:
    """Azimuths, radians, that leave no gap wider than `WIDEST` among those present."""
    if len(present) == 0:
        return np.zeros(0)
    start = np.sort(present)
    gap = np.diff(np.r_[start, start[0] + 2 * np.pi])
    count = np.maximum(np.ceil(gap / WIDEST).astype(np.int64) - 1, 0)
    owner = np.repeat(np.arange(len(gap)), count)
    step = np.arange(len(owner)) - np.repeat(np.cumsum(count) - count, count) + 1
    return start[owner] + gap[owner] * step / (count[owner] + 1)
