"""How does a limb come to hang on a drawing that is in space already? A node on what it grows on, then its own rows.

A drawing in space is a `TreeSkeleton` in sketch units, y up, on the front page; `Drawing` keeps beside it which row of the sketch graph each of its rows is or
is a part of, so that the graph can be made to match.
"""

import dataclasses
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int

from sketchtree.axes import NULL
from sketchtree.propagate.after.cutting import pieces
from sketchtree.sketch.graph import SketchGraph
from sketchtree.skeleton import Kind, TreeSkeleton

_IN_FRONT = 1e-4  # of two limbs as near on the page, the one nearer to the viewer by a unit is so much nearer
_NODE = 0.012  # of the height: nearer than that to a node a limb grows from the node itself


@dataclass(frozen=True)
class Place:
    """A place on a drawn limb."""

    row: int
    piece: int  # number of the straight piece along the row
    share: float  # 0-1 of the piece
    point: Float[np.ndarray, " 3"]


@dataclass(frozen=True, eq=False)
class Drawing:
    """A drawing in space."""

    tree: TreeSkeleton  # sketch units
    source: Int[np.ndarray, " segment"]  # row of the graph; NULL for what was attached since

    def with_node(self, place: Place) -> tuple["Drawing", int]:
        """(the drawing with a node at that place, its row). Near a node there is one already."""
        tree, row = self.tree, place.row
        if tree.is_base[row]:
            return self, row
        near = _NODE * max(float(np.ptp(tree.tip, axis=0).max()), 1e-300)
        if np.linalg.norm(place.point - tree.tip[row]) <= near:
            return self, row
        if np.linalg.norm(place.point - tree.start[row]) <= near:
            return self, int(tree.parent[row])
        return self._split(place), row

    def _split(self, place: Place) -> "Drawing":
        """The row cut in two; its first half takes its number, all later rows move on by one."""
        tree, row = self.tree, place.row
        rows = np.insert(np.arange(len(tree)), row, row)
        parent = tree.parent[rows]
        parent = np.where(parent >= row, parent + 1, parent)
        parent[row], parent[row + 1] = tree.parent[row], row
        tip = tree.tip[rows]
        tip[row] = place.point
        start = np.insert(tree.curve_start, row + 1, tree.curve_start[row] + place.piece)
        columns = {name: getattr(tree, name)[rows] for name in ("radius", "order", "limb", "stroke", "tree", "kind", "depth_sd", "age")}
        return Drawing(tree.replace(parent=parent, tip=tip, curve_start=start, **columns), self.source[rows])

    def with_limb(self, foot: int, nodes: Float[np.ndarray, "node 3"], curves: list[Float[np.ndarray, "point 3"]], limb: int, stroke: int) -> "Drawing":
        """The drawing with a limb more: its nodes past the foot, and the points of its course before each."""
        tree = self.tree
        at, count = int(np.sum(tree.kind != Kind.ROOT)), len(nodes)
        old = np.r_[np.arange(at), np.full(count, NULL), np.arange(at, len(tree))]
        new = old == NULL
        parent = tree.parent[old]
        parent = np.where((parent >= at) & ~new, parent + count, parent)
        parent[new] = np.r_[foot, at + np.arange(count - 1)]
        values = {
            "radius": 1.0, "order": int(tree.order[foot]) + 1, "limb": limb, "stroke": stroke, "tree": int(tree.tree[foot]),
            "kind": int(Kind.DRAWN), "depth_sd": np.nan, "age": np.nan,
        }  # fmt: skip
        columns = {name: np.where(new, value, getattr(tree, name)[old]) for name, value in values.items()}
        tip = tree.tip[old]
        tip[new] = nodes
        before = int(tree.curve_start[at])
        points = np.concatenate([tree.curve_points[:before], *[np.reshape(curve, (-1, 3)) for curve in curves], tree.curve_points[before:]])
        counts = np.where(new, 0, np.diff(tree.curve_start)[old])
        counts[new] = [len(curve) for curve in curves]
        whole = tree.replace(parent=parent, tip=tip, curve_points=points, curve_start=np.r_[0, np.cumsum(counts)], **columns)
        return Drawing(whole, np.where(new, NULL, self.source[old]))

    def graph(self, before: SketchGraph, stroke_ids: tuple[str, ...]) -> SketchGraph:
        """The sketch graph of all of it, seen from the front. What is new has no width of its own."""
        tree, known = self.tree, self.source != NULL
        ids, first = np.unique(np.where(tree.is_base, -1 - np.arange(len(tree)), tree.limb), return_index=True)
        names = list(before.limb_id) + [int(one) for one in ids[np.argsort(first)] if one >= 0 and one not in before.limb_id]
        index = {int(name): k for k, name in enumerate(names)}
        limb = np.array([index[int(one)] for one in tree.limb], np.int64)
        limb[known] = before.limb[self.source[known]]
        return before.replace(
            parent=tree.parent, xy=tree.tip[:, :2], limb=limb, stroke=tree.stroke, tree=tree.tree,
            width=np.where(known, before.width[self.source], np.nan), joined=known & before.joined[self.source], root=tree.kind == Kind.ROOT,
            curve_points=tree.curve_points[:, :2], curve_start=tree.curve_start, limb_id=np.array(names, np.int64), stroke_ids=stroke_ids,
        )  # fmt: skip


def nearest_place(tree: TreeSkeleton, points: Float[np.ndarray, "point 2"], page: TreeSkeleton) -> tuple[int, Place, float]:
    """(which of the points is nearest to a limb on a page, the place there, how far they are apart). `page` is `tree` as that page has it; limbs in front win over
    those behind them."""
    owner, start, end, number = pieces(page)
    above = page.kind[owner] != Kind.ROOT
    along = end[:, :2] - start[:, :2]
    square = np.maximum((along**2).sum(axis=1), 1e-300)
    away = points[:, None] - start[None, :, :2]
    share = np.clip((away * along).sum(axis=2) / square, 0.0, 1.0)
    gap = np.linalg.norm(away - share[..., None] * along, axis=2)
    depth = start[:, 2] + share * (end[:, 2] - start[:, 2])
    cost = np.where(above, gap - _IN_FRONT * depth, np.inf)
    which, piece = np.unravel_index(np.argmin(cost), cost.shape)
    row, t = int(owner[piece]), float(share[which, piece])
    _, first, last, _ = pieces(tree)
    return int(which), Place(row, int(number[piece]), t, first[piece] + t * (last[piece] - first[piece])), float(gap[which, piece])


def place_at(tree: TreeSkeleton, limb: int, share: float, page: TreeSkeleton) -> Place | None:
    """The place at a share of a limb's length on a page; None where there is no such limb."""
    owner, start, end, number = pieces(page)
    mine = np.flatnonzero((page.limb[owner] == limb) & (page.kind[owner] != Kind.ROOT))
    if len(mine) == 0:
        return None
    length = np.linalg.norm((end - start)[mine, :2], axis=1)
    along = np.cumsum(length)
    at = min(max(share, 0.0), 1.0) * along[-1]
    k = int(min(np.searchsorted(along, at), len(mine) - 1))
    t = float(np.clip((at - (along[k] - length[k])) / max(length[k], 1e-300), 0.0, 1.0))
    _, first, last, _ = pieces(tree)
    piece = mine[k]
    return Place(int(owner[piece]), int(number[piece]), t, first[piece] + t * (last[piece] - first[piece]))


def on_other_page(tree: TreeSkeleton, turn) -> TreeSkeleton:
    """The same with all its points moved by `turn`."""
    return dataclasses.replace(tree, tip=turn(tree.tip), curve_points=turn(tree.curve_points))
