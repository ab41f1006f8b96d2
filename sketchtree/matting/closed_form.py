"""Which matte is locally a mixture of two colours, and keeps to the scribbles? Closed-form matting (Levin et al., the paper's Eq. 1).

    min αᵀLα + λ Σ_{i ∈ S} (α_i − s_i)²    →    (L + λ C_s) α = λ h_s        λ = 100 (Figure 2), then 0 ≤ α ≤ 1 by cutting off
"""

import numpy as np
from jaxtyping import Array, Bool, Float, Key
from scipy.sparse import diags_array

from sketchtree.matting.dissection import Factor
from sketchtree.matting.laplacian import laplacian, volume
from sketchtree.matting.alpha import Matte
from sketchtree.matting.scribbles import Scribbles
from sketchtree.photo.photo import Photo
from sketchtree.watch import Pulse, no_pulse

LAMBDA = 100.0
_LEAST = 1e-10  # of λ: keeps the system regular where pixels touch no window (the corners of tiny pictures)


def closed_form(photo: Photo, scribbles: Scribbles, *, key: Key[Array, ""], pulse: Pulse = no_pulse) -> Matte:
    """The closed-form matte; `key` is not used, and the factorisation has no pulse. Its course is the objective αᵀLα, once."""
    fore, back = scribbles.masks(photo)
    matrix = laplacian(photo.rgb / 255.0)
    pulse()
    alpha = solved(factored(matrix, fore | back), fore)
    return Matte(alpha, "closed-form", (float(alpha.ravel() @ (matrix @ alpha.ravel())),))


def factored(matrix, known: Bool[np.ndarray, "row column"]) -> Factor:
    """L + λ C_s, ready to solve with."""
    weight = LAMBDA * (known.ravel() + _LEAST)
    return Factor(matrix + diags_array(weight), known.shape)


def solved(factor: Factor, fore: Bool[np.ndarray, "row column"]) -> Float[np.ndarray, "row column"]:
    """The minimiser of Eq. 1 for foreground scribbles."""
    return np.clip(factor.solve(LAMBDA * fore.ravel().astype(np.float64)), 0.0, 1.0).reshape(fore.shape)


def normalised_objective(matrix, alpha: Float[np.ndarray, "row column"]) -> float:
    """αᵀLα / αᵀDα (Eq. 3)."""
    flat = alpha.ravel().astype(np.float64)
    return float(flat @ (matrix @ flat)) / max(float(flat @ (volume(alpha.shape) * flat)), 1e-30)
