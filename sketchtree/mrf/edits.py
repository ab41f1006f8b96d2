"""Depths after somebody has changed the drawing or a limb: where the next inference starts from.

    infer(graph, prior, Elevation(start=carried(before, fit.depth, graph)), ...)       one more stroke was drawn
    infer(graph, prior, Elevation(start=turned, locked={tip: turned[tip]}), ...)       turned = flipped(graph, fit.depth, limb)
"""

import numpy as np
from jaxtyping import Float

from sketchtree.axes import NULL
from sketchtree.errors import InferenceError
from sketchtree.mrf.factor_graph import FactorGraph
from sketchtree.traverse import limb_chains, sum_from_root


def flipped(graph: FactorGraph, depth: Float[np.ndarray, " segment"], limb: int) -> Float[np.ndarray, " segment"]:
    """Depths with one limb, and all that grows on it, turned to the other side of the page. Raises `InferenceError` for a
    limb that there is none of."""
    if not 0 <= limb < graph.limb_count:
        raise InferenceError(f"There is no limb {limb} to flip.", remedy=f"Name a limb between 0 and {graph.limb_count - 1}.")
    turned = np.zeros(graph.limb_count, bool)
    turned[limb] = True
    for own in np.argsort(graph.limb_first, kind="stable"):  # parents first
        turned[own] |= graph.limb_parent[own] != NULL and turned[graph.limb_parent[own]]
    rise = np.where(graph.is_base, 0.0, depth - depth[np.maximum(graph.parent, 0)])
    return sum_from_root(graph.parent, np.where(turned[graph.limb], -rise, rise))


def carried(before: FactorGraph, depth: Float[np.ndarray, " segment"], graph: FactorGraph) -> Float[np.ndarray, " segment"]:
    """Depths of another drawing of the same tree (sketch units) carried over to `graph`: limbs are told by their ids, slopes along them
    by the share of their length. NaN on limbs that are new."""
    slope = np.full(len(graph), np.nan)
    old = {int(name): limb for limb, name in enumerate(before.limb_id)}
    chains, old_chains = _chains(graph), _chains(before)
    for limb, name in enumerate(graph.limb_id):
        if int(name) in old and limb in chains and old[int(name)] in old_chains:
            rows, source = chains[limb], old_chains[old[int(name)]]
            rise = depth[source] - depth[before.parent[source]]
            middle, end = _share(before, source), _share(graph, rows)
            slope[rows] = np.interp(end, middle, rise / np.maximum(before.length[source] * before.scale, 1e-12))
    return sum_from_root(graph.parent, np.where(graph.is_base, 0.0, slope * graph.length * graph.scale))


def _chains(graph: FactorGraph) -> dict[int, np.ndarray]:
    """limb → its segments, in order."""
    chains = (rows[~graph.is_base[rows]] for rows in limb_chains(graph.parent, graph.limb))
    return {int(graph.limb[rows[0]]): rows for rows in chains if len(rows)}


def _share(graph: FactorGraph, rows) -> Float[np.ndarray, " row"]:
    """Where the middle of each segment of a limb lies, 0 its start, 1 its tip."""
    length = graph.length[rows]
    return (np.cumsum(length) - length / 2) / max(length.sum(), 1e-12)
