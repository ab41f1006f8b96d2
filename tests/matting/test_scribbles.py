"""What scribbles mark, and what is said of those that mark nothing."""

import json

import numpy as np
import pytest

from sketchtree.errors import SketchError
from sketchtree.matting.scribbles import Scribbles, painted, read_scribbles
from sketchtree.photo.photo import Photo

PHOTO = Photo(np.full((40, 30, 3), 200, np.uint8))
TRUNK, BESIDE = [[15, 35], [15, 10]], [[3, 5], [3, 35]]


def written(tmp_path, document, name="s.json"):
    path = tmp_path / name
    path.write_text(document if isinstance(document, str) else json.dumps(document))
    return path


def test_a_line_marks_the_pixels_whose_middle_is_within_half_a_brush():
    mask = painted([np.array([[5.5, 2.5], [5.5, 7.5]])], 3.0, (12, 12))
    rows, columns = np.mgrid[:12, :12] + 0.5
    far = np.hypot(columns - 5.5, rows - np.clip(rows, 2.5, 7.5))
    np.testing.assert_array_equal(mask, far <= 1.5)


def test_a_hair_thin_brush_still_marks_the_pixels_of_its_points():
    assert painted([np.array([[4.0, 6.0]])], 1e-6, (12, 12))[6, 4]


def test_scribbles_are_read_from_json_whatever_else_it_holds(tmp_path):
    found = read_scribbles(written(tmp_path, {"version": 1, "foreground": [TRUNK], "background": [BESIDE], "brush": 4, "units": "px"}), PHOTO)
    assert found.brush == 4.0 and found.foreground[0].tolist() == TRUNK and found.background[0].tolist() == BESIDE


def test_layers_of_an_svg_say_which_is_which_and_its_page_is_the_photo(tmp_path):
    text = (
        '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 60 80"><g id="foreground"><path d="M30 70 L30 20" fill="none" stroke="red" stroke-width="4"/></g>'
        '<path id="background-1" d="M6 10 L6 70" fill="none" stroke="blue" stroke-width="4"/></svg>'
    )
    found = read_scribbles(written(tmp_path, text, "s.svg"), PHOTO)
    np.testing.assert_allclose(found.foreground[0], [[15, 35], [15, 10]])
    np.testing.assert_allclose(found.background[0], [[3, 5], [3, 35]])
    assert found.brush == pytest.approx(2.0)


@pytest.mark.parametrize(
    ("document", "said"),
    [
        ({"foreground": [TRUNK], "background": []}, "has no background line. Draw a line beside the tree, over what is behind it."),
        ({"background": [BESIDE]}, "has no foreground line. Draw a line along the trunk."),
        ({"foreground": [], "background": []}, "is empty. Draw one line along the trunk"),
        ({"foreground": [[[99, 99], [120, 90]]], "background": [BESIDE]}, r"The foreground lines of s.json lie outside the photo \(30 × 40 pixels\)"),
        ({"foreground": [TRUNK], "background": [TRUNK]}, "s.json: its background lines lie over all of its foreground lines. Draw a line along the trunk. Where lines lie over each other, the newer counts."),
        ({"foreground": [TRUNK], "background": [TRUNK], "order": ["background", "foreground"]}, "its foreground lines lie over all of its background lines. Draw a line beside the tree"),
    ],
)
def test_scribbles_that_leave_one_side_nothing_are_named(tmp_path, document, said):
    with pytest.raises(SketchError, match=said):
        read_scribbles(written(tmp_path, document), PHOTO).masks(PHOTO)


@pytest.mark.parametrize(
    ("document", "said"),
    [
        ({"strokes": []}, "holds no scribbles: it has neither a key 'foreground' nor 'background'"),
        ({"foreground": 3, "background": []}, "'foreground' is no list of lines"),
        ({"foreground": [[[1, "a"]]], "background": []}, "foreground line 1 is no list of points"),
        ({"foreground": [[]], "background": []}, "foreground line 1 has no points"),
        ({"foreground": [TRUNK], "background": [BESIDE], "brush": 0}, "has a brush of 0 pixels"),
        ({"foreground": [TRUNK], "background": [BESIDE], "brush": "wide"}, "'brush': 'wide'; a number was expected"),
        ({"foreground": [TRUNK], "background": [BESIDE], "order": ["foreground"]}, r"'order' doesn't name a side for each of the 1 foreground and 1 background lines"),
        ({"foreground": [TRUNK], "background": [BESIDE], "order": 7}, r'Give it as \["foreground", "background", ...\] in the order in which they were drawn, or leave it out'),
        ('{"foreground": [[[1, 1e999]]], "background": []}', "foreground line 1 has a coordinate that is not a finite number"),
    ],
)
def test_a_file_that_holds_no_scribbles_says_what_is_wrong(tmp_path, document, said):
    with pytest.raises(SketchError, match=said):
        read_scribbles(written(tmp_path, document), PHOTO)


def test_a_line_that_leaves_the_photo_is_remarked_on(tmp_path):
    found = read_scribbles(written(tmp_path, {"foreground": [[[15, 35], [15, -20]]], "background": [BESIDE]}), PHOTO)
    assert found.warnings == ("s.json: foreground line 1 leaves the photo; what is outside was left out.",)


def test_lines_never_change_once_made():
    with pytest.raises(ValueError, match="read-only"):
        Scribbles((TRUNK,), (BESIDE,)).foreground[0][0] = 1.0


def test_every_line_of_a_drawing_keeps_its_own_brush(tmp_path):
    text = (
        '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 60 80"><g id="foreground"><path d="M30 70 L30 20" fill="none" stroke="red" stroke-width="4"/>'
        '<path d="M40 70 L40 20" fill="none" stroke="red" stroke-width="12"/></g><path id="background-1" d="M6 10 L6 70" fill="none" stroke="blue" stroke-width="8"/></svg>'
    )
    found = read_scribbles(written(tmp_path, text, "s.svg"), PHOTO)
    assert found.brushes == (pytest.approx((2.0, 6.0)), pytest.approx((4.0,))) and found.brush == pytest.approx(4.0)
    fore, back = found.masks(PHOTO)
    assert fore[20].nonzero()[0].tolist() == [14, 15, *range(17, 23)] and back[20].nonzero()[0].tolist() == [1, 2, 3, 4]


def test_brushes_shrink_with_the_photo():
    found = Scribbles(([[10.0, 20.0]],), ([[2.0, 4.0]],), brushes=((6.0,), (3.0,))).scaled(np.array([0.5, 0.5]), 0.5)
    assert found.brushes == ((3.0,), (1.5,)) and found.brush == 1.5 and found.foreground[0].tolist() == [[5.0, 10.0]]


def test_a_brush_that_paints_nothing_is_refused():
    with pytest.raises(SketchError, match="has a brush of 0 pixels. Give `brush` as the line's width in pixels, above 0."):
        Scribbles(([[10.0, 20.0]],), ([[2.0, 4.0]],), brushes=((0.0,), (3.0,)))


ACROSS = [[2, 20], [28, 20]]


@pytest.mark.parametrize(("order", "newer"), [(None, "background"), (["foreground", "background"], "background"), (["background", "foreground"], "foreground")])
def test_where_lines_lie_over_each_other_the_newer_counts(tmp_path, order, newer):
    found = read_scribbles(written(tmp_path, {"foreground": [TRUNK], "background": [ACROSS]} | ({"order": order} if order else {})), PHOTO)
    fore, back = found.masks(PHOTO)
    assert not (fore & back).any() and (fore[20, 15], back[20, 15]) == (newer == "foreground", newer == "background")
    assert found.overlapping(PHOTO) == ("s.json marks 16 pixels as foreground and as background, the first at (13, 18); the newer line counts.",)


def test_lines_of_a_drawing_lie_over_each_other_as_they_were_drawn(tmp_path):
    trunk, beside, again = (f'<path id="{name}" d="{d}" fill="none" stroke="red" stroke-width="3"/>' for name, d in (("foreground-1", "M15 35 L15 10"), ("background-1", "M2 20 L28 20"), ("foreground-2", "M20 5 L20 35")))
    found = read_scribbles(written(tmp_path, f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 30 40">{trunk}{beside}{again}</svg>', "s.svg"), PHOTO)
    fore, back = found.masks(PHOTO)
    assert found.order == (0, 1, 0)
    assert back[20, 15] and fore[20, 20] and found.scaled(np.array([0.5, 0.5]), 0.5).order == (0, 1, 0)


def test_lines_that_lie_apart_are_not_remarked_on():
    assert Scribbles((TRUNK,), (BESIDE,)).overlapping(PHOTO) == ()
