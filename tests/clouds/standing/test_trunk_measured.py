"""A trunk's diameter, whatever was seen of it, with an error that is true; and the paper's, by one closed curve."""

import numpy as np
import pytest
from stems_made import stem

from sketchtree.clouds.standing.cross_section import cross_section, plane_points
from sketchtree.clouds.standing.tapered import tapered
from sketchtree.clouds.standing.trunk import foot_radii, trunk

BREAST = 1.28
SEEN = {
    "full": {},
    "noisy": {"noise": 0.01},
    "half": {"seen": 0.5},
    "a_third": {"seen": 0.33},
    "flared": {"flare": 0.6},
    "leaning": {"lean": 0.3},
    "half_with_strays_behind_its_edges": {"seen": 0.5, "strays": 0.05},
}


@pytest.mark.parametrize("case", SEEN)
def test_the_diameter_is_found_to_a_few_percent(case):
    found = trunk(stem(**SEEN[case]), BREAST)
    assert found.root == pytest.approx(0.3, rel=0.04)
    assert found.breast == pytest.approx(0.3 - 0.02 * BREAST, rel=0.04)


@pytest.mark.parametrize("case", ["noisy", "half", "a_third", "half_with_strays_behind_its_edges"])
def test_the_stated_error_is_about_what_it_errs(case):
    errs = [(found.breast - 0.3 + 0.02 * BREAST) / found.error for found in (trunk(stem(**SEEN[case], seed=seed), BREAST) for seed in range(8))]
    assert 0.3 < np.sqrt(np.mean(np.square(errs))) < 2.0


def test_what_is_seen_less_of_is_less_sure():
    assert trunk(stem(seen=0.33), BREAST).error > 2 * trunk(stem(), BREAST).error
    assert trunk(stem(seen=0.33), BREAST).seen < 0.6 < trunk(stem(), BREAST).seen


def test_a_thin_stem_is_measured_too():
    assert trunk(stem(0.03, 0.3, noise=0.001, taper=0.0, count=300), 0.24).breast == pytest.approx(0.03, rel=0.06)


def test_branches_that_hang_round_a_stem_are_no_trunk():
    chance, turn = np.random.default_rng(0), 0.9 + 0.7 * np.repeat(np.arange(9), 140)  # nine branches, more to one side than to the other
    far = chance.uniform(0.2, 1.6, len(turn))
    branches = np.c_[far * np.cos(turn / 2), 0.2 + np.repeat(0.14 * np.arange(9), 140) + 0.15 * far, far * np.sin(turn / 2)] + chance.normal(0.0, 0.02, (len(turn), 3))
    points = np.concatenate([stem(count=900), branches])
    assert trunk(points, BREAST).breast == pytest.approx(0.3 - 0.02 * BREAST, rel=0.04)


def test_the_base_is_inside_the_trunk_and_the_axis_along_it():
    found = trunk(stem(seen=0.5, lean=0.2), BREAST)
    np.testing.assert_allclose(found.base, 0.0, atol=0.03)
    np.testing.assert_allclose(found.axis, [np.sin(0.2), np.cos(0.2), 0.0], atol=0.02)


@pytest.mark.parametrize("points", [stem(count=30), np.random.default_rng(0).uniform(size=(500, 3)), np.zeros((40, 3))])
def test_what_lies_round_nothing_has_no_trunk(points):
    assert trunk(points, BREAST) is None


def test_section_5_3_a_closed_spline_gives_the_diameter_at_the_root():
    points = stem(lean=0.2)
    axis = np.array([np.sin(0.2), np.cos(0.2), 0.0])
    found = cross_section(plane_points(points, 0.2 * axis, axis, 0.3))
    assert found.diameter == pytest.approx(0.296, rel=0.02)
    assert found.seen == 1.0


def test_section_5_3_the_spline_follows_a_trunk_that_is_no_circle():
    turn = np.linspace(0, 2 * np.pi, 300, endpoint=False)
    found = cross_section(np.c_[0.2 * np.cos(turn), 0.12 * np.sin(turn)])
    assert found.diameter == pytest.approx(2 * np.sqrt(0.2 * 0.12), rel=0.02)


def test_section_5_3_a_trunk_seen_from_one_side_comes_out_too_thin():
    found = trunk(stem(seen=0.4), BREAST)
    assert found.section.diameter < 0.9 * found.root


def test_a_section_needs_points_all_round():
    assert cross_section(np.zeros((3, 2))) is None


def test_slices_that_saw_little_share_one_taper():
    turn, s = np.linspace(-0.8, 0.8, 40), np.arange(0.0, 1.0, 0.2)
    slices = [np.array([0.05 * k, 0.0]) + (0.2 - 0.05 * at) * np.c_[np.cos(turn), np.sin(turn)] for k, at in enumerate(s)]
    found = tapered(slices, s)
    np.testing.assert_allclose(found.radius(s), 0.2 - 0.05 * s, rtol=0.02)
    np.testing.assert_allclose(found.centre[:, 0], 0.05 * np.arange(5), atol=0.01)


def filled(diameter: float) -> np.ndarray:
    """A stem with points all through it, as depths from photos give."""
    chance = np.random.default_rng(2)
    out, turn = 0.5 * diameter * np.sqrt(chance.uniform(size=900)) + chance.normal(0, 0.04 * diameter, 900), chance.uniform(0, 2 * np.pi, 900)
    return np.c_[out * np.cos(turn), chance.uniform(0, 1.6, 900), out * np.sin(turn)]


def test_a_slender_stem_that_points_fill_has_a_thickness_and_a_wide_heap_has_none():
    assert trunk(filled(0.1), BREAST).root == pytest.approx(0.07, rel=0.15)
    assert trunk(filled(0.9), BREAST) is None


def test_a_foot_whose_thickness_cant_be_told_is_as_thick_as_the_middle_one_of_the_others():
    thin, thick, thickest = (trunk(stem(diameter), BREAST) for diameter in (0.1, 0.2, 0.3))
    np.testing.assert_allclose(foot_radii([thickest, None, thin, thick]), [0.15, 0.1, 0.05, 0.1], rtol=0.06)
    assert foot_radii([None, None]) is None
