"""From samples and the best tree to the depths that are shown: typical steepness, signs of the best.

    |ψ_i|     its median over the samples: the best tree alone is too steep here, too flat there
    sign      that of the best tree; which of two mirror images a limb is, no drawing can tell
    stems     three tenths of the median: samples disagree about the side a trunk leans to
    limbs     tan ψ times f_j = (median |Z_js| / |Z_j|)^.6, Z_j the depth from a limb's start to its tip:
              medians along a limb add up to less than the limb
    crown     tan ψ of laterals times f = (median ext z_s / ext z)^.55, ext the extent from front to back

s runs over the samples; f_j lies within 1/1.5 … 1.5, f within 1/1.6 … 1.6. The three powers were chosen on the
synthetic and the measured trees of `benchmarks`.
"""

import numpy as np
from jaxtyping import Float

from sketchtree.mrf.factor_graph import FactorGraph
from sketchtree.traverse import generations

STEM_SHARE = 0.3
LIMB_POWER, LIMB_LIMIT = 0.6, 1.5
CROWN_POWER, CROWN_LIMIT = 0.55, 1.6
ENOUGH = 160  # samples that the two stretches look at


def typical_elevation(
    graph: FactorGraph, samples: Float[np.ndarray, "sample segment"], best: Float[np.ndarray, " segment"]
) -> Float[np.ndarray, " segment"]:
    """ψ of every row from samples of ψ and the best ψ; radians."""
    size = np.median(np.abs(samples), axis=0)
    psi = np.where(best < 0, -size, size)
    psi = np.where(graph.limb_spreads[graph.limb], psi, STEM_SHARE * psi)
    some = samples[:: -(-len(samples) // ENOUGH)].T
    return stretched_crown(graph, stretched_limbs(graph, psi, some), some)


def stretched_limbs(
    graph: FactorGraph, psi: Float[np.ndarray, " segment"], samples: Float[np.ndarray, "segment sample"]
) -> Float[np.ndarray, " segment"]:
    """ψ with the depth of every lateral limb brought towards its median over the samples."""
    typical = np.median(np.abs(_limb_rise(graph, samples)), axis=1)
    own = np.abs(_limb_rise(graph, psi[:, None])[:, 0])
    factor = np.clip((typical / np.maximum(own, 1e-6)) ** LIMB_POWER, 1 / LIMB_LIMIT, LIMB_LIMIT)
    factor = np.where(graph.limb_spreads, factor, 1.0)
    return np.arctan(np.tan(psi) * factor[graph.limb])


def stretched_crown(
    graph: FactorGraph, psi: Float[np.ndarray, " segment"], samples: Float[np.ndarray, "segment sample"]
) -> Float[np.ndarray, " segment"]:
    """ψ with the extent of the whole brought towards its median over the samples."""
    extent, own = np.median(np.ptp(depth_of(graph, samples), axis=0)), np.ptp(depth_of(graph, psi))
    factor = np.clip((extent / max(own, 1e-6)) ** CROWN_POWER, 1 / CROWN_LIMIT, CROWN_LIMIT)
    return np.where(graph.limb_spreads[graph.limb], np.arctan(np.tan(psi) * factor), psi)


def depth_of(graph: FactorGraph, elevation: Float[np.ndarray, "segment *sample"]) -> Float[np.ndarray, "segment *sample"]:
    """z of every tip, H = 1; 0 at a base. Samples may stand in further columns."""
    depth = _rise(graph, elevation)
    for rows in generations(graph.parent)[1:]:
        depth[rows] += depth[graph.parent[rows]]
    return depth


def _rise(graph, elevation):
    return graph.length.reshape(-1, *(1,) * (elevation.ndim - 1)) * np.tan(elevation)


def _limb_rise(graph, elevation):
    """Depth from every limb's start to its tip, per sample."""
    rise = np.zeros((graph.limb_count, elevation.shape[1]))
    np.add.at(rise, graph.limb, _rise(graph, elevation))
    return rise
