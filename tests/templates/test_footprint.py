"""The footprint of shapes whose outline is known (§7)."""

import numpy as np
import pytest

from sketchtree.templates.seen.footprint import (
    DIRECTIONS,
    VIEWS,
    crown_points,
    footprint,
    project,
    root_branch,
    view_azimuths,
)

ANGLE = 2 * np.pi * np.arange(DIRECTIONS) / DIRECTIONS
CIRCLE = np.stack([np.cos(np.arange(0, 2 * np.pi, 0.01)), np.sin(np.arange(0, 2 * np.pi, 0.01))], axis=1)


def test_a_circle_is_half_as_far_in_every_direction():
    assert footprint(CIRCLE).shape == (64,)
    np.testing.assert_allclose(footprint(CIRCLE), 0.5, atol=1e-4)


def test_a_square_follows_its_sides():
    square = np.array([[0, 0], [2, 0], [2, 2], [0, 2.0]])
    np.testing.assert_allclose(footprint(square), 0.5 / np.maximum(abs(np.cos(ANGLE)), abs(np.sin(ANGLE))), atol=1e-12)


def test_directions_run_counter_clockwise_from_x():
    house = np.array([[-1, -1], [1, -1], [1, 0], [0, 1], [-1, 0.0]])
    f = footprint(house)
    assert f[0] == pytest.approx(0.5) and f[16] == pytest.approx(0.5) and f[48] == pytest.approx(0.5)
    assert f[8] == pytest.approx(0.25 * np.sqrt(2)), "the roof lies to the upper right"
    assert f[56] == pytest.approx(0.5 * np.sqrt(2)), "a corner to the lower right"


def test_only_the_hull_counts_and_the_longer_side_is_one():
    rng = np.random.default_rng(0)
    inner = CIRCLE[::7] * rng.uniform(0.1, 0.9, (len(CIRCLE[::7]), 1))
    np.testing.assert_allclose(footprint(np.concatenate([CIRCLE, inner])), footprint(CIRCLE))
    flat = footprint(CIRCLE * [4.0, 1.0])
    assert flat[0] == pytest.approx(0.5, abs=1e-4) and flat[16] == pytest.approx(0.125, abs=1e-4)


def test_it_is_free_of_place_and_scale_and_turns_with_the_shape():
    rng = np.random.default_rng(1)
    shape = rng.normal(size=(30, 2))
    np.testing.assert_allclose(footprint(40 * shape + [7, -3]), footprint(shape), atol=1e-12)
    quarter = shape @ np.array([[0, 1], [-1, 0]])
    np.testing.assert_allclose(footprint(quarter), np.roll(footprint(shape), 16), atol=1e-9)


def test_a_line_and_a_point_have_a_footprint_too():
    up = footprint(np.array([[0, 0], [0, 1], [0, 3.0]]))
    assert up[16] == up[48] == pytest.approx(0.5, abs=1e-3) and up[0] < 1e-3
    along = footprint(np.array([[0, 5], [2, 5.0]]))
    assert along[0] == pytest.approx(0.5, abs=1e-3) and along[16] < 1e-3
    slope = footprint(np.array([[0, 0], [1, 1.0]]))
    assert slope[8] == pytest.approx(np.sqrt(0.5), abs=1e-3)
    assert not footprint(np.array([[1.0, 1.0]])).any()


def test_there_are_36_views_ten_degrees_apart_and_opposite_views_mirror():
    assert len(view_azimuths()) == VIEWS == 36 and view_azimuths()[1] == 10
    point = np.random.default_rng(2).normal(size=(5, 3))
    np.testing.assert_allclose(project(point, 0.0), point[:, :2])
    np.testing.assert_allclose(project(point, 90.0)[:, 0], -point[:, 2], atol=1e-12)
    np.testing.assert_allclose(project(point, 200.0) * [-1, 1], project(point, 20.0), atol=1e-12)


def test_the_root_branch_is_the_stem_up_to_its_first_lateral():
    parent = np.array([-1, 0, 1, 2, 2, 3])
    np.testing.assert_array_equal(root_branch(parent), [True, True, True, False, False, False])
    np.testing.assert_array_equal(root_branch(np.array([-1, 0, 1])), [True, True, False])
    np.testing.assert_array_equal(root_branch(np.array([-1, 0, 0])), [True, False, False])
    tip = np.array([[0, 0], [0, 1], [0, 2], [0, 3], [1, 2.5], [0, 4.0]])
    start = tip[np.maximum(parent, 0)]
    assert crown_points(start, tip, parent)[:, 1].min() == 2.0
