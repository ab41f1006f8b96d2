"""One drawing over a photo may hold all that a brush says: what is tree, what is not, what is painted into the matte and out of it."""

import numpy as np
import pytest

from sketchtree.matting.scribbles import read_scribbles
from sketchtree.photo.photo import Photo
from sketchtree.sketch.files.sketch_json import sketch_json
from sketchtree.sketch.files.svg_writer import sketch_svg
from sketchtree.sketch.strokes import Sketch, Stroke, StrokeKind
from sketchtree.trunk.edit_matte import edit_matte

PHOTO = Photo(np.zeros((60, 40, 3), np.uint8))


def line(kind: StrokeKind, x: float, width: float) -> Stroke:
    return Stroke(f"s-{x:g}", np.array([(x, -10.0), (x, -30.0), (x, -50.0)]), kind, labelled=True, width=width)


DRAWN = Sketch(
    (line(StrokeKind.FOREGROUND, 20.0, 4.0), line(StrokeKind.BACKGROUND, 5.0, 4.0), line(StrokeKind.MATTE_ADD, 26.0, 8.0), line(StrokeKind.MATTE_ERASE, 14.0, 8.0)),
    page=(0.0, -60.0, 40.0, 0.0),
)


@pytest.fixture(params=[(sketch_json, "drawn.json"), (sketch_svg, "drawn.svg")], ids=["json", "svg"])
def drawing(request, tmp_path):
    write, name = request.param
    (tmp_path / name).write_text(write(DRAWN))
    return tmp_path / name


def test_scribbles_are_those_of_their_kinds_in_pixels(drawing):
    found = read_scribbles(drawing, PHOTO)
    assert [[float(one[0, 0]) for one in side] for side in (found.foreground, found.background)] == [[20.0], [5.0]]
    assert found.foreground[0][:, 1].tolist() == [10.0, 30.0, 50.0]
    assert (found.brush, found.warnings) == (4.0, ())


def test_the_matte_is_edited_by_the_other_two(drawing):
    edited = edit_matte(np.full((60, 40), 0.5, np.float32), drawing)
    assert edited[30, 26] == 1.0 and edited[30, 13] == 0.0
    assert edited[30, 20] == edited[30, 5] == 0.5
