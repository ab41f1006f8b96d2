"""Scribbles over a photo are strokes like any other to files, and no part of the drawn tree."""

import numpy as np
import pytest

from sketchtree.drawing import front_graph
from sketchtree.editing.document import Document
from sketchtree.errors import SketchError
from sketchtree.sketch.files.svg_writer import sketch_svg
from sketchtree.sketch.files.sketch_json import sketch_json
from sketchtree.sketch.formats import read_sketch
from sketchtree.sketch.strokes import SCRIBBLES, Sketch, Stroke, StrokeKind

TRUNK = Stroke("trunk", np.array([(50.0, 0.0), (50.0, 40.0), (52.0, 90.0)]), width=4.0)
LIMB = Stroke("limb", np.array([(50.0, 45.0), (70.0, 60.0), (85.0, 80.0)]), width=2.0)


def scribbled() -> tuple[Stroke, ...]:
    return tuple(Stroke(f"s-{kind}", np.array([(10.0, 5.0), (14.0, 60.0), (20.0, 80.0)]), kind, labelled=True, width=6.0) for kind in sorted(SCRIBBLES))


@pytest.mark.parametrize("write, name", [(sketch_json, "kept.json"), (sketch_svg, "kept.svg")])
def test_a_file_gives_back_every_scribble(write, name, tmp_path):
    sketch = Sketch((TRUNK, *scribbled(), LIMB), page=(0.0, 0.0, 100.0, 100.0))
    (tmp_path / name).write_text(write(sketch))
    back = {stroke.id: stroke for stroke in read_sketch(tmp_path / name).strokes}
    assert set(back) == {stroke.id for stroke in sketch.strokes}
    for stroke in sketch.strokes:
        again = back[stroke.id]
        assert (again.kind, again.width, again.labelled, again.points.tolist()) == (stroke.kind, stroke.width, stroke.labelled, stroke.points.tolist())


def test_the_drawn_tree_is_the_same_with_scribbles_and_without():
    plain, more = front_graph(Sketch((TRUNK, LIMB)), "auto"), front_graph(Sketch((TRUNK, *scribbled(), LIMB)), "auto")
    assert plain.xy.tolist() == more.xy.tolist() and plain.parent.tolist() == more.parent.tolist()
    assert [plain.stroke_ids[k] for k in plain.stroke if k >= 0] == [more.stroke_ids[k] for k in more.stroke if k >= 0]
    assert plain.warnings == more.warnings


def test_scribbles_alone_draw_no_tree():
    with pytest.raises(SketchError, match="has no branch strokes: all it holds is scribbles over a photo"):
        front_graph(Sketch(scribbled()), "auto")


def test_a_file_of_scribbles_alone_can_be_read(tmp_path):
    (tmp_path / "kept.json").write_text(sketch_json(Sketch(scribbled())))
    assert [stroke.kind for stroke in read_sketch(tmp_path / "kept.json").strokes] == sorted(SCRIBBLES)


def test_what_a_drawn_tree_hangs_on_has_no_scribbles():
    document = Document({stroke.id: stroke for stroke in (TRUNK, *scribbled())})
    assert list(document.drawn.strokes) == ["trunk"]
    plain = Document({"trunk": TRUNK})
    assert plain.drawn.strokes is plain.strokes


def test_a_photo_takes_no_scribble_for_a_limb():
    from sketchtree.photo.photo import Photo
    from sketchtree.photo.read_strokes import marked_trees

    crown = Stroke("crown", np.array([(5.0, -60.0), (95.0, -60.0), (95.0, -2.0), (5.0, -2.0)]), StrokeKind.CROWN, labelled=True, closed=True)
    trunk = Stroke("trunk", np.array([(50.0, -95.0), (50.0, -20.0)]), labelled=True)
    over = tuple(Stroke(one.id, one.points * (1.0, -1.0), one.kind, labelled=True) for one in scribbled())
    photo = Photo(np.zeros((100, 100, 3), np.uint8))
    marked = marked_trees(Sketch((crown, trunk, *over)), photo)
    assert [one.names for one in marked] == [one.names for one in marked_trees(Sketch((crown, trunk)), photo)]
