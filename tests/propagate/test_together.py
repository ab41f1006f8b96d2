"""Trees that grow together: each keeps to its own places, none is first, and out of reach nothing changes."""

import numpy as np
import pytest
from scipy.spatial import cKDTree

from sketchtree.keys import root_key
from sketchtree.propagate.generations import Planted, propagate, propagate_together
from sketchtree.propagate.together import Member, Together
from sketchtree.propagate.wanted import Wanted
from sketchtree.skeleton import Kind, TreeSkeleton
from tests.propagate.worlds import HABIT, THETA, circle, drawn_tree

KEY = root_key(0)
NEAR = 1.5  # metres between trunks
TREE = drawn_tree(limbs=8)
FREE = dict(habit=HABIT, theta=THETA)


def stand(*places, tree=TREE, **wanted):
    return [Planted(tree, Wanted(**FREE, **wanted), KEY, np.array([x, 0.0, 0.0])) for x in places]


def alone(tree=TREE, **wanted):
    return propagate(tree, HABIT, THETA, key=KEY, **wanted)


def same(a, b):
    for name in ("parent", "tip", "radius", "limb", "order"):
        np.testing.assert_array_equal(getattr(a.skeleton, name), getattr(b.skeleton, name))


def undrawn(found, x=0.0):
    return found.skeleton.tip[found.skeleton.kind == int(Kind.PROPAGATED)] + [x, 0.0, 0.0]


def shared_voxels(a, b, side=0.5):
    a, b = (set(map(tuple, np.floor(points / side).astype(int))) for points in (a, b))
    return len(a & b)


@pytest.fixture(scope="module")
def close():
    return propagate_together(stand(0.0, NEAR))


@pytest.fixture(scope="module")
def single():
    return alone()


def test_crowns_of_two_equal_trees_overlap_by_less_than_a_tenth_of_what_they_would(close, single):
    without = shared_voxels(undrawn(single), undrawn(single, NEAR))
    assert without > 50
    assert shared_voxels(undrawn(close[0]), undrawn(close[1], NEAR)) < 0.1 * without


def test_no_undrawn_segment_ends_in_anothers_voxels():
    trees = Together([Member(p.tree, p.wanted, p.key, p.place) for p in stand(0.0, NEAR)])
    trees.complete()
    trees._look_round()
    field = trees.neighbours
    for k, growing in enumerate(trees.growing):
        tip = np.concatenate([nodes.tip for nodes, _ in growing.parts]) + trees.members[k].place
        voxel = np.floor((tip - field._corner(k)) / field.pitch).astype(int)
        assert (field.owner[field.part[k]][tuple(voxel.T)] == k).all()


def test_a_gap_of_about_a_twig_stays_between_undrawn_wood(close):
    distance, _ = cKDTree(undrawn(close[0])).query(undrawn(close[1], NEAR))
    assert distance.min() > 0.5 * HABIT.twig_length


def test_outer_sides_grow_as_alone(close, single):
    left = single.skeleton.tip[:, 0] < -1.2
    near, _ = cKDTree(close[0].skeleton.tip).query(single.skeleton.tip[left])
    assert (near < 0.4).mean() > 0.9


@pytest.mark.parametrize("light", [0.0, 0.7])
def test_far_apart_each_tree_is_to_the_last_bit_the_tree_it_is_alone(light):
    single = alone(light=light)
    for found in propagate_together(stand(0.0, 50.0, light=light)):
        same(found, single)


@pytest.mark.parametrize("light", [0.0, 0.7])
def test_the_order_in_which_trees_are_named_changes_nothing(light):
    other = drawn_tree(limbs=5, seed=3)
    planted = [*stand(0.0, 2.2, light=light), *stand(4.0, tree=other, light=light)]
    straight = propagate_together(planted)
    turned = propagate_together(planted[::-1])[::-1]
    for a, b in zip(straight, turned, strict=True):
        same(a, b)


def test_the_same_key_makes_the_same_forest(close):
    for a, b in zip(close, propagate_together(stand(0.0, NEAR)), strict=True):
        same(a, b)


def test_drawn_rows_never_move():
    for found in propagate_together(stand(0.0, 1.0, light=1.0)):
        np.testing.assert_array_equal(found.skeleton.tip[found.drawn_row], TREE.tip)


def test_a_single_tree_without_light_has_no_shared_field():
    trees = Together([Member(TREE, Wanted(**FREE), KEY)])
    assert trees.neighbours is None and not trees.domains
    before = trees.growing[0].space
    trees.complete()
    assert trees.growing[0].space is before


def test_light_turns_growth_up_and_opens_fewer_buds(single):
    lit = alone(light=1.0)

    def rise(found):
        rows = found.skeleton.kind == int(Kind.PROPAGATED)
        vector = found.skeleton.vector[rows]
        return np.mean(vector[:, 1] / np.linalg.norm(vector, axis=1))

    assert rise(lit) > rise(single) + 0.01
    assert len(lit.skeleton) < len(single.skeleton)


def test_a_crown_leans_away_from_a_tall_neighbours_shade():
    tall = drawn_tree(limbs=12, height=14.0)
    planted = [*stand(0.0, light=1.0), *stand(3.0, tree=tall, light=1.0)]
    beside = propagate_together(planted)[0]
    lit = alone(light=1.0)
    rows = beside.skeleton.kind == int(Kind.PROPAGATED)
    assert undrawn(beside)[:, 0].mean() < undrawn(lit)[:, 0].mean() - 0.1
    assert beside.skeleton.vector[rows][:, 0].mean() < 0


@pytest.mark.parametrize("wanted", [dict(fill=True, crown=(circle(),)), dict(generations=2.5), dict(generations=0), dict(max_segments=300)])
def test_every_way_to_grow_works_together_and_far_apart_is_as_alone(wanted):
    single = alone(**wanted)
    for found in propagate_together(stand(0.0, 80.0, **wanted)):
        same(found, single)
    for found in propagate_together(stand(0.0, 2.0, **wanted)):
        assert (np.isfinite(found.skeleton.tip)).all()


def test_each_tree_keeps_to_its_own_crown():
    for found in propagate_together(stand(0.0, 2.0, crown=(circle(),))):
        tip = undrawn(found)
        assert (np.hypot(np.hypot(tip[:, 0], tip[:, 2]), tip[:, 1] - 5.5) <= 4.5 + 1e-6).all()


def beside_each_other(apart: float) -> TreeSkeleton:
    """A drawing of two trees, their rows mixed as strokes may be."""
    from sketchtree.skeleton_joined import joined, moved, reordered

    other = drawn_tree(limbs=5, seed=3)
    other = moved(other.replace(tree=np.ones(len(other), int), limb=other.limb ^ 1), np.array([apart, 0, 0]))
    both = joined([TREE, other])
    order = np.lexsort((both.tree, np.r_[np.arange(len(TREE)), np.arange(len(other))]))
    return reordered(both, order)


def test_trees_of_one_drawing_compete_too():
    drawing = beside_each_other(2.5)
    found = alone(drawing)
    tree, new = found.skeleton, found.skeleton.kind == int(Kind.PROPAGATED)
    apart = [alone(drawing.select(drawing.tree == k)) for k in (0, 1)]
    without = shared_voxels(undrawn(apart[0]), undrawn(apart[1]))
    assert shared_voxels(tree.tip[new & (tree.tree == 0)], tree.tip[new & (tree.tree == 1)]) < 0.1 * without


def test_trees_of_one_drawing_that_stand_far_apart_are_as_drawn_alone():
    drawing = beside_each_other(60.0)
    tree = alone(drawing).skeleton
    for k in (0, 1):
        single = alone(drawing.select(drawing.tree == k)).skeleton
        np.testing.assert_array_equal(tree.select(tree.tree == k).tip, single.tip)


def test_the_rows_of_a_drawing_come_first_in_their_order():
    drawing = beside_each_other(3.0)
    found = alone(drawing)
    np.testing.assert_array_equal(found.skeleton.tip[found.drawn_row], drawing.tip)
    assert (np.diff(found.drawn_row) > 0).all()
    drawn = found.skeleton.kind == int(Kind.DRAWN)
    assert drawn[: drawn.sum()].all() and (np.diff(found.generation) >= 0).all()
    np.testing.assert_array_equal(found.skeleton.tree[found.drawn_row], drawing.tree)
    assert set(found.spaces) == {0, 1}


def test_several_trees_of_a_drawing_share_max_segments():
    found = alone(beside_each_other(3.0), max_segments=400)
    assert found.skeleton.segment_count <= 400 and found.stopped_by == "max_segments"
    assert sum("max_segments" in warning for warning in found.warnings) >= 1
