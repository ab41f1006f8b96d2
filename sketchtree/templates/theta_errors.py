"""How sure is the Θ of a tree? A standard error for each of its eight parameters.

Of n values with standard deviation σ (s of all pairs, φ of the apical, φ of the lateral ones), taken as normal:

    s.e.(μ) = σ / √(n − 3)              s.e.(σ) = σ / √(2 (n − 3))

(n − 3: the standard deviation of Student's t of n − 1 degrees of freedom, since σ too is unknown; Gelman et al. 2013, §3.2.)

Of n + 3 angles ϕ − offset_i (§4) with mean direction μ_γ, R̄ = mean cos(ϕ − μ_γ) and ρ₂ = mean cos 2(ϕ − μ_γ):

    s.e.(μ_γ) = √(δ / n)                δ = (1 − ρ₂) / (2 R̄²), the circular dispersion (Fisher 1993, §2.3 and §4.4)
    s.e.(σ_γ) = √var(R̄) / (R̄ σ_γ)      var(R̄) = (1 + ρ₂ − 2 R̄²) / (2 n), from σ_γ = √(−2 ln R̄) by the delta method
                                        (Mardia & Jupp 2000, §4.8)

An order's Θ is shrunk towards the whole tree's as if that were `SHRINKAGE` more pairs; its standard errors count these pairs
too, n − 3 + `SHRINKAGE`. What fewer than four pairs tell (or, in an order, none) has NaN.
"""

import numpy as np

from sketchtree.parameters import TreeParameters
from sketchtree.skeleton import TreeSkeleton
from sketchtree.templates.estimate import SHRINKAGE, Pairs, estimate, estimate_by_order, orientation_residual, parent_child_pairs


def estimate_with_errors(tree: TreeSkeleton) -> tuple[TreeParameters, TreeParameters]:
    """(Θ, its standard errors) of the whole tree; the errors stand in the fields of the parameters."""
    return estimate(tree), standard_errors(tree)


def estimate_by_order_with_errors(tree: TreeSkeleton) -> tuple[tuple[TreeParameters, TreeParameters], ...]:
    """(Θ, its standard errors) of the pairs whose parent is of order 0, 1, and 2 or more."""
    pairs, thetas = parent_child_pairs(tree), estimate_by_order(tree)
    order = np.minimum(tree.order[pairs.parent], 2)
    return tuple((theta, _errors(pairs, order == o, theta, SHRINKAGE)) for o, theta in enumerate(thetas))


def standard_errors(tree: TreeSkeleton) -> TreeParameters:
    """The standard errors of `estimate(tree)`, in the fields of the parameters."""
    pairs = parent_child_pairs(tree)
    return _errors(pairs, np.ones(len(pairs.child), bool), estimate(tree), 0.0)


def _errors(pairs: Pairs, among, theta: TreeParameters, more: float) -> TreeParameters:
    apical, lateral = among & pairs.apical, among & ~pairs.apical
    s = _of_normal(theta.sigma_s, among.sum() + more)
    alpha = _of_normal(theta.sigma_alpha, apical.sum() + more)
    beta = _of_normal(theta.sigma_beta, lateral.sum() + more)
    return TreeParameters(*s, *alpha, *beta, *_of_angles(orientation_residual(pairs, among, theta.mu_gamma), more))


def _of_normal(sd: float, n: float) -> tuple[float, float]:
    if n <= 3:
        return np.nan, np.nan
    return float(sd / np.sqrt(n - 3)), float(sd / np.sqrt(2 * (n - 3)))


def _of_angles(residual, more: float) -> tuple[float, float]:
    """Of the mean direction and the circular standard deviation of angles about their mean, 0."""
    n = len(residual) + more - 3
    if n <= 0 or len(residual) < 2:
        return np.nan, np.nan
    length, second = np.cos(residual).mean(), np.cos(2 * residual).mean()
    length = float(np.clip(length, 1e-6, 1 - 1e-12))
    variance = max(1 + second - 2 * length**2, 0.0) / (2 * n)
    spread = np.sqrt(-2 * np.log(length))
    return float(np.sqrt(max(1 - second, 0.0) / (2 * length**2 * n))), float(np.sqrt(variance) / (length * spread))
