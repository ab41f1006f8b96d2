"""What a person does to the contour's vertices (Algorithm 1)."""

import json
import re

import numpy as np
import pytest
from silhouettes import forked

from sketchtree.errors import OptionError
from sketchtree.trunk.edits import VertexEdits, edits_of, read_edits
from sketchtree.trunk.skeletonise import trunk_skeleton

LEFT_TIP = (18.0, 48.0)


def tips(edits: VertexEdits) -> np.ndarray:
    skeleton = trunk_skeleton(forked(), edits=edits)
    return skeleton.xy[skeleton.tips]


def test_removing_the_vertices_of_a_limbs_end_removes_the_limb():
    before = trunk_skeleton(forked())
    corners = before.vertices[0][np.hypot(*(before.vertices[0] - LEFT_TIP).T) < 8.0]
    after = tips(VertexEdits(remove=tuple(map(tuple, corners))))
    assert len(after) == 2 and after[:, 0].min() > 40.0


def test_merging_the_segments_on_either_side_of_a_limb_removes_the_limb():
    after = tips(VertexEdits(merge=(((44.0, 95.0), (44.0, 40.0)),)))
    assert len(after) == 2 and after[:, 0].min() > 40.0


def test_a_vertex_that_is_added_ends_a_branch():
    after = tips(VertexEdits(add=((56.0, 90.0),)))
    assert len(after) == 4 and np.hypot(*(after - [56.0, 90.0]).T).min() < 1.5


def test_edits_without_anything_change_nothing():
    assert trunk_skeleton(forked(), edits=VertexEdits()).xy.tobytes() == trunk_skeleton(forked()).xy.tobytes()


def test_a_file_of_edits_says_all_four(tmp_path):
    path = tmp_path / "edits.json"
    path.write_text(json.dumps({"vertices": 12, "remove": [[1, 2]], "add": [[3, 4.5]], "merge": [[[5, 6], [7, 8]]]}))
    assert read_edits(path) == VertexEdits(12, ((1.0, 2.0),), ((3.0, 4.5),), (((5.0, 6.0), (7.0, 8.0)),))


def test_vertices_in_the_file_are_m():
    assert trunk_skeleton(forked(), edits=VertexEdits(vertices=14)).vertex_count == 14
    assert trunk_skeleton(forked(), vertices=16, edits=VertexEdits(vertices=14)).vertex_count == 16


@pytest.mark.parametrize(
    ("edits", "message"),
    [
        (VertexEdits(remove=((90.0, 110.0),)), "`remove` (90, 110): no vertex is there; the nearest is"),
        (VertexEdits(add=((90.0, 110.0),)), "`add` (90, 110): the contour is not there; it is nearest at (56, "),
        (VertexEdits(merge=(((44.0, 100.0), (2.0, 110.0)),)), "`merge` (2, 110): the contour is not there; it is nearest at"),
        (VertexEdits(merge=(((44.0, 100.0), (44.0, 98.0)),)), "`merge` (44, 100), (44, 98): both lie on one segment already."),
    ],
)
def test_what_does_not_exist_is_named(edits, message):
    with pytest.raises(OptionError, match=re.escape(message)):
        trunk_skeleton(forked(), edits=edits)


def test_where_edits_are_not_exact_what_does_not_exist_is_passed_over_and_told():
    beside = ((90.0, 110.0),)
    plain = trunk_skeleton(forked(), edits=VertexEdits(add=((56.0, 90.0),)))
    found = trunk_skeleton(forked(), edits=VertexEdits(remove=beside, add=((56.0, 90.0), *beside), exact=False))
    assert found.xy.tobytes() == plain.xy.tobytes()
    one, other = found.warnings[-2:]
    assert one.startswith("`remove` (90, 110): no vertex is there; ") and other.startswith("`add` (90, 110): the contour is not there; ")
    assert one.endswith(" pixels away. It was passed over.")


def test_a_root_beside_the_trunk_is_an_error_unless_edits_are_not_exact():
    with pytest.raises(OptionError, match=re.escape("The root (90, 5) lies ")):
        trunk_skeleton(forked(), root=(90.0, 5.0))
    found, plain = (trunk_skeleton(forked(), root=root, edits=VertexEdits(exact=False)) for root in ((90.0, 5.0), None))
    assert found.xy.tobytes() == plain.xy.tobytes() and found.warnings[-1].endswith(" pixels beside the trunk. The middle of its foot was taken instead.")


def test_a_polygon_keeps_three_vertices():
    skeleton = trunk_skeleton(forked(), vertices=4)
    with pytest.raises(OptionError, match=re.escape("it would leave 2 vertices; a polygon has at least 3. Keep more vertices, or ask for more.")):
        trunk_skeleton(forked(), vertices=4, edits=VertexEdits(remove=tuple(map(tuple, skeleton.vertices[0][:2]))))


@pytest.mark.parametrize(
    ("said", "message"),
    [
        ([1], "The edits: no JSON object."),
        ({"vertices": "12"}, "The edits: `vertices` is '12', not a whole number."),
        ({"removed": []}, "The edits: the key `removed` is none of vertices, remove, add, merge."),
        ({"remove": 3}, "The edits: `remove` is no list."),
        ({"add": [[1, 2, 3]]}, "The edits: [1, 2, 3] in `add` is no point [x, y]."),
        ({"add": [[1, float("nan")]]}, "The edits: [1, nan] in `add` is no point [x, y]."),
        ({"merge": [[[1, 2]]]}, "The edits: [[1, 2]] in `merge` is no pair of points."),
    ],
)
def test_a_file_that_says_something_else_is_refused(said, message):
    with pytest.raises(OptionError, match=re.escape(message)):
        edits_of(said)


def test_a_file_that_is_no_json_is_refused(tmp_path):
    path = tmp_path / "edits.json"
    path.write_text("{")
    with pytest.raises(OptionError, match=re.escape("edits.json is not JSON")):
        read_edits(path)
    with pytest.raises(OptionError, match=re.escape("gone.json can't be read.")):
        read_edits(tmp_path / "gone.json")
