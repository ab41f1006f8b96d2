"""Strokes on a photo under the page: what they mark, and which limbs are traced."""

import base64
import io
import sys

import numpy as np
import painted_photo as painted
import pytest
from PIL import Image

from sketchtree.errors import OptionError, SketchError
from sketchtree.photo.trace.trace import CIRCLE
from sketchtree.sketch.strokes import Stroke
from sketchtree.studio import wire
from sketchtree.studio.making import photo_answers
from sketchtree.studio.making.photo_asked import Asked
from sketchtree.studio.making.photo_bench import PhotoBench, photo_of
from sketchtree.studio.making.photo_marks import NO_CROWN, NO_LIMB, marks

CROWN, TRUNK, LEFT = painted.mark("crown", painted.CROWN, crown=True), painted.mark("trunk", painted.TRUNK), painted.mark("left", painted.LEFT)
UNIT = painted.AT[2] / painted.SIZE[0]  # page units a pixel


@pytest.fixture(scope="module")
def picture():
    return painted.photo()


@pytest.fixture
def bench(picture):
    one = PhotoBench()
    one.read(wire.digest(picture), picture)
    return one


def asked(picture, *strokes, seed=0):
    return Asked.of(painted.document(*strokes, picture=picture).replace(seed=seed), wire.digest(picture))


def traced(bench, picture, *strokes, revision=1):
    return photo_answers.traced(bench, revision, asked(picture, *strokes))


def test_strokes_mark_the_pixels_that_they_lie_on(picture):
    found = marks((CROWN, TRUNK, LEFT), asked(picture).place, photo_of(picture))
    (tree,) = found.trees
    assert tree.names == ("trunk", "left") and found.crowned and found.remark == ""
    np.testing.assert_allclose(tree.branches[0], painted.TRUNK, atol=1e-9)
    np.testing.assert_allclose(tree.branches[1], painted.LEFT, atol=1e-9)
    assert {tuple(point) for point in tree.crown.round(6)} == {tuple(map(float, point)) for point in painted.CROWN}


def test_a_picture_that_is_only_traced_over_asks_nothing(picture):
    assert Asked.of(painted.document(TRUNK, picture=picture, is_photo=False), "digest") is None


def test_strokes_of_turned_pages_and_obstacles_mark_nothing(picture):
    turned = Stroke("turned", TRUNK.points, view_deg=90.0)
    wall = Stroke("wall", CROWN.points, "obstacle", labelled=True, closed=True)
    assert [stroke.id for stroke in asked(picture, CROWN, TRUNK, turned, wall).strokes] == ["crown", "trunk"]


def test_what_is_missing_is_said_and_is_no_trouble(bench, picture):
    told, known, unknown = traced(bench, picture)
    assert (told.trees, told.remark, known, unknown) == ([], "", (), {})
    assert traced(bench, picture, CROWN)[0].remark == NO_LIMB
    told, known, unknown = traced(bench, picture, TRUNK)
    assert told.remark == NO_CROWN and all(told.trees[0].drawn) and not unknown
    other = painted.mark("second crown", [(560, 30), (590, 30), (590, 60)], crown=True)
    told, _, unknown = traced(bench, picture, CROWN, TRUNK, other)
    assert len(told.trees) == len(unknown) == 1 and told.remark == "One crown is left out: no stroke runs along a limb of this tree."


def test_a_bough_that_no_stroke_marks_is_found(bench, picture):
    told, known, unknown = traced(bench, picture, CROWN, TRUNK)
    (tree,) = told.trees
    assert told.remark == "" and known == () and len(unknown) == 1
    xy = np.array(tree.xy).reshape(-1, 2) * (1.0, -1.0)
    tip = painted.on_page([painted.RIGHT[-1]])[0]
    assert np.hypot(*(xy - tip).T).min() < 1.5 * CIRCLE * painted.SIZE[0] * UNIT and not all(tree.drawn)
    assert tree.parent[0] == -1 and all(up < row for row, up in enumerate(tree.parent)) and min(tree.width) > 0
    assert 0.5 * 24 * UNIT < tree.width[0] < 1.7 * 24 * UNIT


def test_a_stroke_less_is_as_if_it_had_never_been(bench, picture):
    before, *_ = traced(bench, picture, CROWN, TRUNK)
    more, *_ = traced(bench, picture, CROWN, TRUNK, LEFT)
    after, *_ = traced(bench, picture, CROWN, TRUNK)
    assert before == after != more


def test_foliage_is_found_once_a_crown_and_limbs_keep_apart_from_it(bench, picture):
    _, _, unknown = traced(bench, picture, CROWN, TRUNK)
    found, reasons = photo_answers.foliages(bench, unknown, 0)
    assert found.keys() == unknown.keys() and not reasons
    photo_answers.learnt(bench, found)
    told, known, rest = traced(bench, picture, CROWN, TRUNK, LEFT)
    assert known == tuple(found) and not rest and told.trees
    mask = np.asarray(Image.open(io.BytesIO(base64.b64decode(photo_answers.tinted(bench, 4, known).png))))
    assert mask.shape == (600, 600, 2) and 0.02 < (mask[..., 1] > 127).mean() < 0.5 and (mask[:50, :, 1] == 0).all()
    assert photo_answers.tinted(bench, 5, ()).png == ""


def test_a_crown_without_foliage_says_why(bench, picture):
    crown = painted.mark("sky", [(10, 10), (60, 10), (60, 60), (10, 60)], crown=True)
    found, reasons = photo_answers.foliages(bench, traced(bench, picture, crown, TRUNK)[2], 0)
    assert not found and list(reasons.values())[0].startswith("Stroke sky: there is no foliage inside it")


def test_traced_limbs_become_strokes_by_the_names_of_those_that_mark_them(bench, picture):
    made = photo_answers.limbs(bench, asked(picture, CROWN, TRUNK, LEFT))
    names = [stroke.id for stroke in made]
    assert names[:2] == ["trunk", "left"] or {"trunk", "left"} <= set(names)
    assert len(set(names)) == len(names) > 2 and all(stroke.wood and stroke.width > 0 for stroke in made)
    trunk = next(stroke for stroke in made if stroke.id == "trunk")
    assert np.hypot(*(trunk.points[0] - painted.on_page([painted.TRUNK[0]])[0])) < 10 * UNIT
    again = photo_answers.limbs(bench, asked(picture, CROWN, *made))
    assert len({stroke.id for stroke in again}) == len(again)


def test_what_is_not_installed_is_said(bench, picture, monkeypatch):
    monkeypatch.setitem(sys.modules, "sklearn", None)
    with pytest.raises(OptionError, match=r"^Tracing limbs in a photo needs the package `scikit-learn`. Install it with pip install 'sketchtree\[photo\]'.$"):
        photo_answers.limbs(bench, asked(picture, TRUNK))
    photo_answers.get_ready(leaves=True)


def test_what_is_no_photo_is_told_by_who_asks(picture):
    bench = PhotoBench()
    bench.read(wire.digest(picture), b"\x89PNG\r\n\x1a\n no picture")
    told, *_ = traced(bench, picture, TRUNK)
    assert told.trees == [] and told.remark.startswith("The picture ")
    with pytest.raises(SketchError, match="The picture "):
        photo_answers.limbs(bench, asked(picture, TRUNK))
