"""Depths that a user insists on: the way from the base to each is settled first, and held.

    Σ_{i on the way} dz_i = z*,     |dz_i| ≤ ℓ_i tan 78°

The way from the nearest base, or from the nearest row that is settled already, starts from the depths that are known
(else from the page) and takes up what is missing in proportion to ℓ_i; a stem a tenth as readily as a limb.
"""

from collections.abc import Mapping

import numpy as np
from jaxtyping import Bool, Float

from sketchtree.axes import NULL
from sketchtree.errors import InferenceError
from sketchtree.mrf.factor_graph import FactorGraph
from sketchtree.traverse import sum_from_root

STEEPEST = np.radians(78.0)
STEM = 0.1  # how readily a stem gives way, a limb 1
CLOSE = 1e-9  # H


def held_depths(
    graph: FactorGraph, locked: Mapping[int, float], depth: Float[np.ndarray, " segment"]
) -> tuple[Float[np.ndarray, " segment"], Bool[np.ndarray, " segment"]]:
    """(z of every row with the locks kept, which rows are held). `locked` is {row: z of its tip}, H = 1, as `depth` is.

    Rows that grow from held ones move along with them. Raises `InferenceError`, naming the stroke, for a row that there
    is none of, a base, a depth that is not finite, or one that cannot be reached.
    """
    for row, z in locked.items():
        _check(graph, row, z)
    rise = depth - np.where(graph.is_base, depth, depth[np.maximum(graph.parent, 0)])
    held, z_of = graph.is_base.copy(), np.where(graph.is_base, 0.0, np.nan)
    for row in sorted(locked):
        way = [row]
        while not held[graph.parent[way[-1]]]:
            way.append(int(graph.parent[way[-1]]))
        rows = np.array(way[::-1])
        start = z_of[graph.parent[rows[0]]]
        rise[rows] = _spread(graph, rows, rise[rows], locked[row] - start, row)
        z_of[rows] = start + np.cumsum(rise[rows])
        held[rows] = True
    return sum_from_root(graph.parent, rise), held & ~graph.is_base


def _check(graph, row, z):
    if isinstance(row, bool) or not isinstance(row, int | np.integer) or not 0 <= row < len(graph):
        raise InferenceError(f"There is no segment {row} to lock.", remedy=f"Name a row between 0 and {len(graph) - 1}.")
    name = graph.limb_name[graph.limb[row]]
    if graph.is_base[row]:
        raise InferenceError(f"Segment {row} (stroke {name}) is a base, whose depth is 0.", remedy="Lock a segment's tip instead.")
    if not np.isfinite(z):
        raise InferenceError(f"The locked depth of segment {row} (stroke {name}) is {z}.", remedy="Give a finite number.")


def _spread(graph, rows, rise, wanted, row):
    """`rise` changed so that it adds up to `wanted`, no segment steeper than it may be."""
    most = graph.length[rows] * np.tan(STEEPEST)
    if abs(wanted) > most.sum() + CLOSE:
        start = graph.parent[rows[0]]
        since = "the ground" if graph.is_base[start] else f"the locked segment {start} (stroke {graph.limb_name[graph.limb[start]]})"
        raise InferenceError(
            f"The locked depth of segment {row} (stroke {graph.limb_name[graph.limb[row]]}) is {abs(wanted) * graph.scale:.4g} sketch units "
            f"from that of {since}, farther than the {most.sum() * graph.scale:.4g} that its line of {graph.length[rows].sum() * graph.scale:.4g} "
            "can go at 78°.",
            remedy="Bring the two depths nearer to each other, or free one of them.",
        )
    ready = graph.length[rows] * np.where(graph.limb_parent[graph.limb[rows]] == NULL, STEM, 1.0)
    rise = np.clip(rise, -most, most)
    for _ in range(200):
        missing = wanted - rise.sum()
        if abs(missing) <= CLOSE:
            break
        free = (rise < most) if missing > 0 else (rise > -most)
        share = np.where(free, ready, 0.0)
        rise = np.clip(rise + missing * share / max(share.sum(), 1e-300), -most, most)
    return rise


__all__ = ["held_depths"]
