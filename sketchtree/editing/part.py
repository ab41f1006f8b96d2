"""Which part of a factor graph bears on the depths of some limbs?

Their rows, the limbs beside them, whatever competes with them for room, and all that these grow on down to the ground. The drawing's own measures (its height, its
outline, the width of its crown) stay those of the whole, so that a factor of the part is the factor of the whole.
"""

import dataclasses

import numpy as np
from jaxtyping import Bool, Float, Int

from sketchtree.axes import NULL
from sketchtree.mrf.factor_graph import FactorGraph
from sketchtree.mrf.sampling.locks import STEEPEST
from sketchtree.traverse import sum_from_root

_ROWS = ("xy", "length", "direction", "order", "tree", "radius", "is_base", "is_apical", "is_joined")
_LIMBS = ("limb_id", "limb_order", "limb_spreads", "limb_length", "insertion", "trunk_x", "half_width")


def part_of(graph: FactorGraph, free: Bool[np.ndarray, " limb"]) -> tuple[FactorGraph, Int[np.ndarray, " kept"]]:
    """(the part, its rows' numbers in the whole), for limbs that are `free`. Whole limbs are kept or left out."""
    limbs = np.array(free, bool)
    near = free[graph.sibling].any(axis=1)
    limbs[graph.sibling[near]] = True
    rival = free[graph.limb[graph.competitor]].any(axis=1)
    limbs[graph.limb[graph.competitor[rival]]] = True
    for limb in np.argsort(-graph.limb_order, kind="stable"):
        if limbs[limb] and graph.limb_parent[limb] != NULL:
            limbs[graph.limb_parent[limb]] = True
    rows = np.flatnonzero(limbs[graph.limb])
    return _sliced(graph, rows, np.flatnonzero(limbs)), rows


def reachable(graph: FactorGraph, depth: Float[np.ndarray, " segment"]) -> Float[np.ndarray, " segment"]:
    """Depths (H = 1) with no segment steeper than a held one may be: an answer may be a little steeper, and a limb that points at the viewer of a turned page is. NaN
    where nothing is known."""
    rise = np.where(graph.is_base, 0.0, depth - depth[np.maximum(graph.parent, 0)])
    most = 0.99 * graph.length * np.tan(STEEPEST)
    within = sum_from_root(graph.parent, np.where(graph.is_base, 0.0, np.clip(np.nan_to_num(rise), -most, most)))
    return np.where(np.isfinite(depth), within, np.nan)


def _sliced(graph: FactorGraph, rows, limbs) -> FactorGraph:
    row, limb = np.full(len(graph) + 1, NULL), np.full(graph.limb_count + 1, NULL)
    row[rows], limb[limbs] = np.arange(len(rows)), np.arange(len(limbs))
    pair = (limb[graph.sibling] != NULL).all(axis=1)
    rival = (row[graph.competitor] != NULL).all(axis=1)
    columns = {name: getattr(graph, name)[rows] for name in _ROWS} | {name: getattr(graph, name)[limbs] for name in _LIMBS}
    return dataclasses.replace(
        graph,
        **columns,
        parent=row[graph.parent[rows]],
        limb=limb[graph.limb[rows]],
        limb_name=tuple(graph.limb_name[k] for k in limbs),
        limb_parent=limb[graph.limb_parent[limbs]],
        limb_first=row[graph.limb_first[limbs]],
        limb_tip=row[graph.limb_tip[limbs]],
        sibling=limb[graph.sibling[pair]],
        rank_gap=graph.rank_gap[pair],
        competitor=row[graph.competitor[rival]],
    )
