"""Trees drawn from the model, ranks of the truth, the long run, the intervals."""

import jax.numpy as jnp
import numpy as np
import pytest

from benchmarks import cases
from benchmarks.calibration import __main__ as command
from benchmarks.calibration import budget, core_model, coverage, sbc
from benchmarks.calibration.core_model import SHARE_SD, draw_topology, draw_world
from sketchtree.keys import root_key
from sketchtree.mrf.answer.posterior import Posterior
from sketchtree.mrf.elevation import Elevation
from sketchtree.mrf.factor_graph import factor_graph
from tests.mrf.drawings import small_tree

BRIEF = sbc.Sampling(chain_count=5, warm=5, draws=4, apart=3)


@pytest.fixture(scope="module")
def small():
    return factor_graph(small_tree())


def some_worlds(variant, count, seed=0):
    rng = np.random.default_rng(seed)
    return [draw_world(draw_topology(rng), variant, rng) for _ in range(count)]


def assigned(world, variant):
    """(the core model of a drawn tree, the true assignment)."""
    graph = factor_graph(world.graph)
    model = sbc.core(graph, variant)
    psi = np.pad(world.elevation, (0, len(model.page.length) - len(graph))).astype(np.float32)
    return model, model.page.assign(jnp.asarray(psi))


@pytest.mark.parametrize("variant", core_model.VARIANTS)
def test_a_drawn_tree_is_one_that_the_model_allows(variant):
    for world in some_worlds(variant, 20):
        graph = factor_graph(world.graph)
        assert 6 <= len(graph) - 1 <= 15 and np.sum(graph.limb_order > 0) >= 3 and graph.limb_order.max() == 2
        assert np.abs(world.elevation).max() <= np.radians(80)
        assert world.graph.height == pytest.approx(core_model.HEIGHT)
        assert graph.length[1:].min() > core_model.SHORTEST * 0.99


def test_limb_lengths_are_those_that_theta_says():
    found = []
    for world in some_worlds("limbs", 40):
        model, assignment = assigned(world, "limbs")
        order = np.asarray(model.limb_length.kind)
        z = (np.asarray(model.limb_length.excess(assignment))[:, None] - world.theta.length_mean) / world.theta.length_sd
        found.append(z[order > 0])
    z = np.concatenate(found)
    assert abs(z.mean()) < 4 / np.sqrt(len(z)) and abs(z.std() - 1) < 4 / np.sqrt(2 * len(z))


def test_segment_lengths_are_those_that_theta_says():
    found = []
    for world in some_worlds("segments", 40):
        model, assignment = assigned(world, "segments")
        kind = np.asarray(model.segment_length.kind)
        z = (np.asarray(model.segment_length.log_length(assignment))[:, None] - world.theta.segment_mean) / world.theta.segment_sd
        found.append(z[kind > 0])
    z = np.concatenate(found)
    assert abs(z.mean()) < 0.25 and abs(z.std() - 1) < 0.2  # what is thrown away bends them a little


def test_shares_are_walked_limb_by_limb():
    world = some_worlds("limbs", 1)[0]
    model, assignment = assigned(world, "limbs")
    length, total = np.asarray(assignment.length), 0.0
    for limb in range(len(world.graph.limb_id)):
        own = np.log(length[: len(world.graph)][(world.graph.limb == limb) & ~world.graph.is_base])
        total -= 0.5 * np.sum((own - own.mean()) ** 2) / SHARE_SD**2
    assert float(jnp.sum(model.own[0].log_potential(assignment, None))) == pytest.approx(total, rel=1e-4)


def test_a_trunk_is_sized_so_that_the_drawing_is_one_high():
    trunk, limbs = np.array([[0, 0], [0, 1.0], [0, 1.0]]), np.array([[0, 0], [0, 0], [0.1, 0.25]])
    assert core_model._size_of_trunk(trunk, limbs) == (pytest.approx(0.75), pytest.approx(0.75))
    assert core_model._size_of_trunk(trunk, 8 * limbs) == (0.0, 0.0)


def test_ranks_of_one_hundred_trees_are_even():
    found = sbc.ranks("limbs", 100, seed=3, sampling=BRIEF)
    rows = {name: sbc.verdict(rank, BRIEF.kept, bins=5) for name, rank in found.items()}
    assert len(rows) == 15 and all(len(rank) == 100 and rank.max() <= 19 for rank in found.values())
    assert sbc.holm(np.array([row.p for row in rows.values()])) > 0.01
    for row in rows.values():
        assert abs(row.cover[50] - 0.5) < 0.2 and abs(row.cover[90] - 0.9) < 0.12


def test_uneven_ranks_are_found():
    rank = np.random.default_rng(0).integers(0, 100, 2000)
    assert sbc.verdict(rank, 99).p > 0.01 and abs(sbc.verdict(rank, 99).cover[90] - 0.9) < 0.03
    narrow = np.where(np.arange(2000) % 20 == 0, 0, rank)
    assert sbc.verdict(narrow, 99).p < 1e-6
    assert sbc.holm(np.array([0.5, 0.01])) == pytest.approx(0.02)


def test_the_reference_runs_fifty_times_the_blocks():
    everyday, one = Elevation(), budget.reference()
    assert budget.RESTARTS * one.default_steps == budget.TIMES * everyday.default_steps
    assert one.chain_count == everyday.chain_count


def test_sides_are_those_that_the_posterior_tells(small):
    rng = np.random.default_rng(0)
    psi = rng.normal(0, 0.5, (6, 4, len(small))) * ~small.is_base
    own = Posterior(small, psi, np.zeros((6, 4)), np.zeros(len(small)), None, root_key(0))
    table = budget.same_side(small, psi.reshape(-1, len(small)))
    limb = np.flatnonzero(small.limb_parent >= 0)
    for a, b in ((0, 1), (1, 3), (2, 4)):
        assert table[a, b] == pytest.approx(own.same_side(limb[a], limb[b]))


def test_samples_do_not_differ_from_themselves(small):
    psi = np.random.default_rng(0).normal(0, 0.5, (40, len(small)))
    assert budget.difference(small, psi, psi) == (0.0, 0.0)
    steepness, odds = budget.difference(small, psi, np.abs(psi) * 0.5)
    assert steepness > 0.05 and odds > 0.3


def test_drawings_are_new_and_of_both_sets():
    names = [case.name for case in budget.drawings(6)]
    assert len(set(names)) == 6 and sum(name.rpartition("_")[2] == "100" for name in names) >= 3
    assert {name.rpartition("_")[0] for name in names} >= {case.name.rpartition("_")[0] for case in cases.real(views=1)[:2]}


def test_the_interval_score_charges_overshoot():
    assert coverage.score(np.array([0.5, 0.95]), np.array([0.2, 0.2]), np.array([0.8, 0.8])) == pytest.approx(0.6 + 20 * 0.15 / 2)


def test_the_constant_interval_is_that_of_the_other_cases():
    even = np.linspace(0, 1, 101)
    low, high = even[None] * 0, even[None] * 0 + 1
    found = [coverage.Measured(even, np.arange(101) % 3, low, high), coverage.Measured(0 * even, np.arange(101) % 3, low, high)]
    assert coverage._constant(found, 1) == pytest.approx([0.05, 0.95])
    all_of_them = coverage.held(found, 0)
    assert all_of_them.cover == 1.0 and all_of_them.width == 1.0 and all_of_them.segments == 202
    assert coverage.held(found, 0, order=1).segments == 68


def test_true_steepness_is_that_of_the_tree():
    case = cases.quality()[0]
    s = coverage.true_steepness(case)
    row = len(s) - 1
    v = case.position[row] - case.position[case.graph.parent[row]]
    assert s[row] == pytest.approx(abs(v[2]) / np.linalg.norm(v)) and s[0] == 0.0


def test_the_commands_print_their_bars(monkeypatch, capsys, tmp_path):
    even = {"E": np.arange(2000) % 100}
    monkeypatch.setattr(sbc, "ranks", lambda *_, **__: even)
    command.main(["sbc", "--variant", "limbs", "--ranks", str(tmp_path / "r.npz")])
    row = budget.Difference("pine", 9, 0.02, 0.2, 0.01, 0.01)
    monkeypatch.setattr(budget, "differences", lambda *_, **__: iter([row]))
    command.main(["budget", "--drawings", "1", "--json", str(tmp_path / "b.json")])
    one = coverage.Measured(np.array([0.2, 0.5]), np.array([1, 1]), np.zeros((4, 2)), np.ones((4, 2)))
    monkeypatch.setattr(coverage, "measured", lambda *_, **__: one)
    command.main(["coverage", "--set", "real", "--cases", "2"])
    told = capsys.readouterr().out
    assert "smallest p after Holm 1.0000 (bar > 0.01): holds" in told
    assert "odds: mean 0.2000 (bar 0.05): FAILS; worst pine 0.2000" in told
    assert "real: 2 cases" in told and (tmp_path / "r.npz").exists() and "pine" in (tmp_path / "b.json").read_text()
