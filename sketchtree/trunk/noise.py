"""How rough is the contour, and how far must it be evolved so that only its shape is left?

Ours; the paper leaves m to the user. The roughness σ is estimated from how far every point of the contour lies off the line through those `_SPAN` pixels before and after it: for noise that differs from point to
point the median of that is 0.6745 σ √1.5 (and more where the contour bends, which a median hardly sees). A bump as high as h has a relevance of about h however wide it is (`evolution`), and noise leads from
−3 or −4 σ to as much above: so the evolution goes on until the least relevance exceeds `FACTOR` σ, or `LEAST` pixels, which the pixels of an even edge alone need.
"""

from collections.abc import Sequence

import numpy as np
from jaxtyping import Float

FACTOR = 8.0
LEAST = 4.0  # pixels
_SPAN = 6.0  # pixels
_STRIDE = 8  # points, over which their spacing is measured


def roughness(rings: Sequence[Float[np.ndarray, "point 2"]]) -> float:
    """σ, pixels."""
    off = np.concatenate([_off(ring) for ring in rings])
    return float(np.median(off) / (0.6745 * np.sqrt(1.5)))


def noise_level(rings: Sequence[Float[np.ndarray, "point 2"]]) -> float:
    """The relevance below which a vertex is noise, pixels."""
    return max(LEAST, FACTOR * roughness(rings))


def _off(ring) -> Float[np.ndarray, " point"]:
    """Distance of every point from the line through its neighbours `_SPAN` away."""
    stride = max(1, min(_STRIDE, len(ring) // 4))  # from point to point noise makes the contour much longer than it is
    step = float(np.hypot(*(np.roll(ring, -stride, axis=0) - ring).T).mean()) / stride
    k = max(1, min(int(round(_SPAN / max(step, 1e-6))), (len(ring) - 1) // 2))
    before, after = np.roll(ring, k, axis=0), np.roll(ring, -k, axis=0)
    along = after - before
    length = np.maximum(np.hypot(*along.T), 1e-9)
    return np.abs(along[:, 0] * (ring - before)[:, 1] - along[:, 1] * (ring - before)[:, 0]) / length
