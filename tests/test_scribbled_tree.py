"""A tree that comes of scribbles a drawing keeps: the very tree that `sketchtree grow` makes of the picture and a file of the same scribbles."""

import dataclasses

import numpy as np
import pytest

from sketchtree.editing.document import Document, Underlay
from sketchtree.errors import SketchError
from sketchtree.growth_tree import GrowthOptions, TrunkOptions, find_trunk
from sketchtree.keys import root_key
from sketchtree.matting.scribbles import Scribbles
from sketchtree.options import ReadingOptions
from sketchtree.photo.read_photo import photo_in
from sketchtree.scribbled_tree import Scribbled, growth_of, matte_of, on_photo, read_scribbled, repainted, trunk_of
from sketchtree.sketch.strokes import Stroke, StrokeKind
from sketchtree.studio.making.jobs import Jobs
from sketchtree.trunk.wanted import TrunkChoices
from tests.trunk.painted_tree import painted_tree

ON, BESIDE = [(40.0, 92.0), (40.0, 20.0)], [(5.0, 60.0), (5.0, 95.0), (30.0, 96.0)]
READING = ReadingOptions(template="none", height=8.0)
KEY = root_key(5)

PICTURE = painted_tree()
PHOTO = photo_in(PICTURE, "bare.png")


def brush(kind: StrokeKind, line, width: float = 3.0) -> Stroke:
    return Stroke(kind.value, np.array(line) * [1.0, -1.0], kind, labelled=True, width=width)


SAID = (brush(StrokeKind.FOREGROUND, ON), brush(StrokeKind.BACKGROUND, BESIDE, 4.0))
CHOICES = TrunkChoices(on=True, levels=1)


@pytest.fixture(scope="module")
def matte():
    return matte_of(Scribbled(PHOTO, SAID, CHOICES), key=KEY)


def trunk(matte, *more: Stroke, **choices):
    return trunk_of(Scribbled(PHOTO, (*SAID, *more), dataclasses.replace(CHOICES, **choices)), None, key=KEY, reading=READING, matte=matte)


def test_strokes_and_a_file_of_scribbles_are_one_tree(matte):
    scribbles = Scribbles((np.array(ON),), (np.array(BESIDE),), brushes=((3.0,), (4.0,)))
    other = find_trunk(PHOTO, scribbles, None, key=KEY, reading=READING, wanted=TrunkOptions(gap=CHOICES.gap))
    mine = trunk(matte)
    assert (mine.matte.alpha == other.matte.alpha).all() and (mine.tree.tip == other.tree.tip).all() and (mine.tree.radius == other.tree.radius).all()


def test_what_is_erased_from_the_matte_is_no_branch(matte):
    erased = trunk(matte, brush(StrokeKind.MATTE_ERASE, [(34, 56), (10, 26)], 14.0))
    assert trunk(matte).skeleton.xy[:, 0].min() < 25 < 30 < erased.skeleton.xy[:, 0].min()


def test_what_is_painted_into_the_matte_is_a_branch(matte):
    added, plain = (found.skeleton.xy[found.skeleton.xy[:, 1] > 55] for found in (trunk(matte, brush(StrokeKind.MATTE_ADD, [(40, 75), (74, 62)], 5.0)), trunk(matte)))
    assert plain[:, 0].max() < 45 < 68 < added[:, 0].max()


def test_the_matte_is_found_by_the_scribbles_alone(matte):
    wanted = Scribbled(PHOTO, (*SAID, brush(StrokeKind.MATTE_ADD, [(60, 80), (70, 80)])), CHOICES)
    assert repainted(matte, wanted).alpha[80, 65] == 1.0 > matte.alpha[80, 65] and (repainted(matte, Scribbled(PHOTO, SAID)).alpha == matte.alpha).all()


def test_a_contour_can_be_edited(matte):
    plain = trunk(matte)
    tip = plain.skeleton.xy[plain.skeleton.xy[:, 0].argmin()]
    corner = plain.skeleton.vertices[0][np.hypot(*(plain.skeleton.vertices[0] - tip).T).argmin()]
    edited = trunk(matte, remove=(tuple(corner),))
    assert len(edited.skeleton.vertices[0]) == len(plain.skeleton.vertices[0]) - 1


def test_an_edit_that_finds_no_vertex_any_more_is_told_and_the_tree_is_there(matte):
    found = trunk(matte, remove=((79.0, 2.0),))
    assert (found.skeleton.xy == trunk(matte).skeleton.xy).all()
    assert [one for one in found.warnings if one.startswith("`remove` (79, 2): no vertex is there; ") and one.endswith(" It was passed over.")]


def test_the_trunk_stands_where_it_is_put_and_has_its_depths_by_our_inference(matte):
    low, placed, lifted = (trunk(matte, **choices) for choices in ({}, {"root": (40.0, 60.0)}, {"lift": "elevation"}))
    assert np.hypot(*(placed.skeleton.xy[0] - (40, 60))) < 3 < np.hypot(*(low.skeleton.xy[0] - (40, 60)))
    assert (lifted.skeleton.xy == low.skeleton.xy).all() and not np.array_equal(lifted.tree.tip, low.tree.tip)


def test_the_matte_is_found_as_it_is_chosen():
    chosen = dataclasses.replace(CHOICES, matting="closed-form")
    assert matte_of(Scribbled(PHOTO, SAID, chosen), key=KEY).method == "closed-form"


def test_a_photo_without_a_scribble_tells_no_tree():
    with pytest.raises(SketchError, match="needs scribbles that say what is tree"):
        matte_of(Scribbled(PHOTO, ()), key=KEY)


def test_as_many_levels_as_the_drawing_says_unless_others_are_asked_for():
    wanted = Scribbled(PHOTO, SAID, CHOICES)
    assert growth_of(wanted).levels == 1 and growth_of(wanted, GrowthOptions(levels=0)).levels == 0


def test_a_project_holds_the_same_wherever_its_photo_lies_on_the_page(tmp_path):
    page = tuple(dataclasses.replace(stroke, points=stroke.points * 0.5 + (100.0, 50.0), width=stroke.width * 0.5) for stroke in SAID)
    document = Document({stroke.id: stroke for stroke in page}, trunk=CHOICES, underlay=Underlay(PICTURE, 100.0, 50.0, 40.0, 50.0, photo=True))
    path = tmp_path / "bare.sketchtree"
    path.write_bytes(Jobs(None, None)._project(0, None, document))
    found = read_scribbled(path)
    assert found.choices == CHOICES and (found.photo.rgb == PHOTO.rgb).all()
    assert [(one.kind, one.width, one.points.tolist()) for one in found.strokes] == [(one.kind, one.width, one.points.tolist()) for one in SAID]
    path.write_bytes(Jobs(None, None)._project(0, None, document.replace(trunk=TrunkChoices())))
    assert read_scribbled(path) is None  # the photo's tree is taken otherwise


def test_scribbles_of_turned_pages_and_other_strokes_are_left_out():
    turned = dataclasses.replace(SAID[0], view_deg=90.0)
    assert on_photo((turned, Stroke("limb", np.zeros((2, 2))), SAID[1]), (0.0, 0.0), (1.0, 1.0))[0].kind == StrokeKind.BACKGROUND
