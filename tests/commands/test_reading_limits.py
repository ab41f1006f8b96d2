"""`--max-strokes --max-mb --max-megapixels`, and drawings by number: the same for every command that reads a drawing."""

from pathlib import Path

import h5py
import numpy as np
import pytest

from benchmarks import little_tree
from sketchtree.commands.app import run

LIMITS = {
    "--max-strokes 3": ("tree.json", "more than 3", "--max-strokes"),
    "--max-mb 0.001": ("tree.json", "the limit is 0.001 MB", "--max-mb"),
    "--max-megapixels 0.01": ("tree.png", "at most 0.01 megapixels are read", "--max-megapixels"),
}
READING = {"inspect": ["-o", "out.svg"], "infer": ["-o", "out.swc"], "build": ["-o", "out.glb"]}


@pytest.fixture
def drawings(tmp_path, monkeypatch) -> Path:
    for name, data in (little_tree.files() | {"tree.png": little_tree.picture()}).items():
        (tmp_path / name).write_bytes(data)
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.mark.parametrize("command", READING)
@pytest.mark.parametrize("limit", LIMITS)
def test_a_limit_refuses_with_2_and_names_the_option(command, limit, drawings, capfd):
    name, message, option = LIMITS[limit]
    assert run([command, name, *READING[command], *limit.split()]) == 2
    said = capfd.readouterr().err
    assert message in said and option in said and not list(drawings.glob("out.*"))


@pytest.mark.parametrize("command", READING)
@pytest.mark.parametrize(
    ("schema", "message"),
    [(9, "later.sketchtree has project schema 9; this version reads 1. Update sketchtree."), ("x", "later.sketchtree is damaged (invalid literal for int() with base 10: 'x')")],
)  # fmt: skip
def test_a_project_of_a_newer_version_is_refused_with_2(command, schema, message, drawings, capfd):
    with h5py.File(drawings / "later.sketchtree", "w") as file:
        file.attrs["format"], file.attrs["schema"] = "SketchTree project", schema
        file["sketch"] = np.frombuffer((drawings / "tree.json").read_bytes(), np.uint8)
    assert run([command, "later.sketchtree", *READING[command]]) == 2
    said = capfd.readouterr().err
    assert message in " ".join(said.split()) and "Traceback" not in said and not list(drawings.glob("out.*"))


def test_templates_are_matched_under_the_same_limits(drawings, capfd):
    assert run(["templates", "match", "tree.json", "--max-strokes", "3"]) == 2
    assert "--max-strokes" in capfd.readouterr().err
    assert run(["templates", "match", "tree.excalidraw", "--max-mb", "1"]) == 0


@pytest.mark.parametrize("name", [*little_tree.files(), "tree.png"])
def test_every_format_is_inspected(name, drawings):
    assert run(["inspect", name, "-o", "out.svg", "--quiet"]) == 0


def test_one_of_several_drawings_is_named_by_its_number(drawings, capfd):
    (drawings / "two.ndjson").write_bytes(little_tree.quickdraw() * 2)
    assert run(["inspect", "two.ndjson", "-o", "out.svg"]) == 2
    assert "holds 2 drawings, one a line; a sketch is one. Say which: two.ndjson#1 to two.ndjson#2." in capfd.readouterr().err
    assert run(["inspect", "two.ndjson#2", "-o", "out.svg", "--quiet"]) == 0


def test_a_mislabelled_drawing_is_read_and_remarked_on(drawings, capfd):
    (drawings / "wrong.svg").write_bytes(little_tree.inkml())
    assert run(["inspect", "wrong.svg", "-o", "out.svg"]) == 0
    assert "wrong.svg is named like an SVG drawing, but it holds a drawing in digital ink (InkML)" in capfd.readouterr().err
