"""Rank-normalised split R̂ and bulk ESS of one quantity, in plain Python from the formulas. Slow on purpose.

Vehtari et al. 2021, §3.1-3.3 and §4; `draws` is a list of chains, each a list of numbers.
"""

import math
from statistics import NormalDist


def halves(draws):
    """Every chain cut in two; the middle draw of an odd number is left out."""
    n = len(draws[0]) // 2
    return [chain[:n] for chain in draws] + [chain[len(chain) - n :] for chain in draws]


def normal_scores(chains):
    """Φ⁻¹((r − 3/8)/(S + 1/4)), r the rank among all S draws, ties sharing the mean of their ranks."""
    everything = sorted(x for chain in chains for x in chain)
    first, last = {}, {}
    for place, x in enumerate(everything, 1):
        first.setdefault(x, place)
        last[x] = place
    size = len(everything)
    return [[NormalDist().inv_cdf(((first[x] + last[x]) / 2 - 3 / 8) / (size + 1 / 4)) for x in chain] for chain in chains]


def mean(x):
    return sum(x) / len(x)


def variance(x):
    return sum((v - mean(x)) ** 2 for v in x) / (len(x) - 1)


def plain_rhat(chains):
    """√(((n − 1)/n W + B/n) / W)."""
    n = len(chains[0])
    within = mean([variance(chain) for chain in chains])
    if within == 0:
        return math.nan
    between = variance([mean(chain) for chain in chains])  # B/n
    return math.sqrt(((n - 1) / n * within + between) / within)


def median(x):
    ordered = sorted(x)
    half = len(x) // 2
    return ordered[half] if len(x) % 2 else (ordered[half - 1] + ordered[half]) / 2


def rhat(draws):
    """The larger of that of the scores and of the scores of |draw − median|."""
    chains = halves(draws)
    middle = median([x for chain in chains for x in chain])
    folded = [[abs(x - middle) for x in chain] for chain in chains]
    return max(plain_rhat(normal_scores(chains)), plain_rhat(normal_scores(folded)))


def autocovariance(x, lag):
    """Σ (x_i − x̄)(x_{i+lag} − x̄) / n."""
    return sum((x[i] - mean(x)) * (x[i + lag] - mean(x)) for i in range(len(x) - lag)) / len(x)


def ess(draws):
    """m n / τ, τ = −1 + 2 Σ of Geyer's initial monotone sequence of ρ_2k + ρ_2k+1, at least 1/log10(m n)."""
    chains = normal_scores(halves(draws))
    m, n = len(chains), len(chains[0])
    within = mean([variance(chain) for chain in chains])
    plus = (n - 1) / n * within + variance([mean(chain) for chain in chains])
    if plus == 0:
        return math.nan
    rho = [1.0]
    for lag in range(1, n):
        shared = mean([autocovariance(chain, lag) * n / (n - 1) for chain in chains])
        rho.append(1 - (within - shared) / plus)
    total, before = 0.0, math.inf
    for k in range(0, n - 1, 2):
        pair = rho[k] + rho[k + 1]
        if pair <= 0:
            break
        before = min(before, pair)
        total += before
    return m * n / max(2 * total - 1, 1 / math.log10(m * n))
