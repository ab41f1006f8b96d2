"""The options of what becomes of a grown tree, as a designer meets them."""

import json
from pathlib import Path

import pytest

from sketchtree.commands.app import run

ROOT = Path(__file__).resolve().parents[2]
APPLE = str(ROOT / "examples" / "apple.json")
FIX = "Write a plane like `y<4.5`, `x>-1` or `1,1,0<3` (metres), a mesh file's name, or `outside:` and a mesh file's name."
BAD = {
    "--generations 50.5": "`--generations 50.5` is out of range. Give 0 to 50.",
    "--generations -1": "`--generations -1` is out of range. Give 0 to 50.",
    "--generations nan": "`--generations nan` is out of range. Give 0 to 50.",
    "--sag 6": "`--sag 6` is out of range. Give 0 to 5.",
    "--shed 1.5": "`--shed 1.5` is out of range. Give 0 to 1.",
    "--shed-twigs -2": "`--shed-twigs -2` is out of range. Give 0 to 20.",
    "--prune y<": f"`--prune y<` is no plane. {FIX}",
    "--prune nowhere.stl": f"`--prune nowhere.stl`: there is no mesh file nowhere.stl. {FIX}",
    "--prune outside:": f"`--prune outside:` names nothing to prune by. {FIX}",
    "--prune y<-1": "Pruning cuts the tree off at its foot, so nothing is left. Turn the plane's `<` round, or let the mesh reach down "
    "to the ground (the trunk's root is at the origin).",
}


def build(tmp_path, *options, name="t.swc"):
    return run(["build", APPLE, "-o", str(tmp_path / name), "--method", "okabe", "--quiet", *options])


@pytest.mark.parametrize("options", BAD)
def test_a_bad_value_gets_one_paragraph_and_status_2_and_no_file(options, tmp_path, capfd):
    assert build(tmp_path, "--generations", "1", *options.split(" ")) == 2
    said = capfd.readouterr()
    assert said.err == f"sketchtree: {BAD[options]}\n" and said.out == ""
    assert not list(tmp_path.iterdir())


def test_all_options_at_once_are_recorded_in_the_report(tmp_path):
    report = tmp_path / "r.json"
    options = ["--generations", "2.5", "--sag", "1", "--shed", ".3", "--shed-twigs", "1", "--no-untangle", "--prune", "y<3.5", "--prune", "x>-2"]
    assert build(tmp_path, *options, "--report", str(report)) == 0
    record = json.loads(report.read_text())
    wanted = {"generations": 2.5, "sag": 1.0, "shed": 0.3, "shed_twigs": 1.0, "untangle": False, "prune": ["y<3.5", "x>-2"]}
    assert {name: record["options"][name] for name in wanted} == wanted
    assert record["height"] <= 3.5 + 1e-6


def test_fifty_generations_are_bounded_by_max_segments_with_a_clear_message(tmp_path):
    report = tmp_path / "r.json"
    assert build(tmp_path, "--generations", "50", "--max-segments", "600", "--report", str(report)) == 0
    record = json.loads(report.read_text())
    assert record["segments"]["total"] <= 600
    assert any("Raise --max-segments, or ask for fewer generations." in warning for warning in record["warnings"])


def test_a_whole_level_is_the_same_file_as_the_integer(tmp_path):
    assert build(tmp_path, "--generations", "2", name="a.swc") == build(tmp_path, "--generations", "2.0", name="b.swc") == 0
    assert (tmp_path / "a.swc").read_bytes() == (tmp_path / "b.swc").read_bytes()
