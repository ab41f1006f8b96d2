"""Every figure of growth toward points can be another: by a recipe, and by NAME=VALUE. Those of the paper are what stands where nobody says so."""

import dataclasses

import pytest
from scanned import bark, feet

from sketchtree.clouds.growing.figures import KNOWN, changes
from sketchtree.clouds.growing.grown import grown, influence_of
from sketchtree.clouds.growing.logistic import Constant
from sketchtree.clouds.growing.species import read_species, recipe_folder, species
from sketchtree.clouds.growing.wanted import RANGES, Growing
from sketchtree.errors import OptionError, TemplateError
from sketchtree.keys import root_key

PEACH = species("peach")


def recipe(tmp_path, growing: str):
    path = tmp_path / "mine.toml"
    path.write_text((recipe_folder() / "peach.toml").read_text(encoding="utf-8") + "\n[growing]\n" + growing, encoding="utf-8")
    return path


def changed(said, kind=PEACH):
    return changes(said)[0].of(kind)


# the paper's figures


def test_what_nobody_says_otherwise_is_as_the_paper_has_it():
    how = PEACH.growing
    assert how == Growing()
    assert (how.alpha, how.beta, how.tropism) == (1.6, 0.3, (0.0, -1.0, 0.0))
    assert (how.theta, how.kill, how.least, how.most) == (90.0, 0.5, 4.0, 12.0)
    assert (how.influence, how.start, how.rate) == (None, 2.0, 0.3)
    assert (how.weighted, how.eps_d, how.eps_a) == (True, 0.03, 0.9)


# recipes


def test_a_recipe_says_how_its_species_grows(tmp_path):
    said = 'tropism = "up"\nalpha = 2\nbeta = 0.1\ntheta = 70\ninfluence = 6\nleast = 3\nmost = 9\nkill = 0.4\neps_d = 0.05\nweighted = false\n'
    mine = read_species(recipe(tmp_path, said))
    assert mine.growing == Growing(tropism=(0.0, 1.0, 0.0), alpha=2.0, beta=0.1, theta=70.0, influence=6.0, least=3.0, most=9.0, kill=0.4, eps_d=0.05, weighted=False)
    assert mine.roll == 97.0


def test_a_recipe_is_a_species_wherever_one_is_named(tmp_path):
    assert species(str(recipe(tmp_path, "tropism = [0.2, 1, 0]\ninfluence = 'logistic'"))).growing.tropism == (0.2, 1.0, 0.0)


def test_a_recipes_growth_is_what_grows(tmp_path):
    points = bark(spacing=0.08)
    mine = dataclasses.replace(species(str(recipe(tmp_path, "alpha = 0.5"))), internode=0.1)
    one = grown(points, feet(points), mine, key=root_key(0))
    assert one.wanted.alpha == 0.5
    said = grown(points, feet(points), mine, key=root_key(0), wanted=Growing())
    assert one.skeleton.tip.shape != said.skeleton.tip.shape or abs(one.skeleton.tip - said.skeleton.tip).max() > 1e-3


@pytest.mark.parametrize(
    ("growing", "message"),
    [
        ("alpah = 2", f"Recipe mine.toml: `growing.alpah` is not known. Leave it out; known are: {', '.join(RANGES)}, tropism, influence, weighted, steered, decided, settles, sheds, dominant, direct, holds, persists."),
        ("theta = 200", "Recipe mine.toml: `growing.theta` is 200. Give a number from 1 to 180."),
        ('influence = "far"', "Recipe mine.toml: `growing.influence` is 'far'. Give a number from 1 to 1000, internodes, or \"logistic\"."),
        ("tropism = [0, 1]", "Recipe mine.toml: `growing.tropism` is [0, 1]. Give \"up\", \"down\" or three numbers from -1 to 1: x, y, z."),
        ("weighted = 1", "Recipe mine.toml: `growing.weighted` is 1. Give true or false."),
        ("least = 9\nmost = 5", "Recipe mine.toml: Buds would look at least 9 internodes and at most 5. Make `most` the larger one."),
    ],
)
def test_a_growth_at_fault_is_refused_by_key(tmp_path, growing, message):
    with pytest.raises(TemplateError) as refused:
        read_species(recipe(tmp_path, growing))
    assert str(refused.value) == message


# NAME=VALUE


@pytest.mark.parametrize("name", KNOWN)
def test_every_figure_can_be_another(name):
    figure = KNOWN[name]
    text = next(iter(figure.words), None) if figure.between is None else f"{figure.between[0] + 0.25 * (figure.between[1] - figure.between[0]):g}"
    text = {"tropism": "up", "weights": "off", "least": "6", "most": "20"}.get(name, text)
    assert changed(f"{name}={text}") != PEACH


def test_a_figure_is_set_or_multiplied_or_is_a_word():
    assert changed("internode=0.05").internode == 0.05
    assert changed("internode=0.5x").internode == pytest.approx(0.019)
    assert changed("alpha=2x").growing.alpha == 3.2
    assert changed("tropism=up").growing.tropism == (0.0, 1.0, 0.0)
    assert changed("weights=off").growing.weighted is False
    assert changed("influence=logistic", changed("influence=5")).growing.influence is None


def test_several_values_are_several_changes():
    assert [change.text for change in changes("branching=25, 40,1.5x")] == ["25", "40", "1.5x"]


def test_a_constant_influence_and_a_narrower_one_are_what_buds_look():
    assert influence_of(changed("influence=5").growing, 200.0) == Constant(5.0)
    narrow = influence_of(changed("most=8").growing, 200.0)
    assert max(narrow(t) for t in range(60)) == 8.0


@pytest.mark.parametrize(
    ("said", "message"),
    [
        ("branching", "`branching` names no value. Say NAME=VALUE, such as branching=55."),
        ("height=3", f"No figure of growth is called 'height'. Choose one of: {', '.join(KNOWN)}."),
        ("tropism=left", "`tropism=left`: tropism is no such thing. Give down or up."),
        ("roll=far", "`roll=far` is no number. Give 0 to 360, or so many times what it is (0.8x)."),
        ("influence=0", "`influence=0` is out of range. Give 1 to 1000, or so many times what it is (0.8x), or logistic."),
        ("alpha=nan", "`alpha=nan` is out of range. Give 0 to 100, or so many times what it is (0.8x)."),
        ("gamma=0.4,0.5,0.4", "`gamma=0.4,0.5,0.4` says 0.4 twice. Say it once."),
    ],
)
def test_what_makes_no_sense_is_refused(said, message):
    with pytest.raises(OptionError) as refused:
        changes(said)
    assert str(refused.value) == message


@pytest.mark.parametrize(
    ("said", "message"),
    [
        ("internode=20x", "`internode=20x`, which is 0.76, is out of range. Give 0.005 to 0.5."),
        ("influence=2x", "`influence=2x`: there is no number to multiply, since influence is logistic. Give internodes."),
    ],
)
def test_a_multiple_that_no_species_could_have_is_refused(said, message):
    with pytest.raises(OptionError) as refused:
        changed(said)
    assert str(refused.value) == message
