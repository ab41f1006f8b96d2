"""`sketchtree forest` as a designer meets it."""

import json
from pathlib import Path

import jsonschema
import numpy as np
import pytest

from sketchtree.commands.app import run
from sketchtree.export.gltf import read_asset, read_glb_skeleton
from sketchtree.geometry.instances import Instances
from sketchtree.report import report_schema

ROOT = Path(__file__).resolve().parents[2]
APPLE, POPLAR = str(ROOT / "examples" / "apple.json"), str(ROOT / "examples" / "poplar.svg")
QUICK = ["--method", "okabe", "--generations", "1", "--quiet"]


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    """A forest with everything it can write."""
    folder = tmp_path_factory.mktemp("forest")
    arguments = ["forest", APPLE, POPLAR, APPLE, "--spacing", "3", "-o", str(folder / "f.glb"), "--skeleton", str(folder / "f.swc")]
    assert run([*arguments, "--report", str(folder / "r.json"), "--light", ".4", *QUICK]) == 0
    return folder


def test_the_report_satisfies_its_schema_and_has_an_entry_for_every_sketch(made):
    report = json.loads((made / "r.json").read_text())
    jsonschema.validate(report, report_schema())
    assert report["command"] == "forest" and report["options"]["spacing"] == 3.0 and report["options"]["light"] == 0.4
    assert [tree["sketch"] for tree in report["trees"]] == ["apple.json", "poplar.svg", "apple.json"]
    assert [tree["copy"] for tree in report["trees"]] == [0, 0, 1]
    assert [tree["place"] for tree in report["trees"]] == [[0, 0, 0], [3, 0, 0], [6, 0, 0]]
    assert report["segments"]["total"] == sum(tree["segments"]["total"] for tree in report["trees"])
    assert report["leaves"] == sum(tree["leaves"] for tree in report["trees"])
    assert report["trees"][1]["transform"]["translate"][0] - 3.0 == pytest.approx(-report["trees"][1]["transform"]["scale"] * _root_x(POPLAR), rel=1e-6)
    assert report["template_used"] is None and report["attachments"] == []


def _root_x(sketch):
    import sketchtree as st

    graph = st.sketch_graph(st.read_sketch(sketch))
    return float(graph.xy[np.flatnonzero(graph.is_base)[0], 0])


def test_the_glb_holds_every_trees_wood_and_leaves_and_the_skeleton(made):
    import trimesh

    names = set(trimesh.load(made / "f.glb").geometry)
    assert {"wood_1", "wood_2", "wood_3"} <= names and sum(name.startswith("leaf") for name in names) == 3
    tree = read_glb_skeleton(made / "f.glb")
    assert np.unique(tree.tree).tolist() == [0, 1, 2]
    np.testing.assert_allclose(tree.tip[tree.is_base][:, 0], [0, 3, 6], atol=1e-5)


def test_instanced_leaves_are_named_by_their_trees(tmp_path):
    more = ["--leaves", "instanced", "--report", str(tmp_path / "r.json")]
    assert run(["forest", APPLE, APPLE, "--spacing", "3", "-o", str(tmp_path / "f.glb"), *more, *QUICK]) == 0
    asset = read_asset(tmp_path / "f.glb")
    leaves = [part for part in asset.parts if part.name.startswith("leaf")]
    assert all(isinstance(part, Instances) for part in leaves) and {part.name[-2:] for part in leaves} == {"_1", "_2"}
    report = json.loads((tmp_path / "r.json").read_text())
    assert report["options"]["leaves"] == "instanced" and len(asset.skeleton) == report["segments"]["total"] + 2
    middle = [np.vstack([part.translation for part in leaves if part.name.endswith(number)]).mean(axis=0)[0] for number in ("_1", "_2")]
    assert middle[1] - middle[0] == pytest.approx(3, abs=0.5)


@pytest.mark.parametrize(("out", "more", "said"), [
    ("f.obj", ["--leaves", "instanced"], "`.obj` files can't hold instanced leaves. Write .glb, .gltf or .usd, or leave `--leaves instanced` out."),
    ("f.glb", ["--lod", "1"], "No such option '--lod'."),
    ("f.glb", ["--pack", "game"], "No such option '--pack'."),
])  # fmt: skip
def test_what_a_forest_can_not_be_written_as_is_refused(tmp_path, capfd, out, more, said):
    assert run(["forest", APPLE, APPLE, "-o", str(tmp_path / out), *more, *QUICK]) == 2
    assert said in capfd.readouterr().err and not list(tmp_path.iterdir())


def test_the_same_seed_gives_the_same_bytes(tmp_path):
    def forest(name, seed):
        assert run(["forest", APPLE, APPLE, "-o", str(tmp_path / name), "--seed", seed, "--leaf", "none", *QUICK]) == 0
        return (tmp_path / name).read_bytes()

    assert forest("a.glb", "3") == forest("b.glb", "3")
    assert forest("c.glb", "4") != forest("a.glb", "3")


@pytest.mark.parametrize("name", ["f.json", "f.swc", "f.obj", "f.ply", "f.stl"])
def test_the_extension_decides_what_is_written(tmp_path, name):
    assert run(["forest", APPLE, APPLE, "-o", str(tmp_path / name), "--method", "okabe", "--generations", "0", "--leaf", "none", "--quiet"]) == 0
    assert (tmp_path / name).stat().st_size > 1000


BAD = {
    "no sketch": ([], "There is no sketch to make a forest of. Name one or several sketch files."),
    "spacing 0": ([APPLE, "--spacing", "0"], "`--spacing 0` is no distance between trees. Give metres above 0, from trunk to trunk."),
    "spacing nan": ([APPLE, "--spacing", "nan"], "`--spacing nan` is no distance between trees. Give metres above 0, from trunk to trunk."),
    "too many": ([APPLE] * 1001, "1001 trees are more than a forest may have. Give 1000 at most; instance them in your 3D program."),
    "light": ([APPLE, "--light", "2"], "`--light 2` is out of range. Give 0 to 1."),
}


@pytest.mark.parametrize("case", BAD)
def test_bad_input_gets_one_paragraph_and_status_2_and_no_file(case, tmp_path, capfd):
    arguments, message = BAD[case]
    assert run(["forest", *arguments, "-o", str(tmp_path / "f.glb"), "--report", str(tmp_path / "r.json"), *QUICK]) == 2
    said = capfd.readouterr()
    assert said.err == f"sketchtree: {message}\n" and said.out == ""
    assert not list(tmp_path.iterdir())


def test_one_sketch_that_fails_is_named_and_nothing_is_written(tmp_path, capfd):
    bad = tmp_path / "crown_only.svg"
    bad.write_text('<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 9 9"><path id="crown" d="M1 5 C1 1 9 1 9 5 Z" stroke="black" fill="none"/></svg>')
    assert run(["forest", APPLE, str(bad), "-o", str(tmp_path / "f.glb"), *QUICK]) == 2
    said = capfd.readouterr().err
    assert "crown_only.svg" in said and said.count("\n") == 1 and "Traceback" not in said
    assert list(tmp_path.iterdir()) == [bad]


def test_a_sketch_is_never_overwritten(capfd):
    assert run(["forest", POPLAR, APPLE, "-o", APPLE, *QUICK]) == 2
    assert "would overwrite the sketch itself" in capfd.readouterr().err


def test_the_summary_counts_the_sketches(tmp_path, capfd):
    assert run(["forest", APPLE, APPLE, "-o", str(tmp_path / "f.swc"), "--method", "okabe", "--generations", "0"]) == 0
    said = capfd.readouterr().err.splitlines()
    assert said[-1].startswith(f"{tmp_path / 'f.swc'}: 2 sketches, ") and "up to" in said[-1]
    assert [line for line in said if line.endswith("…")] == ["read …", "propagate …", "mesh …", "export …"]


def test_build_takes_light_and_records_it(tmp_path):
    report = tmp_path / "r.json"
    assert run(["build", APPLE, "-o", str(tmp_path / "t.swc"), "--light", ".5", "--report", str(report), *QUICK]) == 0
    assert json.loads(report.read_text())["options"]["light"] == 0.5
