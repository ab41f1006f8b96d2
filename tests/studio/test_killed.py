"""Whatever ends the program, only the stroke in hand is lost."""

import json
import os
import signal
import subprocess
import sys
from contextlib import contextmanager
from pathlib import Path

import pytest
from talking import drawn
from websockets.exceptions import ConnectionClosed
from websockets.sync.client import connect

from sketchtree.studio import messages
from sketchtree.studio.outbox import encode


@contextmanager
def alone(file: Path, shelf: Path):
    """(the process, its page's WebSocket)."""
    environment = os.environ | {"SKETCHTREE_RECOVERY": str(shelf)}
    process = subprocess.Popen([sys.executable, str(Path(__file__).with_name("alone.py")), str(file)], stdout=subprocess.PIPE, text=True, env=environment)
    try:
        base, _, token = process.stdout.readline().strip().partition("/?token=")
        port = base.rpartition(":")[2]
        with connect(f"ws://127.0.0.1:{port}/ws", origin=base, additional_headers={"Cookie": f"sketchtree-{port}={token}"}, proxy=None) as page:
            page.send(encode(messages.Hello(version=messages.VERSION)))
            yield process, page
    finally:
        process.kill()
        process.wait(10)
        process.stdout.close()


def told(page, kind: str) -> dict:
    while True:
        said = page.recv(timeout=20)
        if isinstance(said, str) and json.loads(said)["type"] == kind:
            return json.loads(said)


def test_killed_it_loses_nothing_that_was_answered(tmp_path):
    file, shelf = tmp_path / "oak.sketchtree", tmp_path / "shelf"
    with alone(file, shelf) as (process, page):
        told(page, "changed")
        for k in range(20):
            page.send(encode(drawn(f"s{k}")))
            told(page, "changed")
        page.send(encode(messages.Choose(options={"template": "oak"})))
        told(page, "changed")
        page.send(encode(messages.Undo()))
        told(page, "changed")
        page.send(encode(messages.Sketching(stroke=drawn("in hand").put[0])))
        os.kill(process.pid, signal.SIGKILL)
    with alone(file, shelf) as (_, page):
        event = told(page, "changed")
        assert [one["id"] for one in event["put"]] == [f"s{k}" for k in range(20)]
        assert event["undo"] == "branch" and event["redo"] == "template" and event["options"]["template"] == "auto"
        assert told(page, "welcome")["recovered"]


def test_killed_in_a_storm_of_strokes_it_gives_back_every_one_that_was_answered(tmp_path):
    file, shelf = tmp_path / "oak.sketchtree", tmp_path / "shelf"
    with alone(file, shelf) as (process, page):
        told(page, "changed")
        for k in range(300):
            page.send(encode(drawn(f"s{k}")))
        answered = {one["id"] for _ in range(40) for one in told(page, "changed")["put"]}
        os.kill(process.pid, signal.SIGKILL)
        with pytest.raises(ConnectionClosed):
            while True:
                page.recv(timeout=20)
    with alone(file, shelf) as (_, page):
        found = [one["id"] for one in told(page, "changed")["put"]]
        assert answered <= set(found) and found == [f"s{k}" for k in range(len(found))]
