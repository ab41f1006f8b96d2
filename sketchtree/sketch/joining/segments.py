"""Where do the limbs bend and branch? Nodes, and the columns of the sketch graph.

A node stands at every foot, junction and tip, and where a limb bends: between two junctions the drawn line is split
(Douglas & Peucker 1973) until no point lies farther than BEND from its segment. Junctions closer than MERGE are
one. The drawn points between two nodes are kept as the segment's curve.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float

from sketchtree.axes import NULL
from sketchtree.sketch.joining.joints import Limb, beyond

BEND = 0.012  # of H: how far a drawn line may lie from its straight segments
MERGE = 0.004  # of H: junctions nearer than this along a limb are one


@dataclass(eq=False)
class Rows:
    """Where every limb's nodes stand in the graph."""

    s: list[Float[np.ndarray, " node"]]  # of each limb: lengths of its nodes, the foot left out
    first: list[int]  # of each limb: row of its first node
    foot: list[int]  # of each limb: row of the node it starts from

    def nearest(self, limb: int, s: float) -> int:
        """The row whose node on that limb is nearest to length `s`; the foot counts as length 0."""
        k = int(np.argmin(np.abs(np.r_[0.0, self.s[limb]] - s)))
        return self.foot[limb] if k == 0 else self.first[limb] + k - 1


def columns(limbs: list[Limb], height: float) -> tuple[dict[str, np.ndarray], Rows]:
    """(the columns of a SketchGraph but for ids, where the nodes of every limb stand). `height` is H."""
    seats: list[list[float]] = [[] for _ in limbs]
    for limb in limbs:
        if limb.parent != NULL:
            seats[limb.parent].append(limb.s)
    rows = Rows([_nodes(limb, seats[k], height) for k, limb in enumerate(limbs)], [], [])
    table: dict[str, list] = {name: [] for name in ("parent", "xy", "limb", "stroke", "tree", "width", "joined", "curve")}
    tree = _trees(limbs, height)
    for k, limb in enumerate(limbs):
        if limb.parent == NULL:
            rows.foot.append(len(table["parent"]))
            _append(table, NULL, limb.points[0], k, limb.row[0], tree[k], limb.width[0], False, np.zeros((0, 2)))
        else:
            tree[k] = tree[limb.parent]
            rows.foot.append(rows.nearest(limb.parent, limb.s))
        rows.first.append(len(table["parent"]))
        _append_limb(table, k, limb, rows, tree[k], height)
    return _arrays(table), rows


def _nodes(limb: Limb, seats: list[float], height: float) -> Float[np.ndarray, " node"]:
    length = float(limb.along[-1])
    merge = min(MERGE * height, 0.2 * length)
    fixed = _merged(np.r_[limb.joins, seats], merge, length)
    bounds = np.r_[0.0, fixed]
    inner = [_bends(limb, a, b, BEND * height, merge) for a, b in zip(bounds[:-1], bounds[1:], strict=True)]
    return np.sort(np.concatenate([fixed, *inner]))


def _merged(s: Float[np.ndarray, " junction"], merge: float, length: float) -> Float[np.ndarray, " node"]:
    """Lengths of the junctions, those closer than `merge` as one at their mean, and the tip."""
    s = np.sort(s)
    s = s[(s > merge) & (s < length - merge)]
    groups: list[list[float]] = []
    for value in s.tolist():
        if groups and value - groups[-1][0] < merge:
            groups[-1].append(value)
        else:
            groups.append([value])
    return np.array([*(float(np.mean(group)) for group in groups), length])


def _bends(limb: Limb, low: float, high: float, tolerance: float, merge: float) -> list[float]:
    """Lengths between two nodes at which the limb must bend."""
    inner = np.flatnonzero((limb.along > low + merge) & (limb.along < high - merge))
    if len(inner) == 0:
        return []
    ends = [np.interp([low, high], limb.along, limb.points[:, axis]) for axis in (0, 1)]
    a, b = np.stack(ends, 1)
    distance = _from_segment(limb.points[inner], a, b)
    worst = int(np.argmax(distance))
    if distance[worst] <= tolerance:
        return []
    s = float(limb.along[inner[worst]])
    return [*_bends(limb, low, s, tolerance, merge), s, *_bends(limb, s, high, tolerance, merge)]


def _from_segment(points, a, b) -> Float[np.ndarray, " point"]:
    chord = b - a
    t = np.clip((points - a) @ chord / max(chord @ chord, 1e-300), 0, 1)
    return np.hypot(*(points - a - t[:, None] * chord).T)


def _append_limb(table, k: int, limb: Limb, rows: Rows, tree: int, height: float) -> None:
    parent, previous = rows.foot[k], 0.0
    start = table["xy"][parent]
    kept = np.arange(len(limb.points)) >= (beyond(limb.points, limb.along, start, limb.slack) if limb.parent != NULL else 1)
    for s in rows.s[k]:
        between = kept & (limb.along >= previous) & (limb.along < s - 1e-9 * height) & (limb.points != table["xy"][parent]).any(1)
        xy = np.array([np.interp(s, limb.along, limb.points[:, axis]) for axis in (0, 1)])
        at = min(int(np.searchsorted(limb.along, s - 1e-9 * height)), len(limb.row) - 1)
        joined = previous > 0 and any(abs(previous - join) <= MERGE * height for join in limb.joins)
        width = np.interp(s, limb.along, limb.width)
        _append(table, parent, xy, k, limb.row[at], tree, width, joined, limb.points[between])
        parent, previous = len(table["parent"]) - 1, s


def _append(table, parent, xy, limb, stroke, tree, width, joined, curve) -> None:
    row = dict(parent=parent, xy=np.asarray(xy, float), limb=limb, stroke=stroke, tree=tree, width=width, joined=joined, curve=curve)
    for name, value in row.items():
        table[name].append(value)


def _trees(limbs: list[Limb], height: float) -> dict[int, int]:
    """Stems whose feet are nearer than 15 % of H belong to one tree."""
    stems = sorted((float(limb.points[0, 0]), k) for k, limb in enumerate(limbs) if limb.parent == NULL)
    tree, found, last = -1, {}, -np.inf
    for x, k in stems:
        tree += x - last > 0.15 * height
        found[k], last = tree, x
    return found


def _arrays(table: dict[str, list]) -> dict[str, np.ndarray]:
    curves = table.pop("curve")
    arrays = {name: np.array(column) for name, column in table.items()}
    arrays["xy"] = arrays["xy"].reshape(-1, 2)
    arrays["curve_points"] = np.concatenate(curves)
    arrays["curve_start"] = np.r_[0, np.cumsum([len(curve) for curve in curves])]
    return arrays
