"""Wood is as thick as photos show it, where it is thin."""

import numpy as np
import pytest
from drawn_twigs import PIXEL, shown
from test_thin_wood import END, FOOT, FORK, TOP, TWIG, tree_of

from sketchtree.multiview.thin.followed import followed
from sketchtree.multiview.thin.widths import thickened, widths

FULL = 0.75  # c of bark before this sky
LEANS = np.array([0.25, 0.9, 0.1])
UP = LEANS[None] / np.linalg.norm(LEANS)


@pytest.mark.parametrize("wide", [0.5, 1.0, 2.0, 4.0, 6.0])
def test_a_limb_before_the_sky_is_measured_to_a_fraction_of_a_pixel(wide):
    photos = shown(([FOOT, FOOT + LEANS], wide))
    for thought in (0.6, 1.0, 1.4):
        found = widths((FOOT + 0.5 * LEANS)[None], UP, np.array([0.5 * thought * max(wide, 1.0) * PIXEL]), FULL, photos)
        assert found[0] == pytest.approx(0.5 * wide * PIXEL, rel=0.12, abs=0.1 * PIXEL)


def test_beside_other_wood_photos_tell_nothing():
    beside = np.array([0.0, 0.0, 1e-3]) + 3 * PIXEL * np.array([1.0, 0.0, 1.0])
    photos = shown(([FOOT, TOP], 2.0), *(([FOOT + turn * beside, TOP + turn * beside], 2.0) for turn in ([1, 1, 1], [-1, 1, 1], [1, 1, -1], [-1, 1, -1])))
    assert np.isnan(widths(0.5 * (FOOT + TOP)[None], np.array([[0.0, 1.0, 0.0]]), np.array([PIXEL]), FULL, photos)).all()


def test_a_limb_tapers_and_is_no_thicker_than_what_bears_it():
    photos = shown(([FOOT, TOP], 4.0), ([TOP, END], 3.0), ([FORK, TWIG], 1.0))
    tree = tree_of([FOOT, TOP, END], [FORK, TWIG])
    found = thickened(tree, FULL, photos, PIXEL)
    trunk, twig = found.radius[found.order == 0], found.radius[found.order == 1]
    assert (np.diff(trunk) <= 0).all() and (np.diff(twig) <= 0).all() and twig.max() <= trunk.max()
    low, high = (found.order == 0) & (found.tip[:, 1] < 0.2), (found.order == 0) & (found.tip[:, 1] > 0.8)
    assert np.median(found.radius[low]) == pytest.approx(2.0 * PIXEL, rel=0.1)
    assert np.median(found.radius[high]) == pytest.approx(1.5 * PIXEL, rel=0.12)
    assert np.median(twig) == pytest.approx(0.5 * PIXEL, rel=0.2)
    assert twig[0] < 0.7 * PIXEL  # where it leaves, photos see it and the trunk as one


def test_thick_wood_keeps_what_its_points_say():
    photos = shown(([FOOT, TOP], 12.0))
    tree = tree_of([FOOT, TOP]).replace(radius=np.full(len(tree_of([FOOT, TOP])), 6.3 * PIXEL))
    np.testing.assert_allclose(thickened(tree, FULL, photos, PIXEL).radius, tree.radius)


@pytest.mark.parametrize("wide", [0.5, 0.9])
def test_twigs_that_were_followed_are_as_thick_as_they_are_dark(wide):
    tree = tree_of([FOOT, TOP])
    found = followed(tree, shown(([FOOT, TOP], 2.0), ([TOP, END], wide)), PIXEL)
    assert np.median(found.radius[len(tree) :]) == pytest.approx(0.5 * wide * PIXEL, rel=0.25)
