"""Light: shadows turn headings and keep buds shut; in the open nothing happens."""

import numpy as np
import pytest

from sketchtree.errors import OptionError
from sketchtree.keys import root_key
from sketchtree.parameters import GENERIC
from sketchtree.propagate.space.domain import Domain
from sketchtree.propagate.space.envelope import Envelope
from sketchtree.propagate.space.light import _ENOUGH, _LEAF_AREA, _MOST, _STRICT, _TURN, Canopy, Light, shadow_reach
from tests.propagate.worlds import HABIT, circle, drawn_tree

TREE = drawn_tree()
DOMAIN = Domain.of(TREE, None, HABIT, TREE.height)
REACH = 2.0


def slab(count=6000, seed=1):
    """Leaves to the right of the tree, from the ground to above it."""
    return np.random.default_rng(seed).uniform([1.0, 1.0, -4.0], [3.5, 9.0, 4.0], (count, 3))


def shaded(strength=1.0):
    return Light.under([Canopy(slab(), 0.05)], DOMAIN, REACH, strength)


def headings(count=50, seed=0):
    heading = np.random.default_rng(seed).normal(size=(count, 3))
    return heading / np.linalg.norm(heading, axis=1, keepdims=True)


def turned(light, start, heading, step=0.4):
    count = len(heading)
    return light.turned(np.broadcast_to(start, (count, 3)), heading, np.full(count, step), np.arange(count))


def test_headings_beside_a_shade_turn_away_from_it():
    found = turned(shaded(), [0.5, 4.0, 0.0], headings())
    np.testing.assert_allclose(np.linalg.norm(found, axis=1), 1.0)
    assert ((found - headings())[:, 0] < 0).mean() > 0.9


def test_under_an_even_roof_headings_turn_up_or_stay():
    roof = np.random.default_rng(2).uniform([-9, 7.0, -9], [9, 8.5, 9], (20_000, 3))
    light = Light.under([Canopy(roof, 0.05)], DOMAIN, REACH, 1.0)
    assert (turned(light, [0.0, 6.0, 0.0], headings()) - headings())[:, 1].mean() > 0


def test_in_the_open_headings_stay():
    light = Light.under([Canopy(np.zeros((0, 3)), 0.0)], DOMAIN, REACH, 1.0)
    np.testing.assert_allclose(turned(light, [0.0, 5.0, 0.0], headings()), headings(), atol=1e-15)


@pytest.mark.parametrize("step", [0.05, 0.4, 5.0])
def test_a_turn_is_bounded_and_in_proportion_to_the_strength(step):
    whole, half = (turned(shaded(s), [0.5, 4.0, 0.0], headings(), step) for s in (1.0, 0.5))
    angle = np.arccos(np.clip((whole * headings()).sum(axis=1), -1, 1))
    assert angle.max() <= min(_TURN * step / HABIT.lateral_spacing, _MOST) + 1e-9
    angle_half = np.arccos(np.clip((half * headings()).sum(axis=1), -1, 1))
    np.testing.assert_allclose(np.tan(angle_half), 0.5 * np.tan(angle), rtol=1e-4, atol=1e-6)


def test_g_is_the_slope_of_the_shadow_by_its_reach():
    light, h = shaded(), 1e-4
    at = light.field.low + light.field.pitch * (np.array([[8, 8, 8], [9, 10, 11]]) + 0.5)
    pitch = light.field.pitch
    slope = [(light.field.shadow_at(at + pitch * e) - light.field.shadow_at(at - pitch * e)) / (2 * pitch) for e in np.eye(3)]
    wanted = -REACH * np.array(slope).T
    np.testing.assert_allclose(light.towards(at), wanted / np.maximum(np.linalg.norm(wanted, axis=1, keepdims=True), 1.0), rtol=1e-6)
    assert np.linalg.norm(light.towards(slab() + h), axis=1).max() <= 1 + 1e-12


@pytest.mark.parametrize("strength", [0.3, 1.0])
def test_buds_open_as_often_as_the_light_says(strength):
    light = Light.under([Canopy(slab(30_000), 0.05)], DOMAIN, REACH, strength)
    place, lots = np.array([2.0, 2.0, 0.0]), 20_000
    wanted = min(float(light.field.light_at(place[None])[0]) / _ENOUGH, 1.0) ** (_STRICT * strength)
    opens = light.opens(np.broadcast_to(place, (lots, 3)), np.arange(lots), root_key(0))
    assert 0.01 < wanted < 0.99
    assert opens.mean() == pytest.approx(wanted, abs=0.015)


def test_every_bud_opens_in_the_open_and_lots_belong_to_limbs():
    light = shaded()
    origin, limb = slab(200), np.arange(200)
    opens = light.opens(origin, limb, root_key(0))
    back = light.opens(origin[::-1], limb[::-1], root_key(0))
    np.testing.assert_array_equal(back[::-1], opens)
    assert light.opens(np.broadcast_to([-3.0, 9.5, 0.0], (50, 3)), limb[:50], root_key(0)).all()


def test_an_even_crown_holds_its_leaf_area_in_every_reach():
    ball = np.random.default_rng(0).normal(size=(40_000, 3))
    ball = 5.0 * ball / np.linalg.norm(ball, axis=1, keepdims=True) * np.random.default_rng(1).uniform(size=(40_000, 1)) ** (1 / 3)
    density = Canopy.of(ball, REACH, 0.1).area * len(ball) / (4 / 3 * np.pi * 125)
    assert density * REACH == pytest.approx(_LEAF_AREA, rel=0.03)


def test_the_order_of_trees_changes_nothing():
    one, two = Canopy(slab(), 0.05), Canopy(slab(seed=7) - [5, 0, 0], 0.02)
    a, b = (Light.under(list(both), DOMAIN, REACH, 1.0) for both in ((one, two), (two, one)))
    np.testing.assert_array_equal(a.slope, b.slope)


def test_what_is_beyond_the_box_casts_no_shade():
    far = Canopy(slab() + [500.0, 0, 0], 0.05)
    np.testing.assert_array_equal(Light.under([far], DOMAIN, REACH, 1.0).field.shadow, 0)


def test_a_shadow_reaches_in_proportion_to_the_crown():
    small, large = (Envelope.from_outlines([circle(radius=r)]) for r in (2.0, 4.0))
    assert shadow_reach(large, 10.0) == pytest.approx(2 * shadow_reach(small, 10.0), rel=1e-3)
    assert 0 < shadow_reach(None, 10.0) < 5.0


@pytest.mark.parametrize("strength", [-0.1, 1.01, np.nan])
def test_a_strength_out_of_range_is_refused(strength):
    from sketchtree.propagate.wanted import Wanted

    with pytest.raises(OptionError, match="but must lie between 0 and 1. 0.5 turns twigs to the light; 0 is off."):
        Wanted(HABIT, GENERIC, light=strength)
