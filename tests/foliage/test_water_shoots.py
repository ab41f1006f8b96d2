from dataclasses import replace

import numpy as np

from sketchtree import keys
from sketchtree.foliage.buds import buds
from sketchtree.foliage.populate import leafy_wood, populate
from sketchtree.foliage.twigs import wood_pieces
from sketchtree.foliage.water_shoots import water_shoots
from sketchtree.foliage.wear import wear_of
from sketchtree.skeleton import TreeSkeleton
from tests.foliage.trees import HABIT, crown

KEY = keys.root_key(5)


def stout_limb(thickness=0.06, tip=0.003):
    """A trunk with one straight level limb, 4 m long and thick up to its last metre; ids 1 and 7."""
    tips = np.array([[0, 0, 0], [0, 2, 0], [1.5, 2, 0], [3, 2, 0], [4, 2, 0]], float)
    radius = [0.3, 0.25, thickness, thickness, tip]
    return TreeSkeleton.from_columns([-1, 0, 1, 2, 3], tips, radius, limb=[1, 1, 7, 7, 7], order=[0, 0, 1, 1, 1])


def shoots_of(tree, model=None):
    """Where water shoots start, metres, and what they bear."""
    wear, pieces = wear_of(HABIT, model), wood_pieces(tree)
    borne, _ = buds(leafy_wood(pieces, tree, HABIT, wear), tree.limb, wear, HABIT.twig_radius, KEY)
    return water_shoots(pieces, tree.order, tree.limb, borne, wear, HABIT, KEY)


def test_a_thick_limb_in_the_light_bears_shoots_on_its_outer_part_and_a_trunk_none():
    stand, shoots = shoots_of(stout_limb())
    assert len(shoots) > 5 and np.all(shoots[:, 0, 0] > 1.7)
    assert np.all(np.bincount(stand.shoot) >= 2) and stand.shoot.max() == len(shoots) - 1


def test_shoots_start_on_the_bark_and_are_as_long_as_twigs():
    _, shoots = shoots_of(stout_limb())
    from_axis = np.hypot(shoots[:, 0, 1] - 2, shoots[:, 0, 2])
    length = np.linalg.norm(shoots[:, 1] - shoots[:, 0], axis=1)
    assert np.all(from_axis < 0.061) and np.all(from_axis > 0.015)
    assert 0.6 * HABIT.twig_length < length.mean() < 1.4 * HABIT.twig_length


def test_no_shoot_stands_where_a_leaf_is_near():
    tree = stout_limb()
    pieces, wear = wood_pieces(tree), wear_of(HABIT)
    borne, _ = buds(leafy_wood(pieces, tree, HABIT, wear), tree.limb, wear, HABIT.twig_radius, KEY)
    _, shoots = shoots_of(tree)
    assert (np.linalg.norm(borne.foot[:, None] - shoots[None, :, 0], axis=2).min(axis=0) > 0.07).all()


def test_a_bough_that_carries_a_crown_bears_none():
    assert len(shoots_of(stout_limb(thickness=0.19, tip=0.185))[1]) == 0


def test_thin_wood_bears_leaves_not_shoots():
    assert len(shoots_of(crown(limbs=60))[1]) == 0


def test_needles_and_fronds_bear_none():
    assert len(shoots_of(stout_limb(), "spruce")[1]) == 0
    assert len(shoots_of(stout_limb(), "palm")[1]) == 0


def test_shade_keeps_old_wood_bare():
    tree = stout_limb()
    pieces, wear = wood_pieces(tree), wear_of(HABIT)
    borne, _ = buds(leafy_wood(pieces, tree, HABIT, wear), tree.limb, wear, HABIT.twig_radius, KEY)
    rng = np.random.default_rng(2)
    roof = rng.uniform([-1, 0.5, -1.5], [5, 3.6, 1.5], (40_000, 3))
    roof = roof[np.hypot(roof[:, 1] - 2, roof[:, 2]) > 0.3]
    shaded = replace(borne, **{name: np.repeat(getattr(borne, name)[:1], len(roof), axis=0) for name in borne.__dataclass_fields__} | {"foot": roof})
    many = water_shoots(pieces, tree.order, tree.limb, borne, wear, HABIT, KEY)[1]
    few = water_shoots(pieces, tree.order, tree.limb, borne.followed_by(shaded), wear, HABIT, KEY)[1]
    assert len(few) < 0.5 * len(many)


def test_the_leaves_of_a_tree_name_the_water_shoots_they_stand_on():
    leaves = populate(stout_limb(), HABIT, key=KEY)
    _, water = shoots_of(stout_limb())
    assert np.allclose(leaves.shoot[-len(water) :], water)
    again = populate(stout_limb(), HABIT, key=KEY)
    assert np.array_equal(leaves.position, again.position)
