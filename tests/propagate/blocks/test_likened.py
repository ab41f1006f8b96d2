import dataclasses

import numpy as np
import pytest
from tests.propagate.worlds import HABIT, THETA, drawn_tree

from sketchtree.propagate.blocks.block import blocks_of, blocks_of_parameters
from sketchtree.propagate.blocks.likened import DEEPER, DIVERGENCE, EVIDENCE, STEP, likened, thoroughness

LENT = blocks_of_parameters(THETA, HABIT)


def own(angle=np.radians(80.0), count=20, reach=0.3):
    """Blocks of a trunk with that many laterals, all alike but for a little spread."""
    blocks = blocks_of(drawn_tree(12))
    rows = np.resize(np.flatnonzero(blocks.lateral_count > 0), count)
    pieces = [blocks.select(np.arange(len(blocks)) == row) for row in rows]
    names = [field.name for field in dataclasses.fields(blocks) if field.name != "start"]
    start = np.r_[0, np.cumsum([len(piece.apical) for piece in pieces])]
    joined = dataclasses.replace(blocks, **{name: np.concatenate([getattr(piece, name) for piece in pieces]) for name in names}, start=start)
    lateral = ~joined.apical
    spread = np.resize([-0.1, 0.0, 0.1], len(lateral))
    return dataclasses.replace(
        joined, divergence=np.where(lateral, angle + spread, joined.divergence), reach=np.where(lateral, reach * np.exp(spread), np.nan)
    )


def laterals(blocks, order):
    at = ~blocks.apical & (blocks.order[blocks.owner] == order)
    return blocks.divergence[at], blocks.reach[at]


def test_a_few_long_limbs_move_all_orders_by_the_same_whole_steps():
    moved = likened(LENT, own(), 0.0)
    for order in (0, 1, 2):
        change = laterals(moved, order)[0] - laterals(LENT, order)[0]
        assert np.ptp(change) < 1e-9 and change[0] > 0
        np.testing.assert_allclose(change[0] / STEP, np.round(change[0] / STEP), atol=1e-9)
        np.testing.assert_array_equal(laterals(moved, order)[1], laterals(LENT, order)[1])


def test_the_weight_is_n_over_n_plus_the_evidence():
    drawn = own(count=20)
    off = np.mean(laterals(drawn, 0)[0]) - np.mean(laterals(LENT, 0)[0])
    change = laterals(likened(LENT, drawn, 0.0), 0)[0] - laterals(LENT, 0)[0]
    assert abs(change[0] - 20 / (20 + EVIDENCE) * off) <= STEP / 2 + 1e-9


def test_one_lateral_more_seldom_moves_anything():
    before, after = (likened(LENT, own(count=count), 0.0) for count in (20, 21))
    np.testing.assert_array_equal(before.divergence, after.divergence)


def test_a_thorough_drawing_gives_its_quantiles_mixed_with_those_of_all_trees():
    drawn = own(count=200)
    w = 200 / (200 + EVIDENCE)
    found = laterals(likened(LENT, drawn, 1.0), 2)[0]
    wanted = w * (laterals(drawn, 0)[0].mean() + DEEPER) + (1 - w) * DIVERGENCE[0]
    assert found.mean() == pytest.approx(wanted, abs=0.02)
    assert np.std(found) < np.std(laterals(LENT, 2)[0]) + DIVERGENCE[1]


def test_ranks_are_kept():
    drawn = own(count=60)
    found, lent = (laterals(blocks, 1)[0] for blocks in (likened(LENT, drawn, 1.0), LENT))
    order = np.argsort(lent, kind="stable")
    assert (np.diff(found[order]) >= -1e-9).all()


def test_apical_children_keep_their_angles_and_lose_their_droop_as_far_as_the_drawing_is_thorough():
    moved = likened(LENT, own(), 0.5)
    np.testing.assert_array_equal(moved.divergence[LENT.apical], LENT.divergence[LENT.apical])
    np.testing.assert_allclose(moved.droop[LENT.apical], 0.5 * LENT.droop[LENT.apical])


def test_nothing_drawn_moves_nothing():
    none = LENT.select(np.zeros(len(LENT), bool))
    moved = likened(LENT, none, 0.0)
    np.testing.assert_allclose(moved.divergence, LENT.divergence)
    np.testing.assert_allclose(moved.reach, LENT.reach)


def test_a_reach_is_moved_no_farther_than_behind_the_limbs_tip():
    moved = likened(LENT, own(count=100, reach=1.4), 1.0)
    lateral = ~moved.apical
    behind = 1.1 * (1.0 - moved.position[moved.owner]) + 0.12
    assert (moved.reach[lateral] <= np.maximum(behind, LENT.reach)[lateral] + 1e-9).all()


@pytest.mark.parametrize("reach, thorough", [(0.3, 0.0), (0.05, 1.0)])
def test_a_drawing_is_thorough_when_it_holds_the_short_limbs(reach, thorough):
    assert thoroughness(own(count=20, reach=reach), LENT) == thorough


def test_seven_limbs_are_too_few_to_tell():
    assert thoroughness(own(count=7, reach=0.05), LENT) == 0.0
