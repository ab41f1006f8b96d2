"""Where do the limbs bend and branch? Nodes, and the columns of the sketch graph.

A node stands at every foot, junction and tip, and where a limb bends: between two junctions the drawn line is split
(Douglas & Peucker 1973) until no point lies farther than BEND from its segment; here all stretches of all limbs at once,
round by round. Junctions closer than MERGE are one. The drawn points between two nodes are kept as the segment's curve.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int

from sketchtree.axes import NULL
from sketchtree.sketch.joining.bundle import Bundle
from sketchtree.sketch.joining.joints import Limb

BEND = 0.012  # of H: how far a drawn line may lie from its straight segments
MERGE = 0.004  # of H: junctions nearer than this along a limb are one
SAME = 1e-9  # of H: nearer than this is the same point
ONE_TREE = 0.15  # of H: stems whose feet are nearer than this belong to one tree


@dataclass(eq=False)
class Rows:
    """Where every limb's nodes stand in the graph."""

    s: list[Float[np.ndarray, " node"]]  # of each limb: lengths of its nodes, the foot left out
    first: list[int]  # of each limb: row of its first node
    foot: list[int]  # of each limb: row of the node it starts from

    def nearest(self, limb: int, s: float) -> int:
        """The row whose node on that limb is nearest to length `s`; the foot counts as length 0."""
        lengths = self.s[limb]
        k = int(np.searchsorted(lengths, s))
        before = lengths[k - 1] if k else 0.0
        if k < len(lengths) and lengths[k] - s < s - before:
            k += 1
        return self.foot[limb] if k == 0 else self.first[limb] + k - 1


def columns(limbs: list[Limb], height: float) -> tuple[dict[str, np.ndarray], Rows]:
    """(the columns of a SketchGraph but for ids, where the nodes of every limb stand). `height` is H."""
    bundle = Bundle.of_points([limb.points for limb in limbs])
    merge = np.minimum(MERGE * height, 0.2 * bundle.length)
    limb, s = _bent(bundle, *_fixed(limbs, bundle.length, merge), merge, BEND * height)
    bounds = np.searchsorted(limb, np.arange(len(limbs) + 1))
    stem = np.array([limb.parent == NULL for limb in limbs])
    first = bounds[:-1] + np.cumsum(stem)
    rows = Rows(np.split(s, bounds[1:-1]), first.tolist(), [])
    for k, each in enumerate(limbs):
        rows.foot.append(rows.first[k] - 1 if each.parent == NULL else rows.nearest(each.parent, each.s))
    return _table(limbs, bundle, limb, s, rows, height), rows


def _fixed(limbs: list[Limb], length, merge) -> tuple[Int[np.ndarray, " node"], Float[np.ndarray, " node"]]:
    """(limb, length) of junctions, those closer than `merge` as one at their mean, and of tips; in order."""
    seats = [(limb.parent, limb.s) for limb in limbs if limb.parent != NULL]
    seats += [(k, join) for k, limb in enumerate(limbs) for join in limb.joins]
    groups: list[tuple[int, list[float]]] = []
    for k, s in sorted(seats):
        if not merge[k] < s < length[k] - merge[k]:
            continue
        if groups and groups[-1][0] == k and s - groups[-1][1][0] < merge[k]:
            groups[-1][1].append(s)
        else:
            groups.append((k, [s]))
    limb = np.array([k for k, _ in groups] + list(range(len(limbs))))
    s = np.concatenate([[sum(group) / len(group) for _, group in groups], length])
    order = np.lexsort((s, limb))
    return limb[order], s[order]


def _bent(bundle: Bundle, limb, s, merge, tolerance: float) -> tuple[Int[np.ndarray, " node"], Float[np.ndarray, " node"]]:
    """The nodes and those at which a limb must bend between them; in order."""
    low = np.where(np.concatenate([[True], limb[1:] != limb[:-1]]), 0.0, np.concatenate([[0.0], s[:-1]]))
    found, stretch = [(limb, s)], (limb, low, s)
    while len(stretch[0]):
        k, low, high = stretch
        start = np.searchsorted(bundle.run, bundle.begin[k] + low + merge[k], side="right")
        count = np.maximum(np.searchsorted(bundle.run, bundle.begin[k] + high - merge[k]) - start, 0)
        k, low, high, start, count = (column[count > 0] for column in (k, low, high, start, count))
        if len(k) == 0:
            break
        begin = np.cumsum(count) - count
        each = np.repeat(np.arange(len(k)), count)
        point = np.arange(len(each)) - begin[each] + start[each]
        distance = _from_segment(bundle.points[point], bundle.at(k, low)[each], bundle.at(k, high)[each])
        worst = np.maximum.reduceat(distance, begin)
        at = np.flatnonzero(distance == worst[each])
        farthest = point[at[np.searchsorted(each[at], np.arange(len(k)))]]
        split = worst > tolerance
        k, low, high, middle = k[split], low[split], high[split], bundle.along[farthest[split]]
        found.append((k, middle))
        stretch = (np.tile(k, 2), np.concatenate([low, middle]), np.concatenate([middle, high]))
    limb, s = (np.concatenate(column) for column in zip(*found, strict=True))
    order = np.lexsort((s, limb))
    return limb[order], s[order]


def _from_segment(points, a, b) -> Float[np.ndarray, " point"]:
    """Distance of each point from the segment between its a and b."""
    chord, off = b - a, points - a
    t = np.clip((off * chord).sum(1) / np.maximum((chord * chord).sum(1), 1e-300), 0, 1)
    away = off - t[:, None] * chord
    return np.hypot(away[:, 0], away[:, 1])


def _table(limbs: list[Limb], bundle: Bundle, limb, s, rows: Rows, height: float) -> dict[str, np.ndarray]:
    """The columns, bases put before the first nodes of their limbs."""
    stem = np.array([each.parent == NULL for each in limbs])
    first, foot = np.array(rows.first), np.array(rows.foot)
    row = np.arange(len(limb)) + np.cumsum(stem)[limb]
    base = first[stem] - 1
    after = bundle.after(limb, s - SAME * height)
    width, drawn = np.concatenate([each.width for each in limbs]), np.concatenate([each.row for each in limbs])
    begins = row == first[limb]
    length = len(limb) + len(base)
    table = {"parent": np.full(length, NULL), "xy": np.zeros((length, 2)), "joined": np.zeros(length, bool)}
    table |= {name: np.zeros(length, int) for name in ("limb", "stroke", "tree")} | {"width": np.zeros(length)}
    table["parent"][row] = np.where(begins, foot[limb], row - 1)
    start = bundle.first[:-1][stem]
    for name, node, ground in (
        ("xy", bundle.at(limb, s), bundle.points[start]),
        ("limb", limb, np.flatnonzero(stem)),
        ("stroke", drawn[after], drawn[start]),
        ("tree", _trees(limbs, height)[limb], _trees(limbs, height)[stem]),
        ("width", _between(bundle, width, limb, s), width[start]),
        ("joined", _joined(limbs, limb, s, begins, height), False),
    ):
        table[name][row], table[name][base] = node, ground
    return table | _curves(limbs, bundle, limb, s, row, table, height)


def _between(bundle: Bundle, width, limb, s) -> Float[np.ndarray, " node"]:
    """The drawn width at every node."""
    after = bundle.after(limb, s)
    low, high = bundle.along[after - 1], bundle.along[after]
    t = np.clip((s - low) / np.where(high > low, high - low, 1.0), 0.0, 1.0)
    return np.where(t == 1, width[after], width[after - 1] * (1 - t) + width[after] * t)


def _joined(limbs: list[Limb], limb, s, begins, height: float):
    """Which nodes end a segment that starts where one line was joined to another."""
    joined = np.zeros(len(limb), bool)
    previous = np.concatenate([[0.0], s[:-1]])
    for k in (k for k, each in enumerate(limbs) if each.joins):
        own = np.flatnonzero((limb == k) & ~begins)
        joined[own] = (np.abs(previous[own, None] - np.array(limbs[k].joins)) <= MERGE * height).any(1)
    return joined


def _curves(limbs: list[Limb], bundle: Bundle, limb, s, row, table, height: float) -> dict[str, np.ndarray]:
    """The drawn points strictly inside every segment."""
    of = np.repeat(np.arange(len(limbs)), np.diff(bundle.first))
    node = np.minimum(np.searchsorted(bundle.begin[limb] + s, bundle.run + SAME * height), len(limb) - 1)
    kept = np.arange(len(of)) > bundle.first[of]
    begins = np.concatenate([[True], limb[1:] != limb[:-1]])
    since = np.where(begins[node], -np.inf, np.concatenate([[0.0], s[:-1]])[node] + SAME * height)
    apart = (bundle.points != table["xy"][table["parent"][row]][node]).any(1)
    kept &= (node < len(limb)) & (limb[node] == of) & (bundle.along < s[node] - SAME * height) & (bundle.along > since) & apart
    count = np.bincount(row[node[kept]], minlength=len(table["parent"]))
    return {"curve_points": bundle.points[kept], "curve_start": np.concatenate([[0], np.cumsum(count)])}


def _trees(limbs: list[Limb], height: float) -> Int[np.ndarray, " limb"]:
    """Stems whose feet are nearer than ONE_TREE belong to one tree, and so does what they carry."""
    stems = sorted((float(limb.points[0, 0]), k) for k, limb in enumerate(limbs) if limb.parent == NULL)
    count, tree, last = -1, np.zeros(len(limbs), int), -np.inf
    for x, k in stems:
        count += x - last > ONE_TREE * height
        tree[k], last = count, x
    for k, limb in enumerate(limbs):
        if limb.parent != NULL:
            tree[k] = tree[limb.parent]
    return tree
