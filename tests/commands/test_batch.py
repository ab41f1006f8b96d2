"""`sketchtree batch` as a pipeline meets it: nothing is lost, nothing is overwritten, one bad drawing stops no other."""

import csv
import json
import os
import shutil
import signal
import sys
from pathlib import Path

import jsonschema
import pytest

from sketchtree import tree_asset
from sketchtree.asset import Level
from sketchtree.batch import Manner, orders
from sketchtree.commands import batch_crew, batch_tree
from sketchtree.commands.app import run
from sketchtree.commands.batch import FORMATS
from sketchtree.commands.writing import WHOLE
from sketchtree.options import FileOptions, ReadingOptions, TreeOptions
from sketchtree.report import report_schema

ROOT = Path(__file__).resolve().parents[2]
APPLE = ROOT / "examples" / "apple.json"
TRUNK = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 100"><path d="M50 100 L50 10" stroke="black" fill="none"/>{}</svg>'
FORK = TRUNK.format('<path d="M50 60 L80 30" stroke="black" fill="none"/>')
QUICK = ["--method", "okabe", "--generations", "1", "--leaf", "none", "--quiet"]
BROKEN = "broken.svg is none of the files that can be read"


@pytest.fixture
def at(tmp_path, monkeypatch):
    """An empty folder, and we stand in it."""
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture(scope="module")
def drawings(tmp_path_factory):
    """Two good drawings, one of them in a sub-folder, and a broken one."""
    folder = tmp_path_factory.mktemp("drawings")
    (folder / "deep").mkdir()
    shutil.copy(APPLE, folder / "apple.json")
    (folder / "deep" / "fork.svg").write_text(FORK)
    (folder / "broken.svg").write_text("this is no drawing")
    (folder / "notes.txt").write_text("nor is this")
    return folder


@pytest.fixture(scope="module")
def made(drawings, tmp_path_factory):
    """A batch of them, by one process."""
    out = tmp_path_factory.mktemp("made") / "out"
    assert run(["batch", f"{drawings}/**/*", "--out", str(out), "--seed", "3", *QUICK]) == 1
    return out


def files(folder):
    return {path.relative_to(folder).as_posix(): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


def trees(folder):
    return {name: data for name, data in files(folder).items() if name.endswith(".glb")}


def few(folder, *names):
    (folder / "in").mkdir(exist_ok=True)
    for name in names:
        (folder / "in" / name).write_text(FORK)
    return str(folder / "in")


def rows(out):
    return {Path(row["sketch"]).name: row for row in json.loads((out / "batch.json").read_text())["files"]}


def test_every_good_drawing_becomes_a_tree_and_a_report_and_sub_folders_are_kept(made):
    assert set(files(made)) == {"apple.glb", "apple.report.json", "deep/fork.glb", "deep/fork.report.json", "batch.json", "batch.csv"}
    for name in ("apple", "deep/fork"):
        report = json.loads((made / f"{name}.report.json").read_text())
        jsonschema.validate(report, report_schema())
        assert report["command"] == "batch" and report["seed"] == 3 and report["options"]["generations"] == 1


def test_a_tree_of_a_batch_is_the_tree_that_build_makes(made, tmp_path):
    assert run(["build", str(APPLE), "-o", str(tmp_path / "a.glb"), "--seed", "3", *QUICK]) == 0
    assert (tmp_path / "a.glb").read_bytes() == (made / "apple.glb").read_bytes()


def test_the_summary_has_a_row_a_drawing_and_names_what_failed(made):
    told = json.loads((made / "batch.json").read_text())
    assert told["count"] == {"made": 2, "kept": 0, "failed": 1, "not reached": 0}
    assert [Path(row["sketch"]).name for row in told["files"]] == ["apple.json", "broken.svg", "fork.svg"]
    bad = rows(made)["broken.svg"]
    assert bad["status"] == "failed" and bad["error"].startswith(BROKEN) and bad["output"] is None
    good = rows(made)["apple.json"]
    assert good["error"] is None and good["segments"] > 100 and good["seconds"] > 0 and Path(good["output"]) == made / "apple.glb"
    with open(made / "batch.csv", newline="") as file:
        table = list(csv.DictReader(file))
    assert [row["status"] for row in table] == ["made", "failed", "made"] and table[1]["error"] == bad["error"]


def test_two_processes_make_the_same_bytes_as_one(made, drawings, tmp_path):
    assert run(["batch", f"{drawings}/**/*", "--out", str(tmp_path / "two"), "--jobs", "2", "--seed", "3", *QUICK]) == 1
    assert trees(tmp_path / "two") == trees(made)
    assert list(rows(tmp_path / "two")) == list(rows(made))


def test_resume_keeps_what_is_the_same_and_makes_the_rest(made, drawings, tmp_path, monkeypatch):
    out, built = tmp_path / "out", []
    shutil.copytree(made, out)
    work = batch_tree._built
    monkeypatch.setattr(batch_tree, "_built", lambda order: built.append(Path(order.sketch).name) or work(order))
    again = ["batch", f"{drawings}/**/*", "--out", str(out), "--resume", *QUICK]
    assert run([*again, "--seed", "3"]) == 1
    assert built == ["broken.svg"] and rows(out)["apple.json"]["status"] == "kept" and trees(out) == trees(made)
    (out / "deep" / "fork.glb").unlink()
    (out / "apple.report.json").write_text("{")
    assert run([*again, "--seed", "3"]) == 1
    assert built[1:] == ["apple.json", "broken.svg", "fork.svg"] and trees(out) == trees(made)
    assert run([*again, "--seed", "4"]) == 1
    assert rows(out)["apple.json"]["status"] == "made" and trees(out)["apple.glb"] != trees(made)["apple.glb"]


def test_a_drawing_that_was_changed_is_made_anew(at, capfd):
    folder = few(at, "a.svg", "b.svg")
    assert run(["batch", folder, "--out", "out", *QUICK]) == 0
    (at / "in" / "a.svg").write_text(TRUNK.format(""))
    assert run(["batch", folder, "--out", "out", "--resume", *QUICK]) == 0
    assert {name: row["status"] for name, row in rows(at / "out").items()} == {"a.svg": "made", "b.svg": "kept"}


def test_without_resume_nothing_that_is_there_is_overwritten(at, capfd):
    folder = few(at, "a.svg", "b.svg")
    (at / "out").mkdir()
    (at / "out" / "b.glb").write_text("mine")
    assert run(["batch", folder, "--out", "out", *QUICK]) == 2
    assert capfd.readouterr().err == (
        "sketchtree: There are files already of 1 of the 2 trees, such as out/b.glb. With --resume those made of the same drawings by the same "
        "options are kept and the others are made anew; or name another --out.\n"
    )
    assert files(at / "out") == {"b.glb": b"mine"}


def test_names_that_would_be_one_file_get_their_extensions_and_then_numbers(at):
    folder = few(at, "oak.svg", "OAK.svgz", "batch.svg", "elm.report.svg", "elm.svg", "oak.SVG", "fir.svg")
    assert run(["batch", folder, "--out", "out", "--format", "json", *QUICK]) == 0
    outputs = {name: Path(row["output"]).name for name, row in rows(at / "out").items()}
    assert outputs["fir.svg"] == "fir.json" and outputs["batch.svg"] == "batch.svg.json"
    assert outputs["OAK.svgz"] == "OAK.svgz.json" and {outputs["oak.SVG"], outputs["oak.svg"]} == {"oak.SVG.json", "oak.svg-2.json"}
    assert outputs["elm.report.svg"] == "elm.report.svg.json" and outputs["elm.svg"] == "elm.svg.json"
    assert len(files(at / "out")) == 2 * 7 + 2


def test_one_of_several_drawings_in_a_file_is_named_as_build_names_it(at):
    (at / "two.ndjson").write_text(2 * '{"word": "tree", "drawing": [[[50, 50], [100, 10]], [[50, 80], [60, 30]]]}\n')
    assert run(["batch", "two.ndjson#1", "two.ndjson#2", "two.ndjson", "--out", "out", "--format", "swc", *QUICK]) == 1
    assert [(name, row["status"]) for name, row in rows(at / "out").items()] == [
        ("two.ndjson", "failed"), ("two.ndjson#1", "made"), ("two.ndjson#2", "made")
    ]  # fmt: skip
    assert {"two-1.swc", "two-2.swc"} <= set(files(at / "out"))
    assert run(["batch", "two.ndjson#2", "--out", "out", "--format", "swc", "--resume", *QUICK]) == 0
    assert rows(at / "out")["two.ndjson#2"]["status"] == "kept"


def test_several_files_and_unquoted_patterns_are_taken_too(at):
    few(at, "a.svg")
    (at / "in" / "b").mkdir()
    (at / "in" / "b" / "a.svg").write_text(FORK)
    assert run(["batch", "in/a.svg", "in/b/a.svg", "--out", "out", "--format", "swc", *QUICK]) == 0
    assert {"a.swc", "b/a.swc"} <= set(files(at / "out"))


def test_results_in_the_same_folder_are_not_taken_for_drawings(at):
    few(at, "a.svg")
    for resume in ([], ["--resume"]):
        assert run(["batch", "in/*", "--out", "in", "--format", "json", "--preview", *resume, *QUICK]) == 0
        assert list(rows(at / "in")) == ["a.svg"]


def test_skeletons_are_written_beside_the_trees_and_the_summary_where_it_is_wanted_too(at):
    assert run(["batch", few(at, "a.svg"), "--out", "out", "--skeleton", "--report", "r.json", *QUICK]) == 0
    assert set(files(at / "out")) == {"a.glb", "a.swc", "a.report.json", "batch.json", "batch.csv"}
    assert (at / "r.json").read_bytes() == (at / "out" / "batch.json").read_bytes()


def test_errors_are_told_even_when_quiet_and_a_line_a_drawing_otherwise(at, capfd):
    folder = few(at, "a.svg")
    (at / "in" / "broken.svg").write_text("?")
    (at / "in" / "notes.txt").write_text("?")
    assert run(["batch", folder, "--out", "out", *QUICK]) == 1
    said = capfd.readouterr()
    assert said.err.startswith(f"sketchtree: {folder}/broken.svg: {BROKEN}") and said.err.count("\n") == 1 and said.out == ""
    assert run(["batch", folder, "--out", "out", "--resume", *QUICK[:-1]]) == 1
    lines = capfd.readouterr().err.splitlines()
    assert lines[0] == "1 other file passed over: no drawings by their names, or results in out."
    assert lines[1].startswith(f"{folder}/a.svg → out/a.glb: kept, ") and lines[2].startswith("sketchtree: ") and len(lines) == 4
    assert lines[3].startswith("out: 2 drawings, 1 kept, 1 failed, ")


def test_the_json_log_has_an_object_a_drawing_with_all_facts(at, capfd):
    folder = few(at, "a.svg")
    (at / "in" / "broken.svg").write_text("?")
    assert run(["batch", folder, "--out", "out", "--json-log", *QUICK[:-1]]) == 1
    lines = [json.loads(line) for line in capfd.readouterr().err.splitlines()]
    assert [line["event"] for line in lines] == ["file", "file", "done"] and [line["status"] for line in lines[:2]] == ["made", "failed"]
    assert lines[1]["error"].startswith(BROKEN) and lines[2]["failed"] == 1


def test_a_fault_of_ours_is_that_drawings_failure_with_its_traceback(at, capfd, monkeypatch):
    work = batch_tree._built

    def faulty(order):
        if order.name == "a":
            raise ZeroDivisionError("by\nzero")
        return work(order)

    monkeypatch.setattr(batch_tree, "_built", faulty)
    assert run(["batch", few(at, "a.svg", "b.svg"), "--out", "out", *QUICK]) == 1
    told = rows(at / "out")
    assert told["a.svg"]["error"] == (
        "SketchTree failed on it (ZeroDivisionError: by zero). Please report it, with the drawing and the traceback in batch.json."
    )
    assert "faulty" in told["a.svg"]["traceback"] and told["b.svg"]["status"] == "made"
    assert "Traceback" not in capfd.readouterr().err


def killed_at_b(order, program=None):
    """As a machine short of memory would: the process is gone, without a word."""
    if order.name == "b":
        os.kill(os.getpid(), signal.SIGKILL)
    return batch_tree.make_tree(order, program)


def test_a_process_that_dies_costs_only_the_drawing_it_was_at(at, monkeypatch):
    monkeypatch.setattr(batch_crew, "make_tree", killed_at_b)
    assert run(["batch", few(at, "a.svg", "b.svg", "c.svg"), "--out", "out", "--jobs", "2", *QUICK]) == 1
    told = rows(at / "out")
    assert [row["status"] for row in told.values()] == ["made", "failed", "made"]
    assert told["b.svg"]["error"] == (
        "The process that built it was ended from outside, perhaps for want of memory. "
        "Build it by itself, with a smaller --max-segments or more memory, or leave it out."
    )


def test_ctrl_c_ends_with_130_and_keeps_what_is_done(at, capfd, monkeypatch):
    work = batch_crew.make_tree

    def interrupted(order, program=None):
        if order.name == "b":
            raise KeyboardInterrupt
        return work(order, program)

    monkeypatch.setattr(batch_crew, "make_tree", interrupted)
    folder = few(at, "a.svg", "b.svg")
    assert run(["batch", folder, "--out", "out", *QUICK]) == 130
    assert capfd.readouterr().err.strip() == "sketchtree: stopped; nothing was left half-written."
    assert set(files(at / "out")) == {"a.glb", "a.report.json", "batch.json", "batch.csv"}
    assert [row["status"] for row in rows(at / "out").values()] == ["made", "not reached"]
    monkeypatch.setattr(batch_crew, "make_tree", work)
    assert run(["batch", folder, "--out", "out", "--resume", *QUICK]) == 0
    assert [row["status"] for row in rows(at / "out").values()] == ["kept", "made"]


def test_what_other_processes_finish_after_ctrl_c_is_told_too(at, monkeypatch):
    def interrupted(self, row):
        raise KeyboardInterrupt

    monkeypatch.setattr("sketchtree.commands.batch.Files.tell", interrupted)
    names = [f"{letter}.svg" for letter in "abcdefghijkl"]
    assert run(["batch", few(at, *names), "--out", "out", "--jobs", "2", *QUICK]) == 130
    made = {name for name, row in rows(at / "out").items() if row["status"] == "made"}
    assert {path.name.split(".")[0] for path in (at / "out").glob("*.report.json")} == {Path(name).stem for name in made} != set()


def test_every_file_that_build_writes_a_batch_writes_too():
    assert {f".{kind}" for kind in FORMATS} == set(WHOLE)


def test_a_set_of_files_is_told_by_its_first_and_kept_only_whole(at, monkeypatch):
    monkeypatch.setattr(tree_asset, "make_levels", lambda model, **_: (Level(model.meshes),) * 4)
    few(at, "a.svg")
    again = ["batch", "in/a.svg", "--out", "out", "--levels", "apart", "--format", "gltf", *QUICK]
    assert run(again) == 0
    assert rows(at / "out")["a.svg"]["output"] == str(Path("out", "a_LOD0.gltf")) and not (at / "out" / "a.gltf").exists()
    assert run([*again, "--resume"]) == 0 and rows(at / "out")["a.svg"]["status"] == "kept"
    (at / "out" / "a_LOD2.bin").unlink()
    assert run(again) == 2
    assert run([*again, "--resume"]) == 0 and rows(at / "out")["a.svg"]["status"] == "made"
    assert run([*again, "--resume", "--leaves", "instanced"]) == 0 and rows(at / "out")["a.svg"]["status"] == "made"


def test_drawings_called_like_a_file_of_a_set_keep_their_extensions(at):
    names = {order.name for order in orders([few(at, "a.svg", "a_LOD1.svg", "b.svg")], Manner("out", str(at), "glb", 0, ReadingOptions(), TreeOptions(), files=FileOptions(pack="game")))[0]}
    assert names == {"a.svg", "a_LOD1.svg", "b"}


def test_a_solid_without_its_package_is_refused_before_the_batch(at, capfd, monkeypatch):
    monkeypatch.setitem(sys.modules, "manifold3d", None)
    few(at, "a.svg")
    assert run(["batch", "in/a.svg", "--out", "out", "--solid", *QUICK]) == 2
    assert "A solid needs the package `manifold3d`." in capfd.readouterr().err and not (at / "out").exists()


BAD = {
    "no match": (["none/*.svg"], "`none/*.svg` matches no file. Put a pattern in quotes, such as 'sketches/**/*.svg', or name a folder of drawings."),
    "empty folder": (["empty"], "`empty` is a folder without a drawing. Put a pattern in quotes, such as 'sketches/**/*.svg', or name a folder of drawings."),
    "no drawing": (["*.txt"], "`*.txt` matches one file, but no drawing. Drawings are .svg, .svgz, "),
    "only results": (["*.json", "--out", "."], "All drawings that `*.json` matches lie in `--out .` itself, among the results. Name another folder for --out."),
    "out is a file": (["a.svg", "--out", "a.txt"], "`--out a.txt` is a file. Name a folder; it is made if there is none."),
    "out below a file": (["a.svg", "--out", "a.txt/out"], "The folder a.txt/out can't be made (not a directory). Choose a place you may write to."),
    "jobs 0": (["a.svg", "--jobs", "0"], "`--jobs 0` is no number of processes. Give 1 to 256."),
    "jobs and scheduler": (["a.svg", "--jobs", "2", "--scheduler", "tcp://x:1"], "`--jobs` and `--scheduler` exclude each other. Leave one out."),
    "two of one name": (["a.svg", "--format", "png", "--preview"], "`--preview` and `--format png` would write the same files. Leave --preview out."),
    "leaf": (["a.svg", "--leaf", "nonesuch"], "There is no leaf called “nonesuch”. "),
    "template": (["a.svg", "--template", "nonesuch"], "There is no exemplar called 'nonesuch' in exemplars.h5. "),
    "light": (["a.svg", "--light", "2"], "`--light 2` is out of range. Give 0 to 1."),
    "obstacle": (["a.svg", "--obstacle", "no.glb"], "There is no mesh file no.glb. "),
    "pack": (["a.svg", "--format", "obj", "--pack", "game"], "`--pack game` writes GLB files, not `.obj`. Write `--format glb`."),
    "levels": (["a.svg", "--format", "ply", "--levels", "together"], "`.ply` files hold one level of detail. Write .glb, .gltf or .usd, or ask for `--levels apart`."),
    "report": (["a.svg", "--report", "a.svg"], "`--report a.svg` would overwrite a drawing or a result. Give it another name."),
}


@pytest.mark.parametrize("case", BAD)
def test_bad_input_gets_one_paragraph_and_status_2_and_no_file(case, at, capfd):
    (at / "a.svg").write_text(FORK)
    (at / "a.txt").write_text("?")
    (at / "b.json").write_text("{}")
    (at / "empty").mkdir()
    before = files(at)
    arguments, message = BAD[case]
    assert run(["batch", "--out", "out", *QUICK, *arguments]) == 2
    said = capfd.readouterr()
    assert said.err.startswith(f"sketchtree: {message}") and said.err.count("\n") == 1 and said.err.endswith((".\n", "?\n")) and said.out == ""
    assert files(at) == before and not (at / "out").exists()


@pytest.mark.filterwarnings("default")  # those of distributed and tornado are not ours
def test_a_cluster_makes_the_same_bytes(made, drawings, tmp_path):
    from distributed import LocalCluster

    from sketchtree.templates.making.fingerprint import fingerprint

    fingerprint.cache_clear()  # the sources may have been edited since another test asked
    with LocalCluster(n_workers=1, threads_per_worker=1, processes=True, dashboard_address=":0") as running:
        again = ["batch", f"{drawings}/**/*", "--out", str(tmp_path / "out"), "--scheduler", running.scheduler_address, "--seed", "3", *QUICK]
        assert run(again) == 1
    assert trees(tmp_path / "out") == trees(made)


def test_a_worker_that_does_not_see_the_folder_refuses(tmp_path):
    from sketchtree.batch import Manner, TreeOrder
    from sketchtree.options import ReadingOptions, TreeOptions
    from sketchtree.templates.making.fingerprint import fingerprint

    order = TreeOrder("a.svg", "a", Manner("gone", str(tmp_path), "glb", 0, ReadingOptions(), TreeOptions()))
    refusal = batch_tree.make_tree(order, fingerprint())
    assert refusal.message == f"A worker does not see the folder {tmp_path / 'gone'}."
    assert refusal.remedy == "Put drawings and --out on a disk that all workers share, under the same path."
    assert batch_tree.make_tree(order, "another").message.startswith("A worker runs another SketchTree")
