import numpy as np
import pytest
import trimesh
from tests.propagate.space.solids import box

from sketchtree.errors import OptionError
from sketchtree.propagate.space.mesh_files import read_mesh

REMEDY = "Give a mesh file (.glb, .obj, .ply or .stl), in metres, y up, with the trunk's root at the origin."


@pytest.mark.parametrize("kind", ["glb", "obj", "ply", "stl", "off"])
def test_a_closed_box_is_closed_in_every_format(tmp_path, kind):
    path = tmp_path / f"box.{kind}"
    box((1, 0, -1), (3, 2, 1)).export(path)
    mesh = read_mesh(path)
    assert mesh.is_watertight and len(mesh.faces) == 12
    np.testing.assert_allclose(mesh.bounds, [[1, 0, -1], [3, 2, 1]], atol=1e-6)
    assert mesh.metadata["name"] == f"box.{kind}"


def test_the_parts_of_a_scene_stand_where_its_transforms_put_them(tmp_path):
    scene = trimesh.Scene()
    scene.add_geometry(box((0, 0, 0), (1, 1, 1)))
    scene.add_geometry(box((0, 0, 0), (1, 1, 1)), transform=trimesh.transformations.translation_matrix([5, 0, 0]))
    scene.export(tmp_path / "two.glb")
    mesh = read_mesh(tmp_path / "two.glb")
    np.testing.assert_allclose(mesh.bounds, [[0, 0, 0], [6, 1, 1]], atol=1e-6)
    assert mesh.is_watertight


BAD = {
    "text.obj": ("hello", f"text.obj holds no triangles. {REMEDY}"),
    "point.ply": (
        "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\nend_header\n0 0 0\n",
        f"point.ply holds no triangles. {REMEDY}",
    ),
    "nan.obj": (
        "v 0 0 nan\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
        "nan.obj has corners that are not finite numbers. Export the mesh again, or repair it.",
    ),
    "note.txt": ("hello", f"note.txt can't be read as a mesh (file_type 'txt' not supported). {REMEDY}"),
    "empty.stl": ("", f"empty.stl holds no triangles. {REMEDY}"),
}


@pytest.mark.parametrize("name", BAD)
def test_what_is_no_mesh_is_refused_by_name(tmp_path, name):
    text, message = BAD[name]
    (tmp_path / name).write_text(text)
    with pytest.raises(OptionError) as caught:
        read_mesh(tmp_path / name)
    assert str(caught.value) == message


def test_a_damaged_file_is_refused_in_one_line(tmp_path):
    (tmp_path / "bad.glb").write_bytes(b"glTF" + bytes(40))
    with pytest.raises(OptionError, match=r"^bad\.glb can't be read as a mesh \(.{1,100}\)\. Give a mesh file") as caught:
        read_mesh(tmp_path / "bad.glb")
    assert "\n" not in str(caught.value)


def test_a_missing_file_and_a_folder_are_refused(tmp_path):
    for path in (tmp_path / "none.glb", tmp_path):
        with pytest.raises(OptionError) as caught:
            read_mesh(path)
        assert str(caught.value) == f"There is no mesh file {path}. Check the path."
