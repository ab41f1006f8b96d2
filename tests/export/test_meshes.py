import dataclasses
import zipfile
from xml.etree import ElementTree

import numpy as np
import pytest
import trimesh
from shapes import leafy, square, textured

from sketchtree.errors import ExportError
from sketchtree.export.meshes import write_meshes
from sketchtree.export.meshes.read import read_meshes


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
    assert len(set(named)) == 5 and all((tmp_path / name).exists() for name in named)
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


def test_an_obj_is_read_back_with_its_materials(tmp_path):
    write_meshes(tmp_path / "tree.obj", [textured(), leafy()])
    wood, leaf = read_meshes(tmp_path / "tree.obj").parts
    assert (wood.name, wood.material.name, leaf.name, leaf.material.name) == ("wood", "wood_checks", "leaf", "leaf_checks")
    np.testing.assert_array_equal(leaf.material.base_color_texture[..., 3], leafy().material.base_color_texture[..., 3])
    assert wood.material.normal_texture is not None and wood.material.roughness_texture is not None
    for name in ("position", "uv", "normal"):
        back, given = (getattr(mesh, name)[mesh.triangle] for mesh in (wood, textured()))
        np.testing.assert_allclose(back, given, atol=1e-6)


@pytest.mark.parametrize("suffix", ["ply", "stl"])
def test_a_plain_mesh_is_read_back(tmp_path, suffix):
    write_meshes(tmp_path / f"t.{suffix}", [textured(), leafy()])
    (mesh,) = read_meshes(tmp_path / f"t.{suffix}").parts
    assert len(mesh.triangle) == 4 and (mesh.color is not None) == (suffix == "ply")


def test_the_mean_tint_is_in_the_texture_of_an_obj(tmp_path):
    write_meshes(tmp_path / "t.obj", [leafy()])
    (leaf,) = read_meshes(tmp_path / "t.obj").parts
    white = leaf.material.base_color_texture[..., :3].reshape(-1, 3).max(axis=0) / 255.0
    np.testing.assert_allclose(white**2.2, [0.5, 1.0, 0.25], atol=0.01)
    plain = dataclasses.replace(leafy(), material=dataclasses.replace(square().material, name="plain", base_color=(1.0, 0.5, 1.0, 1.0)))
    write_meshes(tmp_path / "u.obj", [plain])
    assert "Kd 0.5 0.5 0.25" in (tmp_path / "u.mtl").read_text()


def test_an_obj_of_another_program_is_read(tmp_path):
    (tmp_path / "t.obj").write_text("# quads, from the end, without normals\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nl 1 2\nf -4/1 -3/1 -2/1 -1/1\nf 1 2 3\n")
    (mesh,) = read_meshes(tmp_path / "t.obj").parts
    assert len(mesh.triangle) == 3
    np.testing.assert_allclose(np.abs(mesh.normal[:, 2]), 1)


@pytest.mark.parametrize(
    ("name", "text", "message"),
    [
        ("t.obj", "v 0 0 0\n", "holds no triangle. Give a mesh file that is whole, of triangles."),
        ("t.obj", "v 0 0 0\nf 1 2 3\n", "is damaged, or no OBJ file. Give a mesh file that is whole, of triangles."),
        ("t.ply", "no ply", "is damaged, or no PLY file."),
    ],
)
def test_a_mesh_that_can_not_be_read_is_named(tmp_path, name, text, message):
    (tmp_path / name).write_text(text)
    with pytest.raises(ExportError, match=message):
        read_meshes(tmp_path / name)


def test_a_mesh_that_is_not_there_is_named(tmp_path):
    with pytest.raises(ExportError, match="can't be read: no such file or directory. Check the path."):
        read_meshes(tmp_path / "t.stl")


def test_a_3mf_holds_the_wood_welded_upright_on_the_plate(tmp_path):
    doubled = dataclasses.replace(square(), position=np.repeat(square().position[[0, 1, 2, 0, 2, 3]], 1, axis=0), triangle=np.arange(6).reshape(2, 3))
    doubled = dataclasses.replace(doubled, normal=np.tile([0.0, 0.0, 1.0], (6, 1)), uv=np.zeros((6, 2)))
    write_meshes(tmp_path / "t.3mf", [doubled, leafy()])
    with zipfile.ZipFile(tmp_path / "t.3mf") as package:
        assert package.namelist() == ["[Content_Types].xml", "_rels/.rels", "3D/3dmodel.model"]
        model = ElementTree.fromstring(package.read("3D/3dmodel.model"))
    core = "{http://schemas.microsoft.com/3dmanufacturing/core/2015/02}"
    assert model.get("unit") == "meter" and [item.get("name") for item in model.iter(f"{core}object")] == ["wood"]
    vertices = np.array([[float(row.get(axis)) for axis in "xyz"] for row in model.iter(f"{core}vertex")])
    assert len(vertices) == 4 and np.ptp(vertices[:, 2]) == 1 and np.ptp(vertices[:, 1]) == 0
    corners = [[int(row.get(f"v{k}")) for k in (1, 2, 3)] for row in model.iter(f"{core}triangle")]
    a, b, c = vertices[corners[0]]
    assert np.cross(b - a, c - a)[1] < 0  # what faced the viewer, +z, faces −y now


def test_same_wood_same_3mf(tmp_path):
    for name in ("a.3mf", "b.3mf"):
        write_meshes(tmp_path / name, [textured()])
    assert (tmp_path / "a.3mf").read_bytes() == (tmp_path / "b.3mf").read_bytes()


def test_a_normal_map_of_an_obj_has_both_words_that_programs_know(tmp_path):
    write_meshes(tmp_path / "t.obj", [textured()])
    lines = (tmp_path / "t.mtl").read_text().splitlines()
    assert {"norm t_wood_checks_normal.jpg", "map_Bump t_wood_checks_normal.jpg", "map_Kd t_wood_checks_diffuse.jpg", "map_Pr t_wood_checks_rough.jpg"} <= set(lines)
