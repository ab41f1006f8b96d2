"""Round bars that a game collides with instead of the wood."""

import numpy as np
import pytest

from sketchtree.axes import NULL
from sketchtree.geometry.limbs import centre_lines
from sketchtree.rig.bones import bones
from sketchtree.rig.boughs import boughs
from sketchtree.rig.capsules import capsules
from sketchtree.rig.place import wood_places
from tests.geometry.growing import bushy, drawn, stick
from tests.rig.rigged_trees import dressed, grown, rigged


def thick_bush(levels):
    """As `bushy`, but the wood thins from order to order."""
    tree = bushy(levels=levels)
    return tree.replace(radius=0.2 * 0.45**tree.order)


def fitted(tree, **given):
    lines = centre_lines(tree)
    limbs = boughs(tree, lines)
    return lines, capsules(lines, limbs, bones(lines, limbs), **given)


def outside(found, point):
    """(metres outside the nearest capsule, negative inside; how far inside as a share of its radius)."""
    away = np.full(len(point), np.inf)
    share = np.zeros(len(point))
    for start, end, radius in zip(found.start, found.end, found.radius, strict=True):
        chord = end - start
        u = np.clip((point - start) @ chord / (chord @ chord), 0, 1)
        gap = np.linalg.norm(point - start - u[:, None] * chord, axis=1) - radius
        share = np.where(gap < away, -gap / radius, share)
        away = np.minimum(away, gap)
    return away, share


@pytest.mark.parametrize("tree", [grown(), thick_bush(levels=2), drawn()], ids=["grown", "bushy", "drawn"])
def test_the_wood_is_inside_and_close_to_its_capsules(tree):
    lines, found = fitted(tree)
    rng = np.random.default_rng(0)
    limb = rng.integers(0, len(lines), 4000)
    s = rng.uniform(0, 1, 4000) * lines.length[limb]
    point, radius = lines.at(limb, s)
    side = rng.normal(size=(4000, 3))
    side /= np.linalg.norm(side, axis=1, keepdims=True)
    ahead = lines.at(limb, s + 0.01)[0] - lines.at(limb, s - 0.01)[0]
    ahead /= np.linalg.norm(ahead, axis=1, keepdims=True)
    side -= (side * ahead).sum(axis=1, keepdims=True) * ahead
    side /= np.linalg.norm(side, axis=1, keepdims=True)
    on_skin = point + radius[:, None] * side
    thick = (radius >= found.thinnest) & (point[:, 1] > 0) & (wood_places(lines, on_skin).limb == limb)
    away, share = outside(found.capsules, on_skin[thick])
    assert np.quantile(away, 0.99) <= 0.005 and away.max() < 0.02
    assert share.mean() <= 0.25 and found.loose <= 0.25


def test_there_are_no_more_than_asked_for_and_the_threshold_rises_instead():
    lines, few = fitted(thick_bush(levels=3), most=8)
    _, many = fitted(thick_bush(levels=3), most=64)
    assert 1 <= len(few.capsules) <= 8 < len(many.capsules) <= 64
    assert few.thinnest > many.thinnest >= 0.02


def test_a_straight_even_trunk_needs_one_capsule():
    _, found = fitted(stick([[0, 0, 0], [0, 1.5, 0], [0, 3, 0]], 0.1), thinnest=0.02, flare=0.0)
    assert len(found.capsules) == 1 and found.capsules.radius[0] == pytest.approx(0.1, abs=1e-6)
    assert np.allclose(found.capsules.start[0], 0, atol=1e-6) and np.allclose(found.capsules.end[0], [0, 3, 0], atol=1e-6)


def test_a_bent_limb_is_cut_in_several():
    arc = [[np.sin(a), 1 - np.cos(a), 0] for a in np.linspace(0, 1.5, 12)]
    _, found = fitted(stick(3 * np.array(arc), 0.08), flare=0.0)
    assert 4 <= len(found.capsules) <= 64
    assert np.allclose(found.capsules.start[1:], found.capsules.end[:-1])  # each begins where the last ends


def test_a_stems_flare_is_inside():
    _, found = fitted(stick([[0, 0, 0], [0, 1.5, 0], [0, 3, 0]], 0.1), flare=0.45)
    ring = np.column_stack([0.14 * np.cos(np.arange(8)), np.zeros(8), 0.14 * np.sin(np.arange(8))])
    assert np.all(outside(found.capsules, ring)[0] <= 0)


def test_each_moves_with_a_bone_of_its_own_limb_or_of_what_carries_it():
    rigging, _, _ = rigged()
    found = capsules(rigging.lines, rigging.limbs, rigging.bones).capsules
    place = wood_places(rigging.lines, 0.5 * (found.start + found.end))
    on = rigging.bones.limb[found.joint]
    assert np.all((on == place.limb) | (on == rigging.lines.parent[place.limb]))
    assert np.all(capsules(rigging.lines, rigging.limbs, None).capsules.joint == NULL)


def test_thin_trees_have_none():
    _, found = fitted(stick([[0, 0, 0], [0, 1, 0]], 0.01))
    assert len(found.capsules) == 0 and found.capsules.start.shape == (0, 3) and found.loose == 0.0


def test_the_same_tree_has_the_same_capsules():
    _, lines, limbs, _, _, _ = dressed()
    one, two = (capsules(lines, limbs, None).capsules for _ in range(2))
    assert np.array_equal(one.start, two.start) and np.array_equal(one.radius, two.radius)
