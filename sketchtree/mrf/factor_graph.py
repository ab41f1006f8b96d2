"""Which numbers does the inference work on? The sketch graph, normalised and compiled to index arrays.

    H = 1, the first base at 0                  ℓ_i   length on the page, at least 1e-3
    e_i   unit direction on the page            p(i)  parent row, NULL at a base
    j     a limb (stroke): parent limb, order o_j, first row f_j, tip row t_j, insertion u_j ∈ [0, 1]

Limbs are Chen's apical chains: the apical child is the segment that continues its limb. A tree of three stems or
more is a shrub: its stems spread like the laterals of an upright axis that was not drawn.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Float, Int

from sketchtree.axes import NULL
from sketchtree.mrf.outline import Outline, outline_of
from sketchtree.mrf.relations import competition_pairs, competitors, sibling_pairs
from sketchtree.sketch.graph import SketchGraph

SHORTEST = 1e-3  # least length on the page, H = 1
SHRUB = 3  # stems of one tree that make it a shrub
_GRID = 2.0**-22  # normalised positions are rounded to it, so that the units of the file cannot matter


@dataclass(frozen=True, eq=False)
class FactorGraph:
    """Index arrays of one drawing. Rows are those of the sketch graph, in order. Lengths: H = 1."""

    scale: float  # H in sketch units
    parent: Int[np.ndarray, " segment"]  # row; NULL at a base
    xy: Float[np.ndarray, "segment 2"]  # tip on the page
    length: Float[np.ndarray, " segment"]  # ℓ; 0 at a base
    direction: Float[np.ndarray, "segment 2"]  # e; +y at a base
    limb: Int[np.ndarray, " segment"]
    order: Int[np.ndarray, " segment"]
    tree: Int[np.ndarray, " segment"]  # 0 … tree_count − 1
    radius: Float[np.ndarray, " segment"]  # from the drawn width, else a taper
    is_base: Bool[np.ndarray, " segment"]
    is_apical: Bool[np.ndarray, " segment"]  # continues its parent row's limb (not the first of its limb)
    is_joined: Bool[np.ndarray, " segment"]  # apical only because the reader joined two strokes there

    limb_id: Int[np.ndarray, " limb"]  # stable from drawing to drawing
    limb_name: tuple[str, ...]  # id of the stroke that begins each limb
    limb_parent: Int[np.ndarray, " limb"]  # NULL for a stem
    limb_order: Int[np.ndarray, " limb"]  # 0 for a stem
    limb_spreads: Bool[np.ndarray, " limb"]  # may leave the page: laterals, and the stems of a shrub
    limb_first: Int[np.ndarray, " limb"]  # row f_j
    limb_tip: Int[np.ndarray, " limb"]  # row t_j
    limb_length: Float[np.ndarray, " limb"]  # on the page
    insertion: Float[np.ndarray, " limb"]  # u_j: where along its parent limb, by length on the page; 0 for a stem
    trunk_x: Float[np.ndarray, " limb"]  # x_trunk at the height of the limb's tip
    half_width: Float[np.ndarray, " limb"]  # R at the height of the limb's tip

    sibling: Int[np.ndarray, "sibling_pair 2"]  # limbs on one parent limb, nearby in rank
    rank_gap: Int[np.ndarray, " sibling_pair"]  # d = 1, 2, 3
    competitor: Int[np.ndarray, "competition_pair 2"]  # rows whose tips keep apart; each pair once
    crown_radius: float  # R_c, half the drawn width
    outline: Outline

    def __len__(self) -> int:
        return len(self.parent)

    @property
    def limb_count(self) -> int:
        """How many limbs, stems included."""
        return len(self.limb_first)

    @property
    def is_lateral(self) -> Bool[np.ndarray, " segment"]:
        """First segments of limbs that grow from another limb."""
        lateral = np.zeros(len(self), bool)
        lateral[self.limb_first[self.limb_parent != NULL]] = True
        return lateral

    @property
    def tip_aside(self) -> Float[np.ndarray, " limb"]:
        """x_t − x_trunk of every limb's tip."""
        return self.xy[self.limb_tip, 0] - self.trunk_x

    def __str__(self) -> str:
        return (
            f"FactorGraph: {int((~self.is_base).sum())} segments, {self.limb_count} limbs up to order "
            f"{self.limb_order.max(initial=0)}, {len(self.sibling)} sibling pairs, "
            f"{len(self.competitor)} competition pairs; H = {self.scale:g} sketch units"
        )


def factor_graph(graph: SketchGraph) -> FactorGraph:
    """Compile a sketch graph. Scale, shift and the side it is seen from leave the result alone, but for
    `scale` and the sign of x."""
    scale = graph.height or 1.0
    xy = np.round((graph.xy - graph.xy[0]) / scale / _GRID) * _GRID
    start = np.where(graph.is_base[:, None], xy, xy[graph.parent])
    length, direction = _page_vectors(graph, xy - start)
    _, tree = np.unique(graph.tree, return_inverse=True)
    limb_length = np.bincount(graph.limb, length, minlength=len(graph.limb_id))
    insertion = _insertion(graph, length, limb_length)
    order, tip = graph.order, graph.limb_tip
    outline = _outline(graph, xy, tree, order, scale)
    competitor = competition_pairs(
        graph, xy, competitors(graph, length, limb_length), radius=max(np.ptp(xy[:, 0]) / 2, 0.05)
    )
    spreads = _spreads(graph, tree)
    on_ground = spreads & (graph.limb_parent == NULL)
    host = np.where(on_ground, len(spreads) + tree[graph.limb_first], graph.limb_parent)
    sibling, rank_gap = sibling_pairs(host, np.where(on_ground, xy[graph.limb_first, 0], insertion))
    is_apical = ~graph.is_base
    is_apical[graph.limb_first] = False
    return FactorGraph(
        scale=scale, parent=graph.parent, xy=xy, length=length, direction=direction, limb=graph.limb, order=order,
        tree=tree, radius=drawn_radius(graph) / scale, is_base=graph.is_base, is_apical=is_apical,
        is_joined=graph.joined, limb_id=graph.limb_id,
        limb_name=tuple(graph.stroke_ids[k] if k != NULL else "(implied)" for k in graph.stroke[graph.limb_first]), limb_parent=graph.limb_parent, limb_order=graph.limb_order, limb_spreads=spreads,
        limb_first=graph.limb_first, limb_tip=tip, limb_length=limb_length, insertion=insertion,
        trunk_x=outline.trunk_x(xy[tip, 1], tree[tip]), half_width=outline.half_width(xy[tip, 1], tree[tip]),
        sibling=sibling, rank_gap=rank_gap, competitor=competitor,
        crown_radius=max(float(np.ptp(xy[:, 0])) / 2, 0.05), outline=outline,
    )  # fmt: skip


def drawn_radius(graph: SketchGraph) -> Float[np.ndarray, " segment"]:
    """Radius of every row in sketch units: half the line's width where it was drawn with one, else 1 % of
    H at a stem's base, half as thick at each further order, tapering to 40 % along the limb."""
    tip_distance = np.zeros(len(graph))
    along = np.linalg.norm(graph.xy - graph.start, axis=1)
    for row in range(len(graph)):
        if not graph.is_base[row] and graph.limb[graph.parent[row]] == graph.limb[row]:
            tip_distance[row] = tip_distance[graph.parent[row]] + along[row]
        else:
            tip_distance[row] = along[row]
    total = np.maximum(tip_distance[graph.limb_tip][graph.limb], 1e-12)
    taper = 0.01 * (graph.height or 1.0) * 0.5**graph.order * (1 - 0.6 * tip_distance / total)
    return np.where(np.isfinite(graph.width) & (graph.width > 0), graph.width / 2, taper)


def _spreads(graph, tree):
    """Laterals, and stems of which their tree has three or more."""
    is_stem = graph.limb_parent == NULL
    of_tree = tree[graph.limb_first]
    stems = np.bincount(of_tree[is_stem], minlength=tree.max(initial=-1) + 1)
    return ~is_stem | (stems[of_tree] >= SHRUB)


def _page_vectors(graph, vector):
    """ℓ and e. A segment shorter than `SHORTEST` takes its parent's direction."""
    drawn = np.linalg.norm(vector, axis=1)
    length = np.where(graph.is_base, 0.0, np.maximum(drawn, SHORTEST))
    direction = np.where((drawn > SHORTEST / 10)[:, None], vector / np.maximum(drawn, 1e-12)[:, None], 0.0)
    for row in np.flatnonzero(drawn <= SHORTEST / 10):
        direction[row] = (0.0, 1.0) if graph.is_base[row] else direction[graph.parent[row]]
    return length, direction


def _insertion(graph, length, limb_length):
    """u_j: the length on the page from the parent limb's start to the junction, over the whole."""
    along = np.zeros(len(graph))
    for row in range(len(graph)):
        if not graph.is_base[row]:
            same = graph.limb[graph.parent[row]] == graph.limb[row]
            along[row] = length[row] + (along[graph.parent[row]] if same else 0.0)
    parent = graph.limb_parent
    at = graph.parent[graph.limb_first]
    return np.where(parent == NULL, 0.0, along[at] / np.maximum(limb_length[parent], 1e-12))


def _outline(graph, xy, tree, order, scale) -> Outline:
    stems: list[list] = [[] for _ in range(tree.max(initial=-1) + 1)]
    for limb in np.flatnonzero(graph.limb_parent == NULL):
        stems[tree[graph.limb_first[limb]]].append(xy[graph.limb == limb])
    laterals = [xy[(tree == k) & (order > 0)] for k in range(len(stems))]
    crowns = tuple((curve - graph.xy[0]) / scale for curve in graph.crown)
    return outline_of(stems, laterals, crowns)
