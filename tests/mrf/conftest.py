"""What the tests of inference share: a small factor graph, and double precision where a twin is compared."""

import jax
import pytest

from sketchtree.mrf.factor_graph import FactorGraph, factor_graph
from tests.mrf.drawings import small_tree


@pytest.fixture(scope="session")
def small() -> FactorGraph:
    """The factor graph of `small_tree`."""
    return factor_graph(small_tree())


@pytest.fixture
def double():
    """Double precision in jax while a test runs."""
    with jax.enable_x64(True):
        yield
