import os
import stat

import pytest

from sketchtree.errors import ExportError
from sketchtree.export.files import check_extension, check_writable, whole_file, write_set, write_whole


def test_a_file_is_written_whole(tmp_path):
    write_whole(tmp_path / "t.swc", b"1 0")
    assert (tmp_path / "t.swc").read_bytes() == b"1 0"
    assert [path.name for path in tmp_path.iterdir()] == ["t.swc"]


def test_what_fails_leaves_the_old_file_and_nothing_else(tmp_path):
    write_whole(tmp_path / "t.swc", b"old")
    with pytest.raises(RuntimeError), whole_file(tmp_path / "t.swc") as temporary:
        temporary.write_bytes(b"half")
        raise RuntimeError
    assert (tmp_path / "t.swc").read_bytes() == b"old"
    assert len(list(tmp_path.iterdir())) == 1


def test_checking_leaves_nothing_behind(tmp_path):
    assert check_writable(tmp_path / "t.glb") == tmp_path / "t.glb"
    assert list(tmp_path.iterdir()) == []


def test_a_missing_folder_is_named(tmp_path):
    with pytest.raises(ExportError, match=r"Can't write .*t\.glb: the folder .*nowhere does not exist\. Create it, or choose another path\."):
        check_writable(tmp_path / "nowhere" / "t.glb")


def test_a_folder_in_place_of_a_file_is_named(tmp_path):
    with pytest.raises(ExportError, match=r"it is a folder\. Add a file name to the path\."):
        check_writable(tmp_path)


@pytest.mark.skipif(not hasattr(os, "geteuid") or os.geteuid() == 0, reason="the superuser may write anywhere")
def test_a_read_only_folder_is_named(tmp_path):
    tmp_path.chmod(stat.S_IRUSR | stat.S_IXUSR)
    try:
        with pytest.raises(ExportError, match="permission denied. Choose a folder you may write to"):
            check_writable(tmp_path / "t.glb")
    finally:
        tmp_path.chmod(stat.S_IRWXU)


def test_a_full_disk_is_named(tmp_path):
    with pytest.raises(ExportError, match="no space left on device. Free some space or choose another folder"), whole_file(tmp_path / "t.glb"):
        raise OSError(28, "No space left on device")
    assert list(tmp_path.iterdir()) == []


def test_a_file_that_other_programs_write_is_named_with_what_to_write_instead():
    with pytest.raises(ExportError, match=r"`\.fbx` files are not written\. This version writes \.glb, \.gltf, .*\.h5 here\. Write \.glb, which the same programs open\."):
        check_extension("tree.fbx")


def test_an_unknown_extension_is_named():
    with pytest.raises(ExportError, match=r"`\.dwg` files are not written.*Choose one of these extensions\."):
        check_extension("tree.dwg")


def test_a_path_without_extension_is_named():
    with pytest.raises(ExportError, match="it has no extension to tell the format"):
        check_extension("tree")


def test_the_extension_may_be_in_capitals():
    assert check_extension("Tree.GLB") == ".glb"


def test_a_read_only_file_is_named_and_kept(tmp_path):
    (tmp_path / "t.glb").write_bytes(b"mine")
    (tmp_path / "t.glb").chmod(stat.S_IRUSR)
    with pytest.raises(ExportError, match=r"Can't write .*t\.glb: it is read-only\. Make it writable, or choose another name\."):
        write_set({tmp_path / "s.glb": b"new", tmp_path / "t.glb": b"new"})
    assert [(path.name, path.read_bytes()) for path in tmp_path.iterdir()] == [("t.glb", b"mine")]


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="no pipes here")
def test_a_pipe_is_named_and_kept(tmp_path):
    os.mkfifo(tmp_path / "r.json")
    with pytest.raises(ExportError, match=r"it is a device or a pipe, and files are written whole\. Name an ordinary file\."):
        check_writable(tmp_path / "r.json")
    assert stat.S_ISFIFO((tmp_path / "r.json").stat().st_mode)


@pytest.mark.parametrize("path", ["/dev/stdout", "/dev/fd/1", "/dev/null"])
def test_a_device_is_named_and_kept(path):
    with pytest.raises(ExportError, match=f"Can't write {path}: it is a device or a pipe"):
        check_writable(path)


def test_a_link_stays_one_and_its_target_is_written(tmp_path):
    (tmp_path / "disk").mkdir()
    (tmp_path / "t.glb").symlink_to(tmp_path / "disk" / "far.glb")
    for count in (1, 2):
        write_set({tmp_path / name: b"new" for name in ("t.glb", "s.glb")[:count]})
        assert (tmp_path / "t.glb").is_symlink() and (tmp_path / "disk" / "far.glb").read_bytes() == b"new"


def test_a_name_too_long_is_named_before_the_work(tmp_path):
    with pytest.raises(ExportError, match=r"file name too long\. Choose another name\."):
        check_writable(tmp_path / ("t" * 300 + ".glb"))
