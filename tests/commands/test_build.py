"""The program as a designer meets it: one command, a file, and one paragraph when something is wrong."""

import json
import subprocess
import sys
from pathlib import Path

import jsonschema
import numpy as np
import pytest

from sketchtree.commands.app import run
from sketchtree.export.gltf import read_glb_skeleton
from sketchtree.skeleton_files import read_swc
from sketchtree.report import report_schema

ROOT = Path(__file__).resolve().parents[2]
OAK = ROOT / "examples" / "oak.svg"


@pytest.fixture(scope="module")
def oak(tmp_path_factory):
    """One build of the oak, with everything it can write."""
    folder = tmp_path_factory.mktemp("oak")
    status = run(
        ["build", str(OAK), "-o", str(folder / "oak.glb"), "--report", str(folder / "oak.json"), "--skeleton", str(folder / "oak.swc"), "--quiet"]
    )
    assert status == 0
    return folder


def test_the_report_satisfies_its_schema(oak):
    report = json.loads((oak / "oak.json").read_text())
    jsonschema.validate(report, report_schema())
    assert report["segments"]["total"] > report["segments"]["drawn"] > 10
    assert report["leaves"] > 1000
    assert report["triangles"]["wood"] > 0 and report["triangles"]["leaf"] > 0
    assert report["template_used"] == report["template"][0]["name"]
    assert set(report["seconds"]) >= {"read", "match", "infer", "propagate", "foliage", "mesh", "export", "total"}
    assert report["options"]["method"] == "elevation" and report["seed"] == 0


def test_the_glb_holds_wood_leaves_and_its_own_skeleton(oak):
    import trimesh

    scene = trimesh.load(oak / "oak.glb")
    names = set(scene.geometry)
    assert any(name.startswith("wood") for name in names) and any(name.startswith("leaf") for name in names)
    wood = next(mesh for name, mesh in scene.geometry.items() if name.startswith("wood"))
    assert wood.visual.material.baseColorTexture is not None
    report = json.loads((oak / "oak.json").read_text())
    assert read_glb_skeleton(oak / "oak.glb").segment_count == report["segments"]["total"]


def test_the_tree_stands_at_the_origin_with_the_height_reported(oak):
    tree = read_glb_skeleton(oak / "oak.glb")
    report = json.loads((oak / "oak.json").read_text())
    np.testing.assert_allclose(tree.tip[tree.is_base][0], 0, atol=1e-6)
    assert tree.height == pytest.approx(report["height"], rel=1e-4)


def test_the_skeleton_file_reads_back(oak):
    assert len(read_swc(oak / "oak.swc")) > 1000


def test_the_same_seed_gives_the_same_bytes(tmp_path):
    def build(name, seed):
        arguments = ["build", str(ROOT / "examples" / "apple.json"), "-o", str(tmp_path / name), "--seed", seed, "--generations", "2", "--quiet"]
        assert run(arguments) == 0
        return (tmp_path / name).read_bytes()

    one, same, other = (build(name, seed) for name, seed in (("a.glb", "3"), ("b.glb", "3"), ("c.glb", "4")))
    assert one == same != other


@pytest.mark.parametrize("name", ["tree.obj", "tree.ply", "tree.stl", "tree.swc", "tree.json"])
def test_the_extension_decides_what_is_written(tmp_path, name):
    assert run(["build", str(OAK), "-o", str(tmp_path / name), "--generations", "0", "--leaf", "none", "--quiet"]) == 0
    assert (tmp_path / name).stat().st_size > 1000


def test_zero_generations_leave_only_what_was_drawn(tmp_path):
    report = tmp_path / "r.json"
    assert run(["build", str(OAK), "-o", str(tmp_path / "t.swc"), "--generations", "0", "--report", str(report), "--quiet"]) == 0
    segments = json.loads(report.read_text())["segments"]
    assert segments["total"] == segments["drawn"]


def test_height_template_leaf_and_bark_can_be_chosen(tmp_path):
    report = tmp_path / "r.json"
    arguments = ["build", str(OAK), "-o", str(tmp_path / "t.glb"), "--generations", "1", "--height", "4", "--template", "silver_birch"]
    assert run([*arguments, "--leaf", "maple", "--bark", "pine", "--season", "autumn", "--report", str(report), "--quiet"]) == 0
    record = json.loads(report.read_text())
    assert record["template_used"] == "silver_birch"
    assert record["template"][0]["name"] != "" and len(record["template"]) >= 8
    assert record["options"]["leaf"] == "maple" and record["options"]["bark"] == "pine"
    assert 3.0 < record["height"] < 5.0


def write(path: Path, text: str | bytes) -> Path:
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    return path


SVG = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 100">{}</svg>'
TRUNK = '<path d="M50 100 L50 10" stroke="black" fill="none"/>'
BAD = {
    "empty": ("empty.svg", "", []),
    "not an SVG": ("text.svg", "this is no drawing", []),
    "no strokes": ("none.svg", SVG.format(""), []),
    "only a crown": ("crown.svg", SVG.format('<path id="crown" d="M10 50 C10 10 90 10 90 50 Z" stroke="black" fill="none"/>'), []),
    "NaN": ("nan.json", '{"sketchtree": 1, "units": "px", "y": "down", "strokes": [{"id": "a", "kind": "branch", "points": [[0, 0], [NaN, 1]]}]}', []),
    "a dot": ("dot.svg", SVG.format('<path d="M50 50 L50 50" stroke="black"/>'), []),
    "zero viewBox": ("zero.svg", '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 0 0">' + TRUNK + "</svg>", []),
    "too many strokes": ("many.svg", SVG.format(TRUNK * 5), ["--max-strokes", "4"]),
    "unknown template": ("t.svg", SVG.format(TRUNK), ["--template", "nonesuch"]),
    "unknown leaf": ("t.svg", SVG.format(TRUNK), ["--leaf", "nonesuch"]),
    "unknown bark": ("t.svg", SVG.format(TRUNK), ["--bark", "nonesuch"]),
    "negative height": ("t.svg", SVG.format(TRUNK), ["--height", "-3"]),
    "two that exclude each other": ("t.svg", SVG.format(TRUNK), ["--lod", "2", "--levels", "apart"]),
    "no such file": (None, None, []),
}


@pytest.mark.parametrize("case", BAD)
def test_bad_input_gets_one_paragraph_and_status_2_and_no_file(case, tmp_path, capfd):
    name, text, extra = BAD[case]
    sketch = tmp_path / "missing.svg" if name is None else write(tmp_path / name, text)
    before = set(tmp_path.iterdir())
    status = run(["build", str(sketch), "-o", str(tmp_path / "tree.glb"), "--report", str(tmp_path / "r.json"), "--quiet", *extra])
    said = capfd.readouterr()
    assert status == 2
    assert set(tmp_path.iterdir()) == before
    assert said.out == ""
    assert said.err.startswith("sketchtree: ") and said.err.count("\n") == 1 and "Traceback" not in said.err
    assert said.err.count(". ") >= 1 and said.err.endswith(".\n")  # what is wrong, then what to do


@pytest.mark.parametrize(
    ("output", "message"),
    [
        ("no/such/folder/tree.glb", "does not exist"),
        ("tree.fbx", "`.fbx` files are not written"),
        ("tree.xyz", "`.xyz` files are not written"),
        ("tree", "no extension to tell the format"),
        ("", "it is a folder"),
    ],
)
def test_an_unwritable_output_is_refused_before_the_work(output, message, tmp_path, capfd):
    target = tmp_path / (output or "folder.glb")
    if not output:
        target.mkdir()
    assert run(["build", str(OAK), "-o", str(target), "--quiet"]) == 2
    assert message in capfd.readouterr().err


def test_the_sketch_itself_is_never_overwritten(tmp_path, capfd):
    sketch = write(tmp_path / "t.json", "{}")
    assert run(["build", str(sketch), "-o", str(sketch)]) == 2
    assert "would overwrite the sketch itself" in capfd.readouterr().err


def test_the_installed_program_answers_version_and_help():
    for argument in ("--version", "--help"):
        done = subprocess.run([sys.executable, "-m", "sketchtree", argument], capture_output=True, text=True)
        assert done.returncode == 0 and "sketchtree" in done.stdout.lower()
