"""The growth that the studio shows is the very file that `sketchtree grow` writes of the saved project."""

import numpy as np
import pytest

from sketchtree.commands.app import run
from sketchtree.editing.document import Document
from sketchtree.options import ReadingOptions, TreeOptions
from sketchtree.sketch.strokes import Stroke
from sketchtree.studio.making.jobs import Jobs
from sketchtree.studio.making.watching import Stopped
from sketchtree.watch import Watch

LINES = {"trunk": [(0, 0), (2, 50), (0, 100)], "left": [(0, 40), (-20, 60), (-30, 80)], "right": [(0, 50), (30, 85)]}
STROKES = {name: Stroke(name, np.array(points, float), labelled=True) for name, points in LINES.items()}
DOCUMENT = Document(strokes=STROKES, reading=ReadingOptions(template="dragon_tree"), tree=TreeOptions(generations=1, season="autumn"), seed=4)


@pytest.fixture(scope="module")
def jobs():
    return Jobs(None, None)


@pytest.mark.parametrize(("mode", "bend"), [("full", 0.0), ("age", -20.0)])
def test_it_has_the_bytes_of_the_command_line(jobs, tmp_path, mode, bend):
    (tmp_path / "tree.sketchtree").write_bytes(jobs._project(0, Watch(), DOCUMENT))
    shown = jobs.growths.glb(DOCUMENT, mode, bend, Watch())
    assert run(["grow", str(tmp_path / "tree.sketchtree"), "-o", str(tmp_path / "tree.glb"), "--mode", mode, "--bend", str(bend), "--quiet"]) == 0
    assert shown == (tmp_path / "tree.glb").read_bytes()


def test_another_mode_makes_no_other_tree(jobs):
    stages = []
    jobs.growths.glb(DOCUMENT, "full", 0.0, Watch())
    jobs.growths.glb(DOCUMENT, "scale", 0.0, Watch(on_stage=stages.append))
    assert stages == ["grow", "export"]


def test_it_ends_between_its_steps_when_it_is_not_wanted_any_more(jobs):
    def part(done):
        if done > 0.35:
            raise Stopped

    with pytest.raises(Stopped):
        jobs.growths.glb(DOCUMENT, "age", 3.0, Watch(on_part=part))
