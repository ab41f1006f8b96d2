"""Recipes say what they mean, or say where they are wrong."""

import dataclasses

import pytest

from sketchtree.errors import TemplateError
from sketchtree.parameters import Habit
from sketchtree.templates.growing.profile import Profile
from sketchtree.templates.growing.recipe import GROWTH_HABITS, parse_recipe, read_recipe
from sketchtree.templates.making.regenerate import recipe_folder
from sketchtree.templates.growing.tables import Crown, Limbs


def test_a_number_is_a_constant_profile_and_pairs_are_knots(minimal):
    recipe = parse_recipe(minimal.replace("angle = 60.0", "angle = [[0.0, 80], [1.0, 40]]"), file="x.toml")
    assert recipe.limbs[0].ratio == Profile.constant(1.0)
    assert recipe.limbs[1].angle(0.5) == 60.0
    assert recipe.limbs[1].angle(2.0) == 40.0, "constant beyond the last knot"
    assert recipe.habit == Habit(trunk_ratio=0.05, twig_radius=0.01)
    assert recipe.level(7) is recipe.limbs[1], "the last table serves all deeper levels"


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("seed = 1", "sead = 1", "Recipe x.toml, `sead`: it is not a key of recipes. Use one of: crown, growth_habit, habit, limbs"),
        ("seed = 1", "seed = -1", "`seed`: -1 is out of range. Give an integer from 0"),
        ("seed = 1", "seed = 1.5", "`seed`: 1.5 is not a int. Correct its type."),
        ("seed = 1", "seed = true", "`seed`: True is not a int."),
        ('name = "stick"', 'name = "A Stick"', "`name`: 'A Stick' is no plain name. Use small letters, digits and _"),
        ("height = 4.0", 'height = "tall"', "`crown.height`: 'tall' is not a number. It is: height of the tree"),
        ("height = 4.0", "height = 4000", "`crown.height`: 4000 is out of range. Give 0.3 to 120 (m)"),
        ("height = 4.0", "height = nan", "`crown.height`: nan is not a number."),
        ("height = 4.0", "", "`crown.height`: it is missing. Add it: height of the tree"),
        ("levels = 2", "levels = 2.5", "`crown.levels`: 2.5 is no whole number."),
        ("bend = 0.0\nspacing", "bent = 0.0\nspacing", "`limbs[0].bent`: it is not a key of recipes."),
        ("angle = 60.0", "angle = 190", "`limbs[1].angle`: 190 is out of range. Give 0 to 180 (deg)"),
        ("angle = 60.0", "angle = [[0, 10], [0.5]]", "`limbs[1].angle`: [[0, 10], [0.5]] is not a number or [[place, value], ...]."),
        ("angle = 60.0", "angle = [[0.5, 10], [0.2, 9]]", "`limbs[1].angle`: its places [0.5, 0.2] do not rise from 0 to 1."),
        ("angle = 60.0", "planar = 1", "`limbs[1].planar`: 1 is not true or false."),
        ("bare = 0.25", "forks = 0.5", "`limbs[0].forks`: 0.5 is not [[place, value], ...]."),
        ("bare = 0.25", "forks = [[0.5, 1]]", "`limbs[0].forks`: 1 is out of range. Give 2 to 8"),
        ("ratio = 1.0", "ratio = 0.0", "`limbs[0].ratio`: the trunk has no length."),
        ("trunk_ratio = 0.05", "trunk_ratio = 5", "`habit.trunk_ratio`: 5.0 is out of range. Give 0.001 to 0.2."),
        ("trunk_ratio = 0.05", "whorl = 2.0", "`habit.whorl`: 2.0 is not a int."),
        ("trunk_ratio = 0.05", 'leaf_arrangement = "any"', "`habit.leaf_arrangement`: 'any' is not known. Give one of: opposite"),
        ("trunk_ratio = 0.05", "thickness = 1", "`habit.thickness`: it is not a key of recipes."),
        ("trunk_ratio = 0.05", "extra = {day = 2020-01-01}", "`habit.extra`: it holds a value that the database can't keep."),
        ("seed = 1", 'seed = 1\ngrowth_habit = "bushy"', "`growth_habit`: 'bushy' is not known. Give one of: decurrent, fastigiate"),
        ("seed = 1", "seed = 1\nspecies = 3", "`species`: 3 is not a str. Correct its type."),
        ("height = 4.0", "height = 4.0\nwind = -1", "`crown.wind`: -1 is out of range. Give 0 to 180 (deg/m): turn of every limb downwind"),
        ("bare = 0.25", "rest = 100", "`limbs[0].rest`: 100 is out of range. Give -90 to 90 (deg)"),
        ("bare = 0.25", "broken = [[0, 2]]", "`limbs[0].broken`: 2 is out of range. Give 0 to 1 (1)"),
        ("[crown]", "[crown", "Recipe x.toml: it is not valid TOML"),
    ],
)
def test_a_wrong_key_is_named_with_its_file(minimal, old, new, message):
    assert old in minimal
    with pytest.raises(TemplateError) as caught:
        parse_recipe(minimal.replace(old, new, 1), file="x.toml")
    assert message in str(caught.value)
    assert str(caught.value).startswith("Recipe x.toml")


def test_a_recipe_without_a_trunk_is_refused(minimal):
    start, end = minimal.index("[[limbs]]"), minimal.index("[habit]")
    with pytest.raises(TemplateError, match=r"`limbs`: it is missing"):
        parse_recipe(minimal[:start] + minimal[end:], file="x.toml")


def test_a_missing_or_binary_file_is_named(tmp_path):
    with pytest.raises(TemplateError, match=r"none\.toml: it can't be read"):
        read_recipe(tmp_path / "none.toml")
    (tmp_path / "binary.toml").write_bytes(b"\xff\xfe\x00")
    with pytest.raises(TemplateError, match=r"binary\.toml: it can't be read"):
        read_recipe(tmp_path / "binary.toml")


def test_the_readme_lists_every_key():
    text = (recipe_folder() / "README.md").read_text(encoding="utf-8")
    for kind in (Crown, Limbs, Habit):
        for key in dataclasses.fields(kind):
            assert f"| `{key.name}`" in text, key.name
            if kind is not Habit:
                assert key.metadata["meaning"] in text, key.name
                assert f"| `{key.name}`{_row(key)} |" in text, f"unit, range or default of {key.name}"
    assert all(f"`{habit}`" in text for habit in GROWTH_HABITS)


def _row(key) -> str:
    """` * | unit | range | default` as the table shows them."""
    unit, default = key.metadata["unit"], key.default
    span = "" if unit == "bool" else f"{key.metadata['low']:g} – {key.metadata['high']:g}"
    if isinstance(default, Profile):
        default = default.values[0]
    known = {dataclasses.MISSING: "needed", None: "none", True: "true", False: "false"}
    shown = known[default] if isinstance(default, bool) or default in (None, dataclasses.MISSING) else f"{default:g}"
    profile = " *" if "Profile" in str(key.type) else ""
    return f"{profile} | {unit} | {span} | {shown}"


def test_species_and_growth_habit_may_be_left_out(minimal):
    assert parse_recipe(minimal, file="x.toml").growth_habit == ""
    named = parse_recipe('species = "Lignum vulgare"\ngrowth_habit = "irregular"\n' + minimal, file="x.toml")
    assert (named.species, named.growth_habit) == ("Lignum vulgare", "irregular")
