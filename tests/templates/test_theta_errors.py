"""The standard errors of Θ are as large as its errors are."""

import numpy as np
import pytest

from benchmarks.theta import BAR, THETAS, coverage, misses, tree_of
from sketchtree.skeleton import TreeSkeleton
from sketchtree.templates.estimate import SHRINKAGE, estimate, estimate_by_order, parent_child_pairs
from sketchtree.templates.theta_errors import estimate_by_order_with_errors, estimate_with_errors, standard_errors

TREES = 40
THETA = THETAS["broadleaf"]


@pytest.fixture(scope="module")
def forty():
    """(estimate − truth, standard error) of each parameter in 40 trees drawn from a known Θ."""
    return misses(THETA, TREES, first_seed=5000)


def test_the_truth_lies_within_two_standard_errors(forty):
    shares = coverage(*forty)
    assert shares.mean() >= BAR, shares
    assert (shares >= 0.85).all(), f"40 trees of which 95 % are expected, 3 standard deviations allowed: {shares}"


def test_no_parameter_is_biased(forty):
    error, size = forty
    assert (np.abs(error.mean(axis=0)) < 3.5 * size.mean(axis=0) / np.sqrt(TREES)).all()


def test_the_standard_errors_are_the_formulas():
    tree, _ = tree_of(THETA, 9)
    theta, errors = estimate_with_errors(tree)
    assert theta == estimate(tree)
    pairs = parent_child_pairs(tree)
    n, lateral = len(pairs.child), int((~pairs.apical).sum())
    assert errors.mu_s == pytest.approx(theta.sigma_s / np.sqrt(n - 3))
    assert errors.sigma_beta == pytest.approx(theta.sigma_beta / np.sqrt(2 * (lateral - 3)))
    assert errors.mu_gamma == pytest.approx(theta.sigma_gamma / np.sqrt(n - 3), rel=0.1), "a narrow spread is nearly a normal one"
    assert errors.sigma_gamma == pytest.approx(theta.sigma_gamma / np.sqrt(2 * (n - 3)), rel=0.25)


def test_an_order_counts_the_whole_tree_as_more_pairs():
    tree, _ = tree_of(THETA, 9)
    of_order = estimate_by_order_with_errors(tree)
    assert tuple(theta for theta, _ in of_order) == estimate_by_order(tree)
    pairs = parent_child_pairs(tree)
    on_trunk = int((tree.order[pairs.parent] == 0).sum())
    theta, errors = of_order[0]
    assert errors.mu_s == pytest.approx(theta.sigma_s / np.sqrt(on_trunk + SHRINKAGE - 3))
    whole = standard_errors(tree)
    assert all(part.mu_s > whole.mu_s for _, part in of_order)


def test_what_no_pair_tells_has_no_standard_error():
    stick = TreeSkeleton.from_columns([-1, 0, 1, 2], np.outer(np.arange(4), [0, 1, 0]), np.full(4, 0.1))
    assert all(np.isnan(value) for value in standard_errors(stick).as_dict().values())
