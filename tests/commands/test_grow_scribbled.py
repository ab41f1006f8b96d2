"""`sketchtree grow` of a project whose tree is taken from scribbles on its photo."""

import io

import numpy as np
import pytest
from click.testing import CliRunner
from PIL import Image, ImageDraw

from sketchtree.commands.build import build
from sketchtree.commands.grow import grow
from sketchtree.editing.document import Document, Underlay
from sketchtree.options import ReadingOptions
from sketchtree.sketch.strokes import Stroke, StrokeKind
from sketchtree.studio.making.jobs import Jobs
from sketchtree.trunk.wanted import TrunkChoices


@pytest.fixture
def project(tmp_path):
    image = Image.new("RGB", (80, 100), (170, 200, 235))
    for line, width in (([(40, 96), (40, 10)], 8), ([(40, 60), (14, 30)], 5)):
        ImageDraw.Draw(image).line(line, fill=(60, 45, 38), width=width)
    whole = io.BytesIO()
    image.save(whole, "PNG")
    lines = {StrokeKind.FOREGROUND: [(40, -92), (40, -20)], StrokeKind.BACKGROUND: [(5, -60), (5, -95)]}
    strokes = {kind.value: Stroke(kind.value, np.array(line, float), kind, labelled=True, width=3.0) for kind, line in lines.items()}
    document = Document(strokes, underlay=Underlay(whole.getvalue(), 0.0, 0.0, 80.0, 100.0, photo=True), seed=4, reading=ReadingOptions(template="none", height=6.0))
    path = tmp_path / "bare.sketchtree"
    path.write_bytes(Jobs(None, None)._project(0, None, document.replace(trunk=TrunkChoices(on=True, levels=1))))
    return path


def test_it_grows_as_its_project_says(project, tmp_path):
    rows = {}
    for name, words in (("own", ()), ("same", ("--seed", "4", "--levels", "1", "--height", "6")), ("bare", ("--levels", "0"))):
        answer = CliRunner().invoke(grow, [str(project), "-o", str(tmp_path / f"{name}.swc"), "--quiet", *words])
        assert answer.exit_code == 0, answer.output
        rows[name] = [line for line in (tmp_path / f"{name}.swc").read_text().splitlines() if not line.startswith("#")]
    assert rows["own"] == rows["same"] and len(rows["bare"]) < len(rows["own"])


def test_what_the_project_says_already_is_not_asked_for(project, tmp_path):
    answer = CliRunner().invoke(grow, [str(project), "-o", str(tmp_path / "bare.swc"), "--scribbles", str(project)])
    assert answer.exit_code != 0 and "`--scribbles` does nothing here: bare.sketchtree keeps a photo with what is scribbled on it." in str(answer.exception or answer.output)


def test_build_says_who_makes_its_tree(project, tmp_path):
    answer = CliRunner().invoke(build, [str(project), "-o", str(tmp_path / "bare.glb")])
    assert answer.exit_code != 0 and "The tree of bare.sketchtree is taken from scribbles on its photo, and `build` reads a drawing." in str(answer.exception or answer.output)
