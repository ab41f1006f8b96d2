"""Have the chains seen enough? R̂ and the effective sample size.

Vehtari, Gelman, Simpson, Carpenter & Bürkner 2021, "Rank-normalization, folding, and localization: an improved R̂", in its
rank-normalised, split form. Every chain is cut in two; x are the normal scores of the ranks of all draws (R̂ is the larger
of that of x and of the scores of |draw − median|); with W the mean variance within the m halves of n draws, B n times
the variance of their means:

    var⁺ = (n − 1)/n W + B/n        R̂ = √(var⁺ / W)        ESS = m n / (1 + 2 Σ_t ρ_t)

    ρ_t   1 − (W − mean_m of the autocovariance at lag t) / var⁺; summed over the initial monotone sequence of positive
          pairs (Geyer 1992); ESS is at most m n log10(m n)
"""

import numpy as np
from jaxtyping import Float
from scipy.special import ndtri
from scipy.stats import rankdata


def rhat(draws: Float[np.ndarray, "draw chain *quantity"]) -> Float[np.ndarray, " *quantity"]:
    """R̂ of every quantity; NaN with fewer than four draws or where nothing varies."""
    halves = _halves(draws)
    if len(halves) < 2:
        return np.full(halves.shape[2:], np.nan)
    folded = np.abs(halves - np.median(halves, axis=(0, 1)))
    return np.fmax(_plain_rhat(_normal_scores(halves)), _plain_rhat(_normal_scores(folded)))


def ess(draws: Float[np.ndarray, "draw chain *quantity"]) -> Float[np.ndarray, " *quantity"]:
    """Bulk effective sample size of every quantity; NaN with fewer than four draws or where nothing varies."""
    halves = _halves(draws)
    if len(halves) < 2:
        return np.full(halves.shape[2:], np.nan)
    x = _normal_scores(halves)
    n, m = x.shape[:2]
    covariance = _autocovariance(x).mean(axis=1)
    within = covariance[0] * n / (n - 1)
    plus = within * (n - 1) / n + x.mean(axis=0).var(axis=0, ddof=1)
    with np.errstate(invalid="ignore", divide="ignore"):
        rho = 1 - (within - covariance * n / (n - 1)) / plus
    rho[0] = 1.0
    even = n - n % 2
    pairs = rho[0:even:2] + rho[1:even:2]
    pairs = np.minimum.accumulate(np.where(np.minimum.accumulate(pairs > 0, axis=0), pairs, 0.0), axis=0)
    tau = np.maximum(2 * pairs.sum(axis=0) - 1, 1 / np.log10(m * n))
    return np.where(plus > 0, m * n / tau, np.nan)


def _halves(draws):
    half = len(draws) // 2
    return np.concatenate([draws[:half], draws[len(draws) - half :]], axis=1).astype(float)


def _normal_scores(x):
    flat = x.reshape(-1, *x.shape[2:])
    rank = rankdata(flat, axis=0)
    return ndtri((rank - 0.375) / (len(flat) + 0.25)).reshape(x.shape)


def _plain_rhat(x):
    n = len(x)
    within = x.var(axis=0, ddof=1).mean(axis=0)
    between = x.mean(axis=0).var(axis=0, ddof=1)
    with np.errstate(invalid="ignore", divide="ignore"):
        return np.where(within > 1e-12, np.sqrt((n - 1) / n + between / within), np.nan)


def _autocovariance(x):
    """At every lag, of every chain and quantity."""
    n = len(x)
    centred = x - x.mean(axis=0)
    wave = np.fft.rfft(centred, n=2 * n, axis=0)
    return np.fft.irfft(np.abs(wave) ** 2, axis=0)[:n] / n
