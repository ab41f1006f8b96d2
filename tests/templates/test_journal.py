"""A build that was stopped leaves the old file, keeps what is finished, and goes on from there."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from sketchtree.errors import TemplateError
from sketchtree.templates.store.database import Database
from sketchtree.templates.making.journal import Journal
from sketchtree.templates.making.order import Refusal, make_block
from sketchtree.templates.making.regenerate import orders, regenerate


@pytest.fixture
def recipes(tmp_path, minimal):
    (tmp_path / "recipes").mkdir()
    (tmp_path / "recipes" / "stick.toml").write_text(minimal)
    return tmp_path / "recipes"


@pytest.fixture
def whole(tmp_path, recipes):
    """The bytes of a build that nobody stopped."""
    regenerate(tmp_path / "whole.h5", orders(recipes, count=6))
    return (tmp_path / "whole.h5").read_bytes()


def _stopped_after(wanted, out, count, *, jobs=1):
    heard = []

    def progress(name):
        heard.append(name)
        if len(heard) == count:
            raise KeyboardInterrupt

    said = []
    with pytest.raises(KeyboardInterrupt):
        regenerate(out, wanted, jobs=jobs, progress=progress, say=said.append)
    return said


@pytest.mark.parametrize("jobs", [1, 2])
def test_a_stopped_build_leaves_the_old_file_and_goes_on_to_the_same_bytes(tmp_path, recipes, whole, jobs):
    out, wanted, said = tmp_path / "db.h5", orders(recipes, count=6), []
    out.write_bytes(b"precious")
    (last,) = _stopped_after(wanted, out, 3, jobs=jobs)
    assert out.read_bytes() == b"precious"
    parts = Journal(out)
    kept = parts.count(wanted)
    assert parts.folder.name == ".db.h5.parts" and 3 <= kept <= 6
    assert last == f"{kept} finished exemplars are kept in {parts.folder}; the same command goes on from there"
    assert sorted(p.name for p in tmp_path.iterdir() if p.name.startswith(".")) == [".db.h5.parts"], "no torn file stays"
    regenerate(out, wanted, say=said.append)
    assert said == [f"taking up {kept} of 6 exemplars from an earlier run ({parts.folder})"]
    assert out.read_bytes() == whole and not parts.folder.exists()


def test_what_was_kept_is_not_made_again(tmp_path, recipes, whole, monkeypatch):
    out, wanted = tmp_path / "db.h5", orders(recipes, count=6)
    _stopped_after(wanted, out, 4)
    made = []
    monkeypatch.setattr("sketchtree.templates.making.crew.make_block", lambda order: made.append(order.name) or make_block(order))
    regenerate(out, wanted)
    assert made == ["stick_5", "stick_6"] and out.read_bytes() == whole


@pytest.mark.parametrize("damage", [lambda data: data[: len(data) // 2], lambda data: b"", lambda data: data[:3000] + b"\xff" * 64 + data[3064:]])
def test_a_torn_part_is_made_anew(tmp_path, recipes, whole, damage):
    out, wanted = tmp_path / "db.h5", orders(recipes, count=6)
    _stopped_after(wanted, out, 4)
    for part in list(Journal(out).folder.iterdir())[:2]:
        part.write_bytes(damage(part.read_bytes()))
    regenerate(out, wanted)
    assert out.read_bytes() == whole


def test_a_part_serves_only_its_own_recipe_seed_and_program(tmp_path, recipes, minimal, monkeypatch):
    out, wanted = tmp_path / "db.h5", orders(recipes, count=2)
    _stopped_after(wanted, out, 2)
    assert all(map(Journal(out).has, wanted))
    assert not any(map(Journal(out).has, orders(recipes, count=2, seed=1)))
    (recipes / "stick.toml").write_text(minimal.replace("height = 4.0", "height = 5.0"))
    assert not any(map(Journal(out).has, orders(recipes, count=2)))
    monkeypatch.setattr("sketchtree.templates.making.journal.fingerprint", lambda: "another")
    assert not any(map(Journal(out).has, wanted))


def test_an_error_of_the_recipe_names_its_remedy_wherever_it_is_made(tmp_path, recipes, monkeypatch):
    wanted = orders(recipes)
    monkeypatch.setattr("sketchtree.templates.making.crew.make_block", lambda order: Refusal("It will not grow.", "Water it."))
    with pytest.raises(TemplateError, match=r"^It will not grow\. Water it\.$"):
        regenerate(tmp_path / "db.h5", wanted)
    assert not Journal(tmp_path / "db.h5").folder.exists() and not (tmp_path / "db.h5").exists()


def _parts(folder):
    return len(list(folder.glob("*.npz"))) if folder.is_dir() else 0


def _runs(process):
    """Whether there is such a process that is no zombie."""
    try:
        return Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except OSError:
        return False


@pytest.mark.skipif(sys.platform == "win32", reason="signals")
@pytest.mark.parametrize(("how", "status"), [(signal.SIGINT, 130), (signal.SIGKILL, -signal.SIGKILL)])
def test_a_command_that_is_stopped_or_killed_leaves_the_old_file(tmp_path, recipes, how, status):
    out = tmp_path / "db.h5"
    regenerate(out, orders(recipes, count=1))
    before, folder = out.read_bytes(), Journal(out).folder
    typed = [sys.executable, "-m", "sketchtree", "templates", "build", "--recipes", recipes, "--count", "3000", "--out", out, "--jobs", "1"]
    ours = signal.signal(signal.SIGINT, signal.default_int_handler)  # a shell's background job would have the command ignore Ctrl-C
    try:
        run = subprocess.Popen(list(map(str, typed)), stderr=subprocess.PIPE, text=True)
    finally:
        signal.signal(signal.SIGINT, ours)
    with run:
        deadline = time.monotonic() + 60
        while _parts(folder) < 3 and time.monotonic() < deadline and run.poll() is None:
            time.sleep(0.02)
        os.kill(run.pid, how)
        said = run.communicate(timeout=60)[1]
    assert run.returncode == status and "Traceback" not in said
    assert out.read_bytes() == before and Database(out).names == ("stick",)
    assert _parts(folder) >= 3
    if how == signal.SIGINT:
        assert "finished exemplars are kept in" in said and said.splitlines()[-1] == "sketchtree: stopped; nothing was left half-written."


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="reads /proc")
def test_workers_end_with_a_killed_parent(tmp_path, recipes):
    typed = [sys.executable, "-m", "sketchtree", "templates", "build", "--recipes", recipes, "--count", "3000", "--out", tmp_path / "db.h5", "--jobs", "2"]
    with subprocess.Popen(list(map(str, typed)), stderr=subprocess.DEVNULL) as run:
        deadline = time.monotonic() + 60
        while _parts(Journal(tmp_path / "db.h5").folder) < 3 and time.monotonic() < deadline:
            time.sleep(0.05)
        children = Path(f"/proc/{run.pid}/task/{run.pid}/children").read_text()
        workers = [int(child) for child in children.split() if b"spawn_main" in Path(f"/proc/{child}/cmdline").read_bytes()]
        run.kill()
    assert len(workers) == 2
    while any(map(_runs, workers)) and time.monotonic() < deadline:
        time.sleep(0.05)
    assert not any(map(_runs, workers))
