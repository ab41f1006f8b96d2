"""`sketchtree studio`: what it prints, and what it says where it can't start."""

import json
import signal

import pytest

from sketchtree.commands.app import run
from sketchtree.commands.studio import studio
from sketchtree.errors import OptionError
from sketchtree.studio import built, crew, serving

URL = "http://127.0.0.1:1/?token=x"


@pytest.fixture
def started(monkeypatch, tmp_path):
    """Starts nothing: tells an address, and is stopped by Ctrl-C. What it was given, and the addresses that a browser opened."""
    given, opened = [], []

    async def serve(engine, start, page, told):
        given.append(start)
        told(URL)
        raise KeyboardInterrupt

    (tmp_path / "dist").mkdir()
    (tmp_path / "dist" / "index.html").write_text("")
    monkeypatch.setattr(serving, "serve", serve)
    monkeypatch.setattr(built, "page_folder", lambda: tmp_path / "dist")
    monkeypatch.setattr("webbrowser.open", opened.append)
    monkeypatch.setattr("threading.Thread.start", lambda thread: thread.run())
    before = signal.getsignal(signal.SIGTERM)
    yield given, opened
    signal.signal(signal.SIGTERM, before)


def test_it_prints_one_line_opens_the_browser_and_ends_well_by_ctrl_c(started, capfd, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert run(["studio", "--quiet"]) == 0
    said = capfd.readouterr()
    assert said.out == f"Studio: {URL}\n" and said.err == "" and started[1] == [URL]
    assert started[0][0] == serving.Start(None, tmp_path, 0, 0)


def test_without_a_browser_it_only_prints(started, capfd):
    assert run(["studio", "--no-browser", "--json-log", "--port", "8123", "--seed", "7"]) == 0
    said = capfd.readouterr()
    assert said.out == f"Studio: {URL}\n" and started[1] == [] and json.loads(said.err) == {"event": "ready", "text": f"Studio: {URL}"}
    assert (started[0][0].port, started[0][0].seed) == (8123, 7)


def test_a_file_is_opened_in_its_own_folder_and_a_project_may_be_new(started, tmp_path):
    (tmp_path / "oak.svg").write_text("<svg/>")
    assert run(["studio", str(tmp_path / "oak.svg"), "--no-browser"]) == run(["studio", str(tmp_path / "new.sketchtree"), "--no-browser"]) == 0
    assert [(start.file, start.folder) for start in started[0]] == [(tmp_path / name, tmp_path) for name in ("oak.svg", "new.sketchtree")]


@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("nothing.svg", "nothing.svg does not exist. Check the path, or name a new project NAME.sketchtree in a folder that is there."),
        ("no/new.sketchtree", "new.sketchtree does not exist. Check the path, or name a new project NAME.sketchtree in a folder that is there."),
        (".", " is a folder. Give a drawing or a project in it, or start the studio in it."),
        (".hidden.svg", ".hidden.svg is hidden, or no name that a file can have everywhere. Rename it."),
    ],
)
def test_a_file_that_cannot_be_opened_is_told(started, capfd, tmp_path, name, said):
    (tmp_path / ".hidden.svg").write_text("<svg/>")
    assert run(["studio", str(tmp_path / name), "--no-browser"]) == 2
    assert capfd.readouterr().err.endswith(f"{said}\n") and started[0] == []


def test_without_its_extra_it_says_how_to_install_it(capfd, monkeypatch):
    monkeypatch.setattr("importlib.util.find_spec", lambda name: None)
    assert run(["studio"]) == 2
    assert capfd.readouterr().err == "sketchtree: `sketchtree studio` needs starlette, uvicorn, websockets, msgspec. Install it: pip install 'sketchtree[studio]'.\n"


def test_without_its_page_it_says_what_to_do(capfd, monkeypatch, tmp_path):
    monkeypatch.setattr(built, "page_folder", lambda: (_ for _ in ()).throw(OptionError("There is no page.", remedy="Build it.")))
    assert run(["studio"]) == 2
    assert capfd.readouterr().err == "sketchtree: There is no page. Build it.\n"


def test_a_report_says_how_long_it_ran(started, tmp_path):
    assert run(["studio", "--no-browser", "--report", str(tmp_path / "r.json"), "--seed", "3"]) == 0
    record = json.loads((tmp_path / "r.json").read_text())
    assert record["command"] == "studio" and record["seed"] == 3 and record["options"] == {"file": None, "port": 0} and record["seconds"]["total"] >= 0


def test_a_signal_to_end_is_an_end_like_ctrl_c(started):
    assert run(["studio", "--no-browser"]) == 0
    with pytest.raises(KeyboardInterrupt):
        signal.raise_signal(signal.SIGTERM)


def test_its_engine_makes_trees():
    assert callable(crew.Crew) and studio.name == "studio"
