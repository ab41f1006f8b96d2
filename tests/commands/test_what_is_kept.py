"""No file that a tree becomes overwrites what it was made of, or another result; what is in the way is told before the work."""

import stat

import numpy as np
import pytest

from sketchtree.asset import Asset, Level
from sketchtree.commands import app
from sketchtree.export.write import asset_files
from sketchtree.geometry.mesh import Material, Mesh
from sketchtree.levels.make import SHARES
from sketchtree.options import FileOptions
from sketchtree.rig.pack import pack_roles
from sketchtree.tree_files import tree_files

SKETCH = """<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 100"><path d="M50 95 L50 40" stroke="black" fill="none" stroke-width="4"/>
<path d="M50 70 L25 40" stroke="black" fill="none" stroke-width="2"/></svg>"""


def state(folder):
    return {path.name: path.read_bytes() if path.is_file() else None for path in folder.iterdir()}


@pytest.fixture
def at(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "t.svg").write_text(SKETCH)
    return tmp_path


@pytest.mark.parametrize(("more", "said"), [
    (["-o", "t.glb", "--pack", "game", "--skeleton", "t.skeleton.json"], "`--skeleton t.skeleton.json` would overwrite what `-o` writes. Give it another name."),
    (["-o", "t.glb", "--pack", "game", "--report", "t.pack.json"], "`--report t.pack.json` would overwrite what `-o` writes. Give it another name."),
    (["-o", "t.glb", "--levels", "apart", "--report", "t_LOD2.glb"], "`--report t_LOD2.glb` would overwrite what `-o` writes. Give it another name."),
    (["-o", "t.gltf", "--report", "t.bin"], "`--report t.bin` would overwrite what `-o` writes. Give it another name."),
    (["-o", "t.obj", "--levels", "apart", "--report", "t_impostor.mtl"], "`--report t_impostor.mtl` would overwrite what `-o` writes. Give it another name."),
])  # fmt: skip
def test_two_results_of_one_name_are_refused(at, capsys, more, said):
    was = state(at)
    assert app.run(["build", "t.svg", *more]) == 2
    assert said in capsys.readouterr().err and state(at) == was


@pytest.mark.parametrize(("name", "more"), [("t.skeleton.json", ["--pack", "game"]), ("t.pack.json", ["--pack", "game"]), ("t_XVector_Extent.png", ["--pack", "game"])])
def test_a_sketch_that_is_called_like_a_file_of_the_set_is_kept(at, capsys, name, more):
    (at / "t.svg").rename(at / name)
    was = state(at)
    assert app.run(["build", name, "-o", "t.glb", *more]) == 2
    assert f"`-o t.glb` comes with {name}, which would overwrite the sketch itself. Give it another name." in capsys.readouterr().err
    assert state(at) == was


def test_a_sketch_that_is_called_like_a_texture_is_kept(at, capsys):
    (at / "t.svg").rename(at / "t_wood_oak_rough.jpg")
    was = state(at)
    assert app.run(["build", "t_wood_oak_rough.jpg", "-o", "t.obj", "--bark", "oak", "--generations", "0", "--leaf", "none", "--quiet"]) == 2
    said = "t.obj comes with t_wood_oak_rough.jpg, which would overwrite what the tree is made of. Give the output another name."
    assert said in capsys.readouterr().err and state(at) == was


@pytest.mark.parametrize(("name", "more"), [("t_LOD3.glb", ["--levels", "apart"]), ("t_impostor.glb", ["--pack", "game"]), ("t.pack.json", ["--pack", "game"])])
@pytest.mark.parametrize(("what", "said"), [("folder", "it is a folder. Add a file name to the path."), ("read-only", "it is read-only. Make it writable, or choose another name.")])
def test_what_is_in_the_way_of_a_set_is_told_before_the_work(at, capsys, monkeypatch, name, more, what, said):
    monkeypatch.setattr("sketchtree.pipeline.sketch_to_tree", lambda *_, **__: pytest.fail("it worked"))
    if what == "folder":
        (at / name).mkdir()
    else:
        (at / name).write_bytes(b"mine")
        (at / name).chmod(stat.S_IRUSR)
    was = state(at)
    assert app.run(["build", "t.svg", "-o", "t.glb", *more]) == 2
    assert f"Can't write {name}: {said}" in capsys.readouterr().err and state(at) == was


def test_the_names_told_before_the_work_are_those_written(tmp_path):
    parts = [Mesh("impostor" if k == 4 else "wood", *(np.eye(3),) * 2, np.eye(3)[:, :2], np.array([(0, 1, 2)]), Material("wood")) for k in range(5)]
    for kind in ("glb", "gltf", "obj", "ply"):
        told = tree_files(tmp_path / f"t.{kind}", FileOptions(levels="apart"))
        assert set(asset_files(tmp_path / f"t.{kind}", Asset(tuple(Level((part,)) for part in parts)), separate=True)) == set(told.all)
        assert set(asset_files(tmp_path / f"t.{kind}", Asset(tuple(Level((part,)) for part in parts[:4])), separate=True)) == set(told.sure)
        assert set(asset_files(tmp_path / f"t.{kind}", Asset.of(parts[:1]))) == set(tree_files(tmp_path / f"t.{kind}").all)
    told = tree_files(tmp_path / "t.glb", FileOptions(pack="game"))
    assert {path.name for path in told.all} == set(pack_roles("t", len(SHARES) + 1, True)) and {path.name for path in told.perhaps} == {"t_impostor.glb"}


def test_an_obj_beside_a_gltf_of_the_same_name_changes_none_of_its_textures(at):
    for kind in ("gltf", "obj"):
        was = state(at)
        assert app.run(["build", "t.svg", "-o", f"t.{kind}", "--template", "apple", "--generations", "1", "--quiet"]) == 0
    assert was.items() <= state(at).items() and "t_leaf_apple_diffuse.png" in state(at)


def test_a_pixel_error_of_one_level_is_refused(at, capsys):
    assert app.run(["build", "t.svg", "-o", "t.glb", "--pixel-error", "3"]) == 2
    assert (
        "`--pixel-error 3` says where a coarser level takes over, and one level alone is written. "
        "Leave it out, or ask for `--levels together`, `--levels apart` or `--pack game`."
    ) in " ".join(capsys.readouterr().err.split())
