"""Files that belong together are all new, or all as they were: on a full disk, in a folder that can't be written, half-way through."""

import errno
import os

import pytest
from shapes import curved, detailed, leafy, textured

from sketchtree.asset import Asset
from sketchtree.errors import ExportError
from sketchtree.export import files
from sketchtree.export.files import write_set
from sketchtree.export.write import write_asset, write_skeleton

FORMATS = ["glb", "gltf", "usda", "usdz", "obj", "ply", "stl", "3mf"]


def state(folder):
    """Every file below the folder with its bytes, and every folder."""
    return {path.relative_to(folder): path.read_bytes() if path.is_file() else None for path in folder.rglob("*")}


def full_after(monkeypatch, count):
    """The disk is full from the given file on."""
    written, write = [], files._write

    def limited(path, data):
        written.append(path)
        if len(written) > count:
            path.write_bytes(data[: len(data) // 2])
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
        write(path, data)

    monkeypatch.setattr(files, "_write", limited)


def needs(suffix):
    if suffix.startswith("usd"):
        pytest.importorskip("pxr", reason="usd-core is not installed")


@pytest.mark.parametrize("suffix", FORMATS)
@pytest.mark.parametrize("before", [False, True], ids=["new", "over"])
def test_a_full_disk_leaves_everything_as_it_was(tmp_path, monkeypatch, suffix, before):
    needs(suffix)
    if before:
        write_asset(tmp_path / f"t.{suffix}", Asset.of([textured()]))
    was = state(tmp_path)
    full_after(monkeypatch, 1 if suffix in ("gltf", "usda", "obj") else 0)
    with pytest.raises(ExportError, match=r"Can't write .*: no space left on device\. Free some space or choose another folder\."):
        write_asset(tmp_path / f"t.{suffix}", Asset.of([textured(), leafy()]))
    assert state(tmp_path) == was


@pytest.mark.parametrize("suffix", ["swc", "mtg", "json", "h5"])
def test_a_full_disk_leaves_a_skeleton_as_it_was(tmp_path, monkeypatch, suffix):
    write_skeleton(tmp_path / f"t.{suffix}", curved(), header={})
    was = state(tmp_path)
    full_after(monkeypatch, 0)
    with pytest.raises(ExportError, match="no space left on device"):
        write_skeleton(tmp_path / f"t.{suffix}", curved(), header={"seed": 1})
    assert state(tmp_path) == was


def test_levels_in_files_of_their_own_are_one_set(tmp_path, monkeypatch):
    full_after(monkeypatch, 2)
    with pytest.raises(ExportError, match=r"t_LOD2\.glb: no space left on device"):
        write_asset(tmp_path / "t.glb", detailed(), separate=True)
    assert state(tmp_path) == {}


@pytest.mark.parametrize("links", [True, False], ids=["links", "no links"])
def test_a_rename_that_fails_half_way_is_undone(tmp_path, monkeypatch, links):
    (tmp_path / "a").write_bytes(b"old a")
    (tmp_path / "c").write_bytes(b"old c")
    was, replace = state(tmp_path), os.replace

    def stuck(source, target):
        if target.name == "c" and b"new" in source.read_bytes():
            raise OSError(errno.EACCES, os.strerror(errno.EACCES))
        replace(source, target)

    monkeypatch.setattr(files.os, "replace", stuck)
    if not links:
        monkeypatch.setattr(files.os, "link", lambda *names: (_ for _ in ()).throw(OSError(errno.EPERM, "no links here")))
    with pytest.raises(ExportError, match="Can't write .*c: permission denied"):
        write_set({tmp_path / name: f"new {name}".encode() for name in "abc"})
    assert state(tmp_path) == was


def test_ctrl_c_between_two_renames_is_undone(tmp_path, monkeypatch):
    (tmp_path / "a").write_bytes(b"old")
    replace = os.replace

    def stopped(source, target):
        if target.name == "b":
            raise KeyboardInterrupt
        replace(source, target)

    monkeypatch.setattr(files.os, "replace", stopped)
    with pytest.raises(KeyboardInterrupt):
        write_set({tmp_path / "a": b"new", tmp_path / "b": b"new"})
    assert state(tmp_path) == {(tmp_path / "a").relative_to(tmp_path): b"old"}


def test_a_folder_beside_the_file_is_made_and_stays_only_with_it(tmp_path, monkeypatch):
    write_set({tmp_path / "t": b"1", tmp_path / "t_textures" / "a": b"2"})
    assert (tmp_path / "t_textures" / "a").read_bytes() == b"2"
    full_after(monkeypatch, 1)
    with pytest.raises(ExportError):
        write_set({tmp_path / "u": b"1", tmp_path / "u_textures" / "a": b"2"})
    assert not (tmp_path / "u_textures").exists()


def test_a_file_in_place_of_the_folder_is_named(tmp_path):
    (tmp_path / "t_textures").write_bytes(b"")
    with pytest.raises(ExportError, match="t_textures"):
        write_set({tmp_path / "t": b"1", tmp_path / "t_textures" / "a": b"2"})
    assert [path.name for path in tmp_path.iterdir()] == ["t_textures"]


@pytest.mark.parametrize("suffix", FORMATS)
def test_a_folder_in_place_of_the_file_is_named(tmp_path, suffix):
    needs(suffix)
    (tmp_path / f"t.{suffix}").mkdir()
    with pytest.raises(ExportError, match=r"it is a folder\. Add a file name to the path\."):
        write_asset(tmp_path / f"t.{suffix}", Asset.of([textured()]))


@pytest.mark.parametrize("suffix", ["ply", "stl", "3mf"])
def test_nothing_to_draw_is_named(tmp_path, suffix):
    with pytest.raises(ExportError, match="there is no triangle to write"):
        write_asset(tmp_path / f"t.{suffix}", Asset.of([]))
    assert state(tmp_path) == {}


def test_without_usd_core_the_remedy_is_named(tmp_path, monkeypatch):
    monkeypatch.setattr(files, "find_spec", lambda name: None)
    with pytest.raises(ExportError, match=r"Can't write .*t\.usdz: USD needs the package `usd-core`\. Install it: pip install 'sketchtree\[usd\]'\."):
        write_asset(tmp_path / "t.usdz", Asset.of([textured()]))


def test_what_a_format_has_no_place_for_is_told(tmp_path):
    assert write_asset(tmp_path / "t.obj", detailed()) == (f"{tmp_path / 't.obj'} holds the finest of 3 levels of detail; `.obj` has no place for more.",)
    assert write_asset(tmp_path / "t.3mf", Asset.of([textured(), leafy()])) == (
        f"{tmp_path / 't.3mf'} holds the wood alone: leaves are sheets without thickness, which can't be printed.",
    )
    assert write_asset(tmp_path / "t.glb", detailed()) == ()
