import numpy as np
import pytest
import trimesh
from shapes import leafy, square, textured

from sketchtree.errors import ExportError
from sketchtree.export.meshes import write_meshes


@pytest.mark.parametrize("suffix", ["obj", "ply", "stl"])
def test_what_is_written_is_read_back(tmp_path, suffix):
    path = tmp_path / f"tree.{suffix}"
    write_meshes(path, [textured(), leafy()])
    mesh = trimesh.load(path, force="mesh", process=False)
    assert len(mesh.faces) == 4
    np.testing.assert_allclose(mesh.bounds, [[0, 0, 0], [1, 1, 0]], atol=1e-6)


def test_an_obj_names_its_materials_and_textures(tmp_path):
    write_meshes(tmp_path / "tree.obj", [textured(), leafy()])
    assert "mtllib tree.mtl" in (tmp_path / "tree.obj").read_text()
    library = (tmp_path / "tree.mtl").read_text()
    named = [word for line in library.splitlines() for word in line.split()[1:] if word.endswith((".png", ".jpg"))]
    assert len(named) == 5 and all((tmp_path / name).exists() for name in named)
    assert "map_d tree_leaf_checks_alpha.png" in library


def test_an_obj_keeps_its_texture_upright(tmp_path):
    write_meshes(tmp_path / "tree.obj", [square()])
    lines = (tmp_path / "tree.obj").read_text().splitlines()
    assert [line for line in lines if line.startswith("vt")][0] == "vt 0 0"


def test_same_meshes_same_bytes(tmp_path):
    for suffix in ("obj", "ply", "stl"):
        first, second = tmp_path / f"a.{suffix}", tmp_path / f"b.{suffix}"
        for path in (first, second):
            write_meshes(path, [textured(), leafy()])
        assert first.read_bytes().replace(b"mtllib a", b"mtllib b") == second.read_bytes()


def test_a_ply_is_coloured_by_texture_and_tint(tmp_path):
    write_meshes(tmp_path / "t.ply", [leafy()])
    color = trimesh.load(tmp_path / "t.ply", process=False).visual.vertex_colors[0]
    assert color[1] > color[0] > color[2]


def test_nothing_to_write_is_named(tmp_path):
    with pytest.raises(ExportError, match="there is no triangle to write. Build a tree that has at least one branch."):
        write_meshes(tmp_path / "t.stl", [])
    assert list(tmp_path.iterdir()) == []


def test_another_extension_is_named(tmp_path):
    with pytest.raises(ExportError, match=r"This version writes \.obj, \.ply, \.stl, \.3mf here"):
        write_meshes(tmp_path / "t.fbx", [square()])
