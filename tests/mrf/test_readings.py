"""Other trees that the drawing may show."""

from functools import cache

import jax
import numpy as np
import pytest

from sketchtree.errors import OptionError
from sketchtree.mrf.answer.readings import DISTINCT, FAR_BELOW, distinct_readings
from sketchtree.mrf.elevation import Elevation
from sketchtree.mrf.factor_graph import factor_graph
from sketchtree.mrf.infer import infer
from sketchtree.mrf.methods import METHODS, solver_named
from sketchtree.mrf.prior import Prior
from tests.mrf.drawings import lone_stroke, random_tree, sketch, small_tree

KEY = jax.random.key(0)
WORLDS = {"small": small_tree, "random": lambda: random_tree(1, 7)}


@cache
def _graph(world):
    return factor_graph(WORLDS[world]())


@cache
def _fit(world, count=4, mirrors=False):
    return infer(_graph(world), Prior(), Elevation(), key=KEY, alternatives=count, mirrors=mirrors)


def _distance(graph, one, other, mirrors):
    """‖z − z'‖ over the tips of laterals, H = 1; the nearer of two mirror images unless they count."""
    tips = graph.limb_tip[graph.limb_spreads]
    away = [np.sqrt(np.mean((one - side * other)[tips] ** 2)) / graph.scale for side in ((1,) if mirrors else (1, -1))]
    return min(away)


@pytest.mark.parametrize("mirrors", [False, True])
@pytest.mark.parametrize("world", list(WORLDS))
def test_the_answer_comes_first_and_is_the_tree_that_is_shown(world, mirrors):
    fit = _fit(world, mirrors=mirrors)
    assert fit.alternatives[0].depth.tobytes() == fit.depth.tobytes()


@pytest.mark.parametrize("mirrors", [False, True])
@pytest.mark.parametrize("world", list(WORLDS))
def test_readings_are_distinct(world, mirrors):
    fit = _fit(world, mirrors=mirrors)
    assert len(fit.alternatives) >= 2
    for k, one in enumerate(fit.alternatives):
        for other in fit.alternatives[:k]:
            assert _distance(_graph(world), one.depth, other.depth, mirrors) >= 0.999 * DISTINCT


@pytest.mark.parametrize("world", list(WORLDS))
def test_no_reading_is_the_mirror_image_of_another_unless_asked_for(world):
    fit = _fit(world)
    mirrored = [_distance(_graph(world), one.depth, -other.depth, True) for k, one in enumerate(fit.alternatives) for other in fit.alternatives[:k]]
    assert min(mirrored) >= 0.999 * DISTINCT


@pytest.mark.parametrize("mirrors", [False, True])
@pytest.mark.parametrize("world", list(WORLDS))
def test_the_log_posterior_falls_and_none_is_far_below(world, mirrors):
    fit = _fit(world, mirrors=mirrors)
    value = np.array([reading.log_posterior for reading in fit.alternatives])
    assert (np.diff(value) <= 0).all()
    assert value[0] == fit.log_posterior
    assert value[-1] >= value[0] - FAR_BELOW * _graph(world).limb_spreads.sum()


@pytest.mark.parametrize("mirrors", [False, True])
@pytest.mark.parametrize("world", list(WORLDS))
def test_odds_add_up_to_one(world, mirrors):
    odds = [reading.odds for reading in _fit(world, mirrors=mirrors).alternatives]
    assert sum(odds) == pytest.approx(1.0)
    assert min(odds) >= 0


def test_asking_for_readings_leaves_the_answer_as_it_is():
    assert infer(_graph("small"), Prior(), Elevation(), key=KEY).depth.tobytes() == _fit("small").depth.tobytes()
    assert infer(_graph("small"), Prior(), Elevation(), key=KEY).alternatives == ()


def test_one_reading_is_the_answer():
    (only,) = _fit("small", 1).alternatives
    assert only.odds == 1.0 and _fit("small", 1).warnings == ()


def test_where_there_are_fewer_than_asked_for_a_warning_says_so():
    """Two limbs: before and behind the trunk, or both on one side. Eleven readings there are not."""
    two = factor_graph(sketch([-1, 0, 1, 2, 1, 2], [[0, 0], [0, 40], [0, 60], [0, 100], [35, 75], [-40, 90]], [0, 0, 0, 0, 1, 2]))
    fit = infer(two, Prior(), Elevation(), key=KEY, alternatives=11)
    found = len(fit.alternatives)
    assert 1 <= found < 11
    assert f"11 readings were asked for; {found} are distinct." in fit.warnings


@pytest.mark.parametrize("method", [method for method in METHODS if method != "elevation"])
def test_other_methods_know_of_one_reading_and_say_so(method):
    fit = infer(_graph("small"), Prior(), solver_named(method), key=KEY, alternatives=3)
    assert fit.alternatives == ()
    assert f"3 readings were asked for; the method `{method}` knows of one." in fit.warnings


def test_a_lone_stroke_has_one_reading():
    fit = infer(factor_graph(lone_stroke()), Prior(), Elevation(), key=KEY, alternatives=3)
    assert fit.alternatives == ()
    assert fit.warnings == ("3 readings were asked for; the method `elevation` knows of one.",)


def test_less_than_none_is_refused():
    with pytest.raises(OptionError) as raised:
        infer(_graph("small"), Prior(), Elevation(), key=KEY, alternatives=-1)
    assert str(raised.value) == "`alternatives=-1` is negative. Give how many readings are wanted, 0 for none but the answer."


def _made(trees, value, samples, count, **options):
    """Readings among trees that are given by the depth of two tips."""
    graph = factor_graph(sketch([-1, 0, 1, 1, 1], [[0, 0], [0, 50], [30, 80], [-30, 80], [0, 100]], [0, 0, 1, 2, 0]))
    columns = np.zeros((5, len(trees)))
    columns[2:4] = np.array(trees).T
    told = np.zeros((5, len(samples)))
    told[2:4] = np.array(samples).T
    return [tuple(r.depth[2:4]) + (r.odds,) for r in distinct_readings(graph, columns, np.array(value, float), 0, told, count, **options)]


def test_the_reading_that_brings_the_samples_nearest_is_taken_first():
    trees = [(0.3, -0.3), (0.3, 0.3), (0.3, 0.0)]
    samples = [(0.3, -0.3)] * 6 + [(-0.3, -0.3)] * 4
    assert _made(trees, [0, -1, -0.5], samples, 2) == [(0.3, -0.3, 0.6), (0.3, 0.3, 0.4)]


def test_trees_nearer_than_distinct_or_far_below_are_no_readings():
    trees = [(0.3, -0.3), (0.3, -0.28), (-0.3, 0.3), (0.3, 0.3)]
    assert _made(trees, [0, -1, -1, -99], [(0.3, -0.3)] * 4, 4) == [(0.3, -0.3, 1.0)]


def test_with_mirrors_the_mirror_image_is_a_reading_of_its_own():
    trees, samples = [(0.3, -0.3), (0.3, 0.3)], [(0.3, -0.3)] * 3 + [(-0.3, 0.3)] * 5
    assert _made(trees, [0, -1], samples, 2) == [(0.3, -0.3, 1.0), (0.3, 0.3, 0.0)]
    assert _made(trees, [0, -1], samples, 2, mirrors=True) == [(0.3, -0.3, 3 / 8), (-0.3, 0.3, 5 / 8)]
