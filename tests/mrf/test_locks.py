"""Depths that a user insists on are kept, and nothing else is held than the way to them."""

from functools import cache

import jax
import numpy as np
import optimistix
import pytest

from sketchtree.errors import InferenceError
from sketchtree.mrf.elevation import Elevation
from sketchtree.mrf.factor_graph import factor_graph
from sketchtree.mrf.infer import infer
from sketchtree.mrf.prior import Prior
from sketchtree.mrf.sampling.locks import held_depths
from tests.mrf.drawings import lone_stroke, sketch, small_tree

H = small_tree().height
LIMB_1 = {9: 30.0}  # the tip of limb s1, sketch units
WAYS = {"a limb's tip": LIMB_1, "two on one limb": {5: -12.0, 9: 8.0}, "the trunk's tip": {4: 6.0}, "a limb on a limb": {10: -25.0}}
ALL = {4: 2.0, 9: 20.0, 6: -15.0, 7: 11.0, 8: -9.0, 10: 25.0}  # every limb's tip


@cache
def _graph():
    return factor_graph(small_tree())


def _fit(locked, **options):
    return infer(_graph(), Prior(), Elevation(locked=locked, **options), key=jax.random.key(0))


@cache
def _locked(way):
    return _fit(WAYS[way])


@pytest.mark.parametrize("way", list(WAYS))
def test_a_locked_depth_is_kept_exactly(way):
    fit = _locked(way)
    for row, z in WAYS[way].items():
        assert fit.depth[row] == pytest.approx(z, abs=1e-6 * H)
    assert fit.depth[0] == 0 and np.isfinite(fit.depth).all()


@pytest.mark.parametrize("way", list(WAYS))
def test_every_sample_keeps_the_locks(way):
    for row, z in WAYS[way].items():
        np.testing.assert_allclose(_locked(way).posterior.depth[:, row], z, atol=1e-4 * H)


def test_the_steepest_lock_that_can_be_reached_is_kept():
    most = sum(_graph().length[[1, 5, 9]]) * np.tan(np.radians(78)) * H
    fit = _fit({9: 0.9999 * most})
    assert fit.depth[9] == pytest.approx(0.9999 * most, abs=1e-6 * H)


@pytest.mark.parametrize("typical, polish", [(False, None), (True, optimistix.LBFGS(rtol=1e-5, atol=1e-5))])
def test_the_best_tree_and_the_polished_one_keep_the_locks(typical, polish):
    fit = _fit(LIMB_1, typical=typical, polish=polish)
    assert fit.depth[9] == pytest.approx(30.0, abs=1e-6 * H)


@pytest.mark.parametrize(
    "way, held",
    [("a limb's tip", [1, 5, 9]), ("two on one limb", [1, 5, 9]), ("the trunk's tip", [1, 2, 3, 4]), ("a limb on a limb", [1, 5, 10])],
)
def test_nothing_but_the_way_to_a_lock_is_held(way, held):
    _, rows = held_depths(_graph(), {row: z / H for row, z in WAYS[way].items()}, np.zeros(11))
    assert np.flatnonzero(rows).tolist() == held
    moves = np.ptp(_locked(way).posterior.elevation, axis=(0, 1)) > 0
    assert moves.tolist() == [row not in (0, *held) for row in range(11)]


def test_limbs_that_are_free_still_take_both_sides():
    side = np.sign(_locked("a limb's tip").posterior.elevation[:, :, [6, 7, 8]])
    assert (np.abs(side.mean(axis=(0, 1))) < 0.9).all()


def test_locked_rows_do_not_move_apart():
    """Two limbs that cross on the page, drawn thick, one of them locked: the other gives way."""
    xy = [[0, 0], [-20, 30], [20, 30], [0, 40], [-20, 60], [20, 60], [25, 90], [-25, 90], [0, 80]]
    parent, limb = [-1, 0, 0, 0, 1, 2, 4, 5, 3], [0, 1, 2, 0, 1, 2, 1, 2, 0]
    graph = factor_graph(sketch(parent, xy, limb, width=np.full(9, 4.0)))
    for locked in ({6: 3.0}, {7: 3.0}, {6: 0.5, 7: -0.5}):
        fit = infer(graph, Prior(), Elevation(locked=locked), key=jax.random.key(0))
        for row, z in locked.items():
            assert fit.depth[row] == pytest.approx(z, abs=1e-6 * graph.scale)
        assert len(fit.overlaps) == (len(locked) == 2)


def test_with_all_limbs_locked_the_locks_are_the_answer():
    fit = _fit(ALL)
    for row, z in ALL.items():
        assert fit.depth[row] == pytest.approx(z, abs=1e-6 * H)
    assert np.isfinite(fit.log_posterior)
    assert (np.ptp(fit.posterior.elevation, axis=(0, 1)) == 0).all()


def test_a_lone_stroke_can_be_locked():
    graph = factor_graph(lone_stroke())
    fit = infer(graph, Prior(), Elevation(locked={2: 20.0}), key=jax.random.key(0))
    assert fit.depth[2] == pytest.approx(20.0, abs=1e-6 * graph.scale)
    assert np.isfinite(fit.depth).all()


def test_alternatives_keep_the_locks():
    fit = infer(_graph(), Prior(), Elevation(locked=LIMB_1), key=jax.random.key(0), alternatives=3)
    for reading in fit.alternatives:
        assert reading.depth[9] == pytest.approx(30.0, abs=1e-6 * H)


def test_a_start_is_kept_beside_a_lock_and_what_it_does_not_know_stays_unknown():
    start = np.where(np.arange(11) == 8, np.nan, np.where(_graph().is_base, 0.0, 5.0))
    solver = Elevation(locked=LIMB_1, start=start)
    psi, held = solver._known(_graph())
    assert np.isnan(psi[8]) and np.isfinite(np.delete(psi, 8)).all()
    assert np.flatnonzero(held).tolist() == [1, 5, 9]
    assert infer(_graph(), Prior(), solver, key=jax.random.key(0)).depth[9] == pytest.approx(30.0, abs=1e-6 * H)


def test_what_is_missing_is_shared_by_length_and_a_stem_gives_a_tenth():
    z, _ = held_depths(_graph(), {9: 0.2}, np.zeros(11))
    trunk, first, second = (np.diff([0, *z[[1, 5, 9]]]) / _graph().length[[1, 5, 9]]).tolist()
    assert first == pytest.approx(second)
    assert trunk == pytest.approx(0.1 * first)
    assert z[10] == z[5]  # moves along


def test_what_is_known_already_is_changed_only_by_what_is_missing():
    known = np.where(_graph().is_base, 0.0, 0.01 * np.arange(11))
    z, _ = held_depths(_graph(), {9: known[9]}, known)
    np.testing.assert_allclose(z, known, atol=1e-8)


@pytest.mark.parametrize(
    "locked, message",
    [
        ({11: 1.0}, "There is no segment 11 to lock. Name a row between 0 and 10."),
        ({-1: 1.0}, "There is no segment -1 to lock. Name a row between 0 and 10."),
        ({"s1": 1.0}, "There is no segment s1 to lock. Name a row between 0 and 10."),
        ({True: 1.0}, "There is no segment True to lock. Name a row between 0 and 10."),
        ({1.0: 1.0}, "There is no segment 1.0 to lock. Name a row between 0 and 10."),
        ({0: 0.0}, "Segment 0 (stroke s0) is a base, whose depth is 0. Lock a segment's tip instead."),
        ({9: np.nan}, "The locked depth of segment 9 (stroke s1) is nan. Give a finite number."),
        ({9: np.inf}, "The locked depth of segment 9 (stroke s1) is inf. Give a finite number."),
        (
            {9: 1e4},
            "The locked depth of segment 9 (stroke s1) is 1e+04 sketch units from that of the ground, farther than the 490.3 that its line of "
            "104.2 can go at 78°. Bring the two depths nearer to each other, or free one of them.",
        ),
        (
            {5: 0.0, 9: 200.0},
            "The locked depth of segment 9 (stroke s1) is 200 sketch units from that of the locked segment 5 (stroke s1), farther than the 117.6 "
            "that its line of 25 can go at 78°. Bring the two depths nearer to each other, or free one of them.",
        ),
    ],
    ids=["beyond", "negative", "a name", "a truth", "a fraction", "base", "nan", "inf", "too far", "contradictory"],
)
def test_a_lock_that_can_t_be_kept_is_named(locked, message):
    with pytest.raises(InferenceError) as raised:
        _fit(locked)
    assert str(raised.value) == message
