"""`sketchtree grow`, and every other command, of a project whose tree is taken from scribbles on its photo."""

import io
import json

import jsonschema
import numpy as np
import pytest
from click.testing import CliRunner
from PIL import Image, ImageDraw

from sketchtree.commands.app import run
from sketchtree.commands.build import build
from sketchtree.commands.convert import convert
from sketchtree.commands.forest import forest
from sketchtree.commands.grow import grow
from sketchtree.commands.infer import infer
from sketchtree.commands.inspect import inspect
from sketchtree.commands.view import view
from sketchtree.editing.document import Document, Underlay
from sketchtree.export.read import read_contents
from sketchtree.options import ReadingOptions
from sketchtree.report import report_schema
from sketchtree.sketch.strokes import Stroke, StrokeKind
from sketchtree.studio.making.jobs import Jobs
from sketchtree.trunk.wanted import TrunkChoices


@pytest.fixture
def kept(tmp_path):
    """Writes the project, its trunk taken so."""
    image = Image.new("RGB", (80, 100), (170, 200, 235))
    for line, width in (([(40, 96), (40, 10)], 8), ([(40, 60), (14, 30)], 5)):
        ImageDraw.Draw(image).line(line, fill=(60, 45, 38), width=width)
    whole = io.BytesIO()
    image.save(whole, "PNG")
    lines = {StrokeKind.FOREGROUND: [(40, -92), (40, -20)], StrokeKind.BACKGROUND: [(5, -60), (5, -95)]}
    strokes = {kind.value: Stroke(kind.value, np.array(line, float), kind, labelled=True, width=3.0) for kind, line in lines.items()}
    document = Document(strokes, underlay=Underlay(whole.getvalue(), 0.0, 0.0, 80.0, 100.0, photo=True), seed=4, reading=ReadingOptions(template="none", height=6.0))
    path = tmp_path / "bare.sketchtree"
    (tmp_path / "bare.png").write_bytes(whole.getvalue())

    def write(**choices):
        path.write_bytes(Jobs(None, None)._project(0, None, document.replace(trunk=TrunkChoices(**{"on": True, "levels": 1} | choices))))
        return path

    return write


@pytest.fixture
def project(kept):
    return kept()


def rows(path) -> list[str]:
    return [line for line in path.read_text().splitlines() if not line.startswith("#")]


def test_it_grows_as_its_project_says(project, tmp_path):
    found = {}
    for name, words in (("own", ()), ("same", ("--seed", "4", "--levels", "1", "--height", "6")), ("bare", ("--levels", "0"))):
        answer = CliRunner().invoke(grow, [str(project), "-o", str(tmp_path / f"{name}.swc"), "--quiet", *words])
        assert answer.exit_code == 0, answer.output
        found[name] = rows(tmp_path / f"{name}.swc")
    assert found["own"] == found["same"] and len(found["bare"]) < len(found["own"])


def test_matting_root_and_lift_are_those_of_the_project(kept, tmp_path):
    project = kept(matting="closed-form", root=(40.0, 70.0), lift="elevation")
    marks = {"foreground": [[[40, 92], [40, 20]]], "background": [[[5, 60], [5, 95]]], "brush": 3}
    (tmp_path / "marks.json").write_text(json.dumps(marks))
    common = ("--levels", "1", "--height", "6", "--template", "none", "--seed", "4", "--quiet")
    picture = ("--scribbles", str(tmp_path / "marks.json"), "--matting", "closed-form", "--root", "40", "70", "--lift", "elevation")
    for source, name, more in ((project, "own", ()), (tmp_path / "bare.png", "same", picture)):
        answer = CliRunner().invoke(grow, [str(source), "-o", str(tmp_path / f"{name}.swc"), "--report", str(tmp_path / f"{name}.json"), *common, *more])
        assert answer.exit_code == 0, answer.output
    assert rows(tmp_path / "own.swc") == rows(tmp_path / "same.swc")
    said = [json.loads((tmp_path / f"{name}.json").read_text())["options"] for name in ("own", "same")]
    assert [one[name] for one in said for name in ("matting", "lift", "root")] == 2 * ["closed-form", "elevation", [40.0, 70.0]]


def test_an_edit_that_finds_no_vertex_any_more_is_told_and_the_tree_is_written(kept, tmp_path):
    answer = CliRunner().invoke(grow, [str(kept(remove=((79.0, 2.0),))), "-o", str(tmp_path / "bare.swc")])
    assert answer.exit_code == 0 and "`remove` (79, 2): no vertex is there" in answer.output and "It was passed over." in answer.output


def test_what_the_project_says_already_is_not_asked_for(project, tmp_path):
    answer = CliRunner().invoke(grow, [str(project), "-o", str(tmp_path / "bare.swc"), "--scribbles", str(project)])
    assert answer.exit_code != 0 and "`--scribbles` does nothing here: bare.sketchtree keeps a photo with what is scribbled on it." in str(answer.exception or answer.output)


def said(command, *words) -> str:
    """What a command that ends well says."""
    answer = CliRunner().invoke(command, [str(word) for word in words])
    assert answer.exit_code == 0, answer.output
    return answer.output


def test_build_and_convert_make_the_tree_that_grow_ends_with_to_the_last_byte(project, tmp_path):
    said(grow, project, "-o", tmp_path / "grown.glb", "--time", "1")
    said(build, project, "-o", tmp_path / "built.glb", "--report", tmp_path / "built.json", "--skeleton", tmp_path / "built.swc")
    said(convert, project, tmp_path / "converted.glb")
    made = (tmp_path / "built.glb").read_bytes()
    assert made == (tmp_path / "grown.glb").read_bytes() == (tmp_path / "converted.glb").read_bytes()
    report = json.loads((tmp_path / "built.json").read_text())
    jsonschema.validate(report, report_schema())
    assert report["command"] == "build" and report["seed"] == 4 and report["growth"]["input"] == "picture" and report["growth"]["levels"] == 1 and report["growth"]["joints"] is None
    assert report["segments"]["total"] == len(rows(tmp_path / "built.swc")) - 1 and report["options"]["matting"] == "layered"


def test_build_writes_its_levels_of_detail_and_other_looks(project, tmp_path):
    said(build, project, "-o", tmp_path / "coarse.glb", "--lod", "3", "--leaf", "none", "--season", "bare")
    said(convert, project, tmp_path / "bare.glb", "--leaf", "none")
    coarse, bare = (read_contents(tmp_path / name).asset for name in ("coarse.glb", "bare.glb"))
    assert sum(part.triangle_count for part in coarse.parts) < 0.1 * sum(part.triangle_count for part in bare.parts) and {part.name for part in bare.parts} <= {"wood", "wood_twigs"}


def test_it_is_looked_at_as_the_tree_that_is_made_of_it(project, tmp_path, monkeypatch):
    seen = []
    monkeypatch.setattr("sketchtree.view.picture.preview", lambda meshes, path, **how: (seen.extend(meshes), (True, ""))[1])
    said(view, project, "--screenshot", tmp_path / "bare.png")
    assert [mesh.name.split("_")[0] for mesh in seen][:1] == ["wood"] and seen[-1].name == "leaf"


@pytest.mark.parametrize(
    "command, more, says",
    [
        (build, ("-o", "copy.sketchtree"), "bare.sketchtree is the project already, and its tree is made anew of what is scribbled in it."),
        (build, ("-o", "tree.glb", "--fill"), "`--fill` does nothing here: bare.sketchtree keeps a photo with what is scribbled on it."),
        (infer, ("-o", "drawn.swc"), "`infer` reads drawings. `sketchtree grow bare.sketchtree -o TRUNK.swc --levels 0` writes its trunk in 3D."),
        (inspect, ("-o", "seen.png"), "`inspect` reads drawings. `sketchtree grow bare.sketchtree -o TREE.glb --matte MATTE.png --trunk TRUNK.swc` writes what is found in it."),
        (view, ("--screenshot", "seen.png", "--level", "2"), "is made anew, in one level of detail, and there is none numbered 2."),
        (forest, ("-o", "forest.glb"), "`forest` reads drawings. `sketchtree build bare.sketchtree -o TREE.glb` makes its tree."),
    ],
)
def test_what_can_not_be_made_of_it_is_refused_by_name(project, tmp_path, command, more, says):
    answer = CliRunner().invoke(command, [str(project), more[0], str(tmp_path / more[1]), *more[2:]])
    assert answer.exit_code != 0 and says in str(answer.exception or answer.output) and not (tmp_path / more[1]).exists()


def test_of_a_batch_it_is_the_one_that_failed(project, tmp_path):
    assert run(["batch", str(project), "--out", str(tmp_path / "all"), "--quiet"]) == 1
    assert "`batch` reads drawings. `sketchtree build bare.sketchtree -o TREE.glb` makes its tree." in (tmp_path / "all" / "batch.json").read_text()


def test_as_drawn_means_its_strokes_and_there_are_none(project, tmp_path):
    answer = CliRunner().invoke(build, [str(project), "-o", str(tmp_path / "bare.glb"), "--as-drawn"])
    assert answer.exit_code != 0 and "has no branch strokes: all it holds is scribbles over a photo." in str(answer.exception or answer.output)
