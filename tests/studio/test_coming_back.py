"""A studio that was killed is found again by the pages that are open; one that ended in order is not."""

import os
import signal
import socket
import stat
import subprocess
import sys
from contextlib import contextmanager
from pathlib import Path
from urllib.parse import parse_qs, urlsplit

import pytest
from page_line import line, say
from running import running
from talking import drawn
from websockets.exceptions import InvalidStatus

from sketchtree.studio import key as keys
from sketchtree.studio import messages
from sketchtree.studio.recovery import journal_of


@pytest.fixture(autouse=True)
def shelf(tmp_path, monkeypatch):
    monkeypatch.setenv("SKETCHTREE_RECOVERY", str(tmp_path / "shelf"))
    return tmp_path / "shelf"


@contextmanager
def studio(file: Path):
    """(process, address) of a studio of its own."""
    process = subprocess.Popen([sys.executable, str(Path(__file__).with_name("alone.py")), str(file)], stdout=subprocess.PIPE, text=True)
    try:
        yield process, process.stdout.readline().strip()
    finally:
        process.kill()
        process.wait(10)
        process.stdout.close()


def key_of(address: str, folder: Path) -> keys.Key:
    return keys.Key(urlsplit(address).port, parse_qs(urlsplit(address).query)["token"][0], str(folder))


def left(file: Path | None, key: keys.Key, **how) -> Path:
    """As if a studio had ended suddenly."""
    journal = journal_of(file, **how)
    journal.keep_key(key)
    journal.close()
    return journal.path.with_suffix(".key")


def test_a_page_that_is_open_when_the_studio_is_killed_comes_back_and_sends_what_it_has(tmp_path):
    file = tmp_path / "oak.sketchtree"
    with studio(file) as (process, address):
        with line(address) as page:
            say(page, drawn("a"))
            while '"a"' not in str(page.recv(timeout=20)):
                pass
        os.kill(process.pid, signal.SIGKILL)
        process.wait(10)
    with studio(file) as (_, again), line(address) as page:
        assert again == address
        say(page, drawn("unsent"))
        heard = ""
        while '"unsent"' not in heard:
            heard += str(page.recv(timeout=20))
        assert '"id":"a"' in heard


def test_after_an_end_in_order_there_is_another_key(tmp_path, shelf):
    file = tmp_path / "oak.sketchtree"
    with studio(file) as (process, address):
        (key,) = shelf.glob("*.key")
        assert keys.kept(key) == key_of(address, tmp_path) and stat.S_IMODE(key.stat().st_mode) == 0o600
        process.send_signal(signal.SIGINT)
        process.wait(20)
    assert list(shelf.glob("*.key")) == []
    with running(tmp_path, file, port=urlsplit(address).port) as again:
        assert again.url != address
        with pytest.raises(InvalidStatus):
            line(address)


def test_a_studio_of_another_port_folder_or_drawing_has_a_key_of_its_own(tmp_path):
    (tmp_path / "other").mkdir()
    file, token = tmp_path / "oak.sketchtree", "t" * 43
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        left(file, keys.Key(taken.getsockname()[1], token, str(tmp_path)))
        with running(tmp_path, file) as found:
            assert found.token != token and found.port != taken.getsockname()[1]
    left(file, keys.Key(found.port, token, str(tmp_path / "other")))
    with running(tmp_path, file) as found:
        assert found.token != token
    left(file, keys.Key(found.port, token, str(tmp_path)))
    with running(tmp_path, tmp_path / "birch.sketchtree") as other:
        assert other.token != token
    with running(tmp_path, file, port=other.port) as found:
        assert found.port == other.port and found.token != token
    left(file, keys.Key(found.port, token, str(tmp_path)))
    with running(tmp_path, file, port=found.port) as found:
        assert found.token == token


def test_of_drawings_without_a_name_the_one_of_this_folder_comes_back(tmp_path):
    first = journal_of(None, home=tmp_path / "a")
    second = left(None, keys.Key(1234, "t" * 43, str(tmp_path / "b")), home=tmp_path / "b")
    first.close()
    journal = journal_of(None, home=tmp_path / "b")
    assert journal.path.with_suffix(".key") == second and journal.kept_key().port == 1234
    journal.close()
    journal = journal_of(None, home=tmp_path / "a")
    assert journal.kept_key() is None
    journal.close()


def test_a_key_that_others_could_read_or_that_is_no_plain_file_counts_for_nothing(tmp_path):
    path, key = tmp_path / "k.key", keys.Key(1234, "t" * 43, "/home")
    keys.keep(path, key)
    assert keys.kept(path) == key
    path.chmod(0o640)
    assert keys.kept(path) is None
    keys.keep(path, key)
    (tmp_path / "link.key").symlink_to(path)
    assert keys.kept(tmp_path / "link.key") is None
    keys.keep(tmp_path / "link.key", key)
    assert not (tmp_path / "link.key").is_symlink()
    assert keys.kept(tmp_path) is None and keys.kept(tmp_path / "none") is None


def test_another_users_key_counts_for_nothing(tmp_path, monkeypatch):
    keys.keep(tmp_path / "k.key", keys.Key(1234, "t" * 43, "/home"))
    monkeypatch.setattr(keys.os, "getuid", lambda: os.geteuid() + 1)
    assert keys.kept(tmp_path / "k.key") is None


@pytest.mark.parametrize("key", [keys.Key(0, "t" * 43, ""), keys.Key(70_000, "t" * 43, ""), keys.Key(80, "short", ""), keys.Key(80, "t" * 42 + ";", "")])
def test_a_key_that_makes_no_sense_counts_for_nothing(tmp_path, key):
    keys.keep(tmp_path / "k.key", key)
    assert keys.kept(tmp_path / "k.key") is None


@pytest.mark.parametrize("said", [b"", b"{", b"[]", b"\xff" * 20, b'{"port": 80}', b" " * 20_000])
def test_nonsense_in_its_place_counts_for_nothing(tmp_path, said):
    keys.keep(tmp_path / "k.key", keys.Key(80, "t" * 43, ""))
    (tmp_path / "k.key").write_bytes(said)
    assert keys.kept(tmp_path / "k.key") is None


def test_saved_under_another_name_the_key_goes_with_the_drawing(tmp_path, shelf):
    with running(tmp_path, tmp_path / "oak.sketchtree") as found, found.page() as page:
        say(page, drawn("a"), messages.Save(name="birch"))
        while '"type":"saved"' not in str(page.recv(timeout=20)):
            pass
        assert [path.stem.rpartition("-")[0] for path in shelf.glob("*.key")] == ["birch"]
    assert list(shelf.glob("*.key")) == []
