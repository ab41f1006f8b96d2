"""How unlike a local mixture of two colours is a matte? The matting Laplacian L of Levin et al., as the paper takes it (Eq. 1 and 2), and the volume D of every pixel.

    L = D − A        A_ij = Σ_{windows w ∋ i, j} (1 + (I_i − μ_w)ᵀ (Σ_w + ε/|w| 1)⁻¹ (I_j − μ_w)) / |w|        D_ii = Σ_j A_ij

The rows of A over one window sum to 1 (the deviations of a window sum to 0), so D_ii is the number of windows that hold pixel i: 9 inside, fewer at the edges. It is not the
diagonal of L, which lacks A_ii. The Laplacian is pymatting's, compiled the first time it is imported on a machine; it is imported nowhere else.
"""

import numpy as np
from jaxtyping import Float
from scipy.ndimage import convolve
from scipy.sparse import csr_array

from sketchtree.errors import OptionError

RADIUS = 1  # pixels: windows of 3 × 3 (Figure 2)
EPSILON = 1e-7  # pymatting's own: how far a window's colours may be from one line of colours


def laplacian(rgb: Float[np.ndarray, "row column 3"], *, epsilon: float = EPSILON) -> csr_array:
    """L over the pixels of a picture of values 0 to 1, row by row."""
    try:
        from pymatting.laplacian.cf_laplacian import cf_laplacian
    except ImportError:
        raise OptionError(
            "Closed-form and normalised matting need the package `pymatting`.",
            remedy="Install it with pip install 'sketchtree[growth]', or use --matting layered.",
        ) from None
    found = csr_array(cf_laplacian(np.ascontiguousarray(rgb, np.float64), epsilon=epsilon, radius=RADIUS))
    found.sum_duplicates()
    found.eliminate_zeros()
    return found


def volume(shape: tuple[int, int]) -> Float[np.ndarray, " pixel"]:
    """D_ii: the number of windows that hold each pixel, row by row."""
    middles = np.zeros(shape)
    middles[RADIUS:-RADIUS, RADIUS:-RADIUS] = 1.0
    return convolve(middles, np.ones((2 * RADIUS + 1,) * 2), mode="constant").ravel()
