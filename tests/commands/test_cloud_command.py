"""`sketchtree cloud` from the shell."""

import json
import sys
from pathlib import Path

import jsonschema
import pytest

sys.path.insert(0, str(Path(__file__).parents[1] / "clouds"))
from scanned import bark

from sketchtree.clouds.cloud import PointCloud
from sketchtree.clouds.files.read_cloud import read_cloud
from sketchtree.clouds.files.write_cloud import write_cloud
from sketchtree.commands.app import run


@pytest.fixture(scope="module")
def scan(tmp_path_factory):
    path = tmp_path_factory.mktemp("scan") / "tree.ply"
    write_cloud(PointCloud(bark(0.03)), path)
    return path


def test_a_cloud_becomes_a_tree_with_its_skeleton_and_report(scan, tmp_path, capfd):
    out, report, skeleton = tmp_path / "t.glb", tmp_path / "t.json", tmp_path / "t.swc"
    assert run(["cloud", str(scan), "-o", str(out), "--report", str(report), "--skeleton", str(skeleton), "--leaf", "oak", "--quiet"]) == 0
    told = json.loads(report.read_text(encoding="utf-8"))
    assert told["command"] == "cloud" and told["cloud"]["trees"] == 1 and told["leaves"] > 0
    assert skeleton.read_text(encoding="utf-8").count("\n") > 20
    assert out.stat().st_size > 10_000


def test_the_points_can_be_written_with_their_distances_from_the_tree(scan, tmp_path):
    out, distances, report = tmp_path / "t.glb", tmp_path / "d.ply", tmp_path / "t.json"
    assert run(["cloud", str(scan), "-o", str(out), "--distances", str(distances), "--report", str(report), "--quiet"]) == 0
    told = json.loads(report.read_text(encoding="utf-8"))
    schema = json.loads((Path(__file__).parents[2] / "sketchtree" / "report.schema.json").read_text(encoding="utf-8"))
    jsonschema.validate(told, schema)
    assert told["distances"]["share"] < 0.01 and told["distances"]["within"] > 0.95
    assert len(read_cloud(distances)) == told["cloud"]["points"]


def test_distances_are_a_ply_file_of_their_own(scan, tmp_path, capfd):
    assert run(["cloud", str(scan), "-o", str(tmp_path / "t.glb"), "--distances", str(scan)]) == 2
    assert f"`--distances {scan}` would overwrite the cloud itself. Give it another name." in capfd.readouterr().err
    assert run(["cloud", str(scan), "-o", str(tmp_path / "t.glb"), "--distances", str(tmp_path / "d.las")]) == 2
    assert "d.las" in capfd.readouterr().err


def test_the_same_cloud_and_seed_give_the_same_bytes(scan, tmp_path):
    one, other = tmp_path / "a.glb", tmp_path / "b.glb"
    for path in (one, other):
        assert run(["cloud", str(scan), "-o", str(path), "--quiet"]) == 0
    assert one.read_bytes() == other.read_bytes()


@pytest.mark.parametrize(
    ("more", "message"),
    [
        (["--template", "no_such"], "no_such"),
        (["--species", "beech"], "No species 'beech' is known for growth toward points."),
        (["--tree", "3"], "3"),
        (["--pixel", "-1"], "`--pixel -1` is out of range."),
        (["--unit", "0"], "`unit` is 0.0. Say how many metres 1 in the file means: 0.001 for millimetres."),
    ],
)
def test_bad_choices_are_one_paragraph(scan, tmp_path, capfd, more, message):
    assert run(["cloud", str(scan), "-o", str(tmp_path / "t.glb"), *more]) == 2
    told = capfd.readouterr().err
    assert message in told and "Traceback" not in told
    assert not (tmp_path / "t.glb").exists()


def test_a_file_that_is_no_cloud_is_named(tmp_path, capfd):
    bad = tmp_path / "notes.txt"
    bad.write_text("dear diary\n", encoding="utf-8")
    assert run(["cloud", str(bad), "-o", str(tmp_path / "t.glb")]) == 2
    assert "notes.txt" in capfd.readouterr().err


def test_the_cloud_itself_is_not_overwritten(scan, capfd):
    assert run(["cloud", str(scan), "-o", str(scan)]) == 2
    assert "would overwrite" in capfd.readouterr().err
