"""A project file may come from anywhere: what it only says that it holds is not believed, and whatever is wrong with it is said."""

import io
import json

import h5py
import numpy as np
import pytest

from sketchtree.errors import SketchError
from sketchtree.studio.making.documents import document_of

SKETCH = {"sketchtree": 1, "units": "px", "y": "up", "strokes": [{"id": "trunk", "kind": "branch", "points": [[0, 0], [0, 50], [1, 100]]}]}


def project(change=lambda file: None, *, without: tuple[str, ...] = ()) -> bytes:
    """A project of one stroke, with something done to it."""
    whole = io.BytesIO()
    with h5py.File(whole, "w") as file:
        file.attrs["format"], file.attrs["schema"], file.attrs["seed"] = "SketchTree project", 1, 0
        for name, said in (("sketch", SKETCH), ("edits", []), ("settled", {}), ("options", {})):
            if name not in without:
                file[name] = np.frombuffer(json.dumps(said).encode(), np.uint8)
        change(file)
    return whole.getvalue()


def bomb(name: str):
    """A column of 4 TB that takes a few bytes on the disk."""
    return lambda file: file.create_dataset(name, (4_000_000_000_000,), np.uint8, chunks=(1_000_000,), compression="gzip")


def test_a_plain_project_is_read():
    assert list(document_of(project(), "oak.sketchtree").strokes) == ["trunk"]


@pytest.mark.parametrize("name", ["sketch", "edits", "settled", "options", "underlay"])
def test_a_column_that_says_it_is_larger_than_the_machine_is_refused(name):
    data = project(bomb(name), without=(name,))
    assert len(data) < 100_000
    with pytest.raises(SketchError):
        document_of(data, "oak.sketchtree")


def test_which_column_is_too_large_is_said():
    with pytest.raises(SketchError, match=r"^oak\.sketchtree is damaged \(`underlay` says that it holds 4e\+06 MB; 100 MB is the most\)\. Open an older copy of it\.$"):
        document_of(project(bomb("underlay")), "oak.sketchtree")


def test_a_project_of_a_newer_version_says_what_to_do():
    with pytest.raises(SketchError, match=r"^oak\.sketchtree has project schema 9; this version reads 1\. Update sketchtree\.$"):
        document_of(project(lambda file: file.attrs.__setitem__("schema", 9)), "oak.sketchtree")


@pytest.mark.parametrize("left", [9, 100, 500, 1000, 2000])
def test_a_file_that_was_cut_off_is_damaged(left):
    with pytest.raises(SketchError):
        document_of(project()[:left], "oak.sketchtree")


@pytest.mark.parametrize(
    "change",
    [lambda file: file.create_group("underlay"), lambda file: file.create_dataset("underlay", data=1.5), lambda file: file.attrs.__setitem__("seed", "no number"),
     lambda file: file.attrs.__setitem__("schema", "no number"), lambda file: file.create_dataset("underlay", data=np.arange(5))],
)  # fmt: skip
def test_what_makes_no_sense_in_it_is_damage(change):
    with pytest.raises(SketchError, match=r"^oak\.sketchtree is damaged "):
        document_of(project(change), "oak.sketchtree")


def test_options_that_make_no_sense_are_as_by_default():
    def change(file):
        del file["options"]
        file["options"] = np.frombuffer(b'{"generations": "many", "template": 7}', np.uint8)

    assert document_of(project(change), "oak.sketchtree").tree.generations is None
