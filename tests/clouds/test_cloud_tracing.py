"""How the wood runs through points."""

import numpy as np
import pytest
from scanned import LEFT, LENGTH, RIGHT, TRUNK, bark, feet

from sketchtree.axes import NULL
from sketchtree.clouds.tracing.allometry import GAMMA, radii
from sketchtree.clouds.tracing.circles import circles
from sketchtree.clouds.tracing.joined import joined
from sketchtree.clouds.tracing.layers import layers
from sketchtree.clouds.tracing.limbs import bumps, limbs_of
from sketchtree.clouds.tracing.smoothed import led_back, smoothed, straightened
from sketchtree.clouds.tracing.thickness import Measured, measured
from sketchtree.clouds.tracing.traced import traced
from sketchtree.clouds.tracing.ways import ways
from sketchtree.traverse import is_tip, sum_to_root


def nearest(point, tree) -> int:
    """The row whose tip is nearest."""
    return int(np.linalg.norm(tree.tip - point, axis=1).argmin())


@pytest.fixture(scope="module")
def tree():
    points = bark(noise=0.002)
    return traced(points, feet(points)).skeleton


def test_a_scanned_tree_has_the_length_that_it_had(tree):
    assert tree.length.sum() == pytest.approx(LENGTH, rel=0.06)


def test_its_limbs_are_three_and_end_where_they_did(tree):
    long = np.bincount(np.unique(tree.limb, return_inverse=True)[1], tree.length) > 0.2
    assert long.sum() == 3
    for end in (TRUNK[-1], LEFT[-1], RIGHT[-1]):
        assert np.linalg.norm(tree.tip - end, axis=1).min() < 0.06


@pytest.mark.parametrize(("place", "radius"), [((0.025, 1.0, 0.0), 0.1025), ((0.05, 2.0, 0.0), 0.085), ((0.01, 3.6, 0.08), 0.057), ((-0.8, 3.0, 0.3), 0.034)])
def test_and_are_as_thick_as_they_were(tree, place, radius):
    assert tree.radius[nearest(np.array(place), tree)] == pytest.approx(radius, rel=0.12)


def test_axes_lie_inside_the_wood_not_on_its_bark(tree):
    on_trunk = tree.tip[(tree.limb == tree.limb[0]) & (tree.tip[:, 1] > 0.3) & (tree.tip[:, 1] < 1.8)]
    axis = np.stack([np.interp(on_trunk[:, 1], TRUNK[:, 1], TRUNK[:, k]) for k in (0, 2)], axis=1)
    assert np.linalg.norm(on_trunk[:, [0, 2]] - axis, axis=1).max() < 0.02


def test_a_trunk_that_was_seen_from_one_side_has_its_axis_inside():
    points = bark(noise=0.001, seen_from=(0.0, 0.0, 1.0))
    found = traced(points, feet(points)).skeleton
    on_trunk = (found.limb == found.limb[0]) & (found.tip[:, 1] > 0.4) & (found.tip[:, 1] < 1.6)
    assert np.abs(np.median(found.tip[on_trunk, 2])) < 0.02
    assert np.median(found.radius[on_trunk]) == pytest.approx(0.10, rel=0.15)


def test_a_scan_with_a_gap_in_its_trunk_is_one_tree_still():
    points = bark()
    points = points[(points[:, 1] < 0.8) | (points[:, 1] > 1.2)]
    found = traced(points, feet(points))
    assert found.pieces == 2
    assert found.skeleton.is_base.sum() == 1
    assert found.skeleton.height == pytest.approx(4.0, abs=0.1)


def test_two_feet_are_two_trees_that_share_the_points_between_them():
    points = bark(0.03)
    both = np.concatenate([points, points + [6.0, 0.0, 0.0]])
    found = traced(both, [feet(points)[0], feet(points)[0] + len(points)]).skeleton
    assert found.is_base.sum() == 2
    assert np.bincount(found.tree).min() > 0.4 * len(found)
    assert found.tip[found.tree == found.tree[0], 0].max() < 2.0


def test_the_same_points_give_the_same_tree(tree):
    points = bark(noise=0.002)
    again = traced(points, feet(points)).skeleton
    assert (again.tip == tree.tip).all() and (again.radius == tree.radius).all()


def test_no_branch_is_thicker_than_what_bears_it(tree):
    inner = tree.parent != NULL
    assert (tree.radius[inner] <= tree.radius[tree.parent[inner]] + 1e-12).all()


def test_pieces_are_joined_over_their_narrowest_gap():
    line = np.stack([np.linspace(0, 1, 51), np.zeros(51), np.zeros(51)], axis=1)
    graph = joined(np.concatenate([line, line + [1.2, 0.0, 0.0], line + [1.2, 0.5, 0.0]]))
    assert graph.pieces == 3
    bridges = graph.length > 0.17
    assert graph.length[bridges].min() == pytest.approx(0.2)
    assert graph.length.max() <= 1.5 * 0.5 + 1e-9


def test_ways_keep_to_where_points_are_dense():
    # a direct hop of 1 m against a detour in steps of 0.1: Σ d² of the detour is less
    detour = np.array([[0, 0, 0], *[[0, 0.1 * k, 0] for k in range(1, 6)], *[[0.1 * k, 0.5, 0] for k in range(1, 11)], *[[1, 0.5 - 0.1 * k, 0] for k in range(1, 6)]], float)
    graph = joined(detour, neighbours=len(detour) - 1, reach=100.0)
    way = ways(detour, graph, [np.array([0])])
    assert way.length[-1] > 1.85  # but for corners that are cut
    assert way.before[0] == NULL


def test_layers_put_parents_first_and_every_point_in_a_node():
    points = bark(0.03)
    graph = joined(points)
    found = layers(points, graph, ways(points, graph, feet(points)), np.full(len(points), 0.08))
    assert (found.parent < np.arange(len(found.parent))).all()
    assert (np.bincount(found.of_point, minlength=len(found.parent)) == found.size).all()
    assert found.size.sum() == len(points)


def test_a_circle_is_found_among_points_of_something_else():
    turn = np.linspace(0, 2 * np.pi, 60, endpoint=False)
    ring = np.stack([2 + 0.5 * np.cos(turn), 1 + 0.5 * np.sin(turn)], axis=1)
    other = np.stack([np.linspace(2.8, 3.0, 12), np.full(12, 1.9)], axis=1)
    points = np.concatenate([ring, other])[None]
    found = circles(points, np.ones((1, 72), bool))
    assert found.centre[0] == pytest.approx([2, 1], abs=0.01)
    assert found.radius[0] == pytest.approx(0.5, abs=0.01)
    assert found.seen[0] == 1.0
    assert found.near[0] == pytest.approx(60 / 72, abs=0.03)


def test_half_a_circle_is_known_to_be_half():
    turn = np.linspace(0, np.pi, 40, endpoint=False)
    found = circles(np.stack([np.cos(turn), np.sin(turn)], axis=1)[None], np.ones((1, 40), bool))
    assert found.radius[0] == pytest.approx(1.0, abs=0.01)
    assert found.seen[0] == pytest.approx(0.5, abs=0.09)


def test_a_limb_along_the_bark_is_part_of_it():
    trunk = np.stack([np.zeros(8), 0.1 * np.arange(8), np.zeros(8)], axis=1)
    parent = np.array([NULL, 0, 1, 2, 3, 4, 5, 6, 1, 8, 1, 10])
    centre = np.concatenate([trunk, [[0.05, 0.22, 0.0], [0.05, 0.32, 0.0], [0.2, 0.2, 0.0], [0.4, 0.3, 0.0]]])
    limb = limbs_of(parent, centre)
    part_of = bumps(parent, centre, limb, np.full(12, 0.05), np.full(12, 0.01))
    assert part_of.tolist() == [0, 1, 2, 3, 4, 5, 6, 7, 2, 3, 10, 11]


def test_a_bough_to_which_the_way_comes_down_the_bark_hangs_where_it_leaves_the_trunk():
    trunk = np.stack([np.zeros(12), 0.1 * np.arange(12), np.zeros(12)], axis=1)
    down = [[0.05, 0.1 * k, 0.0] for k in (8.2, 7.2, 6.2, 5.2, 4.2)]  # a strip that was seen beside a gap: its foot is the trunk's ninth node
    out = [[0.05 + 0.1 * k, 0.42 + 0.05 * k, 0.0] for k in range(1, 9)]
    parent = np.array([NULL, *range(11), 8, *range(12, 24)])
    centre = np.concatenate([trunk, down, out])
    limb, radius, width = np.where(np.arange(25) < 12, 0, 12), np.full(25, 0.05), np.full(25, 0.01)
    part_of = bumps(parent, centre, limb, radius, width, strips=True)
    assert part_of[12:17].tolist() == [8, 7, 6, 5, 4], "the strip is bark, and the bough's foot the trunk's fifth node"
    assert (part_of[17:] == np.arange(17, 25)).all(), "the bough stays"
    assert (bumps(parent, centre, limb, radius, width) == np.arange(25)).all(), "layers of one width don't tell"
    short = np.delete(np.arange(25), [13, 14, 15, 16])
    assert (bumps(np.array([NULL, *range(11), 4, *range(12, 20)]), centre[short], limb[short], radius[short], width[short], strips=True)[13:] == np.arange(13, 21)).all(), "one that only leaves stays whole"


def test_of_children_the_one_that_bears_most_goes_on():
    parent = np.array([NULL, 0, 1, 1, 3])
    centre = np.array([[0, 0, 0], [0, 1, 0], [0, 1.5, 0], [0.5, 1.5, 0], [1, 2, 0]], float)
    assert limbs_of(parent, centre).tolist() == [0, 0, 2, 0, 0]


def eq5(parent, step, root_radius, gamma, width):
    borne = sum_to_root(parent, step) + 0.5 * width
    return root_radius * (borne / borne.max()) ** gamma


def test_equation_5_holds_where_all_was_seen_by_it():
    parent = np.array([NULL, *range(30), 10, *range(31, 45)])
    step = np.where(parent == NULL, 0.0, 0.2)
    limb = np.where(np.arange(len(parent)) > 30, 31, 0)
    width = np.full(len(parent), 0.02)
    true = eq5(parent, step, 0.1, GAMMA, 0.02)
    seen = Measured(np.zeros((len(parent), 3)), true, 0.02 * true, np.ones(len(parent)))
    found, gamma = radii(parent, step, limb, seen, width, 1e-4)
    assert gamma == pytest.approx(GAMMA, abs=0.04)
    assert found[~is_tip(parent)] == pytest.approx(true[~is_tip(parent)], rel=0.1)


def test_and_says_how_thick_wood_is_that_was_not_seen():
    parent = np.array([NULL, *range(30), 10, *range(31, 45)])
    step = np.where(parent == NULL, 0.0, 0.2)
    limb = np.where(np.arange(len(parent)) > 30, 31, 0)
    true = eq5(parent, step, 0.1, GAMMA, 0.02)
    hidden = np.arange(len(parent)) > 30
    seen = Measured(np.zeros((len(parent), 3)), np.where(hidden, np.nan, true), np.where(hidden, np.nan, 0.02 * true), np.where(hidden, np.nan, 1.0))
    found, _ = radii(parent, step, limb, seen, np.full(len(parent), 0.02), 1e-4)
    assert found[hidden][:-1] == pytest.approx(true[hidden][:-1], rel=0.2)


def test_a_cluster_of_leaves_is_no_measure_of_wood():
    parent = np.array([NULL, *range(40)])
    step, limb = np.where(parent == NULL, 0.0, 0.1), np.zeros(41, int)
    true = eq5(parent, step, 0.1, GAMMA, 0.02)
    seen_as = np.where(np.arange(41) > 30, 0.3, true)
    off = np.where(np.arange(41) > 30, 0.12, 0.02 * true)
    found, _ = radii(parent, step, limb, Measured(np.zeros((41, 3)), seen_as, off, np.ones(41)), np.full(41, 0.02), 1e-4)
    assert found[31:].max() < 0.06


def test_smoothing_keeps_feet_and_tips():
    parent, centre = np.array([NULL, 0, 1, 2, 3]), np.array([[0, 0, 0], [0.1, 1, 0], [-0.1, 2, 0], [0.1, 3, 0], [0, 4, 0]], float)
    found = smoothed(parent, centre, np.zeros(5, int), np.zeros(5, bool))
    assert (found[[0, 4]] == centre[[0, 4]]).all()
    assert np.abs(found[1:4, 0]).max() < 0.1


def test_thick_wood_is_straight_and_twigs_are_as_crooked_as_they_are():
    zigzag = np.stack([0.1 * (-1.0) ** np.arange(12), 0.2 * np.arange(12), np.zeros(12)], axis=1)
    parent, limb = np.array([NULL, *range(11)]), np.zeros(12, int)
    thick = straightened(parent, zigzag, limb, np.full(12, 0.5))
    thin = straightened(parent, zigzag, limb, np.full(12, 0.001))
    assert np.abs(thick[3:-3, 0]).max() < 0.03
    assert np.abs(thin - zigzag).max() < 0.01


def test_a_branch_leaves_where_its_own_course_leads_back_to():
    up = np.stack([np.zeros(8), 0.2 * np.arange(8), np.zeros(8)], axis=1)
    branch = np.array([[0.3, 1.1, 0.0], [0.5, 1.3, 0.0], [0.7, 1.5, 0.0]])
    parent = np.array([NULL, *range(7), 7, 8, 9])
    limb = np.array([0] * 8 + [8] * 3)
    found = led_back(parent, np.concatenate([up, branch]), limb, np.full(11, 0.02))
    assert found[8] == 4  # at 0.8 m: a line at 45 degrees meets the trunk there


def test_axes_of_nodes_move_from_the_bark_to_the_middle():
    points = bark(0.01, seen_from=(1.0, 0.0, 0.0))
    points = points[points[:, 1] < 1.5]
    graph = joined(points)
    found = layers(points, graph, ways(points, graph, feet(points)), np.full(len(points), 0.05))
    limb = limbs_of(found.parent, found.centre)
    seen = measured(points, found.of_point, found.parent, found.centre, limb, found.width)
    middle = (seen.centre[:, 1] > 0.3) & (seen.centre[:, 1] < 1.2) & seen.known
    assert middle.sum() > 5
    assert found.centre[middle, 0].mean() > 0.05
    assert np.abs(seen.centre[middle, 0] - 0.025 * seen.centre[middle, 1]).max() < 0.02
