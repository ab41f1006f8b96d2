"""Where may a drawn limb bear laterals that were not drawn?

Chen et al. 2008, §6: "our system also introduces new lateral branches along disproportionately long
branches caused by inaccurate sketch". Along each drawn limb nodes are wanted at the arcs k · h, k = 1, 2, …; a
drawn node within 0.3 h of one serves, else the row is split there, at the point of its own drawn
curve nearest to it (a straight row at the arc itself). The projection and every curve point stay as drawn.

    h   spacing of laterals on this limb, metres; it depends on nothing but the limb, so that strokes
        drawn later leave its nodes, and the numbers drawn for them, as they were
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Float, Int

from sketchtree.axes import NULL
from sketchtree.propagate.blocks.open_branch import arc_length, limb_arcs
from sketchtree.skeleton import TreeSkeleton

_SERVES = 0.3  # of the spacing: a drawn node this near to k · h takes its place
_SNAP = 0.25  # of the spacing: a curve point this near to k · h is where the row is split


@dataclass(frozen=True, eq=False)
class Split:
    """A tree whose long rows were split. No row was moved; `row` says where the old rows are now."""

    tree: TreeSkeleton
    row: Int[np.ndarray, " segment"]  # of the new tree, for every row of the old one
    number: Int[np.ndarray, " segment"]  # k of the node at each new row's tip; NULL where it is no such node


def split_long(
    tree: TreeSkeleton, spacing: Float[np.ndarray, " segment"], eligible: Bool[np.ndarray, " segment"]
) -> Split:
    """Nodes every `spacing` metres along the limbs of `eligible` rows (the same spacing for all rows of a limb)."""
    arc, _ = limb_arcs(tree)
    length = arc_length(tree)
    begin = arc - length
    eligible = eligible & ~tree.is_base & (length > 0)
    served = _served(tree, arc, spacing, eligible)
    owner, number, at = _cuts(begin, arc, length, spacing, eligible)
    points = _polyline(tree, length)
    at, owner, number = _snap(points, at, owner, number, spacing)
    return _insert(tree, points, at, owner, number, served)


def split_at(tree: TreeSkeleton, row: Int[np.ndarray, " node"], at: Float[np.ndarray, " node"]) -> tuple[Split, Int[np.ndarray, " node"]]:
    """(the tree with a node `at` metres along each of these rows' drawn curves, strictly within them; the new row that ends at each node). Equal places are one node."""
    places, which = np.unique(np.stack([row, at], axis=1), axis=0, return_inverse=True)
    owner, at = places[:, 0].astype(np.int64), places[:, 1]
    points = _polyline(tree, arc_length(tree))
    split = _insert(tree, points, points[0][points[2][owner]] + at, owner, np.arange(len(owner)), np.full(len(tree), NULL))
    node = np.flatnonzero(split.number != NULL)
    place = np.empty(len(owner), np.int64)
    place[split.number[node]] = node
    return split, place[which.reshape(-1)]


def _served(tree, arc, spacing, eligible):
    """k of the rows whose drawn tip serves as the node k; of two at one k the nearer one."""
    number = np.rint(arc / spacing).astype(np.int64)
    miss = np.abs(arc / spacing - number)
    candidate = np.flatnonzero(eligible & (number > 0) & (miss <= _SERVES))
    order = candidate[np.lexsort((miss[candidate], number[candidate], tree.limb[candidate]))]
    same = np.zeros(len(order), bool)
    same[1:] = (tree.limb[order][1:] == tree.limb[order][:-1]) & (number[order][1:] == number[order][:-1])
    served = np.full(len(tree), NULL)
    served[order[~same]] = number[order[~same]]
    return served


def _cuts(begin, arc, length, spacing, eligible):
    """(row, k, metres from the row's start) of every wanted node strictly inside a row."""
    low = np.floor(begin / spacing + _SERVES).astype(np.int64) + 1
    high = np.ceil(arc / spacing - _SERVES).astype(np.int64) - 1
    count = np.where(eligible, np.maximum(high - low + 1, 0), 0)
    owner = np.repeat(np.arange(len(arc)), count)
    number = low[owner] + np.arange(len(owner)) - np.repeat(np.cumsum(count) - count, count)
    return owner, number, number * spacing[owner] - begin[owner]


def _polyline(tree, length):
    """All rows' polylines end to end: (arc along them all, point, row's first vertex, arc at each row's start)."""
    inner = np.diff(tree.curve_start)
    count = inner + 2
    first = np.cumsum(count) - count
    point = np.empty((count.sum(), 3))
    point[first] = tree.start
    point[first + count - 1] = tree.tip
    owner = np.repeat(np.arange(len(tree)), inner)
    point[np.arange(len(tree.curve_points)) + 2 * owner + 1] = tree.curve_points
    step = np.r_[0.0, np.linalg.norm(np.diff(point, axis=0), axis=1)]
    step[first] = 0.0
    return np.cumsum(step), point, first, np.r_[0.0, np.cumsum(length)[:-1]]


def _snap(points, at, owner, number, spacing):
    """Cuts moved to the nearest curve point where one is near; each as an arc along all polylines.

    A cut keeps its own place where its neighbour took that point."""
    along, _, first, _ = points
    last = np.r_[first[1:], len(along)] - 1
    s = along[first[owner]] + at
    right = np.searchsorted(along, s)
    nearest = np.where(np.abs(along[right - 1] - s) < np.abs(along[np.minimum(right, len(along) - 1)] - s), right - 1, right)
    inner = (nearest > first[owner]) & (nearest < last[owner])
    near = inner & (np.abs(along[np.where(inner, nearest, 0)] - s) <= _SNAP * spacing[owner])
    return np.where(near, along[np.where(near, nearest, 0)], s), owner, number


def _insert(tree, points, at, owner, number, served):
    """The tree with a row for every cut, before the row it was cut from."""
    along, point, first, _ = points
    extra = np.bincount(owner, minlength=len(tree))
    row = np.arange(len(tree)) + np.cumsum(extra)
    total = len(tree) + len(owner)
    slot = row[owner] - extra[owner] + np.arange(len(owner)) - (np.cumsum(extra) - extra)[owner]
    source = np.empty(total, np.int64)
    source[row], source[slot] = np.arange(len(tree)), owner

    new_number = np.full(total, NULL)
    new_number[row], new_number[slot] = served, number
    tip = tree.tip[source]
    hit = np.searchsorted(along, at)
    hit = np.minimum(hit, len(along) - 1)
    exact = along[hit] == at
    before = np.maximum(hit - 1, 0)
    gap = along[hit] - along[before]
    t = np.where(gap > 0, (at - along[before]) / np.where(gap > 0, gap, 1.0), 0.0)
    tip[slot] = np.where(exact[:, None], point[hit], point[before] + t[:, None] * (point[hit] - point[before]))

    head = row - extra
    parent = np.arange(total) - 1
    parent[head] = np.where(tree.parent == NULL, NULL, row[tree.parent])
    span = along[np.r_[first[1:], len(along)] - 1] - along[first]
    share = (at - along[first[owner]]) / np.where(span[owner] > 0, span[owner], 1.0)
    columns = {name: getattr(tree, name)[source] for name in ("order", "limb", "stroke", "tree", "kind")}
    for name in ("radius", "depth_sd", "age"):
        value = getattr(tree, name)
        above = np.where(tree.parent == NULL, value, value[tree.parent])
        column = value[source]
        column[slot] = above[owner] + share * (value[owner] - above[owner])
        columns[name] = column
    split = TreeSkeleton(parent=parent, tip=tip, **columns, **_curves(tree, points, at, owner, slot, row, total))
    return Split(split, row, new_number)


def _curves(tree, points, at, owner, slot, row, total):
    """The curve points again, each with the piece it lies on; those that became nodes left out."""
    along, point, first, _ = points
    inner = np.diff(tree.curve_start)
    line = np.repeat(np.arange(len(tree)), inner)
    vertex = np.arange(len(tree.curve_points)) + 2 * line + 1
    passed = np.searchsorted(at, along[vertex], side="left")
    is_node = (passed < len(at)) & (at[np.minimum(passed, len(at) - 1)] == along[vertex]) if len(at) else np.zeros(len(vertex), bool)
    of_row = np.bincount(owner, minlength=len(tree))
    before = (np.cumsum(of_row) - of_row)[line]
    piece = row[line] - of_row[line] + np.clip(passed - before, 0, of_row[line])
    keep = ~is_node
    count = np.bincount(piece[keep], minlength=total)
    return {"curve_points": tree.curve_points[keep], "curve_start": np.r_[0, np.cumsum(count)]}
