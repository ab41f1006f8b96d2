"""How opaque is a pixel, given which colours are before and behind? A posterior over a grid of alphas.

A pixel's colour is c = α F + (1 − α) B with F ~ N(μ_F, Σ_F) of the tree's mixture, B ~ N(μ_B, Σ_B) of what is behind, so that

    p(c | α) = Σ_F,B w_F w_B N(c; α μ_F + (1 − α) μ_B, α² Σ_F + (1 − α)² Σ_B + σ² I + (Δ²/12) d dᵀ)        d = μ_F − μ_B

    σ   noise of the picture         Δ   width of the grid's cell: its α may lie anywhere in it

The prior is a spike at 0, a lesser one at 1 and an even part between; how much of it is not at 0 differs from place to place.
"""

from functools import partial

import jax
import jax.numpy as jnp
import numpy as np
from jax.scipy.special import logsumexp
from jaxtyping import Array, Float

from sketchtree.matting.behind import Behind
from sketchtree.matting.colours import PAIRS, Colours
from sketchtree.watch import Pulse, no_pulse

GRID = np.array([0.0, 0.02, 0.06, 0.12, 0.2, 0.3, 0.42, 0.54, 0.66, 0.78, 0.89, 0.97, 1.0])
CELL = np.where((GRID > 0) & (GRID < 1), np.gradient(GRID), 0.0)
NOISE = 0.008  # of 1: two levels of 255
OPAQUE = 0.3  # of the prior that is not at 0, the part at 1
_CHUNK = 16384  # pixels at a time: one shape, compiled once
_FORE, _COMMON = 4, 5  # components that mixtures are padded to
_NEVER = -1e6  # log weight of a component that only pads


def posterior(
    rgb: Float[np.ndarray, "row column 3"], fore: Colours, behind: Behind, wood: Float[np.ndarray, "row column"], *, pulse: Pulse = no_pulse
) -> Float[np.ndarray, "alpha row column"]:
    """The probability of each alpha of `GRID` at each pixel; `wood` is the prior probability that it is not 0."""
    rows, columns = wood.shape
    tables = _padded(fore, _FORE) + _padded(behind.common, _COMMON)[1:]
    share = np.zeros((rows * columns, _COMMON))
    share[:, : len(behind.common.weight)] = behind.share.reshape(rows * columns, -1)
    pixels = (rgb.reshape(-1, 3), behind.mean.reshape(-1, 3), behind.covariance.reshape(-1, 6), share, wood.reshape(-1))
    found = []
    for start in range(0, rows * columns, _CHUNK):
        pulse()
        part = [_filled(column[start : start + _CHUNK]) for column in pixels]
        found.append(np.asarray(_chunk(*part, *tables)))
    return np.concatenate(found, axis=1)[:, : rows * columns].reshape(len(GRID), rows, columns)


def _filled(column: np.ndarray) -> Float[Array, "pixel ..."]:
    short = _CHUNK - len(column)
    return jnp.asarray(np.concatenate([column, np.repeat(column[-1:], short, axis=0)]) if short else column, jnp.float32)


def _padded(mixture: Colours, size: int) -> tuple:
    """(log weights, means, covariances as six) with components that never are."""
    count = len(mixture.weight)
    assert count <= size, f"{count} components, {size} at most"
    log_weight, mean, six = np.full(size, _NEVER), np.zeros((size, 3)), np.tile([1.0, 0, 0, 1.0, 0, 1.0], (size, 1))
    log_weight[:count], mean[:count] = np.log(mixture.weight), mixture.mean
    six[:count] = np.stack([mixture.covariance[:, i, j] for i, j in PAIRS], axis=1)
    return tuple(jnp.asarray(table, jnp.float32) for table in (log_weight, mean, six))


@partial(jax.jit)
def _chunk(colour, own_mean, own_six, share, wood, log_fore, fore_mean, fore_six, common_mean, common_six):
    noise = NOISE**2 * jnp.asarray([1.0, 0, 0, 1.0, 0, 1.0], jnp.float32)
    log_half, log_share = jnp.log(jnp.float32(0.5)), jnp.log(jnp.maximum(share, 1e-30))

    def at(alpha_and_cell):
        alpha, cell = alpha_and_cell
        parts = []
        for k in range(_FORE):
            six = alpha**2 * fore_six[k] + noise
            for j in range(-1, _COMMON):
                mean, behind, weight = (own_mean, own_six, log_half) if j < 0 else (common_mean[j], common_six[j], log_half + log_share[:, j])
                apart = fore_mean[k] - mean
                outer = jnp.stack([apart[..., p] * apart[..., q] for p, q in PAIRS], axis=-1)
                spread = six + (1 - alpha) ** 2 * behind + cell**2 / 12 * outer
                parts.append(log_fore[k] + weight + _log_gauss(colour - alpha * fore_mean[k] - (1 - alpha) * mean, spread))
        return logsumexp(jnp.stack(parts), axis=0)

    likelihood = jax.lax.map(at, (jnp.asarray(GRID, jnp.float32), jnp.asarray(CELL, jnp.float32)))
    between = jnp.asarray(CELL / CELL.sum(), jnp.float32)[:, None] * (1 - OPAQUE) * wood
    prior = between.at[0].set(1 - wood).at[-1].set(OPAQUE * wood)
    return jax.nn.softmax(likelihood + jnp.log(prior), axis=0)


def _log_gauss(d: Float[Array, "pixel 3"], six: Float[Array, "pixel 6"]) -> Float[Array, " pixel"]:
    """log N(d; 0, Σ), Σ as its six entries."""
    a, b, c, e, f, g = (six[..., k] for k in range(6))
    ka, kb, kc = e * g - f * f, c * f - b * g, b * f - c * e
    kd, ke, kf = a * g - c * c, b * c - a * f, a * e - b * b
    det = jnp.maximum(a * ka + b * kb + c * kc, 1e-20)
    x, y, z = d[..., 0], d[..., 1], d[..., 2]
    return -0.5 * ((ka * x * x + kd * y * y + kf * z * z + 2 * (kb * x * y + kc * x * z + ke * y * z)) / det + jnp.log(det)) - 2.7568156


def mean(chance: Float[np.ndarray, "alpha row column"]) -> Float[np.ndarray, "row column"]:
    """The expected alpha."""
    return np.tensordot(GRID, chance, axes=1)
