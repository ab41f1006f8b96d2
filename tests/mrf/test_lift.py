"""From depths to a skeleton."""

import numpy as np
import pytest

from sketchtree.mrf.lift import curve_depth, lift
from sketchtree.similarity import Similarity
from sketchtree.skeleton import Kind
from tests.mrf.drawings import sketch, small_tree

WORLD = Similarity(0.05, (1.0, 2.0, 3.0))


def _curved():
    """A trunk and one limb of three segments, each with drawn points between."""
    parent = [-1, 0, 1, 1, 3, 4]
    xy = np.array([[0, 0], [0, 50], [0, 100], [20, 60], [40, 75], [60, 80]], float)
    curve = {row: xy[parent[row]] + (xy[row] - xy[parent[row]]) * np.array([[0.25], [0.5], [0.8]]) for row in range(1, 6)}
    return sketch(parent, xy, [0, 0, 0, 1, 1, 1], curve=curve)


def test_drawn_points_keep_their_x_and_y_to_the_last_bit():
    graph = _curved()
    depth = np.array([0, 1.0, 2, -8, -12, 9])
    tree = lift(graph, depth, WORLD)
    assert (tree.tip[:, :2] == WORLD.to_world(graph.xy)).all()
    assert (tree.curve_points[:, :2] == WORLD.to_world(graph.curve_points)).all()
    same = lift(graph, depth, Similarity(1.0, (0.0, 0.0, 0.0)))
    assert (same.tip[:, :2] == graph.xy).all()
    assert (same.tip[:, 2] == depth).all()


def test_rows_are_the_graph_s_rows_and_are_drawn():
    graph = small_tree()
    tree = lift(graph, np.zeros(len(graph)), WORLD)
    assert (tree.parent == graph.parent).all()
    assert (tree.kind == Kind.DRAWN).all()
    assert (tree.order == graph.order).all()
    assert (tree.limb == graph.limb_id[graph.limb]).all()
    assert (tree.stroke == graph.stroke).all()


def test_depths_and_their_sd_are_scaled_to_metres():
    graph = small_tree()
    tree = lift(graph, np.arange(11.0), WORLD, depth_sd=np.full(11, 4.0), radius=np.full(11, 0.02))
    np.testing.assert_allclose(tree.tip[:, 2], 3.0 + 0.05 * np.arange(11))
    np.testing.assert_allclose(tree.depth_sd, 0.2)
    np.testing.assert_allclose(tree.radius, 0.02)


def test_curves_never_overshoot_their_nodes():
    graph = _curved()
    depth = np.array([0, 0, 0, 10.0, 30, 5])
    z = curve_depth(graph, depth)
    for row in range(1, len(graph)):
        piece = z[graph.curve_start[row] : graph.curve_start[row + 1]]
        low, high = sorted((depth[graph.parent[row]], depth[row]))
        assert (piece >= low - 1e-12).all() and (piece <= high + 1e-12).all()


def test_a_straight_limb_stays_straight():
    graph = _curved()
    along = np.array([0, 0, 0, 22.360679775, 22.360679775 + 25, 22.360679775 + 25 + 20.615528128])
    z = curve_depth(graph, 0.4 * along)
    t = np.array([0.25, 0.5, 0.8])
    for row in (3, 4, 5):
        start, end = 0.4 * along[graph.parent[row]], 0.4 * along[row]
        np.testing.assert_allclose(z[graph.curve_start[row] : graph.curve_start[row + 1]], start + (end - start) * t, atol=1e-6)


def test_slopes_meet_at_the_nodes_of_a_limb():
    parent, xy = [-1, 0, 1, 2], np.array([[0, 0], [0, 50], [30, 60], [60, 70]], float)
    near = 1e-5
    between = {row: xy[parent[row]] + (xy[row] - xy[parent[row]]) * np.array([[near], [1 - near]]) for row in (2, 3)}
    graph = sketch(parent, xy, [0, 0, 1, 1], curve=between)
    depth = np.array([0, 0, 12.0, 15.0])
    z = curve_depth(graph, depth)
    h = np.hypot(30, 10)
    before, after = (depth[2] - z[1]) / (near * h), (z[2] - depth[2]) / (near * h)
    assert before == pytest.approx(after, rel=1e-2)
    assert after > 0


def test_without_drawn_widths_the_radius_tapers_and_is_positive():
    tree = lift(small_tree(), np.zeros(11), WORLD)
    assert (tree.radius > 0).all()
    assert tree.radius[1] > tree.radius[4] > 0


def test_a_point_on_top_of_its_parent_is_lifted_without_a_warning():
    xy = small_tree().xy.copy()
    xy[9] = xy[5]
    tree = lift(small_tree().replace(xy=xy), np.zeros(11), WORLD)
    assert np.isfinite(tree.tip).all()
