import numpy as np
import pytest

from sketchtree.sketch.files.transforms import length, matrix_of, transform_list

BOX = (0.0, 0.0, 200.0, 100.0)


def moved(matrix, x, y):
    return (matrix @ (x, y, 1.0))[:2]


@pytest.mark.parametrize(
    "text, expected",
    [
        ("translate(125px, 190px)", (126, 192)),
        ("translate(10)", (11, 2)),
        ("translate(50%, 50%)", (101, 52)),
        ("translateY(3)", (1, 5)),
        ("translateX(3mm)", (1 + 3 * 96 / 25.4, 2)),
        ("scale(2)", (2, 4)),
        ("scale(2 -1)", (2, -2)),
        ("scaleY(3)", (1, 6)),
        ("rotate(90)", (-2, 1)),
        ("rotate(.25turn)", (-2, 1)),
        ("rotate(90 1 2)", (1, 2)),
        ("skewX(45)", (3, 2)),
        ("matrix(1,2,3,4,5,6)", (12, 16)),
        ("translate(10 0) scale(2)", (12, 4)),
        ("none", (1, 2)),
    ],
)
def test_each_function_moves_a_point_as_css_says(text, expected):
    assert moved(transform_list(text, BOX), 1, 2) == pytest.approx(expected)


def test_a_style_sheet_replaces_the_attribute():
    assert moved(matrix_of("scale(9)", {"transform": "translate(1px, 1px)"}, BOX), 1, 2) == pytest.approx((2, 3))


def test_rotation_turns_about_the_transform_origin():
    style = {"transform": "rotate(180deg)", "transform-origin": "center"}
    assert moved(matrix_of(None, style, BOX), 0, 0) == pytest.approx((200, 100))


def test_individual_properties_come_before_the_transform():
    style = {"translate": "5px", "scale": "2", "transform": "translate(1px)"}
    assert moved(matrix_of(None, style, BOX), 0, 0) == pytest.approx((7, 0))


@pytest.mark.parametrize("text", ["warp(3)", "rotate(3px)", "matrix(1,2)", "translate(1furlong)"])
def test_what_is_no_transform_is_named(text):
    with pytest.raises(ValueError, match="is not a transform in the plane"):
        transform_list(text)


def test_lengths_are_in_user_units_of_96_to_the_inch():
    assert [length("1in"), length("72pt"), length("25%", 8.0), length("-.5e1")] == pytest.approx([96, 96, 2, -5])
    with pytest.raises(ValueError, match="not a length"):
        length("wide")


def test_a_matrix_composes_with_the_outermost_first():
    assert np.allclose(transform_list("scale(2) translate(3 4)"), transform_list("scale(2)") @ transform_list("translate(3 4)"))
