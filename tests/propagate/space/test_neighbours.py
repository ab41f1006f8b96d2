"""Neighbours: every voxel is one tree's, what is grown into stays, and nobody is first."""

import numpy as np
import pytest

from sketchtree.axes import NULL
from sketchtree.propagate.space.domain import Domain
from sketchtree.propagate.space.neighbours import Neighbours, Wood
from tests.propagate.worlds import HABIT, drawn_tree

TREE = drawn_tree()
DOMAIN = Domain.of(TREE, None, HABIT, TREE.height)
NOTHING = Wood(np.zeros((0, 3)), np.zeros(0))
GAP = 0.3


def drawn(tree=TREE):
    return Wood.along(tree.start, tree.tip)


def pair(apart=4.0, *, swapped=False):
    places = np.array([[0.0, 0, 0], [apart, 0, 0]])
    places = places[::-1] if swapped else places
    return Neighbours([DOMAIN, DOMAIN], places, np.full(2, GAP))


@pytest.fixture
def territories():
    return pair().claimed([drawn(), drawn()], [NOTHING, NOTHING])


def cloud(count=4000, seed=0):
    return np.random.default_rng(seed).uniform(DOMAIN.low, DOMAIN.high, (count, 3))


def test_two_equal_trees_share_the_space_between_them_in_halves():
    board = drawn_tree(limbs=0)
    both = pair().claimed([drawn(board), drawn(board)], [NOTHING, NOTHING])
    y = np.linspace(1.0, 7.0, 30)
    for x, own in ((1.4, True), (2.8, False)):
        assert (both[0].inside(np.column_stack([np.full(30, x), y, np.zeros(30)])) == own).all()


def test_a_gap_of_a_twig_stays_between_territories(territories):
    point = cloud(20_000)
    first, second = point[territories[0].inside(point)], point[territories[1].inside(point - [4.0, 0, 0])]
    from scipy.spatial import cKDTree

    distance, _ = cKDTree(first).query(second)
    assert distance.min() > 0.7 * GAP


def test_no_place_is_two_trees_own(territories):
    point = cloud()
    assert not (territories[0].inside(point) & territories[1].inside(point - [4.0, 0, 0])).any()


def test_each_tree_keeps_the_voxels_of_its_own_drawn_wood():
    both = pair()
    both.claimed([drawn(), drawn()], [NOTHING, NOTHING])
    for k in (0, 1):
        stands = both.stands[k].copy()
        part = both.owner[both.part[k]]
        assert (part[stands] == k).mean() > 0.9
    assert (both.owner[both.part[0]] != NULL).all()


def test_what_has_been_grown_into_stays_its_trees_whoever_claims_it():
    both = pair()
    both.claimed([drawn(), drawn()], [NOTHING, NOTHING])
    held = [(both.owner[both.part[k]] == k) & both.stands[k] for k in (0, 1)]
    flood = Wood(np.repeat(TREE.tip, 200, axis=0) + [4.0, 0, 0], np.full(200 * len(TREE), 5.0))
    both.claimed([NOTHING, NOTHING], [flood, NOTHING])
    assert (both.owner[both.part[1]][held[1]] == 1).all()
    assert (both.owner[both.part[0]][held[0]] == 0).all()


def test_a_claim_wins_what_nobody_stands_in():
    both = pair()
    point = np.array([[2.6, 5.0, 3.5]])
    before = both.claimed([drawn(), drawn()], [NOTHING, NOTHING])
    claim = Wood(np.repeat(point, 500, axis=0), np.full(500, 5.0))
    after = both.claimed([NOTHING, NOTHING], [claim, NOTHING])
    assert after[0].inside(point).all() and not after[1].inside(point - [4.0, 0, 0]).any()
    assert before[0].own.sum() < after[0].own.sum()


def test_the_order_of_trees_changes_nothing():
    one = pair().claimed([drawn(), drawn()], [NOTHING, NOTHING])
    two = pair(swapped=True).claimed([drawn(), drawn()], [NOTHING, NOTHING])
    for a, b in zip(one, two[::-1], strict=True):
        np.testing.assert_array_equal(a.own, b.own)
        np.testing.assert_array_equal(a.distance, b.distance)


def test_a_step_ends_before_what_is_anothers(territories):
    rng = np.random.default_rng(3)
    start = cloud(3000)
    start = start[territories[0].inside(start)]
    end = start + rng.normal(0, 1.5, start.shape)
    fraction = territories[0].exit_fraction(start, end)
    assert (fraction < 1).any() and (fraction == 1).any() and fraction.min() >= 0
    assert territories[0].inside(start + fraction[:, None] * (end - start)).all()


def test_what_starts_elsewhere_does_not_grow(territories):
    start = cloud()
    start = start[~territories[0].inside(start)]
    assert (territories[0].exit_fraction(start, start + 0.1) == 0).all()


def test_no_strip_of_a_neighbour_is_stepped_over(territories):
    across = territories[0].exit_fraction(np.array([[0.5, 5.0, 0.0]]), np.array([[11.0, 5.0, 0.0]]))
    assert across[0] < 0.4


def test_headings_towards_a_neighbour_turn_away_and_others_stay_to_the_last_bit(territories):
    start = np.tile([1.3, 5.0, 0.3], (2, 1))
    heading = np.array([[1.0, 0, 0], [-1.0, 0, 0]])
    found = territories[0].turned(start, heading, np.full(2, 0.3), np.arange(2))
    assert found[0, 0] < 0.98
    np.testing.assert_array_equal(found[1], heading[1])
    np.testing.assert_allclose(np.linalg.norm(found, axis=1), 1.0)


def test_trees_out_of_reach_have_no_neighbours():
    assert pair(apart=60.0).claimed([drawn(), drawn()], [NOTHING, NOTHING]) == [None, None]


def test_far_trees_leave_a_pair_as_it_is():
    places = np.array([[0.0, 0, 0], [4.0, 0, 0], [900.0, 0, 0]])
    three = Neighbours([DOMAIN] * 3, places, np.full(3, GAP)).claimed([drawn()] * 3, [NOTHING] * 3)
    two = pair().claimed([drawn()] * 2, [NOTHING] * 2)
    assert three[2] is None
    for a, b in zip(three, two, strict=False):
        np.testing.assert_array_equal(a.own, b.own)


def test_the_grid_is_bounded():
    places = np.column_stack([4.0 * np.arange(40), np.zeros((40, 2))])
    row = Neighbours([DOMAIN] * 40, places, np.full(40, GAP), most=100_000)
    assert row.owner.size < 150_000


def test_wood_along_rows_has_their_length_and_ends_at_their_tips():
    wood = drawn()
    assert wood.length.sum() == pytest.approx(TREE.length.sum())
    np.testing.assert_array_equal(wood.point[3::4], TREE.tip)
