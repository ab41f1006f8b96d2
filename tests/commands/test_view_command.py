"""`sketchtree view`: a picture, a film or a window of a tree in a file."""

import json

import numpy as np
import pytest
from PIL import Image

from sketchtree.commands import app
from sketchtree.export.gltf import write_glb
from sketchtree.export.skeletons.swc import write_swc
from sketchtree.geometry.mesh import Material, Mesh
from sketchtree.skeleton import TreeSkeleton
from sketchtree.view import NO_OPENGL, picture


@pytest.fixture
def glb(tmp_path):
    corners = np.array([[-1.0, 0, 0], [1, 0, 0], [0, 3, 0]])
    mesh = Mesh("wood", corners, np.tile([[0.0, 0, 1]], (3, 1)), corners[:, :2], np.array([[0, 1, 2]]), Material("wood", base_color=(0.2, 0.4, 0.1, 1)))
    write_glb(tmp_path / "t.glb", [mesh])
    return tmp_path / "t.glb"


def drawn_or_skip(code, capsys, path):
    said = capsys.readouterr().err
    if not path.exists():
        pytest.skip(said)
    assert code == 0, said


def size_of(path):
    with Image.open(path) as shown:
        return shown.size


def test_a_screenshot_has_the_size_asked_for_and_a_report(glb, tmp_path, capsys):
    out = tmp_path / "p.png"
    code = app.run(["view", str(glb), "--screenshot", str(out), "--size", "120x90", "--quiet", "--report", str(tmp_path / "r.json")])
    drawn_or_skip(code, capsys, out)
    assert size_of(out) == (120, 90)
    report = json.loads((tmp_path / "r.json").read_text())
    assert report["triangles"] == 1 and report["command"] == "view" and report["warnings"] == []


def test_several_sides_make_a_sheet(glb, tmp_path, capsys):
    out = tmp_path / "p.png"
    code = app.run(["view", str(glb), "--screenshot", str(out), "--size", "64x48", "--view", "front", "--view", "side", "--quiet"])
    drawn_or_skip(code, capsys, out)
    assert size_of(out) == (128, 48)


def test_a_turntable_is_a_film_of_so_many_frames(glb, tmp_path, capsys):
    out = tmp_path / "t.gif"
    code = app.run(["view", str(glb), "--turntable", str(out), "--size", "64x64", "--frames", "4", "--seconds", "2", "--quiet"])
    drawn_or_skip(code, capsys, out)
    with Image.open(out) as film:
        assert film.n_frames == 4 and film.size == (64, 64) and film.info["duration"] == 500


def test_a_skeleton_is_shown_as_wood(tmp_path, capsys):
    tree = TreeSkeleton.from_columns(parent=np.array([-1, 0, 1]), tip=np.array([[0, 0, 0], [0, 2, 0], [1, 3.0, 0]]), radius=np.array([0.2, 0.15, 0.1]))
    write_swc(tmp_path / "t.swc", tree, header={})
    out = tmp_path / "p.png"
    drawn_or_skip(app.run(["view", str(tmp_path / "t.swc"), "--screenshot", str(out), "--size", "64x48", "--quiet"]), capsys, out)
    with Image.open(out) as shown:
        assert len(np.unique(np.asarray(shown).reshape(-1, 3), axis=0)) > 20


def test_what_could_not_be_drawn_is_a_warning(glb, tmp_path, capsys, monkeypatch):
    monkeypatch.setattr("sketchtree.view.picture.draw_in_child", lambda *_: (False, NO_OPENGL))
    assert app.run(["view", str(glb), "--screenshot", str(tmp_path / "p.png")]) == 0
    assert f"Note: {tmp_path / 'p.png'} was not drawn: {NO_OPENGL}" in capsys.readouterr().err


def test_without_a_screen_a_window_is_refused_with_another_way(glb, capsys, monkeypatch):
    for name in ("DISPLAY", "WAYLAND_DISPLAY"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setattr("sys.platform", "linux")
    assert app.run(["view", str(glb)]) == 2
    assert capsys.readouterr().err.endswith("sketchtree: No window could be opened: there is no screen here. Use `--screenshot P.png`, which needs no screen.\n")


def test_without_opengl_too(glb, capsys, monkeypatch):
    monkeypatch.setattr("sketchtree.view.window.has_screen", lambda: True)
    monkeypatch.setattr(picture, "command", lambda *_: ["false"])
    monkeypatch.setattr(picture, "reason_of", lambda _: NO_OPENGL)
    assert app.run(["view", str(glb)]) == 2
    assert capsys.readouterr().err.endswith("No window could be opened: there is no OpenGL here. Use `--screenshot P.png`, which needs no screen.\n")


@pytest.mark.parametrize(("arguments", "said"), [
    (["--screenshot", "p.jpg"], "Can't write p.jpg: `.jpg` files are not written"),
    (["--turntable", "t.avi"], "Can't write t.avi: `.avi` files are not written"),
    (["--screenshot", "p.png", "--view", "below"], "There is no view called 'below'. Choose one of: front, side, back, top, three-quarter."),
    (["--screenshot", "p.png", "--size", "12"], "`--size 12` is no size of a picture. Give width and height in pixels, 16 to 8192 each, such as 1200x900."),
    (["--screenshot", "p.png", "--size", "9x9"], "`--size 9x9` is no size of a picture."),
    (["--screenshot", "p.png", "--level", "2"], "t.glb holds 1 level of detail, none numbered 2. Count from 0."),
    (["--turntable", "t.gif", "--frames", "1"], "A film of 1 frames can't be made. Ask for 2 to 720."),
    (["--turntable", "t.gif", "--seconds", "0"], "A film of 0 seconds can't be made. Ask for 0.1 to 600."),
])  # fmt: skip
def test_wrong_choices_are_refused_and_nothing_is_written(glb, tmp_path, capsys, monkeypatch, arguments, said):
    monkeypatch.chdir(tmp_path)
    before = sorted(tmp_path.iterdir())
    assert app.run(["view", "t.glb", *arguments]) == 2
    assert said in capsys.readouterr().err and sorted(tmp_path.iterdir()) == before


def test_mp4_needs_ffmpeg(glb, tmp_path, capsys, monkeypatch):
    monkeypatch.setattr("sketchtree.view.film._programs", lambda: iter(()))
    assert app.run(["view", str(glb), "--turntable", str(tmp_path / "t.mp4")]) == 2
    assert "t.mp4: no ffmpeg was found. Install one, `pip install 'sketchtree[video]'`, or ask for a .gif, .webp or .apng." in capsys.readouterr().err


def test_a_file_that_is_no_tree_is_refused(tmp_path, capsys):
    (tmp_path / "t.txt").write_text("no tree")
    assert app.run(["view", str(tmp_path / "t.txt"), "--screenshot", str(tmp_path / "p.png")]) == 2
    assert "t.txt" in capsys.readouterr().err
