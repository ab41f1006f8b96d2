import pytest

from sketchtree.sketch.roles.named import role_in_name, role_in_names
from sketchtree.sketch.strokes import Stroke


@pytest.mark.parametrize(
    "name, role",
    [
        ("ground", "ground"),
        ("Ground line", "ground"),
        ("groundLine", "ground"),
        ("my_grass_2", "ground"),
        ("SHADOW", "shadow"),
        ("leaves", "leaves"),
        ("Blossoms 3", "leaves"),
        ("roots", "root"),
        ("hatching", "hatching"),
        ("paper", "paper"),
        ("reference photo", "paper"),
    ],
)
def test_a_word_in_any_spelling_says_what_a_stroke_is(name, role):
    assert role_in_name(name) == role


@pytest.mark.parametrize("name", ["background tree", None, "", "path1234", "leafcutter", "underground", "beetroot"])
def test_parts_of_words_say_nothing(name):
    assert role_in_name(name) in (None, "paper") and role_in_name("beetroot") is None


def test_a_stroke_s_own_id_wins_over_its_layer():
    assert role_in_names(Stroke("shadow-1", [(0, 0), (1, 1)], layer="ground")) == "shadow"
    assert role_in_names(Stroke("path1", [(0, 0), (1, 1)], layer="ground")) == "ground"
