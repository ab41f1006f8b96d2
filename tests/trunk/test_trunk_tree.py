"""Skeleton in the picture → tree in space (§II.3)."""

import re

import numpy as np
import pytest
from silhouettes import capsules, forked

from benchmarks.trunk_limbs import roundness
from sketchtree.errors import OptionError
from sketchtree.keys import root_key
from sketchtree.options import ReadingOptions
from sketchtree.page import page_to_world
from sketchtree.trunk.around import Seen, around, mirrored, seen_about
from sketchtree.trunk.as_tree import as_tree
from sketchtree.trunk.limbs import limb_of, own_radius, trunk_drawing
from sketchtree.trunk.siblings import STEEPEST, Room, leaving, sibling_angles, sibling_depth
from sketchtree.trunk.skeletonise import trunk_skeleton

KEY = root_key(0)
UP = np.array([0.0, 1.0, 0.0])


def bushy() -> np.ndarray:
    """A stem with five limbs, one of them with a twig."""
    stem = ((100.0, 250.0), (100.0, 20.0), 7.0)
    limbs = [((100.0, y), (100.0 + side * 60.0, y - 40.0), 3.5) for y, side in ((190.0, 1), (165.0, -1), (135.0, 1), (110.0, -1), (75.0, 1))]
    return capsules([stem, *limbs, ((130.0, 170.0), (160.0, 175.0), 3.0)], (230, 200))


def many_limbs() -> np.ndarray:
    """A stem with sixteen limbs, every third of them short."""
    limbs = [((100.0, 205.0 - 11.0 * k), (100.0 + (-1) ** k * reach, 205.0 - 11.0 * k - 0.6 * reach), 2.5) for k, reach in enumerate([70, 66, 30, 74, 60, 26, 66, 70, 30, 60, 56, 24, 50, 44, 20, 36])]
    return capsules([((100.0, 250.0), (100.0, 12.0), 7.0), *limbs], (230, 200))


def azimuth(d, z: float, p) -> float:
    """The angle of (d, z) about p from the page's right-hand side, a frame made another way."""
    p = p / np.linalg.norm(p)
    right = np.cross(p, [0.0, 0.0, 1.0])
    right /= np.linalg.norm(right)
    c = np.array([*d, z])
    return float(np.arctan2(c @ np.cross(right, p), c @ right))


@pytest.mark.parametrize("theta", [0.0, 0.3, -0.4, np.pi - 0.3, 2 * np.pi - 0.2])
@pytest.mark.parametrize("p", [UP, np.array([0.3, 0.9, 0.2]), np.array([-0.6, 0.5, -0.1])])
def test_a_limb_has_the_azimuth_that_was_drawn_for_it(theta, p):
    right = np.array([p[1], -p[0]]) / np.hypot(p[0], p[1])
    side = 1.0 if np.cos(theta) > 0 else -1.0
    d = side * 0.8 * right + 0.6 * p[:2] / np.hypot(p[0], p[1])
    z = leaving(d, p, theta)
    assert abs(z) <= STEEPEST / 2
    assert np.exp(1j * azimuth(d, z, p)) == pytest.approx(np.exp(1j * theta))


def test_an_angle_of_the_other_side_is_mirrored_in_depth_kept():
    d = np.array([0.8, 0.6])
    assert leaving(d, UP, np.pi - 0.3) == pytest.approx(leaving(d, UP, 0.3))
    assert leaving(d, UP, np.pi + 0.3) == pytest.approx(leaving(d, UP, -0.3))


def test_no_limb_leaves_the_page_by_more_than_the_steepest():
    assert abs(leaving(np.array([0.8, 0.6]), UP, np.pi / 2)) <= STEEPEST


def test_siblings_take_all_k_angles_an_even_turn_apart():
    _, graph = trunk_drawing(trunk_skeleton(bushy()))
    angle = sibling_angles(graph, KEY, spread=0.0)
    laterals = np.flatnonzero(graph.limb_parent == 0)
    k = len(laterals)
    assert k == 5
    assert np.diff(np.sort(angle[laterals])) == pytest.approx(2 * np.pi / k)


def seen(right, reach) -> Seen:
    """Limbs as heavy as each other, evenly along their parent."""
    count = len(right)
    return Seen(np.array(right, float), np.array(reach, float), np.full(count, 1 / count), np.linspace(0, 1, count), 0.5)


def test_limbs_drawn_short_point_at_the_viewer_and_long_ones_to_the_side():
    angle, _ = around(seen([1, -1, 1, -1, 1, -1, 1, -1], [1, 1, 0.2, 0.2, 1, 1, 0.2, 0.2]), np.zeros(2))
    aside = np.abs(np.cos(angle))
    assert aside[[0, 1, 4, 5]].min() > aside[[2, 3, 6, 7]].max()


def test_front_and_back_have_as_much_wood():
    one = seen([1, -1] * 6, [0.7] * 12)
    angle, leaning = around(one, np.zeros(2))
    deep = np.sin(mirrored(angle, one.right))
    assert abs(deep.mean()) < 0.1 and np.sum(deep > 0.3) >= 4 and np.sum(deep < -0.3) >= 4
    assert np.abs(leaning).max() < 0.05


def test_a_mirrored_angle_is_on_the_side_that_was_drawn_and_as_far_in_front():
    angle, right = np.linspace(0, 2 * np.pi, 17), np.array([1.0, -1.0])[:, None]
    turned = mirrored(angle, right)
    assert np.all(np.cos(turned) * right >= -1e-12) and np.allclose(np.sin(turned), np.sin(angle))


def test_what_is_seen_of_a_limb_is_its_side_and_its_reach_beside_its_siblings():
    _, graph = trunk_drawing(trunk_skeleton(bushy()))
    laterals = np.flatnonzero(graph.limb_parent == 0)
    found = seen_about(graph, 0, laterals)
    foot = graph.start[graph.limb_first[laterals], 0]
    assert found.right.tolist() == np.sign(graph.xy[graph.limb_first[laterals], 0] - foot).tolist()
    assert found.reach.max() == 1.0 and found.reach.min() > 0.7 and found.weight.sum() == pytest.approx(1.0)


def test_no_limb_leaves_the_round_crown_that_its_side_shows():
    _, graph = trunk_drawing(trunk_skeleton(many_limbs()))
    room = Room.of(graph)
    depth = sibling_depth(graph, sibling_angles(graph, KEY))
    assert np.all(np.abs(depth[room.ends]) <= room.deep[room.ends] + 1e-9)
    assert Room.of(trunk_drawing(trunk_skeleton(forked()))[1]) is None


@pytest.mark.parametrize("seed", range(3))
def test_a_crown_is_about_as_deep_as_it_is_wide_and_round(seed):
    tree = as_tree(trunk_skeleton(many_limbs()), key=root_key(seed))
    found = roundness(tree)
    assert 0.75 <= found["depth"] <= 1.33 and found["round"] >= 0.7 and found["gap"] <= 120.0, found


def test_siblings_angles_are_normal_about_those():
    _, graph = trunk_drawing(trunk_skeleton(forked()))
    off = np.array([sibling_angles(graph, root_key(seed), 0.35) - sibling_angles(graph, KEY, 0.0) for seed in range(200)])[:, 1:]
    assert off.mean() == pytest.approx(0.0, abs=0.06) and off.std() == pytest.approx(0.35, abs=0.05)


def test_a_trunk_stays_in_the_page():
    _, graph = trunk_drawing(trunk_skeleton(bushy()))
    depth = sibling_depth(graph, sibling_angles(graph, KEY))
    assert np.all(depth[graph.limb == 0] == 0.0) and np.abs(depth).max() > 10.0


def test_the_projection_is_that_of_the_picture_to_the_last_bit():
    skeleton = trunk_skeleton(bushy())
    _, graph = trunk_drawing(skeleton)
    tree = as_tree(skeleton, key=KEY, height=9.0)
    similarity = page_to_world(graph, 9.0)
    assert np.array_equal(tree.tip[:, :2], similarity.to_world(graph.xy))
    assert np.array_equal(tree.curve_points[:, :2], similarity.to_world(graph.curve_points))
    assert tree.radius == pytest.approx(graph.width / 2 * similarity.scale)


def test_the_root_is_the_origin_and_the_height_what_was_asked_for():
    tree = as_tree(trunk_skeleton(bushy()), key=KEY, height=9.0)
    assert tree.tip[0] == pytest.approx([0.0, 0.0, 0.0]) and tree.height == pytest.approx(9.0)


def test_elevation_keeps_the_projection_and_the_thickness_too():
    skeleton = trunk_skeleton(forked())
    one = as_tree(skeleton, key=KEY, height=9.0)
    other = as_tree(skeleton, key=KEY, lift="elevation", height=9.0, options=ReadingOptions(template="none"))
    assert np.abs(one.tip[:, :2] - other.tip[:, :2]).max() < 1e-9 and np.ptp(other.tip[:, 2]) > 0
    assert other.radius == pytest.approx(one.radius)


def test_limbs_have_names_of_their_parents_and_orders():
    sketch, graph = trunk_drawing(trunk_skeleton(bushy()))
    names = [stroke.id for stroke in sketch.strokes]
    assert names[0] == "trunk" and {f"trunk.{k}" for k in range(1, 6)} < set(names)
    assert sum(name.count(".") == 2 for name in names) == 1
    assert np.bincount(graph.limb_order).tolist() == [1, 5, 1]


def test_the_straightest_thickest_branch_carries_the_limb_on():
    xy = np.array([[0.0, 0.0], [0.0, -20.0], [2.0, -40.0], [15.0, -35.0]])
    limb, order = limb_of(np.array([-1, 0, 1, 1]), xy, np.array([5.0, 4.0, 2.0, 2.0]))
    assert limb.tolist() == [0, 0, 0, 1] and order.tolist() == [0, 0, 0, 1]
    limb, _ = limb_of(np.array([-1, 0, 1, 1]), xy, np.array([5.0, 4.0, 1.0, 4.0]))
    assert limb.tolist() == [0, 0, 1, 0]


def test_a_limb_is_no_thicker_at_its_foot_than_where_it_leaves_its_parent():
    _, graph = trunk_drawing(trunk_skeleton(bushy()))
    assert graph.width[graph.limb == 0].max() > 13.0
    assert graph.width[graph.limb_order[graph.limb] > 0].max() < 10.5  # where the twig forks off, the circle is wider than the limb


def test_within_the_forks_circle_a_limb_has_its_own_radius():
    xy = np.array([[0.0, 0.0], [0.0, -20.0], [0.0, -40.0], [3.0, -20.0], [12.0, -20.0]])
    thick = own_radius(np.array([-1, 0, 1, 1, 3]), xy, np.array([6.0, 6.0, 5.0, 5.5, 2.0]), np.array([0, 0, 0, 1, 1]))
    assert thick.tolist() == [6.0, 6.0, 5.0, 2.0, 2.0]


def test_another_seed_gives_other_depths_and_the_same_seed_the_same():
    skeleton = trunk_skeleton(bushy())
    one, same, other = (as_tree(skeleton, key=root_key(seed)) for seed in (1, 1, 2))
    assert one.tip.tobytes() == same.tip.tobytes() and not np.array_equal(one.tip, other.tip)


def test_an_unknown_lift_or_height_is_refused():
    skeleton = trunk_skeleton(forked())
    with pytest.raises(OptionError, match=re.escape("There is no lift called `okabe`. Use one of: siblings, elevation.")):
        as_tree(skeleton, key=KEY, lift="okabe")
    with pytest.raises(OptionError, match=re.escape("A height of -1 m is not positive. Give metres above 0.")):
        as_tree(skeleton, key=KEY, height=-1.0)


def test_a_straight_twig_carries_no_trunk_on():
    xy = np.array([[0.0, 0.0], [0.0, -20.0], [0.0, -28.0], [8.0, -40.0], [14.0, -80.0]])
    limb, _ = limb_of(np.array([-1, 0, 1, 1, 3]), xy, np.array([5.0, 4.0, 4.0, 3.0, 3.0]))
    assert limb.tolist() == [0, 0, 1, 0, 0]


def test_a_limb_that_turns_up_on_the_page_turns_up_in_depth_too():
    bent = capsules([((50.0, 130.0), (50.0, 20.0), 6.0), ((50.0, 90.0), (80.0, 80.0), 3.0), ((80.0, 80.0), (84.0, 30.0), 3.0)])
    _, graph = trunk_drawing(trunk_skeleton(bent))
    rows = np.flatnonzero(graph.limb == 1)
    depth = sibling_depth(graph, np.where(graph.limb_parent < 0, np.nan, 0.9))
    rise = (depth[rows] - depth[graph.parent[rows]]) / np.hypot(*(graph.xy[rows] - graph.start[rows]).T)
    assert abs(rise[0]) > 2.0 * abs(rise[-1]) > 0.0
