"""Discrete curve evolution (§II.2, Algorithm 1)."""

import math

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from sketchtree.trunk.evolution import evolve, relevance


def crown(seed: int) -> np.ndarray:
    """A spiky ring round the origin that does not cross itself, 62 vertices."""
    rng = np.random.default_rng(seed)
    angle = 2.0 * np.pi * (np.arange(62) + rng.uniform(0.05, 0.95, 62)) / 62
    radius = rng.uniform(4.0, 40.0, 62)
    return np.column_stack([radius * np.cos(angle), radius * np.sin(angle)])


def test_relevance_is_the_turn_angle_times_both_lengths_over_their_sum():
    assert relevance((0.0, 0.0), (3.0, 0.0), (3.0, 6.0)) == pytest.approx(math.pi / 2 * 3.0 * 6.0 / 9.0)


def test_a_vertex_on_a_straight_line_has_no_relevance():
    assert relevance((0.0, 0.0), (1.0, 1.0), (5.0, 5.0)) == pytest.approx(0.0, abs=1e-12)


def test_a_low_bump_is_as_relevant_however_wide_it_is():
    narrow, wide = (relevance((-half, 0.0), (0.0, 1.0), (half, 0.0)) for half in (10.0, 1000.0))
    assert narrow == pytest.approx(1.0, rel=0.01) and wide == pytest.approx(1.0, rel=0.01)


def test_a_thin_twig_is_relevant_by_its_length():
    assert relevance((-0.01, 0.0), (0.0, 30.0), (0.01, 0.0)) == pytest.approx(math.pi * 30.0 / 2.0, rel=0.01)


def test_the_least_relevant_vertex_goes_first():
    square = np.array([[0.0, 0.0], [5.0, -0.2], [10.0, 0.0], [10.0, 5.0], [10.5, 7.0], [10.0, 10.0], [0.0, 10.0]])
    kept = evolve([square], vertices=6).kept[0]
    assert kept.tolist() == [0, 2, 3, 4, 5, 6]


def test_a_square_with_bumps_becomes_a_square():
    side = np.linspace(0.0, 1.0, 20, endpoint=False)
    corners = 100.0 * np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
    ring = np.concatenate([corners[k] + side[:, None] * (corners[(k + 1) % 4] - corners[k]) for k in range(4)])
    ring[np.arange(80) % 20 != 0] += np.random.default_rng(0).uniform(-0.5, 0.5, (76, 2))
    assert evolve([ring], vertices=4).kept[0].tolist() == [0, 20, 40, 60]
    assert evolve([ring], noise=4.0).kept[0].tolist() == [0, 20, 40, 60]


@settings(max_examples=40, deadline=None)
@given(seed=st.integers(0, 10_000), vertices=st.integers(3, 62))
def test_evolution_only_takes_vertices_away_and_never_crosses_itself(seed, vertices):
    ring = crown(seed)
    found = evolve([ring], vertices=vertices)
    assert vertices <= found.count <= len(ring) and len(found.went) == len(ring) - found.count
    assert np.all(np.diff(found.kept[0]) > 0)
    assert shapely.Polygon(ring[found.kept[0]]).is_valid


@settings(max_examples=40, deadline=None)
@given(seed=st.integers(0, 10_000), noise=st.floats(0.1, 20.0))
def test_the_area_changes_by_no_more_than_half_the_relevances_that_went_times_the_length(seed, noise):
    """Each that goes takes l₁ l₂ sin β / 2 = R (l₁ + l₂) sin β / 2β ≤ R L / 2."""
    ring = crown(seed)
    found = evolve([ring], noise=noise)
    before, after = shapely.Polygon(ring), shapely.Polygon(ring[found.kept[0]])
    assert (found.went <= noise).all()
    assert abs(after.area - before.area) <= found.went.sum() * found.length / 2.0 + 1e-9


def test_without_noise_to_remove_an_even_polygon_keeps_its_area():
    angle = np.linspace(0.0, 2.0 * np.pi, 400, endpoint=False)
    circle = 100.0 * np.column_stack([np.cos(angle), np.sin(angle)])
    found = evolve([circle], noise=2.0)
    assert found.count < 60
    assert shapely.Polygon(circle[found.kept[0]]).area == pytest.approx(np.pi * 1e4, rel=0.03)


def test_a_vertex_stays_while_a_hole_is_in_the_way():
    outer = np.array([[0.0, 0.0], [40.0, 0.0], [40.0, 10.0], [20.0, 11.0], [0.0, 10.0]])
    hole = np.array([[19.5, 10.2], [20.0, 10.6], [20.5, 10.2]])
    kept = evolve([outer, hole], vertices=3).kept
    assert not shapely.LineString(outer[[*kept[0], kept[0][0]]]).crosses(shapely.Polygon(hole[kept[1]]).exterior)
    assert 3 in kept[0]


def test_every_ring_keeps_three_vertices():
    angle = np.linspace(0.0, 2.0 * np.pi, 30, endpoint=False)
    ring = np.column_stack([np.cos(angle), np.sin(angle)])
    found = evolve([50.0 * ring, 5.0 * ring[::-1]], noise=1e9)
    assert [len(rows) for rows in found.kept] == [3, 3]


def test_relevances_over_the_contours_length_are_the_papers():
    ring = crown(3)
    one, twice = evolve([ring], vertices=10), evolve([2.0 * ring], vertices=10)
    assert one.kept[0].tolist() == twice.kept[0].tolist()
    assert one.went / one.length == pytest.approx(twice.went / twice.length)
