"""`sketchtree cloud --method grown`: another figure, a tree of each of several values, and the tree cycle after cycle."""

import json
import sys
from pathlib import Path

import jsonschema
import pytest

sys.path.insert(0, str(Path(__file__).parents[1] / "clouds"))
from scanned import bark

from sketchtree.clouds.cloud import PointCloud
from sketchtree.clouds.files.write_cloud import write_cloud
from sketchtree.commands.app import run


@pytest.fixture(scope="module")
def scan(tmp_path_factory):
    path = tmp_path_factory.mktemp("scan") / "tree.ply"
    write_cloud(PointCloud(bark(0.08)), path)
    return path


@pytest.fixture(scope="module")
def written(scan, tmp_path_factory):
    """One run that writes all there is beside a tree."""
    folder = tmp_path_factory.mktemp("out")
    more = ["--set", "internode=0.1", "--vary", "branching=20,1.5x", "--vary", "tropism=up", "--series", str(folder / "all"), "--frames", "4", "--wood", "tubes"]
    assert run(["cloud", str(scan), "-o", str(folder / "t.swc"), "--method", "grown", "--report", str(folder / "t.json"), "--quiet", *more]) == 0
    return folder


@pytest.fixture(scope="module")
def told(written):
    return json.loads((written / "t.json").read_text(encoding="utf-8"))


def test_every_value_is_a_tree_of_its_own_beside_the_tree(written):
    names = {path.name for path in written.iterdir()}
    assert names == {"t.swc", "t_branching_20.swc", "t_branching_1.5x.swc", "t_tropism_up.swc", "t.json", "all"}
    assert len({path.read_bytes() for path in written.glob("*.swc")}) == 4


def test_the_series_is_numbered_from_the_first_shoot_to_the_whole_tree(written, told):
    assert sorted(path.name for path in (written / "all").iterdir()) == [f"t_{k:04d}.glb" for k in range(4)]
    series = told["cloud"]["growth"]["series"]
    assert [row["file"] for row in series] == [f"t_{k:04d}.glb" for k in range(4)]
    assert series[-1]["cycle"] == told["cloud"]["growth"]["cycles"]
    assert series[-1]["segments"] == told["segments"]["total"]
    assert [row["cycle"] for row in series] == sorted(row["cycle"] for row in series)
    assert 0 < series[0]["length"] < series[1]["length"] < series[-1]["length"]


def test_the_report_tells_every_figure_and_keeps_the_schema(told):
    jsonschema.validate(told, json.loads((Path(__file__).parents[2] / "sketchtree" / "report.schema.json").read_text(encoding="utf-8")))
    growth, kind = told["cloud"]["growth"], told["cloud"]["species"]
    assert kind["internode"] == 0.1
    assert growth["figures"]["alpha"] == 1.6 and growth["figures"]["influence"] is None
    first, second, _ = growth["variations"]
    assert (first["file"], first["figure"], first["value"], first["species"]["branching"]) == ("t_branching_20.swc", "branching", "20", 20.0)
    assert second["species"]["branching"] == pytest.approx(1.5 * kind["branching"], abs=1e-3)
    assert first["species"]["internode"] == 0.1


def test_a_variation_is_the_tree_that_is_set_so(scan, written, tmp_path):
    out = tmp_path / "t.swc"
    assert run(["cloud", str(scan), "-o", str(out), "--method", "grown", "--set", "internode=0.1", "--set", "branching=20", "--wood", "tubes", "--quiet"]) == 0
    assert out.read_bytes() == (written / "t_branching_20.swc").read_bytes()


GROWN = ["--method", "grown"]


@pytest.mark.parametrize(
    ("more", "message"),
    [
        (["--vary", "branching=20"], "`--vary branching=20` is about how a tree grows, and one that is traced is where its points are. Add `--method grown`, or leave it out."),
        (["--series", "all"], "`--series all` is about how a tree grows, and one that is traced is where its points are. Add `--method grown`, or leave it out."),
        (["--set", "alpha=2"], "`--set alpha=2` says how a tree grows, and one that is traced is where its points are. Add `--method grown`, or leave it out."),
        ([*GROWN, "--set", "alpha=1,2"], "`--set alpha=1,2` gives several values. Give one; `--vary` makes a tree of each of several."),
        ([*GROWN, "--vary", "height=3"], "No figure of growth is called 'height'. Choose one of: internode, roll, branching, gamma, alpha"),
        ([*GROWN, "--vary", "roll=1,2", "--vary", "roll=2"], "`--vary` says roll=2 twice. Say it once."),
        ([*GROWN, "--vary", "roll=" + ",".join(map(str, range(65)))], "65 variations are asked for. Ask for 64 at most."),
        ([*GROWN, "--frames", "4"], "`--frames` counts the trees of a series, and none is asked for. Add `--series FOLDER`, or leave it out."),
        ([*GROWN, "--series", "none/all"], "the folder none does not exist. Create it, or choose another path."),
    ],
)
def test_what_makes_no_sense_is_one_paragraph_and_nothing_is_written(scan, tmp_path, capfd, monkeypatch, more, message):
    monkeypatch.chdir(tmp_path)
    assert run(["cloud", str(scan), "-o", "t.swc", *more]) == 2
    told = capfd.readouterr().err
    assert message in told and "Traceback" not in told
    assert not list(tmp_path.iterdir())


def test_a_cloud_of_the_name_of_a_variation_is_not_overwritten(scan, tmp_path, capfd):
    points = tmp_path / "t_roll_2.ply"
    points.write_bytes(scan.read_bytes())
    assert run(["cloud", str(points), "-o", str(tmp_path / "t.ply"), *GROWN, "--vary", "roll=2"]) == 2
    assert "would overwrite" in capfd.readouterr().err


def test_a_report_of_the_name_of_a_variation_is_not_overwritten(scan, tmp_path, capfd):
    assert run(["cloud", str(scan), "-o", str(tmp_path / "t.swc"), "--report", str(tmp_path / "t_roll_2.swc"), *GROWN, "--vary", "roll=2"]) == 2
    assert "would overwrite what it is made of, or another tree" in capfd.readouterr().err


def test_a_longer_series_is_not_mixed_with_a_new_one(scan, tmp_path, capfd):
    (tmp_path / "all").mkdir()
    (tmp_path / "all" / "t_0009.glb").write_bytes(b"")
    assert run(["cloud", str(scan), "-o", str(tmp_path / "t.swc"), *GROWN, "--series", str(tmp_path / "all"), "--frames", "4"]) == 2
    assert "t_0009.glb of a longer series" in capfd.readouterr().err
