"""Elevations ψ and depths z, one from the other: dz_i = ℓ_i tan ψ_i, z_i = Σ dz on the way from the base."""

import numpy as np
from jaxtyping import Float

from sketchtree.mrf.factor_graph import FactorGraph
from sketchtree.traverse import generations


def elevation_of(graph: FactorGraph, depth: Float[np.ndarray, " segment"]) -> Float[np.ndarray, " segment"]:
    """ψ of every row, radians, from z of every tip, H = 1; 0 at a base, NaN where either end of a segment is."""
    rise = depth - depth[np.maximum(graph.parent, 0)]
    return np.where(graph.is_base, 0.0, np.arctan2(rise, np.maximum(graph.length, 1e-12)))


def depth_of(graph: FactorGraph, elevation: Float[np.ndarray, "segment *sample"]) -> Float[np.ndarray, "segment *sample"]:
    """z of every tip, H = 1; 0 at a base. Samples may stand in further columns."""
    depth = graph.length.reshape(-1, *(1,) * (elevation.ndim - 1)) * np.tan(elevation)
    for rows in generations(graph.parent)[1:]:
        depth[rows] += depth[graph.parent[rows]]
    return depth
