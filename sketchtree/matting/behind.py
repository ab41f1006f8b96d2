"""What is behind the tree at each pixel? What is seen of it near by: the mean and spread of the colours there, and which of its common colours are common there.

Both are moments under Gaussian windows of pixels that count by how surely nothing of the tree is in them. The narrowest window that holds enough of them decides, so that a
gradient is followed closely where much of it shows and bridged where little does.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float
from scipy.ndimage import gaussian_filter
from scipy.special import logsumexp

from sketchtree.matting.colours import PAIRS, Colours
from sketchtree.watch import Pulse, no_pulse

WINDOWS = (6.0, 12.0, 24.0, 60.0)  # pixels, σ
ENOUGH = 0.1  # of a window's weight
_COMMON = 15.0  # pixels, σ of the window in which colours are common
_FINEST = 0.006  # spread of a colour at least, of 1
_ANYWHERE = 1e-4  # share that every colour keeps


@dataclass(frozen=True, eq=False)
class Behind:
    """What is behind each pixel: one Gaussian of its own, and shares of common colours."""

    mean: Float[np.ndarray, "row column 3"]
    covariance: Float[np.ndarray, "row column 6"]  # in the order of `colours.PAIRS`
    common: Colours
    share: Float[np.ndarray, "row column component"]  # of `common`, sums to 1


def look_behind(rgb: Float[np.ndarray, "row column 3"], weight: Float[np.ndarray, "row column"], common: Colours, *, pulse: Pulse = no_pulse) -> Behind:
    """What is behind each pixel, by pixels that count by their weights (0 to 1)."""
    products = np.stack([rgb[..., i] * rgb[..., j] for i, j in PAIRS], axis=-1)
    moments = _windowed(np.concatenate([rgb, products], axis=-1), weight, pulse)
    mean = moments[..., :3]
    covariance = moments[..., 3:] - np.stack([mean[..., i] * mean[..., j] for i, j in PAIRS], axis=-1)
    covariance[..., [k for k, (i, j) in enumerate(PAIRS) if i == j]] += _FINEST**2
    return Behind(mean, covariance, common, _shares(rgb, weight, common))


def _windowed(values: Float[np.ndarray, "row column value"], weight, pulse: Pulse) -> Float[np.ndarray, "row column value"]:
    found, left = np.zeros_like(values), np.ones((*weight.shape, 1))
    for sigma in WINDOWS:
        pulse()
        total = _blurred(weight, sigma)[..., None]
        here = _blurred(values * weight[..., None], sigma) / (total + 1e-9)
        taken = left if sigma == WINDOWS[-1] else left * np.clip(total / ENOUGH, 0.0, 1.0)
        found += taken * here
        left = left - taken
    return found


def _shares(rgb, weight, common: Colours) -> Float[np.ndarray, "row column component"]:
    parts = common.log_parts(rgb.reshape(-1, 3))
    own = np.exp(parts - logsumexp(parts, axis=1, keepdims=True)).reshape(*weight.shape, -1) * weight[..., None]
    share = _blurred(own, _COMMON) + _ANYWHERE * common.weight
    return share / share.sum(axis=-1, keepdims=True)


def _blurred(values: np.ndarray, sigma: float) -> np.ndarray:
    over = (sigma, sigma, 0.0)[: values.ndim]
    return gaussian_filter(values, over, mode="nearest", truncate=3.0)
