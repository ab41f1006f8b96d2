"""Matte → skeleton (§II.2): what is kept, what is said, and what is refused."""

import re

import numpy as np
import pytest
from scipy.ndimage import distance_transform_edt, gaussian_filter
from silhouettes import LEFT, RIGHT, STEM, capsules, forked, ring

from sketchtree.axes import NULL
from sketchtree.errors import OptionError, SkeletonError, SketchError
from sketchtree.trunk.binary import binary_trunk
from sketchtree.trunk.edits import VertexEdits
from sketchtree.trunk.medial import medial_axis
from sketchtree.trunk.outline import outline, signed_area
from sketchtree.trunk.rooted import rooted
from sketchtree.trunk.segments import convex
from sketchtree.trunk.skeletonise import trunk_skeleton
from sketchtree.trunk.trunk_skeleton import TrunkSkeleton


def tip_near(skeleton: TrunkSkeleton, x: float, y: float) -> float:
    return float(np.hypot(*(skeleton.xy[skeleton.tips] - [x, y]).T).min())


def rough(alpha: np.ndarray, sd: float, seed: int) -> np.ndarray:
    """The same trunk, its contour moved in and out by noise of so many pixels."""
    mask = alpha >= 0.5
    signed = distance_transform_edt(mask) - distance_transform_edt(~mask)
    field = gaussian_filter(np.random.default_rng(seed).normal(size=alpha.shape), 0.7)
    return (signed + sd * field / field.std() > 0).astype(float)


def test_a_stem_with_two_limbs_has_three_tips_at_their_ends():
    skeleton = trunk_skeleton(forked())
    assert len(skeleton.tips) == 3
    assert tip_near(skeleton, 50.0, 14.0) < 2.0
    assert max(tip_near(skeleton, 18.0, 48.0), tip_near(skeleton, 84.5, 38.4)) < 2.0


def test_the_foot_is_the_middle_of_the_lower_edge():
    skeleton = trunk_skeleton(forked())
    assert skeleton.xy[skeleton.root] == pytest.approx([50.0, 120.0], abs=1.0)
    assert skeleton.radius[skeleton.root] == pytest.approx(6.0, abs=0.7)


def test_the_axis_lies_in_the_middle_of_the_wood():
    skeleton = trunk_skeleton(capsules([STEM]))
    assert np.abs(skeleton.xy[:, 0] - 50.0).max() < 0.5


def test_radii_are_those_of_the_euclidean_distance_transform():
    alpha = forked()
    skeleton = trunk_skeleton(alpha)
    transform = distance_transform_edt(alpha >= 0.5)
    inner = np.setdiff1d(np.arange(len(skeleton)), [skeleton.root, *skeleton.tips])
    column, row = np.floor(skeleton.xy[inner]).astype(int).T
    assert np.abs(skeleton.radius[inner] - transform[row, column]).max() < 1.0


def test_a_full_medial_axis_has_many_ends_and_the_pruned_one_few():
    binary = binary_trunk(rough(forked(), 1.0, 3))
    shape = outline(binary)
    count = sum(len(points) for points in shape.rings)
    full = medial_axis(binary, shape.rings, np.arange(count))
    ends = np.bincount(full.edges.ravel()) == 1
    assert ends.sum() > 40
    assert len(trunk_skeleton(rough(forked(), 1.0, 3)).tips) == 3


def test_points_of_the_axis_that_touch_one_segment_alone_are_gone():
    binary = binary_trunk(forked())
    shape = outline(binary)
    half = (np.arange(len(shape.rings[0])) < len(shape.rings[0]) // 2).astype(int)
    axis = medial_axis(binary, shape.rings, half)
    assert (np.bincount(axis.edges.ravel()) == 1).sum() == 2


@pytest.mark.parametrize("seed", range(4))
def test_noise_of_a_pixel_changes_no_branch(seed):
    sturdy = capsules([STEM, (*LEFT[:2], 4.0), (*RIGHT[:2], 4.0)])
    skeleton = trunk_skeleton(rough(sturdy, 1.0, seed))
    assert len(skeleton.tips) == 3 and np.sum(np.bincount(skeleton.edges[:, 0]) > 1) == 2


def test_turning_the_picture_over_turns_the_skeleton_over():
    one, other = trunk_skeleton(forked()), trunk_skeleton(forked()[:, ::-1])
    assert len(one.tips) == len(other.tips)
    assert max(tip_near(other, 100.0 - x, y) for x, y in one.xy[one.tips]) < 1.5


def test_the_contour_runs_between_pixels_with_the_trunk_on_its_left():
    alpha = np.zeros((20, 20))
    alpha[5:15, 4:16] = 1.0
    alpha[9:12, 8:13] = 0.0
    shape = outline(binary_trunk(alpha))
    assert shape.polygons[0].min(axis=0) == pytest.approx([4.0, 5.0]) and shape.polygons[0].max(axis=0) == pytest.approx([16.0, 15.0])
    assert signed_area(shape.polygons[0]) == pytest.approx(120.0, abs=1.0) and signed_area(shape.holes[0]) == pytest.approx(-15.0, abs=1.0)


def test_half_transparent_pixels_move_the_contour_by_parts_of_a_pixel():
    alpha = np.zeros((20, 20))
    alpha[5:15, 5:15] = 1.0
    alpha[5:15, 15] = 0.75
    assert outline(binary_trunk(alpha)).polygons[0][:, 0].max() == pytest.approx(15.5 + 1 / 3, abs=0.01)


def test_the_number_of_vertices_asked_for_is_kept():
    skeleton = trunk_skeleton(forked(), vertices=12)
    assert skeleton.vertex_count == 12


def test_only_convex_vertices_part_the_contour():
    skeleton = trunk_skeleton(forked())
    assert skeleton.parting[0].tolist() == convex(skeleton.vertices[0]).tolist()
    assert 0 < skeleton.parting[0].sum() < len(skeleton.parting[0])


def test_fewer_than_three_vertices_are_refused():
    with pytest.raises(OptionError, match=re.escape("The contour can't be evolved to 2 vertices: a polygon has at least 3. Ask for 3 or more, or let the number be found.")):
        trunk_skeleton(forked(), vertices=2)
    with pytest.raises(OptionError, match="to 1 vertices"):
        trunk_skeleton(forked(), edits=VertexEdits(vertices=1))


def test_more_vertices_than_there_are_is_said():
    skeleton = trunk_skeleton(capsules([((10.0, 10.0), (10.0, 20.0), 3.0)], (30, 20)), vertices=500)
    assert re.fullmatch(r"500 vertices were asked for; \d+ are left, since the contour has no more\.", skeleton.warnings[-1])


def test_an_empty_matte_is_refused():
    with pytest.raises(SketchError, match=re.escape("The matte is empty: nowhere is it half opaque. Draw a foreground scribble along the trunk, or give another matte.")):
        trunk_skeleton(np.full((40, 40), 0.4))


def test_a_matte_that_is_not_finite_is_refused():
    with pytest.raises(SketchError, match="one channel of finite numbers"):
        trunk_skeleton(np.full((40, 40), np.nan))


def test_of_several_pieces_the_largest_is_kept_and_the_others_are_said():
    alpha = np.maximum(forked(), capsules([((85.0, 90.0), (95.0, 90.0), 3.0)]))
    skeleton = trunk_skeleton(alpha)
    assert len(skeleton.tips) == 3
    assert re.fullmatch(r"The matte is in pieces: one other piece was left out \(\d\.\d% of its pixels\)\.", skeleton.warnings[0])


def test_of_several_pieces_the_one_that_holds_the_root_is_kept():
    alpha = np.maximum(forked(), capsules([((85.0, 70.0), (85.0, 115.0), 4.0)]))
    skeleton = trunk_skeleton(alpha, root=(85.0, 117.0))
    assert skeleton.xy[:, 0].min() > 80.0 and skeleton.xy[skeleton.root, 1] > 110.0


def test_pieces_over_a_small_gap_may_be_joined_one_after_the_other():
    alpha = forked()
    alpha[:, 30:32] = alpha[:, 25:27] = 0.0
    assert tip_near(trunk_skeleton(alpha), 18.0, 48.0) > 8.0
    skeleton = trunk_skeleton(alpha, gap=3.0)
    assert tip_near(skeleton, 18.0, 48.0) < 2.0 and len(skeleton.tips) == 3
    assert skeleton.warnings == ("2 pieces of the matte were joined to the trunk over gaps of at most 3 pixels.",)


def test_what_hangs_together_by_a_corner_alone_is_followed_through_it():
    alpha = np.zeros((60, 60))
    alpha[30:60, 28:33] = 1.0
    alpha[5:30, 33:38] = 0.51
    skeleton = trunk_skeleton(alpha)
    assert tip_near(skeleton, 35.5, 5.0) < 2.0 and len(skeleton.tips) == 1


def test_a_root_beside_the_trunk_or_the_picture_is_refused():
    with pytest.raises(OptionError, match=re.escape("The root (5, 110) lies 39 pixels beside the trunk.")):
        trunk_skeleton(forked(), root=(5.0, 110.0))
    with pytest.raises(OptionError, match=re.escape("The root (500, 10) lies outside the picture of 100 × 120 pixels.")):
        trunk_skeleton(forked(), root=(500.0, 10.0))


def test_a_given_root_is_where_the_tree_stands():
    skeleton = trunk_skeleton(forked(), root=(18.0, 48.0))
    assert np.hypot(*(skeleton.xy[skeleton.root] - [18.0, 48.0])) < 4.0
    assert tip_near(skeleton, 50.0, 119.0) < 8.0


def test_small_holes_are_filled_and_large_ones_cut():
    alpha = ring()
    alpha[110, 50] = 0.0
    skeleton = trunk_skeleton(alpha)
    assert skeleton.warnings == ("1 small hole in the trunk was filled.", "The trunk has 1 hole; the loop round each is cut where the ways round it meet.")


def test_a_loop_is_cut_where_it_is_thinnest():
    skeleton = trunk_skeleton(ring())
    assert len(skeleton.edges) == len(skeleton) - 1
    ends = skeleton.xy[skeleton.tips]
    assert len(ends) == 3 and np.sum((ends[:, 0] > 60) & (ends[:, 1] < 78) & (ends[:, 1] > 45)) >= 1


def test_of_a_cycle_the_edge_with_the_smallest_circle_goes():
    square = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
    tree, loops = rooted(square, np.array([[0, 1], [1, 2], [2, 3], [3, 0]]), np.array([5.0, 4.0, 1.0, 3.0]), 0)
    assert loops == 1
    kept = {frozenset(map(tuple, (tree.xy[row], tree.xy[up]))) for row, up in enumerate(tree.parent) if up != NULL}
    assert frozenset({(0.0, 0.0), (1.0, 0.0)}) in kept and frozenset({(0.0, 0.0), (0.0, 1.0)}) in kept


def test_a_graph_with_a_cycle_is_no_trunk():
    xy = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]])
    with pytest.raises(SkeletonError, match=re.escape("The trunk's graph has a cycle: 3 edges join 3 nodes. Cut every loop; `trunk_skeleton` does so where two ways from the root meet.")):
        TrunkSkeleton(xy, np.array([[0, 1], [1, 2], [2, 0]]), np.ones(3), 0)
    with pytest.raises(SkeletonError, match="in pieces"):
        TrunkSkeleton(np.zeros((4, 2)), np.array([[0, 1], [2, 3], [3, 2]]), np.ones(4), 0)


def test_the_same_matte_gives_the_same_skeleton():
    one, other = trunk_skeleton(forked()), trunk_skeleton(forked())
    assert one.xy.tobytes() == other.xy.tobytes() and one.radius.tobytes() == other.radius.tobytes()


def test_a_limb_is_found_before_a_veil_of_twigs_that_is_half_opaque():
    y, x = np.mgrid[:80, :80]
    alpha = np.where(np.hypot(x - 40, y - 30) < 28, 0.6, 0.0)
    alpha[8:, 38:43] = 1.0
    skeleton = trunk_skeleton(alpha)
    assert len(skeleton.tips) == 1
    assert np.abs(skeleton.xy[:, 0] - 40.5).max() < 2.0


def test_a_silhouettes_contour_stays_where_it_was():
    alpha = forked()
    ring = outline(binary_trunk(alpha)).polygons[0]
    inside = np.pad(alpha, 1) >= 0.5
    assert np.abs(signed_area(ring) - inside.sum()) < 0.03 * inside.sum()


def test_a_gap_that_is_none_is_refused():
    for gap, said in ((-1.0, "-1"), (float("nan"), "nan")):
        with pytest.raises(OptionError, match=re.escape(f"A gap of {said} pixels can't be bridged. Give pixels from 0 on.")):
            trunk_skeleton(forked(), gap=gap)


def test_a_matte_that_is_opaque_all_over_is_told():
    told = "The matte is opaque all over: the whole picture was taken for the trunk. Draw a background scribble beside the tree."
    assert told in trunk_skeleton(np.ones((50, 50))).warnings
