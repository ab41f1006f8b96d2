"""Told to end, the studio ends: at any time, without a traceback, without a process that stays, and nothing of the drawing is lost."""

import os
import signal
import subprocess
import sys
import threading
import time
from contextlib import contextmanager
from pathlib import Path
from urllib.parse import urlsplit

import httpx
import pytest
from page_line import line, say
from talking import drawn, stroke

from sketchtree.studio import messages
from sketchtree.studio.recovery import journal_of

pytestmark = pytest.mark.skipif(os.name != "posix", reason="signals as POSIX has them")
PATIENCE = 60.0  # seconds; nothing here is asserted to be quick


@contextmanager
def studio(folder: Path):
    """The program in a session of its own, as at a terminal; with the engine that makes trees."""
    (folder / "page").mkdir()
    process = subprocess.Popen(
        [sys.executable, str(Path(__file__).with_name("pageless.py")), str(folder / "page"), "studio", "oak.sketchtree", "--no-browser"],
        cwd=folder, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, start_new_session=True,
    )  # fmt: skip
    try:
        yield process
    finally:
        if process.poll() is None:
            os.killpg(process.pid, signal.SIGKILL)
        process.wait(PATIENCE)
        process.stdout.close(), process.stderr.close()


def end(process: subprocess.Popen, how: str) -> tuple[int, str]:
    """(exit status, what it said on stderr) after Ctrl-C at the terminal, which all its processes hear, or after being told alone."""
    os.killpg(process.pid, signal.SIGINT) if how == "ctrl-c" else process.send_signal(signal.SIGTERM)
    _, said = process.communicate(timeout=PATIENCE)
    return process.returncode, said


def stay(session: int) -> list[str]:
    """Processes of a session that are there for good, zombies that nobody has buried aside: one that has ended may still be listed for a moment."""
    until = time.monotonic() + PATIENCE
    while (found := _listed(session)) and time.monotonic() < until:
        time.sleep(0.05)
    return found


def _listed(session: int) -> list[str]:
    found = subprocess.run(["ps", "-eo", "sid=,stat=,args="], capture_output=True, text=True, check=True).stdout.splitlines()
    return [one for one in found if one.split()[0] == str(session) and not one.split()[1].startswith("Z")]


def ask_for_pictures(address: str) -> None:
    base, token = address.split("/?token=")
    cookie = f"sketchtree-{urlsplit(base).port}={token}"

    def ask(name: str) -> None:
        try:
            httpx.get(f"{base}/picture/template/{name}.png", headers={"Cookie": cookie}, timeout=PATIENCE, trust_env=False)
        except httpx.HTTPError:
            pass  # it ended first

    for name in ("silver_birch", "english_oak", "stone_pine"):
        threading.Thread(target=ask, args=(name,), daemon=True).start()


@pytest.fixture
def shelf(tmp_path, monkeypatch):
    monkeypatch.setenv("SKETCHTREE_RECOVERY", str(tmp_path / "shelf"))
    return tmp_path / "shelf"


@pytest.mark.parametrize("how", ["ctrl-c", "terminated"])
def test_while_trees_and_pictures_are_being_made(tmp_path, shelf, how):
    with studio(tmp_path) as process:
        address = process.stdout.readline().strip().removeprefix("Studio: ")
        with line(address) as page:
            trunk = messages.Strokes(label="branch", put=[stroke("trunk", 300, 500, 302, 380, 298, 250)])
            say(page, trunk, *(drawn(f"s{k}") for k in range(3)), messages.Choose(options={"generations": 4}))
            ask_for_pictures(address)
            while '"s2"' not in str(page.recv(timeout=PATIENCE)):
                pass
            status, said = end(process, how)
        assert (status, said) == (0, "") and stay(process.pid) == []
    assert not list(shelf.glob("*.key"))
    journal = journal_of(tmp_path / "oak.sketchtree")
    assert list(journal.play().history.document.strokes) == ["trunk", "s0", "s1", "s2"]
    journal.close()


@pytest.mark.parametrize("how", ["ctrl-c", "terminated"])
def test_while_it_starts(tmp_path, shelf, how):
    with studio(tmp_path) as process:
        while not list(shelf.glob("*.lock")) and process.poll() is None:  # its own work begins
            pass
        status, said = end(process, how)
        assert status in (0, 130) and "Traceback" not in said and stay(process.pid) == []
