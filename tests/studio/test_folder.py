"""The page may name files of one folder, by their names alone; drawings are called so that it can name their strokes."""

import tomllib
from pathlib import Path

import pytest

from sketchtree.editing.document import Document
from sketchtree.editing.edits import Edits, Held
from sketchtree.errors import ExportError, SketchError
from sketchtree.sketch.strokes import Stroke
from sketchtree.studio import examples, folder
from sketchtree.studio.folder import Folder, is_name, project_name
from sketchtree.studio.ids import fitting, is_id

ROOT = Path(__file__).resolve().parents[2]


@pytest.mark.parametrize("name", ["oak.svg", "Übung 3.sketchtree", "木.svg", "a.b.c", "console.svg", "🌳"])
def test_these_are_names(name):
    assert is_name(name)


@pytest.mark.parametrize(
    "name", ["", ".", "..", ".x", "a/b", "a\\b", "C:x", "a\x00", "a\n", "x.", "x ", "CON", "con.svg", "Com1.sketchtree", "lpt9", "a*b", "a?b", "<a>", "\ud800", "x" * 241, "木" * 81]
)
def test_these_are_not(name):
    assert not is_name(name)


@pytest.mark.parametrize(("name", "file"), [("oak", "oak.sketchtree"), ("oak.sketchtree", "oak.sketchtree"), ("oak.svg", "oak.svg.sketchtree"), ("A.SketchTree", "A.sketchtree")])
def test_a_project_has_its_extension_once(name, file):
    assert project_name(name) == file


@pytest.mark.parametrize("name", ["", ".sketchtree", "../x", "a/b", "nul", "x" * 300])
def test_no_project_is_called_so(name):
    with pytest.raises(ExportError, match=r"^That is no name for a file\. Give one without a path, a colon, or a dot at its start\.$"):
        project_name(name)


def test_drawings_projects_and_clouds_are_listed_the_newest_first(tmp_path):
    import os

    for age, name in enumerate(("c.sketchtree", "a.svg", "b.PNG", "scan.LAZ", "notes.txt", ".d.svg", "e")):
        (tmp_path / name).write_text("x")
        os.utime(tmp_path / name, ns=(10**18 - age, 10**18 - age))
    (tmp_path / "link.svg").symlink_to("/etc/passwd")
    (tmp_path / "f.svg").mkdir()
    assert Folder(tmp_path).files() == ["c.sketchtree", "a.svg", "b.PNG", "scan.LAZ"]
    assert Folder(tmp_path / "gone").files() == []


def test_a_link_inside_the_folder_is_followed_and_one_out_of_it_is_not(tmp_path):
    home = tmp_path / "home"
    home.mkdir()
    (home / "a.svg").write_text("a")
    (home / "inner.svg").symlink_to("a.svg")
    (tmp_path / "secret.svg").write_text("secret")
    (home / "outer.svg").symlink_to("../secret.svg")
    (home / "out.sketchtree").symlink_to("../new.sketchtree")
    assert Folder(home).read("inner.svg") == b"a"
    with pytest.raises(SketchError, match=r"^outer\.svg leads out of the folder home\. Choose a file of the folder itself\.$"):
        Folder(home).read("outer.svg")
    with pytest.raises(SketchError, match=r"^out\.sketchtree leads out of the folder home\."):
        Folder(home).write("out.sketchtree", b"x")
    assert not (tmp_path / "new.sketchtree").exists()


def test_a_folder_that_is_a_link_itself_is_fine(tmp_path):
    (tmp_path / "real").mkdir()
    (tmp_path / "link").symlink_to("real")
    Folder(tmp_path / "link").write("a.sketchtree", b"a")
    assert (tmp_path / "real" / "a.sketchtree").read_bytes() == b"a" and Folder(tmp_path / "link").name == "real"


def test_a_file_that_is_missing_or_too_large_is_told(tmp_path, monkeypatch):
    with pytest.raises(SketchError, match=r"^a\.svg can't be read: no such file or directory\. Choose another file\.$"):
        Folder(tmp_path).read("a.svg")
    monkeypatch.setattr(folder, "MAX_UPLOAD", 10_000_000)
    with open(tmp_path / "b.svg", "wb") as file:
        file.truncate(20_000_000)
    with pytest.raises(SketchError, match=r"^b\.svg has 20 MB; 10 MB is the most\. Choose a smaller file\.$"):
        Folder(tmp_path).read("b.svg")


def test_strokes_get_names_that_the_page_can_say():
    names = ["fine", "x" * 65, "a\nb", "stroke-1", ""]
    document = Document(strokes={name: Stroke(name, [[0, 0], [1, 1]]) for name in names})
    fit = fitting(document).strokes
    assert list(fit) == ["fine", "stroke-2", "stroke-3", "stroke-1", "stroke-4"] and all(is_id(name) and name == stroke.id for name, stroke in fit.items())
    assert fit["fine"] is document.strokes["fine"]


def test_strokes_that_edits_speak_of_keep_their_names():
    document = Document(strokes={"x" * 65: Stroke("x" * 65, [[0, 0], [1, 1]])}, edits=Edits(held={1: Held(1, [0.5], [1.0])}))
    assert fitting(document) is document


def test_every_example_comes_with_the_package():
    included = tomllib.loads((ROOT / "pyproject.toml").read_text())["tool"]["hatch"]["build"]["targets"]["wheel"]["force-include"]
    assert {source.removeprefix("examples/") for source in included if source.startswith("examples/")} == set(examples.files()) and examples.FIRST in examples.names()
    assert all((examples.folder() / name).is_file() for name in examples.files())


def test_there_is_no_other_example():
    with pytest.raises(SketchError, match=r"^There is no example of that name\. The examples are apple\.json, "):
        examples.data("../README.md")
