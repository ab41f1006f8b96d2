"""A sketch of a grown tree is what its pencil says."""

from dataclasses import replace

import numpy as np
import pytest
import shapely

from benchmarks.tree_sketch import PLACE, SCALE, Pencil, crown_curve, main_limbs, random_pencil, recipes, sketch_of
from sketchtree.templates.seen.footprint import crown_points, footprint, project
from sketchtree.templates.growing.procedural import grow

PENCIL = Pencil(azimuth=40.0)


@pytest.fixture(scope="module")
def tree():
    """A young birch, no exemplar."""
    return grow(next(recipe for recipe in recipes() if recipe.name == "silver_birch"), 77)


def test_the_nodes_miss_their_places_by_the_jitter(tree):
    still = sketch_of(tree, replace(PENCIL, jitter=0.0), np.random.default_rng(1))
    drawn = main_limbs(tree, PENCIL)
    np.testing.assert_allclose(still.xy, SCALE * project(drawn.tip, 40.0) + PLACE)
    shaken = sketch_of(tree, replace(PENCIL, jitter=0.02), np.random.default_rng(1))
    assert np.std(shaken.xy - still.xy) == pytest.approx(0.02 * SCALE * tree.height, rel=0.15)


@pytest.mark.parametrize("share", [1 / 3, 2 / 3])
def test_a_share_of_the_limbs_is_left_out_and_no_limb_hangs_in_the_air(tree, share):
    whole = sketch_of(tree, PENCIL, np.random.default_rng(1))
    part = sketch_of(tree, replace(PENCIL, left_out=share), np.random.default_rng(1))
    limbs = len(np.unique(whole.limb)) - 1
    left = len(np.unique(part.limb)) - 1
    assert limbs - round(share * limbs) - 1 <= left <= limbs - round(share * limbs)
    assert (part.parent == -1).sum() == 1


def test_two_orders_or_three_are_drawn(tree):
    for deepest in (1, 2):
        assert sketch_of(tree, replace(PENCIL, deepest=deepest), np.random.default_rng(1)).order.max() == deepest


def test_the_crowns_curve_follows_the_crown_but_is_not_its_hull(tree):
    point = project(crown_points(tree.start, tree.tip, tree.parent), 40.0)
    curve = crown_curve(point, np.random.default_rng(3))
    drawn, hull = shapely.Polygon(curve), shapely.MultiPoint(point).convex_hull
    assert drawn.is_valid
    assert 0.8 < drawn.intersection(hull).area / drawn.union(hull).area < 0.98
    off = footprint(curve) - footprint(point)
    assert 0.002 < np.sqrt(np.mean(off**2)) < 0.08
    turn = np.angle(np.exp(1j * np.diff(np.unwrap(np.angle(np.diff(curve @ [1, 1j]))))))
    assert np.abs(turn).max() < np.radians(40), "smooth: no corner"


def test_the_same_seed_draws_the_same_sketch(tree):
    a, b = (sketch_of(tree, random_pencil(rng), rng) for rng in (np.random.default_rng(5), np.random.default_rng(5)))
    np.testing.assert_array_equal(a.xy, b.xy)
    np.testing.assert_array_equal(a.crown[0], b.crown[0])
