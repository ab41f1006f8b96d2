"""The worked factors of notebooks/03_your_own_prior_and_factor.ipynb: each does what it promises."""

from functools import cache

import jax
import jax.numpy as jnp
import numpy as np
import pytest

from sketchtree.errors import InferenceError
from sketchtree.mrf.elevation import Elevation
from sketchtree.mrf.factor_graph import factor_graph
from sketchtree.mrf.infer import infer
from sketchtree.mrf.prior import Prior
from tests.mrf.drawings import sketch, small_tree

WALL = -0.07  # z, H


class Wall:
    """Nothing grows behind the wall."""

    def log_potential(self, assignment, theta):
        return -0.5 * (jnp.maximum(WALL - assignment.tip.z, 0.0) / 0.01) ** 2


class Decussate:
    """Each pair of laterals is square to the pair before."""

    def __init__(self, graph):
        limbs = np.flatnonzero(graph.limb_order == 1)
        self.row = graph.limb_first[limbs[np.argsort(graph.insertion[limbs], kind="stable")]]

    def log_potential(self, assignment, theta):
        v = assignment.direction.at(self.row)
        one, other = jnp.arctan2(v.z, v.x)[0::2], jnp.arctan2(v.z, v.x)[1::2]
        opposite, square = jnp.cos(one - other) + 1, jnp.cos(one[1:] - one[:-1])
        return -0.5 * (jnp.concatenate([opposite, square]) / 0.1) ** 2


class Ellipsoid:
    """Tips of laterals lie on an ellipsoid."""

    half, centre = np.array([0.65, 0.6, 0.25]), 0.6

    def __init__(self, graph):
        self.tip = graph.limb_tip[graph.limb_order > 0]
        self.page = (graph.xy[self.tip] - [0.0, self.centre]) / self.half[:2]

    def log_potential(self, assignment, theta):
        return -0.5 * ((self.radius(assignment.tip.z, jnp) - 1) / 0.05) ** 2

    def radius(self, z, numpy=np):
        return numpy.sqrt((self.page**2).sum(1) + (z[self.tip] / self.half[2]) ** 2)


def four_pairs():
    """A trunk with four pairs of opposite limbs."""
    at, parent, xy, limb = 0, [-1], [[0.0, 0.0]], [0]
    for k in range(4):
        parent, xy, limb = [*parent, at], [*xy, [0.0, 25.0 + 18.0 * k]], [*limb, 0]
        at = len(parent) - 1
        for side in (-1, 1):
            parent, xy, limb = [*parent, at], [*xy, [side * (30.0 - 4.0 * k), 37.0 + 18.0 * k]], [*limb, 2 * k + 1 + (side > 0)]
    return sketch([*parent, at], [*xy, [0.0, 100.0]], [*limb, 0])


@cache
def depths(drawing, *, typical=True, **factors):
    """H = 1."""
    graph = factor_graph(drawing())
    fit = infer(graph, Prior(), Elevation(factors=factors, typical=typical), key=jax.random.key(0))
    return graph, fit.depth / graph.scale


def test_nothing_grows_behind_the_wall():
    _, free = depths(small_tree)
    _, z = depths(small_tree, typical=False, wall=Wall())
    assert free.min() < WALL - 0.1, "the wall is in somebody's way"
    assert z.min() > WALL - 0.02
    assert z.max() > 0.1, "the limbs grow on the other side"


def test_each_pair_is_square_to_the_pair_before():
    graph, z = depths(four_pairs, siblings=Decussate)
    row = Decussate(graph).row
    azimuth = np.arctan2(z[row] - z[graph.parent[row]], graph.xy[row, 0] - graph.xy[graph.parent[row], 0])
    assert np.cos(azimuth[0::2] - azimuth[1::2]) == pytest.approx(-1.0, abs=0.15)
    assert np.abs(np.cos(azimuth[2::2] - azimuth[:-2:2])).max() < np.cos(np.radians(70))


def test_tips_lie_near_the_ellipsoid():
    graph, z = depths(small_tree, crown=Ellipsoid)
    _, free = depths(small_tree)
    assert np.abs(Ellipsoid(graph).radius(z) - 1).max() < 0.15
    assert np.abs(Ellipsoid(graph).radius(free) - 1).max() > 0.2


@pytest.mark.parametrize(
    ("value", "told"),
    [
        (lambda assignment, theta: jnp.log(assignment.length - 0.05), r"`mine` returned nan for factor 0 \(segment 0, stroke s0\). Guard divisions"),
        (lambda assignment, theta: jnp.sum(assignment.tip.z), r"`mine` returned an array of shape \(\) and type float32. Return one real number a factor"),
        (lambda assignment, theta: assignment.depth, "`mine` failed: AttributeError: 'Assignment' object has no attribute 'depth'"),
    ],
)
def test_what_can_t_be_a_factor_is_refused_by_name(value, told):
    class Mine:
        log_potential = staticmethod(value)

    with pytest.raises(InferenceError, match=told):
        infer(factor_graph(small_tree()), Prior(), Elevation(factors={"mine": Mine()}), key=jax.random.key(0))
