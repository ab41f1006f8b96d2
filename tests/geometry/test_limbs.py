import numpy as np
import pytest
from growing import bushy, drawn, fork, stick

from sketchtree.axes import NULL
from sketchtree.geometry.chains import chains
from sketchtree.geometry.limbs import centre_lines
from sketchtree.skeleton import TreeSkeleton


def distance_to_lines(lines, point):
    """From each point to the nearest point of the fine polylines."""
    inner = np.flatnonzero(np.diff(lines.of_point) == 0)
    a, d = lines.point[inner], lines.point[inner + 1] - lines.point[inner]
    best = np.full(len(point), np.inf)
    for row, p in enumerate(point):
        share = np.clip(np.sum((p - a) * d, axis=1) / np.sum(d * d, axis=1), 0, 1)
        best[row] = np.linalg.norm(p - a - share[:, None] * d, axis=1).min()
    return best


def test_every_row_is_in_one_limb_and_limbs_are_chains():
    tree = bushy(1)
    cut = chains(tree)
    assert sorted(cut.row) == sorted(np.flatnonzero(~tree.is_base))
    for limb in range(len(cut.foot)):
        rows = cut.row[cut.start[limb] : cut.start[limb + 1]]
        assert tree.parent[rows[0]] == cut.foot[limb]
        np.testing.assert_array_equal(tree.parent[rows[1:]], rows[:-1])


def test_limbs_follow_the_limb_column():
    tree = bushy(1)
    cut = chains(tree)
    assert len(cut.foot) == len(np.unique(tree.limb))
    assert len(np.unique(np.stack([cut.of_row, tree.limb]), axis=1).T) == len(cut.foot)


def test_strokes_drawn_end_to_end_become_one_limb():
    tree = stick([(0, y, 0) for y in range(5)], 0.1, limb=np.array([0, 0, 0, 1, 1]))
    assert len(chains(tree).foot) == 1


def test_a_thin_child_does_not_continue_a_thick_limb_that_ends():
    tree = stick([(0, 0, 0), (0, 1, 0), (0, 2, 0)], [0.2, 0.2, 0.02], limb=np.array([0, 0, 1]))
    assert len(chains(tree).foot) == 2


def test_two_stems_of_one_base_both_stand_on_the_ground():
    tree = TreeSkeleton.from_columns(np.array([-1, 0, 0]), np.array([(0, 0, 0), (1, 2, 0), (-1, 2, 0.0)]), np.full(3, 0.05), limb=np.array([0, 0, 1]))
    lines = centre_lines(tree)
    assert lines.is_stem.all() and (lines.parent == NULL).all()


@pytest.mark.parametrize("tree", [drawn(), bushy(2), fork(40, 0.6, 3)], ids=["drawn", "bushy", "fork"])
def test_every_node_lies_on_a_centre_line(tree):
    rows = np.flatnonzero(~tree.is_base)[:300]
    assert distance_to_lines(centre_lines(tree), tree.tip[rows]).max() <= 1e-6 * tree.height


def test_every_drawn_point_lies_on_a_centre_line():
    tree = drawn()
    assert distance_to_lines(centre_lines(tree), tree.curve_points).max() <= 1e-6 * tree.height


def test_the_line_stays_near_a_drawn_polyline_between_its_points():
    tree = drawn()
    lines = centre_lines(tree)
    dense = np.concatenate([0.5 * (curve[1:] + curve[:-1]) for curve in (tree.curve(row) for row in range(1, len(tree)))])
    assert distance_to_lines(lines, dense).max() < 0.004


def test_laterals_start_on_their_parents_line():
    lines = centre_lines(bushy(3))
    lateral = np.flatnonzero(lines.parent != NULL)
    there, _ = lines.at(lines.parent[lateral], lines.parent_s[lateral])
    np.testing.assert_allclose(lines.point[lines.start[lateral]], there, atol=1e-9)


def test_a_lateral_starts_thinner_than_its_parent_is_there():
    lines = centre_lines(bushy(3))
    lateral = np.flatnonzero(lines.parent != NULL)
    _, wood = lines.at(lines.parent[lateral], lines.parent_s[lateral])
    assert (lines.radius[lines.start[lateral]] < wood).all()


def test_an_undrawn_lateral_leans_towards_its_parent_where_it_starts():
    lines = centre_lines(fork(60, 0.5))
    step = lines.point[lines.start[1] + 1] - lines.point[lines.start[1]]
    assert np.degrees(np.arccos(step[1] / np.linalg.norm(step))) < 50


def test_a_drawn_lateral_starts_along_its_stroke():
    tree = fork(60, 0.5)
    tree = tree.replace(kind=np.zeros(len(tree), int))
    lines = centre_lines(tree)
    step = lines.point[lines.start[1] + 1] - lines.point[lines.start[1]]
    assert np.degrees(np.arccos(step[1] / np.linalg.norm(step))) == pytest.approx(60, abs=0.5)


def test_stems_begin_under_the_ground():
    lines = centre_lines(stick([(0, 0, 0), (0, 1, 0)], 0.1), underground=0.3)
    np.testing.assert_allclose(lines.point[0], (0, -0.03, 0))
    assert lines.ground[0] == pytest.approx(0.03)


def test_lengths_rise_along_every_limb():
    lines = centre_lines(drawn())
    same = np.diff(lines.of_point) == 0
    assert (np.diff(lines.s)[same] > 0).all()


def test_a_straight_limb_stays_straight():
    lines = centre_lines(stick([(0, 0, 0), (0, 1, 0), (0, 1.2, 0), (0, 5, 0)], 0.1))
    np.testing.assert_allclose(lines.point[:, [0, 2]], 0.0, atol=1e-12)
    np.testing.assert_allclose(lines.curvature, 0.0, atol=1e-6)


def test_curvature_of_a_circle():
    angle = np.linspace(0, np.pi, 60)
    lines = centre_lines(stick(np.stack([3 - 3 * np.cos(angle), 3 * np.sin(angle), 0 * angle], axis=1), 0.01))
    middle = (lines.s > 2) & (lines.s < 7)
    np.testing.assert_allclose(lines.curvature[middle], 1 / 3, rtol=0.02)


def test_rows_of_no_length_are_passed_over():
    tree = stick([(0, 0, 0), (0, 1, 0), (0, 1, 0), (0, 2, 0)], 0.1)
    assert centre_lines(tree).length[0] == pytest.approx(2.03)


def test_a_tree_without_length_has_no_limbs():
    assert len(centre_lines(stick([(0, 0, 0)], 0.1))) == 0


def test_radius_falls_no_faster_than_the_steepest_taper():
    lines = centre_lines(stick([(0, 0, 0), (0, 1, 0), (0, 1.05, 0), (0, 3, 0)], [0.3, 0.3, 0.05, 0.02]))
    assert (np.diff(lines.radius) / np.diff(lines.s) > -0.26).all()


def test_a_tree_with_only_a_base_has_no_line():
    lines = centre_lines(stick([(0, 0, 0)], 0.1))
    assert len(lines) == 0 and lines.point.shape == (0, 3) and len(lines.length) == 0 and len(lines.first_row) == 0


def test_several_bases_and_nothing_else_have_no_line():
    assert len(centre_lines(TreeSkeleton.from_columns(np.array([-1, -1]), np.zeros((2, 3)), np.ones(2)))) == 0


def test_a_tree_of_one_segment_has_one_line():
    lines = centre_lines(stick([(0, 0, 0), (0, 2, 0)], 0.1))
    assert len(lines) == 1 and lines.is_stem[0] and lines.first_row[0] == 1
    np.testing.assert_allclose(lines.length, 2.03)


def test_rows_that_are_apart_make_limbs_of_their_own():
    tree = stick([(0, y, 0) for y in range(5)], 0.1)
    lines = centre_lines(tree, apart=np.array([False, False, False, True, True]))
    np.testing.assert_allclose(lines.length, [2.03, 2.0])
    np.testing.assert_array_equal(lines.first_row, [1, 3])
