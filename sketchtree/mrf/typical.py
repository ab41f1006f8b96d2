"""From samples and the best tree to the depths that are shown: typical steepness, signs of the best.

    |ψ_i|    its median over the samples (MAP itself is too steep here, too flat there)
    sign     that of the best tree; which of two mirror images a limb is, no drawing can tell
    trunk    half the median: a stem leans in depth less than the median of its |ψ| says, because the samples' signs disagree
    stretch  tan ψ of laterals times the factor f that brings the crown's depth to what the samples say,
             f = (median ext z_s / ext z)^p within 1/1.6 … 1.6; medians along a limb add up to less than the limb
"""

import numpy as np
from jaxtyping import Float

from sketchtree.axes import NULL
from sketchtree.mrf.factor_graph import FactorGraph
from sketchtree.traverse import generations

TRUNK = 0.5
STRETCH_POWER = 0.7
STRETCH_LIMIT = 1.6


def typical_elevation(
    graph: FactorGraph, samples: Float[np.ndarray, "sample segment"], best: Float[np.ndarray, " segment"]
) -> Float[np.ndarray, " segment"]:
    """ψ of every row from samples of ψ and the best ψ; radians."""
    size = np.median(np.abs(samples), axis=0)
    psi = np.where(best < 0, -size, size)
    psi = np.where(graph.order == 0, TRUNK * psi, psi)
    return stretched(graph, psi, samples)


def stretched(graph, psi, samples):
    """ψ with its laterals' depths multiplied by the stretch."""
    if not (graph.limb_parent != NULL).any():
        return psi
    extent = np.median(np.ptp(depth_of(graph, samples.T), axis=0))
    own = np.ptp(depth_of(graph, psi))
    factor = np.clip((extent / max(own, 1e-9)) ** STRETCH_POWER, 1 / STRETCH_LIMIT, STRETCH_LIMIT)
    return np.where(graph.order > 0, np.arctan(np.tan(psi) * factor), psi)


def depth_of(graph: FactorGraph, elevation: Float[np.ndarray, "segment *sample"]) -> Float[np.ndarray, "segment *sample"]:
    """z of every tip, H = 1; 0 at a base. Samples may stand in further columns."""
    depth = graph.length.reshape(-1, *(1,) * (elevation.ndim - 1)) * np.tan(elevation)
    for rows in generations(graph.parent)[1:]:
        depth[rows] += depth[graph.parent[rows]]
    return depth
