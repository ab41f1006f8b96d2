"""Strokes over a photo are the marks of its trees, or refused by name (`photo/read_strokes`)."""

import json

import numpy as np
import pytest

from sketchtree.errors import SketchError
from sketchtree.photo.photo import Photo
from sketchtree.photo.read_strokes import read_strokes

PHOTO = Photo(np.zeros((300, 200, 3), np.uint8), name="p.jpg")
CROWN = "M 40,20 160,20 160,150 40,150 Z"
TRUNK = "M 100,290 100,200 102,100"


def svg(tmp_path, *groups, box="0 0 200 300"):
    """A file of groups: (name, path data, ...), a path as `data` or (id, data)."""
    body = ""
    for name, *paths in groups:
        drawn = "".join(f'<path id="{p[0]}" d="{p[1]}"/>' if isinstance(p, tuple) else f'<path d="{p}"/>' for p in paths)
        body += f'<g id="{name}" fill="none" stroke="black">{drawn}</g>'
    path = tmp_path / "s.svg"
    path.write_text(f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="{box}">{body}</svg>')
    return path


def refused(path, photo=PHOTO):
    with pytest.raises(SketchError) as error:
        read_strokes(path, photo)
    return str(error.value)


def test_a_crown_and_a_trunk_are_one_tree_in_the_photos_pixels(tmp_path):
    (tree,) = read_strokes(svg(tmp_path, ("crown", ("c", CROWN)), ("branches", ("b", TRUNK))), PHOTO)
    assert {tuple(p) for p in tree.crown} == {(40, 20), (160, 20), (160, 150), (40, 150)} and len(tree.crown) == 4
    assert tree.branches[0].tolist() == [[100, 290], [100, 200], [102, 100]]
    assert (tree.crown_name, tree.names, tree.warnings) == ("c", ("b",), ())


def test_the_trunk_comes_first_and_every_stroke_begins_at_its_foot(tmp_path):
    groups = ("crown", CROWN), ("branches", ("limb", "M 50,60 100,120"), ("down", "M 100,80 100,290"), ("up", "M 101,150 150,60"))
    (tree,) = read_strokes(svg(tmp_path, *groups), PHOTO)
    assert tree.names == ("down", "limb", "up")
    assert [branch[0].tolist() for branch in tree.branches] == [[100, 290], [100, 120], [101, 150]]


def test_a_stroke_named_trunk_is_the_trunk(tmp_path):
    groups = ("crown", CROWN), ("branches", ("weeping", "M 60,100 50,299"), ("trunk", "M 100,280 100,90"))
    assert read_strokes(svg(tmp_path, *groups), PHOTO)[0].names == ("trunk", "weeping")


def test_of_two_that_reach_hardly_lower_the_first_is_the_trunk(tmp_path):
    groups = ("crown", CROWN), ("branches", ("first", "M 100,284 100,90"), ("second", "M 110,290 130,90"))
    assert read_strokes(svg(tmp_path, *groups), PHOTO)[0].names == ("first", "second")


def test_an_open_crown_is_closed_and_loops_of_a_careless_hand_belong_to_it(tmp_path):
    open_ = "M 40,20 160,20 160,150 40,150 40,30"
    assert len(read_strokes(svg(tmp_path, ("crown", open_), ("branches", TRUNK)), PHOTO)[0].crown) >= 4
    looped = "M 40,20 160,20 160,150 40,150 40,10 50,10 50,30 30,30 Z"
    (tree,) = read_strokes(svg(tmp_path, ("crown", looped), ("branches", TRUNK)), PHOTO)
    assert tree.crown[:, 0].min() >= 30 and tree.crown[:, 1].max() == 150


def test_without_a_name_the_stroke_that_closes_is_the_crown(tmp_path):
    (tree,) = read_strokes(svg(tmp_path, ("all", ("x", CROWN), ("y", TRUNK))), PHOTO)
    assert (tree.crown_name, tree.names) == ("x", ("y",))


def test_sketch_json_marks_a_tree_as_well(tmp_path):
    strokes = [
        {"id": "c", "kind": "crown", "closed": True, "points": [[40, 20], [160, 20], [160, 150], [40, 150]]},
        {"id": "t", "kind": "branch", "points": [[100, 290], [100, 100]]},
    ]
    (tmp_path / "s.json").write_text(json.dumps({"sketchtree": 1, "units": "px", "y": "down", "strokes": strokes}))
    (tree,) = read_strokes(tmp_path / "s.json", PHOTO)
    assert tree.branches[0].tolist() == [[100, 290], [100, 100]]


LEFT, RIGHT = "M 10,20 90,20 90,150 10,150 Z", "M 110,20 190,20 190,150 110,150 Z"


def test_of_several_trees_each_has_the_limbs_in_or_under_its_crown(tmp_path):
    limbs = ("r", "M 150,290 150,100"), ("l", "M 50,290 50,160"), ("r2", "M 150,110 180,40")
    left, right = read_strokes(svg(tmp_path, ("crown", LEFT, RIGHT), ("branches", *limbs)), PHOTO)
    assert left.names == ("l",) and right.names == ("r", "r2")


def test_a_layer_named_tree_says_whose_a_limb_is(tmp_path):
    groups = ("tree 1", ("crown_a", LEFT), ("a", "M 150,290 150,160")), ("tree 2", ("crown_b", RIGHT), ("b", "M 50,290 50,160"))
    left, right = read_strokes(svg(tmp_path, *groups), PHOTO)
    assert (left.crown_name, left.names, right.crown_name, right.names) == ("crown_a", ("a",), "crown_b", ("b",))


def test_a_tree_without_a_limb_is_refused(tmp_path):
    path = svg(tmp_path, ("crown", ("c1", LEFT), ("c2", RIGHT)), ("branches", "M 50,290 50,100"))
    assert refused(path) == "Stroke c2: no stroke runs along a limb of this tree. Draw one along its trunk, from its foot."


def test_a_page_of_the_same_shape_is_scaled_and_said(tmp_path):
    path = svg(tmp_path, ("crown", "M 20,10 80,10 80,75 20,75 Z"), ("branches", "M 50,145 50,50"), box="0 0 100 150")
    (tree,) = read_strokes(path, PHOTO)
    assert tree.branches[0].tolist() == [[100, 290], [100, 100]] and tree.crown.max(axis=0).tolist() == [160, 150]
    assert tree.warnings == ("s.svg is drawn on a page of 100 × 150; it was scaled to the photo's 200 × 300.",)


def test_a_page_that_begins_elsewhere_is_shifted(tmp_path):
    path = svg(tmp_path, ("crown", "M 50,40 170,40 170,170 50,170 Z"), ("branches", "M 110,310 110,120"), box="10 20 200 300")
    assert read_strokes(path, PHOTO)[0].branches[0].tolist() == [[100, 290], [100, 100]]


def test_a_page_of_another_shape_is_refused(tmp_path):
    path = svg(tmp_path, ("crown", CROWN), ("branches", TRUNK), box="0 0 300 300")
    assert refused(path) == "s.svg is drawn on a page of 300 × 300, but p.jpg has 200 × 300 pixels. Draw the strokes over this photo, with its size as the page's."


def json_file(tmp_path, *strokes):
    path = tmp_path / "s.json"
    path.write_text(json.dumps({"sketchtree": 1, "units": "px", "y": "down", "strokes": [{"id": i, "kind": k, "points": p} for i, k, p in strokes]}))
    return path


ROUND = ("c", "crown", [[40, 20], [160, 20], [160, 150], [40, 150]])


def test_what_leaves_the_photo_is_cut_off_and_said(tmp_path):
    path = json_file(tmp_path, ("c", "crown", [[-40, 20], [160, 20], [160, 150], [-40, 150]]), ("t", "branch", [[100, 340], [100, 100]]))
    (tree,) = read_strokes(path, PHOTO)
    assert tree.crown[:, 0].min() == 0 and tree.branches[0].tolist() == [[100, 300], [100, 100]]
    assert tree.warnings == ("Stroke c leaves the photo; what is outside was cut off.", "Stroke t leaves the photo; what is outside was cut off.")


def test_a_limb_outside_is_left_out_and_said(tmp_path):
    path = json_file(tmp_path, ROUND, ("t", "branch", [[100, 290], [100, 100]]), ("far", "branch", [[400, 290], [400, 100]]))
    (tree,) = read_strokes(path, PHOTO)
    assert tree.names == ("t",) and tree.warnings == ("Stroke far lies outside the photo; it was left out.",)


def test_a_crown_outside_and_limbs_that_are_all_outside_are_refused(tmp_path):
    away = ("c", "crown", [[440, 20], [560, 20], [560, 150], [440, 150]])
    assert refused(json_file(tmp_path, away, ("t", "branch", [[100, 290], [100, 100]]))) == (
        "Stroke c: it lies outside the photo. Draw the strokes over the photo, with its size as the page's."
    )
    assert refused(json_file(tmp_path, ROUND, ("t", "branch", [[400, 290], [400, 100]]))) == (
        "s.json has no stroke along a limb inside the photo. Draw one along the trunk, from its foot."
    )


@pytest.mark.parametrize(
    ("points", "says"),
    [
        ([[40, 20], [160, 20]], "Stroke c: it has 2 points, too few to surround a crown. Draw it round the tree's crown."),
        ([[40, 20], [160, 20], [100, 20]], "Stroke c: it surrounds no area. Draw it round the tree's crown."),
    ],
)
def test_a_crown_that_surrounds_nothing_is_refused(points, says, tmp_path):
    assert refused(json_file(tmp_path, ("c", "crown", points), ("t", "branch", [[100, 290], [100, 100]]))) == says


def test_a_file_without_a_crown_or_without_a_limb_is_refused(tmp_path):
    assert refused(svg(tmp_path, ("branches", TRUNK))) == (
        "s.svg has no stroke round a crown. Draw one round the tree's crown, in a layer named 'crown', or closed."
    )
    assert refused(svg(tmp_path, ("crown", CROWN))).startswith("s.svg has no branch strokes")
    assert refused(svg(tmp_path, ("all", CROWN))) == "s.svg has no stroke along a limb inside the photo. Draw one along the trunk, from its foot."


def test_a_stroke_of_more_points_than_a_hand_draws_is_refused_by_name(tmp_path):
    scribble = "M 0,0 " + " ".join(f"L {k % 199},{k * 7 % 293}" for k in range(20_001))
    assert "20,000 are the most" in refused(svg(tmp_path, ("crown", ("c", CROWN)), ("branches", ("b", TRUNK), ("scribble", scribble))))
