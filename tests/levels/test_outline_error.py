"""How far off is a coarser tree, and from how far away does that not show?"""

import numpy as np
import pytest
from test_raster import square

from sketchtree.levels.outline_error import ROWS, coverage, displacement, overlap, views_round
from sketchtree.levels.raster import View, silhouette


def test_a_square_grown_by_a_margin_is_displaced_by_that_margin():
    """By corners' worth more: the outer ring is a little longer than the rim."""
    view = View.round(0.0, [0.0, 0, 0], 1.0, 400)
    small, large = (silhouette([square(half=half)], view) for half in (0.5, 0.55))
    assert displacement(small, large, view) == pytest.approx(0.05, rel=0.12)


def test_the_same_tree_is_not_displaced_and_overlaps_whole():
    view = View.round(0.0, [0.0, 0, 0], 1.0, 64)
    shown = silhouette([square()], view)
    assert displacement(shown, shown, view) == 0.0 and overlap(shown, shown) == 1.0
    assert overlap(shown, ~shown) == 0.0
    assert overlap(~shown & shown, ~shown & shown) == 1.0


def test_coverage_is_the_height_at_which_the_error_is_as_many_pixels_as_allowed():
    share = coverage(0.02, 10.0, 1.0)
    assert share * ROWS * 0.02 / 10.0 == pytest.approx(1.0)
    assert coverage(0.02, 10.0, 2.0) == pytest.approx(2 * share)
    assert coverage(0.0, 10.0, 1.0) == 1.0


def test_views_go_round_the_tree_and_hold_it_whole():
    tall = square(half=0.5)
    views = views_round([tall], 4, 64)
    assert len(views) == 4 and np.allclose([view.towards for view in views], [[0, 0, 1], [1, 0, 0], [0, 0, -1], [-1, 0, 0]], atol=1e-12)
    for view in views:
        place = view.place(tall.position)
        assert (place[:, :2] > 0).all() and (place[:, :2] < 64).all()
    assert views_round([], 4, 64) == ()
