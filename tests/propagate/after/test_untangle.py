import dataclasses

import numpy as np
import pytest
from tests.propagate.after.crossings import crossing, drawn, post_with, twig
from tests.propagate.after.hanging import KEY, shuffled
from tests.propagate.worlds import HABIT, THETA, circle, drawn_tree

from sketchtree.geometry.radii import PipeRadii
from sketchtree.propagate.after import untangle
from sketchtree.propagate.after.overlaps import is_undrawn, overlapping, share_overlapping
from sketchtree.propagate.after.untangle import Untangle
from sketchtree.propagate.generations import propagate
from sketchtree.propagate.space.envelope import Envelope
from sketchtree.propagate.space.space import Space
from sketchtree.skeleton import Kind, TreeSkeleton
from sketchtree.stage import SkeletonStage

DENSE = dataclasses.replace(HABIT, lateral_spacing=0.3, twig_radius=0.01, max_order=3)
COLUMNS = ("parent", "tip", "radius", "limb", "order", "kind", "curve_points", "curve_start")


@pytest.fixture(scope="module")
def grown():
    """A tree that grew in a round crown, so dense and thick that many branches overlap."""
    found = propagate(drawn_tree(8), DENSE, THETA, generations=4, crown=(circle(points=90),), key=KEY)
    return found, PipeRadii(DENSE)(found.skeleton)


@pytest.fixture(scope="module")
def freed(grown):
    found, tree = grown
    return Untangle(DENSE, found.spaces).run(tree)


def same(one, two):
    return all(np.array_equal(getattr(one, name), getattr(two, name)) for name in COLUMNS)


class Wall:
    """Nothing may be where z < 0, but for what grew there."""

    def inside(self, point):
        return point[:, 2] >= 0

    def exit_fraction(self, start, end, bisections=16):
        return np.where(end[:, 2] >= 0, 1.0, np.where(start[:, 2] > 0, start[:, 2] / (start[:, 2] - end[:, 2] + 1e-300), 0.0))


def test_it_is_a_stage():
    assert isinstance(Untangle(), SkeletonStage)


def test_two_crossing_twigs_part_and_the_lesser_turns():
    tree = crossing()
    free = Untangle(HABIT).run(tree)
    assert len(overlapping(tree)) == 1 and len(overlapping(free.skeleton)) == 0
    moved = np.linalg.norm(free.skeleton.tip - tree.tip, axis=1) > 0
    assert (tree.limb[moved] == 101).all() and moved.sum() == 2
    assert len(free.turned) == 1 and 0 < free.turned[0] < np.radians(5.0)


def test_a_twig_through_a_thick_drawn_limb_gives_way_and_the_drawing_stays():
    tree = crossing(other=drawn)
    tree = tree.replace(radius=np.where(tree.limb == 100, 0.05, tree.radius))
    free = Untangle(HABIT).run(tree).skeleton
    assert len(overlapping(free)) == 0 and len(free) == len(tree)
    np.testing.assert_array_equal(free.tip[tree.kind == Kind.DRAWN], tree.tip[tree.kind == Kind.DRAWN])


def test_a_heavy_undrawn_limb_gives_way_to_a_light_drawn_one():
    tree = post_with(twig(3, [1.2, 3, 0], [2, 3, 0], [3, 3, 0]), drawn(2, [0.5, 2.4, 0], [1.5, 3.6, 0]))
    free = Untangle(HABIT).run(tree).skeleton
    moved = np.linalg.norm(free.tip - tree.tip, axis=1) > 0
    assert (tree.limb[moved] == 100).all() and len(overlapping(free)) == 0


def test_where_no_turn_helps_it_is_cut_just_before_the_other():
    tree = post_with(drawn(0, [1.9, 3, -6], [1.9, 3, 6]), twig(3, [1.0, 3, 0], [2.5, 3, 0]))
    tree = tree.replace(radius=np.where(tree.limb == 100, 1.25, tree.radius))
    free = Untangle(HABIT).run(tree).skeleton
    end = free.tip[free.limb == 101]
    assert len(overlapping(tree)) == 2 and len(overlapping(free)) == 0
    assert len(end) == 1 and 0.2 < end[0, 0] < 1.9 - 1.27
    np.testing.assert_allclose(end[0, 1:], [3.0, 0.0], atol=1e-9)


def test_what_would_be_shorter_than_half_a_twig_goes_altogether():
    cage = drawn(1, [0.2, 3.0, -1.0], [0.2, 3.0, 1.0])
    tree = post_with(cage, twig(3, [0.5, 3, 0], [1.0, 3, 0]))
    tree = tree.replace(radius=np.where(tree.limb == 100, 0.15, tree.radius))
    free = Untangle(HABIT).run(tree)
    assert not (free.skeleton.limb == 101).any() and (tree.limb[free.rows] != 101).all()


def test_nothing_changes_where_nothing_overlaps():
    tree = crossing(0.2)
    free = Untangle(HABIT).run(tree)
    assert free.skeleton is tree and len(free.turned) == 0 and free.rows.tolist() == list(range(len(tree)))


def test_limbs_that_neither_overlap_nor_are_borne_by_what_turned_keep_every_bit(grown, freed):
    _, tree = grown
    still = (freed.skeleton.tip == tree.tip[freed.rows]).all(axis=1)
    assert 0.5 < still.mean() < 0.99
    np.testing.assert_array_equal(freed.skeleton.radius[still & (freed.skeleton.kind == Kind.DRAWN)], tree.radius[tree.kind == Kind.DRAWN])


def test_less_than_1_percent_of_a_grown_tree_still_overlap_and_less_than_3_percent_are_lost(grown, freed):
    _, tree = grown
    before, after = share_overlapping(tree), share_overlapping(PipeRadii(DENSE)(freed.skeleton))
    lost = 1.0 - is_undrawn(freed.skeleton).sum() / is_undrawn(tree).sum()
    assert min(before) > 0.05, before
    assert max(after) < 0.01 and lost < 0.03, (after, lost)


def test_drawn_rows_never_move(grown, freed):
    _, tree = grown
    kept = freed.rows[tree.kind[freed.rows] == Kind.DRAWN]
    assert kept.tolist() == np.flatnonzero(tree.kind == Kind.DRAWN).tolist()
    np.testing.assert_array_equal(freed.skeleton.tip[freed.skeleton.kind == Kind.DRAWN], tree.tip[kept])


def uncut(grown, freed):
    """(rows of what is left that are as long as they were, the same rows of the tree)."""
    tree = grown[1]
    whole = np.abs(freed.skeleton.length - tree.length[freed.rows]) < 1e-9
    return np.flatnonzero(whole), freed.rows[whole]


def test_turning_keeps_lengths(grown, freed):
    tree = grown[1]
    rows, _ = uncut(grown, freed)
    assert len(rows) > 0.98 * len(freed.rows)
    assert (freed.skeleton.length <= tree.length[freed.rows] + 1e-9).all()


def test_turning_keeps_the_angles_of_all_that_a_branch_bears(grown, freed):
    tree, left = grown[1], freed.skeleton
    rows, were = uncut(grown, freed)
    goes_on = left.limb[left.parent[rows]] == left.limb[rows]
    inner = goes_on & is_undrawn(left)[left.parent[rows]] & np.isin(left.parent[rows], rows)

    def cosine(of, some):
        way, above = of.vector[some], of.vector[of.parent[some]]
        return np.einsum("bi,bi->b", way, above) / (np.linalg.norm(way, axis=1) * np.linalg.norm(above, axis=1))

    assert inner.sum() > 500
    np.testing.assert_allclose(cosine(left, rows[inner]), cosine(tree, were[inner]), atol=1e-9)


def test_what_would_only_be_cut_turns_by_more_than_12_degrees_and_nothing_by_more_than_45(freed):
    assert freed.turned.max() <= np.radians(45.0) + 1e-9
    assert (freed.turned <= np.radians(12.0) + 1e-9).mean() > 0.7


def test_no_branch_is_turned_out_of_the_crown_or_into_the_ground(grown, freed):
    found, tree = grown
    crown = found.space.barriers[0]
    moved = (freed.skeleton.tip != tree.tip[freed.rows]).any(axis=1)
    was = crown.inside(tree.tip[freed.rows])
    assert moved.sum() > 100
    assert crown.lobes[0].margin(freed.skeleton.tip[moved & was]).min() > -1e-3
    assert freed.skeleton.tip[:, 1].min() >= 0.0


def test_no_branch_is_turned_into_an_obstacle():
    tree = crossing(0.01)
    free, walled = (Untangle(HABIT, spaces).run(tree).skeleton for spaces in ({}, {0: Space((Wall(),))}))
    away = crossing(-0.01)
    back = Untangle(HABIT, {0: Space((Wall(),))}).run(away.replace(tip=away.tip + [0, 0, 0.02])).skeleton
    for left in (free, walled, back):
        assert len(overlapping(left)) == 0
    assert (walled.tip[:, 2] >= -1e-9).all() and (back.tip[:, 2] >= -1e-9).all()


def test_an_implied_crown_holds_nothing_back():
    tree = crossing()
    tight = dataclasses.replace(Envelope.from_outlines((circle(0.0, 3.0, 1.0, 90),)), binding=False)
    assert same(Untangle(HABIT, {0: Space((tight,))})(tree), Untangle(HABIT)(tree))


def test_the_same_tree_gives_the_same_bytes(grown, freed):
    found, tree = grown
    assert same(Untangle(DENSE, found.spaces)(tree), freed.skeleton)


def test_the_order_of_rows_does_not_matter(grown):
    tree = grown[1]
    tree = tree.replace(curve_points=np.zeros((0, 3)), curve_start=np.zeros(len(tree) + 1, int))
    other, rows = shuffled(tree, 4)
    one, two = Untangle(DENSE).run(tree), Untangle(DENSE).run(other)
    back = np.argsort(rows[two.rows])
    np.testing.assert_array_equal(rows[two.rows][back], one.rows)
    np.testing.assert_array_equal(two.skeleton.tip[back], one.skeleton.tip)
    np.testing.assert_array_equal(two.skeleton.radius[back], one.skeleton.radius)


def test_a_stroke_more_far_away_leaves_every_branch_as_it_was():
    limbs = twig(3, [1.2, 3, 0], [2, 3, 0], [3, 3, 0]), twig(2, [0.5, 2.4, 0], [1.5, 3.6, 0])
    alone, more = post_with(*limbs), post_with(*limbs, drawn(5, [-2, 5, 0], [-3, 6, 0]), twig(6, [-3, 6, 0], [-3.01, 5, 0.5]))
    one, two = Untangle(HABIT)(alone), Untangle(HABIT)(more)
    np.testing.assert_array_equal(two.tip[two.limb == 101], one.tip[one.limb == 101])


def test_a_tree_that_is_too_large_is_left_as_it_is_and_that_is_told(monkeypatch):
    monkeypatch.setattr(untangle, "LARGEST", 5)
    tree = crossing()
    left = Untangle(HABIT).run(tree)
    assert left.skeleton is tree
    assert left.warnings == (
        "With 12 rows the tree is too large to look for branches that run through each other (at most 5), so some may. "
        "Ask for fewer with --max-segments.",
    )


def test_a_tree_of_drawn_branches_alone_is_left_as_it_is():
    tree = drawn_tree(5)
    assert Untangle(HABIT).run(tree).skeleton is tree
    empty = TreeSkeleton.from_columns(np.zeros(0, int), np.zeros((0, 3)), np.zeros(0))
    assert len(Untangle(HABIT)(empty)) == 0
