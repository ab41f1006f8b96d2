"""`sketchtree cloud` from the shell."""

import functools
import json
import sys
from pathlib import Path

import jsonschema
import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).parents[1] / "clouds"))
from scanned import bark

from sketchtree.clouds.cloud import PointCloud
from sketchtree.clouds.files.read_cloud import read_cloud, read_placed
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


def test_a_pot_can_be_kept(scan, tmp_path):
    report = tmp_path / "t.json"
    assert run(["cloud", str(scan), "-o", str(tmp_path / "t.swc"), "--keep-pot", "--report", str(report), "--quiet"]) == 0
    assert json.loads(report.read_text(encoding="utf-8"))["options"]["keep_pot"] is True


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


def noisy(scan, folder):
    """Files that are no cloud, or hold no one tree."""
    xyz, chance = bark(0.08), np.random.default_rng(0)
    np.savetxt(folder / "named.csv", xyz, delimiter=",", header="alpha,beta,gamma", comments="")
    np.savetxt(folder / "few.xyz", xyz[:50])
    np.savetxt(folder / "three.xyz", np.concatenate([xyz, 0.9 * xyz + [6, 0, 0], 0.8 * xyz + [0, 0, 7]]))
    np.savetxt(folder / "ground.xyz", np.c_[chance.uniform(-3, 3, 3000), chance.normal(0, 0.002, 3000), chance.uniform(-3, 3, 3000)])
    (folder / "cut.ply").write_bytes(scan.read_bytes()[:2000])
    (folder / "empty.ply").write_bytes(b"")
    (folder / "garbage.las").write_bytes(chance.bytes(3000))
    (folder / "photo.jpg").write_bytes(b"\xff\xd8\xff\xe0")
    (folder / "folder").mkdir()


@pytest.mark.parametrize(
    ("name", "message"),
    [
        ("nowhere.ply", "There is no file {}. Check the path."),
        ("folder", "{} is a folder, not a point cloud. Give the cloud inside it; a folder of photos is for `sketchtree views`."),
        ("empty.ply", "empty.ply is empty. Export the cloud again."),
        ("cut.ply", "points. The file was cut off: copy or export it again."),
        ("garbage.las", "garbage.las is no point cloud that is known here. Give PLY, LAS, LAZ, XYZ (or other text with x, y, z), NPZ or NPY."),
        ("photo.jpg", "photo.jpg is a picture, which is not read as a point cloud. Give a folder of photos to `sketchtree views`."),
        ("named.csv", "The columns of named.csv are named alpha, beta, gamma; none are x, y and z. Name three of them x, y and z."),
        ("few.xyz", "Only 50 points of the cloud may be a tree. Give a cloud with more points, or one with a tree in it."),
        ("ground.xyz", " points of the cloud may be a tree. Give a cloud with more points, or one with a tree in it."),
        ("three.xyz", "Say which with `--tree K`, or cut it out of the cloud."),
    ],
)
def test_a_bad_cloud_is_one_paragraph_and_nothing_is_written(scan, tmp_path, capfd, name, message):
    noisy(scan, tmp_path)
    out, skeleton, report = (tmp_path / f"t.{kind}" for kind in ("glb", "swc", "json"))
    assert run(["cloud", str(tmp_path / name), "-o", str(out), "--skeleton", str(skeleton), "--report", str(report), "--quiet"]) == 2
    told = capfd.readouterr().err
    assert told.startswith("sketchtree: ") and told.endswith(f"{message.format(tmp_path / name)}\n") and told.count("\n") == 1
    assert not any(path.exists() for path in (out, skeleton, report))


@pytest.mark.parametrize(("when", "left"), [("tracing", ()), ("writing", ("t.glb",))])
def test_ctrl_c_leaves_no_file_half_written(scan, tmp_path, capfd, monkeypatch, when, left):
    def stopped(*_, **__):
        raise KeyboardInterrupt

    monkeypatch.setattr("sketchtree.cloud_tree.traced" if when == "tracing" else "sketchtree.tree_output.write_skeleton_of", stopped)
    assert run(["cloud", str(scan), "-o", str(tmp_path / "t.glb"), "--skeleton", str(tmp_path / "t.swc"), "--quiet"]) == 130
    assert capfd.readouterr().err.strip() == "sketchtree: stopped; nothing was left half-written."
    assert sorted(path.name for path in tmp_path.iterdir()) == list(left)


def test_millions_of_points_are_thinned_while_they_are_read_and_that_is_said(tmp_path, capfd, monkeypatch):
    monkeypatch.setattr("sketchtree.cloud_tree.read_placed", functools.partial(read_placed, max_points=1000))
    np.savetxt(tmp_path / "large.xyz", bark(0.02), fmt="%.4f")
    assert run(["cloud", str(tmp_path / "large.xyz"), "-o", str(tmp_path / "t.swc")]) == 0
    told = capfd.readouterr().err
    assert "Note: large.xyz holds " in told and " were kept, one in each voxel of " in told


def test_fewer_roots_than_were_asked_for_are_told(scan, tmp_path, capfd):
    assert run(["cloud", str(scan), "-o", str(tmp_path / "t.swc"), "--roots", "3"]) == 0
    assert "Note: 3 roots were asked for; the points show 1." in capfd.readouterr().err
