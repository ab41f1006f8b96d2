"""How are depths made smooth but for the edges that the photo shows? A guided filter (He et al. 2013) on slanted planes, whose pixels count by how likely they
are.

    q_p = ā_p I_p + b̄_p        a_k = cov_k(I, ρ) / (var_k(I) + ε),  b_k = ρ̄_k − a_k Ī_k

Means over a window are weighted by the likelihood of Eq. 3, 0 where there is no depth, so that nothing flows in from where none was found. For one guide the
filter is a fixed weighting of pixels, so it may be put to each of a plane's three numbers. What is averaged at a pixel is the middle between the depths around
and where the planes around would lie at it: the first alone would flatten a round limb, the second would bulge it by as much (ours). A pixel that would move by
more than `MOST` keeps its depth: it stands at an edge that the photo does not show.
"""

import numpy as np
from jaxtyping import Float
from scipy.ndimage import uniform_filter

EPSILON = 1e-3  # of brightness, squared
MOST = 0.5  # pixels of disparity


def guided(
    value: Float[np.ndarray, "row column"], guide: Float[np.ndarray, "row column"], weight: Float[np.ndarray, "row column"], radius: int, epsilon: float = EPSILON
) -> Float[np.ndarray, "row column"]:
    """The filtered values; unchanged where nothing near has weight."""
    side = 2 * radius + 1

    def mean(of, by, whole):
        return uniform_filter(of * by, side) / np.maximum(whole, 1e-12)

    value, guide, weight = (np.asarray(column, np.float64) for column in (value, guide, weight))
    shift = np.average(value, weights=weight) if weight.sum() > 0 else 0.0
    own, whole = value - shift, uniform_filter(weight, side)
    mean_guide, mean_value = mean(guide, weight, whole), mean(own, weight, whole)
    slope = (mean(guide * own, weight, whole) - mean_guide * mean_value) / (np.maximum(mean(guide * guide, weight, whole) - mean_guide**2, 0.0) + epsilon)
    rest = mean_value - slope * mean_guide
    found = mean(slope, weight, whole) * guide + mean(rest, weight, whole) + shift
    return np.where(whole > 1e-6, found, value)


def smoothed(plane: Float[np.ndarray, "row column 3"], guide, likely, pixel: float, radius: int) -> Float[np.ndarray, "row column"]:
    """Inverse depths after the filter, of planes (ρ, ∂ρ/∂x, ∂ρ/∂y); `pixel`: inverse depth of one pixel of disparity."""
    y, x = np.indices(likely.shape)
    rho, across, down = np.moveaxis(np.asarray(plane, np.float64) / pixel, 2, 0)
    flat = guided(rho - 0.5 * (across * x + down * y), guide, likely, radius)
    found = flat + 0.5 * (x * guided(across, guide, likely, radius) + y * guided(down, guide, likely, radius))
    return np.where(np.abs(found - rho) <= MOST, found, rho) * pixel
