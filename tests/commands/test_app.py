"""How commands end, and what they say on the way."""

import json
from pathlib import Path

from sketchtree import pipeline
from sketchtree.commands.app import run
from sketchtree.commands.progress import Progress

CURVY = Path(__file__).resolve().parents[2] / "examples" / "curvy.svg"


def test_ctrl_c_ends_with_130_and_leaves_nothing_half_written(tmp_path, capfd, monkeypatch):
    def interrupted(*_, **__):
        raise KeyboardInterrupt

    monkeypatch.setattr(pipeline, "complete", interrupted)
    assert run(["build", str(CURVY), "-o", str(tmp_path / "t.glb"), "--method", "flat", "--quiet"]) == 130
    assert list(tmp_path.iterdir()) == []
    assert capfd.readouterr().err.strip() == "sketchtree: stopped; nothing was left half-written."


def test_an_unknown_option_ends_with_2(capfd):
    assert run(["build", str(CURVY), "-o", "t.glb", "--no-such-option"]) == 2
    assert "--no-such-option" in capfd.readouterr().err


def test_quiet_says_nothing(tmp_path, capfd):
    assert run(["infer", str(CURVY), "-o", str(tmp_path / "t.swc"), "--method", "flat", "--quiet"]) == 0
    said = capfd.readouterr()
    assert said.out == "" and said.err == ""


def test_the_json_log_is_one_object_a_line(tmp_path, capfd):
    assert run(["infer", str(CURVY), "-o", str(tmp_path / "t.swc"), "--method", "flat", "--json-log"]) == 0
    lines = [json.loads(line) for line in capfd.readouterr().err.splitlines()]
    assert [line["stage"] for line in lines if line["event"] == "stage"] == ["read", "match", "infer", "export"]
    assert lines[-1]["event"] == "done" and "t.swc" in lines[-1]["text"]


def test_without_a_terminal_every_stage_is_a_plain_line(capfd):
    progress = Progress(("read", "infer"))
    with progress.running():
        progress("read")
        progress("infer")
        progress.say("Done.")
    assert capfd.readouterr().err.splitlines() == ["read …", "infer …", "Done."]


def test_a_picture_that_cannot_be_drawn_is_a_warning_and_the_tree_is_written(tmp_path, capfd, monkeypatch):
    monkeypatch.setattr("sketchtree.view.preview", lambda *_, **__: (False, "no OpenGL here; install libgl1"))
    arguments = ["build", str(CURVY), "-o", str(tmp_path / "t.glb"), "--preview", str(tmp_path / "t.png")]
    assert run([*arguments, "--method", "flat", "--generations", "0"]) == 0
    assert (tmp_path / "t.glb").exists() and not (tmp_path / "t.png").exists()
    assert "t.png was not drawn: no OpenGL here; install libgl1" in capfd.readouterr().err
