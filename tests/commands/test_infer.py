"""`sketchtree infer`: what was drawn keeps its place on the page."""

import json
from pathlib import Path

import jsonschema
import numpy as np
import pytest

from sketchtree.commands.app import run
from sketchtree.commands.options import METHODS
from sketchtree.skeleton_files import read_swc
from sketchtree.mrf.methods import METHODS as SOLVERS
from sketchtree.report import report_schema
from sketchtree.sketch.formats import read_sketch
from sketchtree.sketch.reading import sketch_graph

ROOT = Path(__file__).resolve().parents[2]
CURVY = ROOT / "examples" / "curvy.svg"


def infer(path: Path, *arguments: str):
    assert run(["infer", str(CURVY), "-o", str(path), "--quiet", *arguments]) == 0
    return read_swc(path)


def test_the_command_line_names_every_method():
    assert set(METHODS) == set(SOLVERS)


@pytest.mark.parametrize("method", METHODS)
def test_drawn_nodes_keep_their_place_on_the_page(tmp_path, method):
    tree = infer(tmp_path / "t.swc", "--frame", "sketch", "--method", method)
    graph = sketch_graph(read_sketch(CURVY))
    drawn = np.concatenate([graph.xy, graph.curve_points])
    gap = np.linalg.norm(drawn[:, None] - tree.tip[None, :, :2], axis=2).min(axis=1)
    assert gap.max() <= 1e-6 * graph.height
    assert len(tree) == len(drawn)


def test_the_default_method_gives_the_tree_depth_and_flat_gives_none(tmp_path):
    deep = infer(tmp_path / "a.swc", "--frame", "sketch")
    flat = infer(tmp_path / "b.swc", "--frame", "sketch", "--method", "flat")
    assert np.ptp(flat.tip[:, 2]) == 0
    assert np.ptp(deep.tip[:, 2]) > 0.15 * np.ptp(deep.tip[:, 0])


def test_the_world_frame_has_its_root_at_the_origin_and_metres(tmp_path):
    tree = infer(tmp_path / "t.swc", "--height", "7")
    np.testing.assert_allclose(tree.tip[0], 0, atol=1e-9)
    assert tree.tip[:, 1].max() == pytest.approx(7.0, rel=1e-6)


def test_the_report_of_infer_satisfies_the_schema(tmp_path):
    infer(tmp_path / "t.swc", "--report", str(tmp_path / "r.json"), "--theta", "fixed", "--template", "none")
    report = json.loads((tmp_path / "r.json").read_text())
    jsonschema.validate(report, report_schema())
    assert report["triangles"] is None and report["template"] == [] and report["template_used"] is None
    assert report["infer"]["method"] == "elevation"


def test_only_skeletons_come_out_of_infer(tmp_path, capfd):
    assert run(["infer", str(CURVY), "-o", str(tmp_path / "t.glb")]) == 2
    assert "writes .swc, .mtg, .json, .h5 here" in capfd.readouterr().err
