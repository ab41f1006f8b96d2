import pytest

from sketchtree.sketch.files.labels import is_automatic, kind_named, plain_name, role_named
from sketchtree.sketch.strokes import StrokeKind


@pytest.mark.parametrize(
    "name",
    ["crown", "Crown", "the crown 2", "CROWNS", "crown_outline_1_", "crown_x5F_outline", "crown-outline", "treeCrown", "crown1", "Canopy",
     "foliage outline", "leaf outline", "leaf canopy", "layer crown", "branch crown", "tree_x0020_crown", "crónica crown"],
)  # fmt: skip
def test_these_names_are_crowns(name):
    assert kind_named(name) is StrokeKind.CROWN and role_named(name) is None


@pytest.mark.parametrize("name", ["branch", "Branches", "trunk", "main trunk 2", "limb12", "twigs", "stem", "boughs", "crown branches", "ground branch"])
def test_these_names_are_branches(name):
    assert kind_named(name) is StrokeKind.BRANCH


@pytest.mark.parametrize("name", ["obstacle", "obstacles_1_", "keep out", "keepOut"])
def test_these_names_are_obstacles(name):
    assert kind_named(name) is StrokeKind.OBSTACLE


@pytest.mark.parametrize(
    "name, role",
    [
        ("ground", "ground"),
        ("Ground line", "ground"),
        ("horizon", "ground"),
        ("root", "root"),
        ("Roots", "root"),
        ("trunk roots", "root"),
        ("cast shadow", "shadow"),
        ("crown shadow", "shadow"),
        ("leaf", "leaves"),
        ("leaves_x5F_2", "leaves"),
        ("crown leaves", "leaves"),
        ("Foliage", "leaves"),
        ("cross-hatching", "hatching"),
        ("bark texture", "hatching"),
        ("grass", "ground"),
        ("Background", "paper"),
        ("paper scan", "paper"),
        ("reference photo", "paper"),
        ("notes", "paper"),
    ],
)
def test_these_names_are_roles_and_no_kind(name, role):
    assert role_named(name) == role and kind_named(name) is None


@pytest.mark.parametrize(
    "name", ["", None, "groundbreaking", "uprooted", "crowned", "branching", "trunkated", "leaflet", "foreground2d", "path12", "Ebene 1", "système", "éleaf"]
)
def test_part_of_a_word_says_nothing(name):
    assert kind_named(name) is None and role_named(name) is None


def test_the_first_name_that_says_something_decides():
    assert kind_named(None, "layer 3", "crown", "obstacle") is StrokeKind.CROWN
    assert kind_named("shadow", "crown") is None and role_named("shadow", "crown") == "shadow"


def test_illustrators_escapes_are_undone():
    assert plain_name("crown_x5F_outline_1_") == "crown_outline"
    assert plain_name("_x31_st_x0020_limb") == "1st limb"
    assert plain_name("a_x0_b") == "a_x0_b" and plain_name("a_xD800_b") == "a_xD800_b" and plain_name("a_x1F_b") == "a_x1F_b"


@pytest.mark.parametrize("name", ["g1234", "Layer_1", "layer12", "path-7", "SVGID_1_", "group 3", "12", "Vector 4", "_2_"])
def test_names_that_programs_make_up_are_known(name):
    assert is_automatic(name)


@pytest.mark.parametrize("name", ["oak", "left side", "layers of ink", "g-clef", "grapes"])
def test_names_of_people_are_kept(name):
    assert not is_automatic(name)
