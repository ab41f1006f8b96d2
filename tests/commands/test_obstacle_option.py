"""`sketchtree build --obstacle MESH`, and obstacles drawn in the sketch."""

import json
from pathlib import Path

import numpy as np
import pytest
import trimesh
from tests.propagate.space.solids import ball, box, meets

from sketchtree.commands.app import run
from sketchtree.export.gltf import read_glb_skeleton
from sketchtree.skeleton import Kind

ROOT = Path(__file__).resolve().parents[2]
POPLAR = ROOT / "examples" / "poplar.svg"
FEW = ["--generations", "2", "--leaf", "none", "--quiet"]


def build(folder, *extra, sketch=POPLAR, name="tree.glb"):
    """(status, skeleton, report) of one build."""
    report = folder / "report.json"
    status = run(["build", str(sketch), "-o", str(folder / name), "--report", str(report), *FEW, *extra])
    return status, read_glb_skeleton(folder / name), json.loads(report.read_text())


def new(tree):
    rows = (tree.kind == Kind.PROPAGATED) & ~tree.is_base
    return tree.start[rows], tree.tip[rows]


@pytest.fixture(scope="module")
def free(tmp_path_factory):
    return build(tmp_path_factory.mktemp("free"))


def test_nothing_new_meets_the_meshes_given(free, tmp_path):
    tree = free[1]
    one, two = ball(tree.tip[tree.order == 1].mean(axis=0) + [0.6, 0, 0], 0.5), box((-4, 3, 0.4), (4, 5, 3))
    one.export(tmp_path / "ball.ply"), two.export(tmp_path / "box.stl")
    names = [str(tmp_path / "ball.ply"), str(tmp_path / "box.stl")]
    status, grown, report = build(tmp_path, "--obstacle", names[0], "--obstacle", names[1])
    assert status == 0 and report["options"]["obstacle"] == names
    assert sum(meets(*new(tree), mesh).sum() for mesh in (one, two)) > 3
    assert not any(meets(*new(grown), mesh).any() for mesh in (one, two))


def test_an_obstacle_far_away_changes_no_branch_and_is_told(free, tmp_path):
    ball((500, 0, 0), 2.0).export(tmp_path / "far.obj")
    status, grown, report = build(tmp_path, "--obstacle", str(tmp_path / "far.obj"))
    assert status == 0
    np.testing.assert_array_equal(grown.tip, free[1].tip)
    assert any(warning.startswith("The obstacle far.obj is out of the tree's reach") for warning in report["warnings"])


def test_a_region_drawn_in_the_sketch_stays_empty_on_the_page(tmp_path):
    line = '<path d="{}" stroke="black" fill="none"/>'
    limbs = "".join(line.format(f"M100 {y} Q{100 + s * 30} {y - 20} {100 + s * 55} {y - 25}") for y, s in ((120, 1), (110, -1), (85, 1), (80, -1), (60, 1)))
    region = '<path id="obstacle" d="M112 95 L200 95 L200 200 L112 200 Z" stroke="grey" fill="none"/>'
    sketch = tmp_path / "beside.svg"
    page = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 200 200">{}</svg>'
    body = line.format("M100 200 C98 150 102 90 100 30") + limbs
    sketch.write_text(page.format(body))
    before = build(tmp_path, "--template", "english_oak", sketch=sketch)
    sketch.write_text(page.format(body + region))
    status, grown, report = build(tmp_path, "--template", "english_oak", sketch=sketch)
    scale, (x, y, _) = report["transform"]["scale"], report["transform"]["translate"]

    def shows(tree):
        at = (new(tree)[1][:, :2] - [x, y]) / scale
        return ((at[:, 0] > 112) & (at[:, 0] < 200) & (at[:, 1] < -95) & (at[:, 1] > -200)).sum()

    assert status == 0 and shows(before[1]) > 5 and shows(grown) == 0
    assert any("drawn branch" in warning and "to an obstacle, or into it" in warning for warning in report["warnings"])


def test_a_region_around_the_root_is_refused_by_its_number(tmp_path, capfd):
    sketch = tmp_path / "around.json"
    strokes = [
        {"id": "trunk", "kind": "branch", "points": [[0, 0], [0, 60], [2, 100]]},
        {"id": "limb", "kind": "branch", "points": [[0, 60], [30, 90]]},
        {"id": "pot", "kind": "obstacle", "closed": True, "points": [[-20, -5], [20, -5], [20, 30], [-20, 30]]},
    ]
    sketch.write_text(json.dumps({"sketchtree": 1, "units": "px", "y": "up", "strokes": strokes}))
    assert run(["build", str(sketch), "-o", str(tmp_path / "t.glb"), *FEW]) == 2
    assert capfd.readouterr().err == (
        "sketchtree: The obstacle region 1 of the drawing is drawn around the root of the tree, so nothing could grow. Draw it beside the trunk.\n"
    )
    assert list(tmp_path.iterdir()) == [sketch]


def file(folder, name, content):
    path = folder / name
    content.export(path) if isinstance(content, trimesh.Trimesh) else path.write_text(content)
    return path


BAD = {
    "missing": (None, "There is no mesh file"),
    "no mesh": ("hello", "tried.obj holds no triangles."),
    "NaN": ("v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "tried.obj has corners that are not finite numbers."),
    "around the root": (box((-1, -1, -1), (1, 4, 1)), "The obstacle tried.obj encloses the root of the tree, so nothing could grow."),
    "around everything": (ball((0, 5, 0), 30.0), "The obstacle tried.obj encloses the root of the tree"),
    "millimetres": (box((-500, -10, -4000), (8000, 6000, 4000)), "a mesh in millimetres is a thousand times too large."),
}


@pytest.mark.parametrize("case", BAD)
def test_bad_obstacles_get_one_paragraph_and_status_2_before_the_work(case, tmp_path, capfd):
    content, message = BAD[case]
    path = tmp_path / "tried.obj" if content is None else file(tmp_path, "tried.obj", content)
    before = set(tmp_path.iterdir())
    status = run(["build", str(POPLAR), "-o", str(tmp_path / "t.glb"), "--report", str(tmp_path / "r.json"), "--obstacle", str(path)])
    said = capfd.readouterr()
    assert status == 2 and set(tmp_path.iterdir()) == before
    assert said.err.startswith("sketchtree: ") and message in said.err
    assert said.err.count("\n") == 1 and "Traceback" not in said.err and "infer" not in said.err
