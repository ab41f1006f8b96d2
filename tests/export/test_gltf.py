import dataclasses
import json
import struct

import numpy as np
import pytest
import trimesh
from shapes import checks, leafy, square, textured

from sketchtree.errors import ExportError
from sketchtree.export.gltf import GENERATOR, glb_bytes, read_glb_json, write_glb
from sketchtree.export.gltf.tangents import tangents


def document(meshes, **options):
    data = glb_bytes(meshes, **options)
    return json.loads(data[20 : 20 + struct.unpack("<I", data[12:16])[0]])


def test_it_is_a_binary_gltf_of_the_length_it_says():
    data = glb_bytes([square()])
    assert data[:4] == b"glTF" and struct.unpack("<II", data[4:12]) == (2, len(data))


def test_same_meshes_same_bytes(tmp_path):
    for name in ("a.glb", "b.glb"):
        write_glb(tmp_path / name, [textured(), leafy()], extras={"seed": 3})
    assert (tmp_path / "a.glb").read_bytes() == (tmp_path / "b.glb").read_bytes()


def test_generator_names_the_program_and_its_version():
    assert document([square()])["asset"] == {"version": "2.0", "generator": GENERATOR}
    assert GENERATOR.startswith("SketchTree ")


def test_nodes_are_named_after_the_meshes_under_one_root():
    nodes = document([square("wood"), leafy()])["nodes"]
    assert [node["name"] for node in nodes] == ["tree", "wood", "leaf"] and nodes[0]["children"] == [1, 2]


def test_extras_stand_on_the_scene(tmp_path):
    write_glb(tmp_path / "t.glb", [square()], extras={"sketchtree": {"rows": 7}})
    assert read_glb_json(tmp_path / "t.glb")["scenes"][0]["extras"] == {"sketchtree": {"rows": 7}}


def test_positions_have_their_exact_bounds():
    content = document([square()])
    accessor = content["accessors"][content["meshes"][0]["primitives"][0]["attributes"]["POSITION"]]
    assert accessor["min"] == [0, 0, 0] and accessor["max"] == [1, 1, 0]


def test_vertices_and_indices_have_their_targets():
    content = document([textured()])
    primitive = content["meshes"][0]["primitives"][0]
    target = {name: content["bufferViews"][content["accessors"][row]["bufferView"]]["target"] for name, row in primitive["attributes"].items()}
    assert set(target.values()) == {34962}
    assert content["bufferViews"][content["accessors"][primitive["indices"]]["bufferView"]]["target"] == 34963


@pytest.mark.parametrize(("count", "component"), [(4, 5123), (65536, 5125)])
def test_indices_are_as_wide_as_they_must_be(count, component):
    mesh = square()
    many = dataclasses.replace(mesh, **{name: np.resize(getattr(mesh, name), (count, getattr(mesh, name).shape[1])) for name in ("position", "normal", "uv")})
    content = document([many])
    assert content["accessors"][content["meshes"][0]["primitives"][0]["indices"]]["componentType"] == component


def test_a_leaf_is_masked_and_two_sided():
    material = document([leafy()])["materials"][0]
    assert material["alphaMode"] == "MASK" and material["alphaCutoff"] == 0.5 and material["doubleSided"]


def test_wood_has_all_its_textures_and_tangents():
    content = document([textured()])
    material = content["materials"][0]
    assert {"baseColorTexture", "metallicRoughnessTexture"} <= set(material["pbrMetallicRoughness"])
    assert "normalTexture" in material and "TANGENT" in content["meshes"][0]["primitives"][0]["attributes"]


def test_colours_and_normals_are_jpeg_and_alpha_is_png():
    kinds = {image["name"]: image["mimeType"] for image in document([textured(), leafy()])["images"]}
    assert kinds == {
        "wood_checks_albedo": "image/jpeg",
        "wood_checks_roughness": "image/jpeg",
        "wood_checks_normal": "image/jpeg",
        "leaf_checks_albedo": "image/png",
    }


def test_a_texture_used_twice_is_stored_once():
    image = checks()
    content = document([square("wood", base_color_texture=image), square("wood_2", base_color_texture=image)])
    assert len(content["images"]) == 1 and len(content["materials"]) == 2


def test_trimesh_reads_back_what_was_written(tmp_path):
    write_glb(tmp_path / "t.glb", [textured(), leafy()])
    scene = trimesh.load(tmp_path / "t.glb", process=False)
    wood, leaf = scene.geometry["wood"], scene.geometry["leaf"]
    np.testing.assert_allclose(wood.vertices, textured().position)
    np.testing.assert_array_equal(wood.faces, textured().triangle)
    np.testing.assert_allclose(wood.vertex_normals, textured().normal, atol=1e-6)
    np.testing.assert_allclose(wood.visual.uv, np.c_[textured().uv[:, 0], 1 - textured().uv[:, 1]])
    assert leaf.visual.material.alphaMode == "MASK"


def test_a_mesh_without_triangles_is_left_out():
    empty = dataclasses.replace(square("leaf"), triangle=np.zeros((0, 3), int))
    content = document([square(), empty])
    assert [node["name"] for node in content["nodes"]] == ["tree", "wood"]


def test_a_tree_without_any_mesh_is_still_a_file():
    assert "meshes" not in document([]) and "buffers" not in document([])


def test_tangents_follow_u_and_the_image_stands_upright():
    np.testing.assert_allclose(tangents(square()), np.broadcast_to([1, 0, 0, 1], (4, 4)), atol=1e-12)


def test_a_mirrored_image_has_the_other_hand():
    mesh = square()
    mirrored = dataclasses.replace(mesh, uv=mesh.uv * [-1, 1])
    np.testing.assert_allclose(tangents(mirrored), np.broadcast_to([-1, 0, 0, -1], (4, 4)), atol=1e-12)


def test_tangents_are_unit_and_perpendicular_even_without_a_texture_direction():
    mesh = dataclasses.replace(square(), uv=np.zeros((4, 2)))
    found = tangents(mesh)
    np.testing.assert_allclose(np.linalg.norm(found[:, :3], axis=1), 1)
    np.testing.assert_allclose(np.sum(found[:, :3] * mesh.normal, axis=1), 0, atol=1e-12)


def test_a_number_that_is_not_finite_is_named(tmp_path):
    mesh = square()
    bad = dataclasses.replace(mesh, position=np.where(mesh.position > 0, np.nan, 0.0))
    with pytest.raises(ExportError, match="The position of a vertex of mesh `wood` is not a finite number"):
        write_glb(tmp_path / "t.glb", [bad])
    assert list(tmp_path.iterdir()) == []


def test_reading_something_else_is_named(tmp_path):
    (tmp_path / "t.glb").write_bytes(b"not a tree")
    with pytest.raises(ExportError, match="is not a GLB file"):
        read_glb_json(tmp_path / "t.glb")
