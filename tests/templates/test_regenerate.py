"""The committed database is what its recipes make, on one process or several."""

import tomllib
from pathlib import Path

import numpy as np
import pytest

from sketchtree.errors import TemplateError
from sketchtree.foliage.models import leaf_names
from sketchtree.geometry.bark import bark_names
from sketchtree.parameters import TreeParameters
from sketchtree.templates.store import database
from sketchtree.templates.store.database import Database
from sketchtree.templates.growing.recipe import read_recipe
from sketchtree.templates.making.regenerate import make, orders, recipe_folder, regenerate

SOME = ("apple", "date_palm", "hazel")


def test_the_committed_file_has_exactly_the_recipes(shipped):
    recipes = {p.stem: p.read_text(encoding="utf-8") for p in recipe_folder().glob("*.toml")}
    assert sorted(recipes) == list(shipped.names)
    for name, text in recipes.items():
        assert shipped.exemplar(name).recipe == text, f"{name}: run `sketchtree templates build` and commit"
    assert shipped.path.stat().st_size < 6e6


def test_the_wheel_carries_it():
    project = tomllib.loads((recipe_folder().parent / "pyproject.toml").read_text(encoding="utf-8"))
    included = project["tool"]["hatch"]["build"]["targets"]["wheel"]["force-include"]
    packaged = Path(database.__file__).parents[1] / "data" / "exemplars.h5"
    assert included["template_db/exemplars.h5"] == packaged.relative_to(recipe_folder().parent).as_posix()


@pytest.mark.parametrize("name", ["date_palm", "english_oak"])
def test_a_rebuild_from_the_recipe_gives_the_committed_exemplar(shipped, name):
    (order,) = orders(recipe_folder(), only=(name,))
    exemplar, views = make(order)
    stored, index = shipped.exemplar(name), shipped.index(name)
    np.testing.assert_array_equal(exemplar.skeleton.parent, stored.skeleton.parent)
    np.testing.assert_allclose(exemplar.skeleton.tip, stored.skeleton.tip, atol=1e-5)
    np.testing.assert_allclose(exemplar.skeleton.radius, stored.skeleton.radius, rtol=1e-5)
    for key, value in exemplar.theta.as_dict().items():
        assert stored.theta.as_dict()[key] == pytest.approx(value, rel=1e-4, abs=1e-4)
    np.testing.assert_allclose(shipped.views.footprint[index], views.footprint, atol=1e-4)
    np.testing.assert_allclose(shipped.views.posture[index], views.posture, atol=1e-4)
    assert stored.seed == read_recipe(recipe_folder() / f"{name}.toml").seed


def test_the_same_recipes_give_the_same_bytes_whatever_the_number_of_processes(tmp_path):
    wanted, heard = orders(recipe_folder(), only=SOME), []
    regenerate(tmp_path / "a.h5", wanted, progress=heard.append)
    regenerate(tmp_path / "b.h5", wanted, jobs=2)
    assert (tmp_path / "a.h5").read_bytes() == (tmp_path / "b.h5").read_bytes()
    assert heard == list(SOME) == list(Database(tmp_path / "a.h5").names)


def test_a_count_goes_round_the_recipes_with_new_seeds():
    wanted = orders(recipe_folder(), only=("apple", "hazel"), count=5)
    assert [o.name for o in wanted] == ["apple", "hazel", "apple_2", "hazel_2", "apple_3"]
    assert len({o.seed for o in wanted if o.name.startswith("apple")}) == 3
    assert orders(recipe_folder(), only=("hazel",), seed=3)[0].seed == orders(recipe_folder(), only=("hazel",))[0].seed + 3
    assert not np.array_equal(make(wanted[1])[0].skeleton.tip[:50], make(wanted[3])[0].skeleton.tip[:50])


def test_a_species_stands_for_all_its_recipes():
    assert [o.name for o in orders(recipe_folder(), only=("Picea abies",))] == ["norway_spruce", "norway_spruce_young"]
    assert [o.name for o in orders(recipe_folder(), only=("apple", "Picea abies"))] == ["apple", "norway_spruce", "norway_spruce_young"]


def test_unknown_or_doubled_recipes_are_refused(tmp_path, minimal):
    with pytest.raises(TemplateError, match=r"There is no recipe called 'elm'\. Use one of: american_elm, apple, "):
        orders(recipe_folder(), only=("elm",))
    with pytest.raises(TemplateError, match=r"There are no recipes \(\*\.toml\) in"):
        orders(tmp_path)
    (tmp_path / "a.toml").write_text(minimal)
    (tmp_path / "b.toml").write_text(minimal)
    with pytest.raises(TemplateError, match=r"have the same `name`"):
        orders(tmp_path)


def test_every_exemplar_is_a_sound_tree_of_its_size(shipped):
    for name in shipped.names:
        e = shipped.exemplar(name)
        tree, habit = e.skeleton, e.habit
        assert 300 <= tree.segment_count <= 4000, name
        assert tree.height == pytest.approx(habit.height, rel=0.15), name
        assert tree.radius.max() == pytest.approx(habit.trunk_ratio * tree.height, rel=1e-3), name
        np.testing.assert_allclose(tree.tip[0], 0, atol=1e-6, err_msg=name)
        assert tree.tip[:, 1].min() >= 0, name
        continued = tree.limb[1:] == tree.limb[tree.parent[1:]]
        on_base = tree.is_base[tree.parent[1:]] | tree.is_base[1:]
        step = tree.order[1:] - tree.order[tree.parent[1:]]
        assert (step[continued & ~on_base] == 0).all() and (step[~continued & ~on_base] == 1).all(), name
        thinner = tree.radius[1:] <= tree.radius[tree.parent[1:]] * (1 + 1e-6)
        assert thinner[~tree.is_base[1:]].all(), name
        assert habit.leaf in leaf_names() and habit.bark in bark_names(), name
        assert e.source.endswith("estimated") and e.title
        assert e.thumbnail.shape == (128, 128) and 0.02 < (e.thumbnail < 128).mean() < 0.5, name
        assert all(isinstance(theta, TreeParameters) for theta in (e.theta, *e.theta_order))


def test_species_have_the_traits_that_name_them(shipped):
    at = {name: shipped.exemplar(name) for name in shipped.names}
    assert at["date_palm"].skeleton.order.max() == 1 == at["date_palm"].habit.max_order
    assert at["date_palm"].habit.leaf_arrangement == "frond"
    assert at["hazel"].skeleton.is_base.sum() > 5
    spruce = at["norway_spruce"]
    assert spruce.habit.arrangement == "whorled" and spruce.habit.apical_control > 0.9
    first = [r for r in np.flatnonzero(spruce.skeleton.order == 1) if spruce.skeleton.order[spruce.skeleton.parent[r]] == 0]
    assert np.bincount(spruce.skeleton.parent[first]).max() == 5, "whorls of five"
    willow = at["weeping_willow"].skeleton
    hanging = willow.vector[:, 1] < -0.9 * willow.length
    assert hanging.mean() > 0.4
    assert np.degrees(at["lombardy_poplar"].theta.mu_beta) < 35 < np.degrees(at["english_oak"].theta.mu_beta)
