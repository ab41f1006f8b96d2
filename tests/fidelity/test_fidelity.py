"""Measures of likeness: what they are for the same tree, for a moved one, for half of one, and what each counts."""

import dataclasses

import numpy as np
import pytest

from sketchtree.axes import NULL
from sketchtree.clouds.cloud import PointCloud
from sketchtree.errors import SkeletonError
from sketchtree.fidelity.distance_colours import oklab, ramp, srgb
from sketchtree.fidelity.distance_file import write_distances
from sketchtree.fidelity.edit_distance import edit_distance
from sketchtree.fidelity.limb_tree import LimbTree, limb_tree
from sketchtree.fidelity.recall import recall
from sketchtree.fidelity.sampled import along, over
from sketchtree.fidelity.scan_distance import coloured, mesh_to_scan, scan_to_mesh, vertices_to_scan
from sketchtree.fidelity.similarity import alike, stava_like
from sketchtree.geometry.mesh import Material, Mesh
from sketchtree.keys import root_key
from sketchtree.skeleton import TreeSkeleton


def forked(lean: float = 0.5, limbs: int = 2) -> TreeSkeleton:
    """A trunk of two metres with limbs that leave at one metre."""
    parent, tip, radius, limb = [NULL, 0, 1], [[0, 0, 0], [0, 1, 0], [0, 2, 0]], [0.1, 0.1, 0.05], [0, 0, 0]
    for k in range(limbs):
        turn = 2 * np.pi * k / limbs
        parent, radius, limb = [*parent, 1], [*radius, 0.04], [*limb, 3 + k]
        tip = [*tip, [lean * np.cos(turn), 1.5, lean * np.sin(turn)]]
    return TreeSkeleton.from_columns(parent, np.array(tip, float), radius, limb=limb, order=[min(one, 1) for one in limb])


def square(size: float = 1.0, at: float = 0.0) -> Mesh:
    """A square of two triangles in the plane z = `at`."""
    corner = size * np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], float) + [0, 0, at]
    return Mesh("wood", corner, np.tile([0.0, 0.0, 1.0], (4, 1)), corner[:, :2], np.array([[0, 1, 2], [0, 2, 3]]), Material("wood"))


def test_a_tree_is_quite_like_itself():
    found = stava_like(forked(), forked())
    assert (found.shape, found.geometry, found.structure, found.total) == pytest.approx((1, 1, 1, 1))


def test_it_does_not_matter_which_tree_is_which():
    one, other = forked(0.5, 2), forked(0.9, 3)
    assert stava_like(one, other).total == pytest.approx(stava_like(other, one).total)


def test_a_tree_that_is_more_unlike_is_less_alike():
    tree = forked(0.5, 3)
    near, far = stava_like(tree, forked(0.55, 3)).total, stava_like(tree, forked(1.5, 8)).total
    assert 1.0 > near > far > 0.0


def test_a_tree_twice_as_large_has_half_its_shape_and_all_its_structure():
    small, large = forked(), forked()
    large = large.replace(tip=2 * large.tip, radius=2 * large.radius)
    found = stava_like(small, large)
    assert found.structure == pytest.approx(1.0)
    assert found.geometry == pytest.approx(1.0)
    assert found.shape < 0.6


def test_alike_is_a_ratio():
    assert alike(1, 4) == alike(4, 1) == 0.25
    assert alike(0, 0) == 1.0


def limbs(parent, length, place=None) -> LimbTree:
    length = np.array(length, float)
    zero = np.zeros(len(length))
    return LimbTree(np.array(parent), length, zero, zero, zero, zero, zero if place is None else np.array(place, float))


def test_editing_nothing_costs_nothing():
    tree = limbs([NULL, 0, 0, 1], [4, 2, 1, 1])
    assert edit_distance(tree, tree) == pytest.approx(0.0)


def test_the_order_of_limbs_counts_nothing():
    assert edit_distance(limbs([NULL, 0, 0, 1], [4, 2, 1, 1]), limbs([NULL, 0, 0, 2], [4, 1, 2, 1])) == pytest.approx(0.0)


def test_taking_a_limb_out_costs_its_share_and_what_the_others_gain():
    # shares 3/4, 1/4 against 1: the trunk changes by a quarter, the limb goes
    assert edit_distance(limbs([NULL, 0], [3, 1]), limbs([NULL], [3])) == pytest.approx(0.5)


def test_a_limb_that_leaves_elsewhere_costs_as_far_as_it_moved():
    found = edit_distance(limbs([NULL, 0], [3, 1], [0, 0.2]), limbs([NULL, 0], [3, 1], [0, 0.7]))
    assert found == pytest.approx(0.25 * 0.5)


def test_a_limb_between_may_be_taken_out_and_what_it_bears_stays():
    # trunk - a - b against trunk - b: only a is gone, if shares of the rest are as they were
    a, b = limbs([NULL, 0, 1], [5, 1, 4]), limbs([NULL, 0], [5, 4])
    assert edit_distance(a, b) <= 0.1 + (5 / 9 - 0.5) + (4 / 9 - 0.4) + 1e-9


def test_nothing_costs_more_than_making_all_anew():
    assert edit_distance(limbs([NULL, *range(5)], [1] * 6), limbs([NULL] + [0] * 5, [1] * 6)) <= 2.0


def test_only_the_longest_limbs_are_compared():
    many = limbs([NULL] + [0] * 40, [10] + [0.01] * 40)
    assert edit_distance(many, limbs([NULL], [10]), most=1) == pytest.approx(0.0)


def test_a_limb_knows_its_length_slope_angle_and_place():
    found = limb_tree(forked(0.5, 2))
    assert found.parent.tolist() == [NULL, 0, 0]
    assert found.length == pytest.approx([2, 0.5**0.5, 0.5**0.5])
    assert found.place.tolist() == [0, 0.5, 0.5]
    assert found.slope == pytest.approx([0, 45, 45])
    assert found.divergence[1:] == pytest.approx([45, 45])
    assert found.straightness == pytest.approx([1, 1, 1])
    assert found.thickness == pytest.approx([0.1, 0.04, 0.04])


def test_all_of_a_tree_is_in_itself():
    found = recall(forked(), forked())
    assert dataclasses.astuple(found) == pytest.approx((0, 1, 1, 1, 1))


def test_a_lost_limb_is_missed_by_recall_and_not_by_precision():
    whole, part = forked(0.5, 2), forked(0.5, 2).select([True, True, True, True, False])
    found = recall(whole, part)
    assert found.tip_recall == pytest.approx(2 / 3)
    assert found.tip_precision == 1.0
    assert found.length_precision == 1.0
    assert found.length_recall == pytest.approx(1 - (0.5**0.5 - 0.03) / (2 + 2 * 0.5**0.5), abs=0.02)


def test_two_tips_are_not_both_found_by_one():
    one = forked(0.5, 2)
    two = one.append({"parent": np.array([1]), "tip": one.tip[3:4] + 0.001, "radius": np.array([0.04]), "limb": np.array([9])})
    assert recall(two, one).tip_recall == pytest.approx(3 / 4)


def test_chamfer_adds_both_ways():
    line = TreeSkeleton.from_columns([NULL, 0], [[0, 0, 0], [0, 1, 0]], [0.1, 0.1])
    moved = line.replace(tip=line.tip + [0.1, 0, 0])
    assert recall(line, moved).chamfer == pytest.approx(0.2, rel=1e-6)


def test_trees_without_height_are_refused():
    flat = TreeSkeleton.from_columns([NULL, 0], [[0, 0, 0], [1, 0, 0]], [0.1, 0.1])
    with pytest.raises(SkeletonError, match="A tree without any height can't be compared. Give trees that stand."):
        stava_like(flat, forked())
    with pytest.raises(SkeletonError, match="A tree without any height or length can't be compared. Give trees that stand."):
        recall(flat, forked())


def test_distances_to_a_surface_are_exact():
    scan = np.array([[0.5, 0.5, 0.25], [0.2, 0.9, -0.5], [2.0, 1.0, 0.0]])
    found = scan_to_mesh(scan, [square()])
    assert found.metres == pytest.approx([0.25, 0.5, 1.0])
    assert found.mean == pytest.approx(1.75 / 3)
    assert found.within(0.5 / found.height) == pytest.approx(2 / 3)


def test_surfaces_are_asked_evenly_however_they_are_cut():
    chance = np.random.default_rng(0)
    scan = np.c_[chance.random((4000, 2)), np.zeros(4000)]
    near, far = square(), square(at=0.3)
    assert mesh_to_scan([near], scan, key=root_key(0), places=2000).mean < 0.02
    both = mesh_to_scan([near, far], scan, key=root_key(0), places=4000)
    assert both.mean == pytest.approx(0.155, abs=0.01)
    assert vertices_to_scan([far], scan).mean == pytest.approx(0.3, abs=0.01)


def test_places_over_a_surface_come_of_the_key():
    a, b, c = (over([square()], 50, key=root_key(seed)) for seed in (0, 0, 1))
    assert (a == b).all() and not (a == c).all()
    assert (a >= 0).all() and (a <= 1).all()


def test_places_along_a_tree_are_evenly_spread():
    place, row = along(forked(), 0.1)
    assert len(place) == 10 + 10 + 7 + 7
    assert np.bincount(row).tolist() == [0, 10, 10, 7, 7]


def test_colours_of_distances_differ_by_even_steps():
    shown = ramp(np.linspace(0, 1, 41))
    step = np.linalg.norm(np.diff(oklab(shown), axis=0), axis=1)
    assert step == pytest.approx(step.mean(), rel=0.02)
    assert srgb(oklab(shown)) == pytest.approx(shown, abs=1e-6)


def test_a_file_of_distances_says_in_plain_text_what_its_colours_mean(tmp_path):
    path = tmp_path / "d.ply"
    found = write_distances(PointCloud([[0.5, 0.5, 0.006], [0.2, 1.0, 0.5], [0.2, 0.0, 0.0]]), [square()], path)
    assert found.metres == pytest.approx([0.006, 0.5, 0])
    head, rows = path.read_bytes().split(b"end_header\n")
    assert b"comment distance: metres from the tree; blue 0, yellow 0.0075, red 0.015 and more; mean 0.1687, 16.867% of the height" in head
    assert b"property float distance" in head
    held = np.frombuffer(rows, [("xyz", "<f4", 3), ("colour", "u1", 3), ("distance", "<f4")])
    assert held["distance"] == pytest.approx([0.006, 0.5, 0])
    assert held["colour"][1].tolist() == coloured(np.array([1.0]), 1.0)[0].tolist()


def test_far_is_red_and_near_is_blue():
    blue, yellow, red = coloured(np.array([0.0, 0.5, 2.0]), 1.0)
    assert blue[2] > blue[0] and red[0] > red[2] and yellow[1] > 200
