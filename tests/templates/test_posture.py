"""Posture says what a person sees, whatever the scale or the side."""

import numpy as np
import pytest

from sketchtree.templates.seen.drawing import Drawing
from sketchtree.templates.seen.posture import FEATURES, posture


def features(graph):
    return dict(zip(FEATURES, posture(Drawing.of_graph(graph))[0], strict=True))


@pytest.fixture
def cross(graph_of):
    """A stem of 4 with level arms of 1 on both sides at height 3; one arm's end hangs by 1."""
    xy = [[0, 0], [0, 3], [0, 4], [1, 3], [1, 2], [-1, 3.0]]
    return graph_of([-1, 0, 1, 1, 3, 1], xy, [0, 0, 0, 1, 1, 2])


def test_the_figures_of_a_drawing_known_by_hand(cross):
    f = features(cross)
    assert f["aspect"] == pytest.approx(np.log(2 / 4))
    assert f["bare"] == pytest.approx(0.75)
    assert f["leader"] == pytest.approx(1.0) and f["stems"] == 0.0
    assert f["start"] == pytest.approx(0.0)
    assert f["droop"] == pytest.approx(-2 / 3), "weighted by length: 2 of 3 hang"
    assert f["rise"] == pytest.approx(-np.sqrt(0.5) * 2 / 3)
    assert f["reach"] == pytest.approx((2 + 1) / 2 / 4)
    assert f["arch"] == pytest.approx((1 - np.sqrt(2) / 2) * 2 / 3)
    assert np.isnan(f["insertions"]) and np.isnan(f["taper"]), "two limbs say nothing about their spread"


def test_it_is_free_of_scale_place_and_side(cross):
    moved = cross.replace(xy=cross.xy * [-30.0, 30.0] + [5.0, -9.0])
    np.testing.assert_allclose(posture(Drawing.of_graph(moved)), posture(Drawing.of_graph(cross)), atol=1e-12)


def test_longer_limbs_below_taper_upwards(graph_of):
    xy = [[0, 0], [0, 1], [0, 3], [0, 4], [2, 1], [1, 3], [-2, 1.0]]
    f = features(graph_of([-1, 0, 1, 2, 1, 2, 1], xy, [0, 0, 0, 0, 1, 2, 3]))
    at, length = np.array([1, 3, 1]) / 4, np.array([2, 1, 2]) / 4
    assert f["taper"] == pytest.approx(np.mean((at - at.mean()) * (length - length.mean())) / (at.var() + 0.02))
    assert f["insertions"] == pytest.approx(at.std())


def test_of_bare_stems_only_their_outline_and_number_are_known(graph_of):
    f = features(graph_of([-1, 0, -1, 2], [[0, 0], [-1, 2], [0.5, 0], [1, 2.0]], [0, 0, 1, 1]))
    assert f["stems"] == 1.0 and f["leader"] == 1.0 and f["aspect"] == 0.0
    assert sum(np.isnan(x) for x in f.values()) == len(FEATURES) - 3


def test_species_differ_where_a_person_says_they_do(shipped):
    at = {n: dict(zip(FEATURES, row, strict=True)) for n, row in zip(shipped.names, shipped.views.posture.mean(axis=1), strict=True)}
    assert at["weeping_willow"]["droop"] < -0.5 < 0.5 < at["lombardy_poplar"]["droop"]
    assert at["lombardy_poplar"]["aspect"] < at["norway_spruce"]["aspect"] < at["english_oak"]["aspect"]
    assert at["date_palm"]["bare"] > 0.6 and at["date_palm"]["insertions"] < 0.05
    assert at["stone_pine"]["bare"] > at["english_oak"]["bare"]
    assert abs(at["norway_spruce"]["rise"]) < 0.3 and at["hazel"]["stems"] > 2
