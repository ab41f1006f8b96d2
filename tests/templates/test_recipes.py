"""The shipped recipes: enough of them, each true to what it says of itself."""

from collections import Counter, defaultdict

import numpy as np
import pytest

from sketchtree.foliage.models import leaf_names
from sketchtree.geometry.bark import bark_names
from sketchtree.templates.growing.procedural import grow
from sketchtree.templates.growing.recipe import GROWTH_HABITS, read_recipe
from sketchtree.templates.making.regenerate import recipe_folder
from sketchtree.traverse import limb_chains

RECIPES = {path.stem: read_recipe(path) for path in sorted(recipe_folder().glob("*.toml"))}
OPPOSITE = ("norway_maple", "european_ash", "weeping_ash", "horse_chestnut", "lilac", "elder", "olive")  # as botany has it
DISTICHOUS = ("european_beech", "small_leaved_lime", "american_elm", "hazel", "fastigiate_hornbeam")
ROWS = 5000  # of one exemplar, at most


@pytest.fixture(scope="module")
def trees():
    return {name: grow(recipe) for name, recipe in RECIPES.items()}


def test_there_are_enough_exemplars_species_and_habits():
    assert len(RECIPES) >= 34
    assert len({recipe.species for recipe in RECIPES.values()}) >= 26
    habits = Counter(recipe.growth_habit for recipe in RECIPES.values())
    assert set(habits) == set(GROWTH_HABITS) and min(habits.values()) >= 3, habits


def test_every_recipe_says_what_it_is_and_where_its_figures_come_from():
    for name, recipe in RECIPES.items():
        assert recipe.name == name and recipe.species and recipe.title, name
        assert recipe.source == "estimated" or recipe.source.endswith("; the rest estimated"), name
        assert recipe.habit.leaf in leaf_names() and recipe.habit.bark in bark_names(), name


def test_some_species_are_shown_young_and_old_alive_and_dead():
    of = defaultdict(set)
    for name, recipe in RECIPES.items():
        of[recipe.species].add(name)
    assert of["Quercus robur"] == {"english_oak", "english_oak_young", "dead_oak"}
    assert of["Picea abies"] == {"norway_spruce", "norway_spruce_young"}
    assert of["Pinus sylvestris"] >= {"scots_pine", "scots_pine_young", "pine_snag", "windswept_pine"}


def test_the_readme_names_every_recipe():
    text = (recipe_folder() / "README.md").read_text(encoding="utf-8")
    assert [name for name in RECIPES if f"`{name}`" not in text] == []


def test_no_tree_is_too_large_or_grows_into_the_ground(trees):
    for name, tree in trees.items():
        assert 100 < len(tree) <= ROWS, (name, len(tree))
        assert tree.tip[:, 1].min() >= 0.0, name
        assert tree.tip[~tree.is_base][:, 1].min() > 0.0, name


def test_a_tree_has_about_the_height_its_recipe_says(trees):
    broken = {"pine_snag"}
    for name in set(trees) - broken:
        crown = RECIPES[name].crown
        assert 0.8 * crown.height <= trees[name].height <= 1.3 * crown.height, name
    assert trees["pine_snag"].height < 0.9 * RECIPES["pine_snag"].crown.height


@pytest.mark.parametrize("name", OPPOSITE)
def test_opposite_species_bear_laterals_in_opposite_pairs(trees, name):
    recipe, tree = RECIPES[name], trees[name]
    assert recipe.habit.arrangement == "opposite" and recipe.habit.whorl == 2
    bearing = recipe.limbs[1 : int(recipe.crown.levels) - 1]
    assert all(table.whorl == 2 and table.phyllotaxis == 90.0 for table in bearing)
    turned = np.array([_turn_between(tree, pair) for pair in _pairs(tree)])
    assert len(turned) > 20 and np.median(turned) > 150 and np.percentile(turned, 10) > 110


@pytest.mark.parametrize("name", DISTICHOUS)
def test_two_ranked_species_bear_laterals_left_and_right(name):
    recipe = RECIPES[name]
    assert recipe.habit.arrangement == "alternate"
    assert any(table.phyllotaxis == 180.0 and table.planar and table.whorl == 1 for table in recipe.limbs)


def test_conifers_in_whorls_bear_their_branches_in_whorls(trees):
    for name in ("norway_spruce", "norway_spruce_young", "silver_fir", "scots_pine_young"):
        tree = trees[name]
        first = [rows[0] for rows in limb_chains(tree.parent, tree.limb) if tree.order[rows[-1]] == 1]
        assert np.bincount(tree.parent[first]).max() == RECIPES[name].limbs[0].whorl, name


def test_the_same_recipe_grows_the_same_tree_again(trees):
    for name in ("english_oak", "windswept_hawthorn", "dead_oak", "umbrella_thorn", "bonsai_pine"):
        np.testing.assert_array_equal(grow(RECIPES[name]).tip, trees[name].tip)
        np.testing.assert_array_equal(grow(RECIPES[name]).radius, trees[name].radius)


def test_another_seed_is_another_tree_of_the_same_kind(trees):
    for name in RECIPES:
        other = grow(RECIPES[name], RECIPES[name].seed + 7919)
        if name != "pine_snag":  # what is left of a dead trunk is a matter of luck
            assert 0.35 < len(other) / len(trees[name]) < 2.8, name
        assert 0.7 < other.height / trees[name].height < 1.45, name


def test_the_shipped_file_is_small():
    assert (recipe_folder() / "exemplars.h5").stat().st_size < 6_000_000


def _pairs(tree):
    """Laterals that start at one node, two of them."""
    at = defaultdict(list)
    for rows in limb_chains(tree.parent, tree.limb):
        parent = tree.parent[rows[0]]
        if parent >= 0 and tree.order[rows[0]] > max(tree.order[parent], 1):
            at[int(parent)].append(int(rows[0]))
    return [pair for pair in at.values() if len(pair) == 2]


def _turn_between(tree, pair) -> float:
    """Degrees between the azimuths of two laterals about the wood that bears them."""
    axis = tree.vector[tree.parent[pair[0]]]
    axis = axis / np.linalg.norm(axis)
    a, b = (tree.vector[row] - tree.vector[row] @ axis * axis for row in pair)
    return np.degrees(np.arccos(np.clip(a @ b / np.linalg.norm(a) / np.linalg.norm(b), -1, 1)))
