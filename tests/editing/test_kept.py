"""What was done by hand is written down and read back."""

import json

import numpy as np
import pytest
from drawn_by_hand import document, limb, made

from sketchtree import pipeline
from sketchtree.editing import kept, operations
from sketchtree.editing.edits import Adopted
from sketchtree.errors import SketchError
from sketchtree.export.skeletons.hdf5 import write_project
from sketchtree.keys import root_key
from sketchtree.options import ReadingOptions, TreeOptions


@pytest.fixture(scope="module")
def edited():
    """The little drawing with a held limb, an adopted one and a room kept clear."""
    after = made(document())[1]
    after = operations.hold(after, limb("left"), 1.0, 9.0)
    adopted = Adopted(77, limb("right"), 0.5, np.array([[0.0, 0, 0], [3, 4, 5]]), 0.4, was=5)
    return operations.adopt(operations.clear(after, Adopted(9, limb("high"), 0.5, adopted.path, 0.4)), adopted)


def test_edits_read_back_to_the_last_bit(edited):
    rows = kept.edits_as_json(edited.edits)
    again = kept.edits_from_json(json.loads(json.dumps(rows)))
    assert kept.edits_as_json(again) == rows and again.adopted[77].was == 5


def test_what_is_settled_reads_back_to_the_last_bit(edited):
    row = kept.settled_as_json(edited.settled)
    assert kept.settled_as_json(kept.settled_from_json(json.loads(json.dumps(row)))) == row


@pytest.mark.parametrize("rows", [{}, [1], [{"op": "hold", "limb": "x"}], [{"op": "burn", "limb": "1"}], [{"op": "hold", "limb": "1", "share": [0, 1], "depth": [0]}],
                                  [{"op": "clear", "limb": "1", "path": [[0, 0]], "radius": 1}]])  # fmt: skip
def test_what_is_no_list_of_edits_is_refused(rows):
    with pytest.raises(ValueError, match="."):
        kept.reading(kept.edits_from_json, rows)


def test_a_project_brings_back_the_same_tree(edited, tmp_path):
    options = ReadingOptions(template="none")
    key = root_key(edited.seed)
    drawn, settled = made(edited)
    model = pipeline.complete(drawn, key=key, options=TreeOptions(generations=1, leaf="none"))
    write_project(tmp_path / "tree.sketchtree", model, seed=0, options={})
    again = pipeline.sketch_to_tree(tmp_path / "tree.sketchtree", key=key, reading=options, tree=TreeOptions(generations=1, leaf="none"))
    assert again.drawn.touched == frozenset()
    np.testing.assert_array_equal(again.skeleton.tip, model.skeleton.tip)
    np.testing.assert_array_equal(again.meshes[0].position, model.meshes[0].position)


def test_edits_outlive_seed_and_generations_on_the_command_line(edited, tmp_path):
    drawn, _ = made(edited)
    model = pipeline.complete(drawn, key=root_key(0), options=TreeOptions(generations=0, leaf="none"))
    write_project(tmp_path / "tree.sketchtree", model, seed=0, options={})
    again = pipeline.sketch_to_tree(
        tmp_path / "tree.sketchtree", key=root_key(5), reading=ReadingOptions(template="none"), tree=TreeOptions(generations=2, leaf="none")
    )
    np.testing.assert_array_equal(again.drawn.skeleton.tip, drawn.skeleton.tip)


def test_a_project_whose_edits_are_damaged_is_named(edited, tmp_path):
    import h5py

    drawn, _ = made(edited)
    path = tmp_path / "bad.sketchtree"
    write_project(path, pipeline.complete(drawn, key=root_key(0), options=TreeOptions(generations=0, leaf="none")), seed=0, options={})
    with h5py.File(path, "r+") as file:
        del file["edits"]
        file["edits"] = np.frombuffer(b"[{]", np.uint8)
    with pytest.raises(SketchError, match="^What was done by hand in bad.sketchtree can't be read .* Open an older copy, or save its drawing as JSON and begin from that.$"):
        pipeline.draw_out(path, key=root_key(0), options=ReadingOptions(template="none"))
