from dataclasses import replace

import numpy as np
import pytest

from sketchtree import keys
from sketchtree.foliage.blossom import blossom
from sketchtree.foliage.cards import leaf_mesh
from sketchtree.foliage.models import leaf_model, leaf_names
from sketchtree.foliage.populate import populate
from tests.foliage.trees import HABIT, single_twig, small_tree

KEY = keys.root_key(3)
BEARING = [name for name in leaf_names() if leaf_model(name).blossom]


@pytest.mark.parametrize("name", BEARING)
def test_in_spring_a_species_with_blossoms_bears_its_own_beside_the_young_leaves(name):
    tree = small_tree(twigs=20)
    found = blossom(tree, HABIT, key=KEY, model=name, season="spring")
    assert found.model == leaf_model(name).blossom and len(found) > 0
    assert leaf_mesh(found, season="spring").name == "leaf_blossom"
    young = populate(tree, HABIT, key=KEY, model=name, season="spring")
    near = np.linalg.norm(found.position[:, None] - young.position[None], axis=2).min(axis=1)
    if leaf_model(name).blossom_on == "twigs":
        assert near.max() < 0.02  # each stands where a leaf does


@pytest.mark.parametrize("season", ["summer", "autumn", "bare"])
def test_there_is_none_out_of_spring(season):
    assert blossom(small_tree(), HABIT, key=KEY, model="cherry", season=season) is None


def test_a_species_without_one_has_none():
    assert blossom(small_tree(), HABIT, key=KEY, model="oak", season="spring") is None


def test_candles_rise_and_catkins_hang():
    tree = small_tree(twigs=20)
    candle, catkin = (blossom(tree, HABIT, key=KEY, model=name, season="spring") for name in ("horse_chestnut", "hazel"))
    assert candle.direction[:, 1].min() > 0.5 and catkin.direction[:, 1].max() < -0.7


def test_a_new_limb_leaves_the_others_blossoms_as_they_were():
    before, after = (blossom(small_tree(twigs=n), HABIT, key=KEY, model="apple", season="spring") for n in (4, 5))
    old = np.isin(after.segment, np.arange(len(small_tree(twigs=4))))
    assert old.sum() == len(before) < len(after)
    for name in ("direction", "size", "tint"):
        assert np.allclose(getattr(before, name), getattr(after, name)[old], atol=1e-12), name


def test_no_more_than_the_most_are_kept():
    assert len(blossom(small_tree(twigs=20), HABIT, key=KEY, model="apple", season="spring", most=7)) == 7


def test_a_blossom_model_can_be_worn_as_a_leaf():
    leaves = populate(single_twig(), HABIT, key=KEY, model="cherry_blossom")
    assert leaves.model == "cherry_blossom" and len(leaves) > 3


def test_blossoms_of_tall_species_are_drawn_larger_as_their_leaves_are():
    low, tall = (blossom(small_tree(), replace(HABIT, height=h), key=KEY, model="apple", season="spring") for h in (4.0, 30.0))
    assert tall.size.mean() == pytest.approx(1.5 * low.size.mean())
