"""One stroke along the trunk finds the limbs that show; strokes come and go; nothing is found where there is no wood."""

import dataclasses

import jax
import numpy as np
import pytest
import shapely
from PIL import Image, ImageDraw

from painted import LIMBS, TRUNK, bare_tree, distance, marked, walked
from sketchtree.axes import NULL
from sketchtree.errors import OptionError, SketchError
from sketchtree.photo.appearance import Mixture
from sketchtree.photo.marked import Marked
from sketchtree.photo.trace.follow import Walk, follow
from sketchtree.photo.trace.palette import Palette
from sketchtree.photo.trace.trace import CIRCLE, Tracing, carried_on, root_radius
from sketchtree.photo.trace.wood_likeness import WoodLikeness, apart_from_leaves, bhattacharyya, learn_wood

KEY = jax.random.key(0)


@pytest.fixture(scope="module")
def photo():
    return bare_tree()


@pytest.fixture(scope="module")
def from_the_trunk(photo):
    return Tracing()(photo, marked(), key=KEY)


def all_along(traced):
    rows = np.flatnonzero(traced.parent != NULL)
    return np.concatenate([walked([traced.xy[traced.parent[row]], traced.xy[row]]) for row in rows])


@pytest.mark.parametrize("limb", LIMBS)
def test_a_stroke_along_the_trunk_finds_every_limb_that_grows_from_it_and_what_those_bear(from_the_trunk, limb):
    """§2, Figure 3a: the fork is detected and a new branch is created, although no stroke passes through it."""
    shown = walked(LIMBS[limb][0])
    assert np.mean(distance(shown, all_along(from_the_trunk)) < 8) > 0.8


def test_nothing_is_found_where_there_is_no_wood(from_the_trunk):
    wood = np.concatenate([walked(TRUNK), *(walked(points) for points, _ in LIMBS.values())])
    assert np.max(distance(all_along(from_the_trunk), wood)) < 14


def test_a_stroke_is_kept_as_it_was_drawn(photo):
    traced = Tracing()(photo, marked("right"), key=KEY)
    drawn = traced.xy[(traced.stroke == 1) & traced.drawn]
    assert np.max(distance(drawn, walked(LIMBS["right"][0], 0.5))) < 1.0
    assert np.max(distance(walked(LIMBS["right"][0]), all_along(traced))) < 13


def test_a_stroke_over_nothing_still_makes_a_limb(photo):
    """"one is missing due to the dense foliage and is added by a second branch stroke" (§5): the user knows better than the picture."""
    sky = np.array([(306.0, 200.0), (360.0, 150.0), (430.0, 120.0)])
    traced = Tracing()(photo, dataclasses.replace(marked(), branches=(*marked().branches, sky), names=("trunk", "sky")), key=KEY)
    assert np.max(distance(walked(sky), all_along(traced))) < 8


@pytest.mark.parametrize("gap", [20.0, 35.0])
def test_a_stroke_begun_beside_the_trunk_leaves_it_at_an_angle_that_a_limb_has(photo, gap):
    """Straight across from the nearest place it would leave level, and go far towards the viewer before it rises."""
    start = np.array([TRUNK[-1][0] + gap, 330.0])
    steep = start + np.array([[0.0, 0.0], [20.0, -60.0], [50.0, -150.0]])
    traced = Tracing(most=0)(photo, dataclasses.replace(marked(), branches=(*marked().branches, steep), names=("trunk", "steep")), key=KEY)
    first = np.flatnonzero((traced.stroke == 1) & (traced.stroke[np.maximum(traced.parent, 0)] == 0))[0]
    step = traced.xy[first] - traced.xy[traced.parent[first]]
    assert step[1] < -abs(step[0])


def test_taking_a_stroke_away_takes_its_limb_away(photo):
    sky = np.array([(306.0, 200.0), (360.0, 150.0), (430.0, 120.0)])
    both = dataclasses.replace(marked(), branches=(*marked().branches, sky), names=("trunk", "sky"))
    with_it, without = Tracing()(photo, both, key=KEY), Tracing()(photo, marked(), key=KEY)
    assert distance(sky[-1:], all_along(with_it)) < 8 < distance(sky[-1:], all_along(without))


def test_the_circle_has_a_radius_of_50_pixels_where_the_photo_has_1500():
    assert 1500 * CIRCLE == pytest.approx(50.0)


@pytest.mark.parametrize("wanted", ["thick", ""])
def test_an_unknown_way_of_measuring_widths_is_named(wanted):
    with pytest.raises(OptionError, match="must be measured or paper. measured is what is taken by default."):
        Tracing(widths=wanted)


def test_strokes_alone_are_traced_when_nothing_may_be_found(photo):
    assert Tracing(most=0)(photo, marked("left"), key=KEY).drawn.all()


def test_the_trunk_is_as_thick_as_painted(from_the_trunk):
    assert from_the_trunk.radius[0] == pytest.approx(12, abs=2)


def test_no_limb_is_thicker_than_what_it_grows_from(from_the_trunk):
    rows = np.flatnonzero(from_the_trunk.parent != NULL)
    assert (from_the_trunk.radius[rows] <= from_the_trunk.radius[from_the_trunk.parent[rows]] + 1e-9).all()


def test_measured_limbs_are_about_as_thick_as_painted(from_the_trunk):
    for points, width in LIMBS.values():
        at = walked(points)[len(walked(points)) // 2]
        near = np.argmin(distance(from_the_trunk.xy, at[None]))
        assert from_the_trunk.radius[near] == pytest.approx(width / 2, abs=2.5)


def test_by_the_paper_a_branch_has_three_quarters_of_its_parents_radius(photo):
    """§2: "we simply set branch radius to 75% of its parent"."""
    traced = Tracing(widths="paper")(photo, marked(), key=KEY)
    np.testing.assert_allclose(traced.radius, traced.radius[0] * 0.75**traced.generation)
    assert set(traced.generation) >= {0, 1, 2}


def test_the_root_circle_is_the_largest_of_nothing_but_wood(photo):
    likeness = learn_wood(Palette.of(photo), marked(), None, width=3, key=KEY)
    assert root_radius(likeness, marked().branches[0], 20.0, 60.0) == pytest.approx(12, abs=2)


def test_the_palette_can_be_kept_while_strokes_come_and_go(photo):
    kept = Palette.of(photo)
    again, fresh = Tracing()(photo, marked("left"), key=KEY, palette=kept), Tracing()(photo, marked("left"), key=KEY)
    np.testing.assert_array_equal(again.xy, fresh.xy)


def test_the_same_key_gives_the_same_table(photo, from_the_trunk):
    again = Tracing()(photo, marked(), key=KEY)
    for column in ("parent", "xy", "radius", "generation", "stroke", "drawn"):
        np.testing.assert_array_equal(getattr(again, column), getattr(from_the_trunk, column))


def test_heavy_grain_still_finds_the_main_limbs():
    traced = Tracing()(bare_tree(grain=25.0), marked(), key=KEY)
    for limb in ("left", "right"):
        assert np.mean(distance(walked(LIMBS[limb][0]), all_along(traced)) < 10) > 0.6


def test_without_a_stroke_along_the_trunk_nothing_can_be_traced(photo):
    with pytest.raises(SketchError, match="^No stroke marks the trunk. Draw one from the root up along the trunk.$"):
        Tracing()(photo, Marked(marked().crown, ()), key=KEY)


def test_the_childs_own_stroke_carries_a_limb_on_before_what_bends_least():
    parent, xy = np.array([NULL, 0, 1, 1]), np.array([(0.0, 0.0), (0.0, -10.0), (8.0, -14.0), (0.0, -20.0)])
    stroke, half = np.array([0, 0, 0, 1]), np.ones(4)
    assert carried_on(parent, xy, half, stroke, np.array([True] * 4))[1] == 2
    assert carried_on(parent, xy, half, stroke, np.array([True, True, False, False]))[1] == 3


def test_a_component_of_wood_that_is_close_to_the_leaves_is_dropped():
    """§2: "we discard the Gaussian component in the branch GMM if it is too close to some component in the foliage GMM"."""
    spread = np.eye(3) * 30.0
    wood = Mixture(np.array([0.6, 0.4]), np.array([(70.0, 50.0, 40.0), (60.0, 120.0, 40.0)]), np.array([spread] * 2))
    leaf = Mixture(np.array([1.0]), np.array([(62.0, 121.0, 41.0)]), spread[None])
    foot = np.random.default_rng(0).normal((70.0, 50.0, 40.0), 5.0, (200, 3))
    kept = apart_from_leaves(wood, leaf, foot)
    assert len(kept) == 1 and kept.mean[0, 0] == 70.0 and kept.weight[0] == 1.0


def test_what_the_foot_of_the_trunk_is_made_of_is_never_dropped():
    spread = np.eye(3) * 30.0
    wood = Mixture(np.array([1.0]), np.array([(60.0, 120.0, 40.0)]), spread[None])
    assert len(apart_from_leaves(wood, wood, np.tile((60.0, 120.0, 40.0), (50, 1)))) == 1


def test_the_distance_of_two_gaussians_is_nought_for_the_same_and_grows_with_the_gap():
    spread = np.eye(3) * 9.0
    at = [bhattacharyya(np.zeros(3), spread, np.array([gap, 0.0, 0.0]), spread) for gap in (0.0, 3.0, 6.0)]
    np.testing.assert_allclose(at, [0.0, 0.125, 0.5])


@pytest.mark.parametrize(("half", "places"), [(15.0, 1), (4.0, 2)])
def test_what_lies_within_a_limbs_thickness_is_no_branch_of_it(half, places):
    """Ours: the same strip of wood 16 pixels aside is the flank of a thick limb, and a branch of a thin one."""
    strip = Image.new("L", (200, 200), 0)
    ImageDraw.Draw(strip).line((100, 100, 118, 82), fill=1, width=3)
    mask = np.asarray(strip) > 0
    one = Mixture(np.ones(1), np.zeros((1, 3)), np.eye(3)[None])
    walk = Walk()
    walk.add(NULL, np.array([100.5, 100.5]), half, 0, True, 0)
    trunk = np.stack([np.full(140, 100.5), np.arange(40.0, 180.0)], axis=1)
    found = follow(WoodLikeness(one, one, np.zeros(mask.shape, np.float32), mask), walk, 22.5, on_strokes=trunk, within=shapely.box(0, 0, 200, 200))
    assert len(found.parent) == places
