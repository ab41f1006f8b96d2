"""Chen §5.2.1, ICM: P_ICM and the climb on it."""

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
import pytest

from sketchtree.mrf.chen.bottom_up import BottomUp
from sketchtree.mrf.chen.estep import Reading
from sketchtree.mrf.factor_graph import factor_graph
from sketchtree.mrf.chen.icm import ICM, competing
from sketchtree.parameters import GENERIC
from tests.mrf.drawings import lone_stroke, random_tree, sketch
from tests.twins.chen_model import log_icm

KEY = jax.random.key(0)
THETA = {name: jnp.asarray(value) for name, value in GENERIC.as_dict().items()}


def _start(graph) -> Reading:
    return BottomUp()(graph, GENERIC, Reading(np.zeros(len(graph)), np.zeros(len(graph), int)), KEY)


@pytest.mark.parametrize("seed", [0, 1])
def test_log_p_agrees_with_the_slow_twin(double, seed):
    graph = factor_graph(random_tree(seed, 8))
    reading = _start(graph)
    pairs = ICM().pairs(graph, reading)
    z = np.zeros(len(pairs.xy))
    z[: len(graph)] = reading.depth
    theta = {name: jnp.asarray(value) for name, value in GENERIC.as_dict().items()}
    slow = log_icm(graph, reading.depth, reading.label, GENERIC, list(zip(*competing(graph))), graph.crown_radius)
    assert float(eqx.filter_jit(type(pairs).log_p)(pairs, jnp.asarray(z), theta)) == pytest.approx(slow, rel=1e-4)


@pytest.mark.parametrize("seed", [3, 4])
def test_a_sweep_never_lowers_log_p(seed):
    graph = factor_graph(random_tree(seed, 10))
    reading, icm = _start(graph), ICM()
    pairs = icm.pairs(graph, reading)
    state = icm.init(pairs, reading)
    competitors = list(zip(*competing(graph)))
    value = []
    for _ in range(12):
        depth = np.asarray(state.depth, float)[: len(graph)]
        value.append(log_icm(graph, depth, reading.label, GENERIC, competitors, graph.crown_radius))
        state, _ = icm.step(pairs, THETA, state)
    assert (np.diff(value) >= -1e-5).all() and value[-1] > value[0]


def test_it_ends_when_the_depths_rest(small):
    icm, reading = ICM(tol=0.01), _start(small)
    state = icm.init(icm.pairs(small, reading), reading)
    assert not icm.terminate(state)
    assert not icm.terminate(state._replace(moved=jnp.asarray(0.02)))
    assert icm.terminate(state._replace(moved=jnp.asarray(0.009)))


def test_a_climb_is_its_sweeps_one_after_the_other(small):
    icm, reading = ICM(tol=0.0, max_sweeps=5), _start(small)
    pairs = icm.pairs(small, reading)
    state = icm.init(pairs, reading)
    for _ in range(5):
        state, _ = icm.step(pairs, THETA, state)
    np.testing.assert_allclose(icm(small, GENERIC, reading, KEY).depth, state.depth[: len(small)], atol=1e-5)


def test_bases_and_stem_starts_are_not_moved(small):
    depth = ICM()(small, GENERIC, _start(small), KEY).depth
    assert depth[0] == depth[1] == 0


def test_labels_are_left_alone(small):
    reading = _start(small)
    assert (ICM()(small, GENERIC, reading, KEY).label == reading.label).all()


def test_competition_spreads_two_tips_that_meet_on_the_page():
    xy = [[0, 0], [0, 50], [0, 70], [-20, 80], [0, 100], [20, 90], [1, 100]]
    graph = factor_graph(sketch([-1, 0, 1, 1, 3, 2, 5], xy, [0, 0, 0, 1, 1, 2, 2]))
    apart = {}
    for weight in (0.0, 5.0):
        reading = Reading(np.zeros(7), np.array([0, 0, 1, 2, 1, 1, 1]))
        nudged = reading._replace(depth=np.array([0, 0, 0, 0, 0.01, 0, -0.01]))
        depth = ICM(competition=weight)(graph, GENERIC, nudged, KEY).depth
        apart[weight] = abs(depth[4] - depth[6])
    assert apart[5.0] > apart[0.0]


def test_kin_do_not_compete(small):
    pair = set(zip(*(column.tolist() for column in competing(small))))
    for row in range(1, len(small)):
        assert (min(row, small.parent[row]), max(row, small.parent[row])) not in pair
    assert (6, 7) not in pair and (3, 6) not in pair
    assert len(pair) == len({tuple(sorted(p)) for p in pair})


def test_a_lone_stroke_stays_on_the_page_s_side_of_infinity():
    graph = factor_graph(lone_stroke())
    assert np.isfinite(ICM()(graph, GENERIC, _start(graph), KEY).depth).all()
