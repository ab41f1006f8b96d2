"""Places, levels of detail, bones and what collides, as a glTF file holds them."""

import dataclasses
import json
import struct

import numpy as np
import pytest
from shapes import bars, bending, bones, curved, detailed, leafy, scattered, square, textured

from sketchtree.asset import Armature, Asset, Level
from sketchtree.errors import ExportError
from sketchtree.export.gltf import asset_bytes, read_asset, read_glb, read_glb_skeleton, write_gltf
from sketchtree.export.write import write_asset


def document(asset, **options):
    data = asset_bytes(asset, **options)
    return json.loads(data[20 : 20 + struct.unpack("<I", data[12:16])[0]])


def named(content, name):
    return next(node for node in content["nodes"] if node["name"] == name)


def test_places_are_an_extension_that_a_reader_must_know():
    content = document(Asset.of([scattered()]))
    assert content["extensionsUsed"] == content["extensionsRequired"] == ["EXT_mesh_gpu_instancing"]
    columns = named(content, "leaf")["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]
    accessor = {name: content["accessors"][number] for name, number in columns.items()}
    assert {name: (row["componentType"], row["type"], row["count"]) for name, row in accessor.items()} == {
        "TRANSLATION": (5126, "VEC3", 5), "ROTATION": (5122, "VEC4", 5), "SCALE": (5126, "VEC3", 5), "_COLOR_0": (5121, "VEC4", 5),
    }  # fmt: skip
    assert accessor["ROTATION"]["normalized"] and accessor["_COLOR_0"]["normalized"]


def test_thirty_thousand_places_take_less_than_forty_bytes_each():
    few, many = (len(asset_bytes(Asset.of([scattered(count)]))) for count in (5, 30_005))
    assert (many - few) / 30_000 < 40


def test_places_are_read_back(tmp_path):
    write_gltf(tmp_path / "t.glb", Asset.of([scattered()]))
    (back,) = read_asset(tmp_path / "t.glb").parts
    given = scattered()
    np.testing.assert_allclose(back.translation, given.translation, atol=1e-6)
    np.testing.assert_allclose(back.rotation, given.rotation, atol=3e-5)
    np.testing.assert_allclose(back.color, given.color, atol=0.002)
    (merged,) = read_glb(tmp_path / "t.glb")
    np.testing.assert_allclose(merged.position, given.merged().position, atol=1e-4)


def test_coarser_levels_hang_on_the_finest_and_are_not_in_the_scene():
    content = document(detailed())
    first = named(content, "tree_LOD0")
    ids = first["extensions"]["MSFT_lod"]["ids"]
    assert [content["nodes"][number]["name"] for number in ids] == ["tree_LOD1", "tree_LOD2"]
    assert first["extras"]["MSFT_screencoverage"] == [0.5, 0.1, 0.0]
    assert content["nodes"][0]["children"] == [content["nodes"].index(first)]
    assert [content["nodes"][child]["name"] for child in first["children"]] == ["wood_LOD0", "leaf_LOD0"]
    assert "MSFT_lod" in content["extensionsUsed"] and "MSFT_lod" not in content["extensionsRequired"]


def test_levels_are_read_back(tmp_path):
    write_gltf(tmp_path / "t.glb", detailed())
    back = read_asset(tmp_path / "t.glb")
    assert [level.triangle_count for level in back.levels] == [12, 4, 2]
    assert [level.coverage for level in back.levels] == [0.5, 0.1, 0.0]


def test_levels_may_stand_in_files_of_their_own(tmp_path):
    write_asset(tmp_path / "t.glb", detailed(), separate=True)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["t_LOD0.glb", "t_LOD1.glb", "t_LOD2.glb"]
    assert [sum(len(mesh.triangle) for mesh in read_glb(tmp_path / f"t_LOD{k}.glb")) for k in range(3)] == [12, 4, 2]
    assert len(read_glb_skeleton(tmp_path / "t_LOD0.glb")) == len(curved())


def test_bones_are_nodes_relative_to_their_parents():
    content = document(Asset.of([bending()], armature=bones()))
    trunk, limb = named(content, "trunk"), named(content, "limb")
    assert trunk["children"] == [content["nodes"].index(limb)] and content["nodes"].index(trunk) in content["nodes"][0]["children"]
    np.testing.assert_allclose(limb["translation"], [0, 0.5, 0])
    assert limb["extras"] == {"length": 0.4}


def test_a_skinned_mesh_is_a_root_of_the_scene():
    content = document(Asset.of([bending(), leafy()], armature=bones()))
    assert [content["nodes"][number]["name"] for number in content["scenes"][0]["nodes"]] == ["tree", "wood"]
    assert named(content, "wood")["skin"] == 0 and "skin" not in named(content, "leaf")


def test_weights_are_bytes_that_sum_to_one_and_idle_joints_are_joint_0(tmp_path):
    write_gltf(tmp_path / "t.glb", Asset.of([bending()], armature=bones()))
    (back,) = read_asset(tmp_path / "t.glb").parts
    weight = np.round(back.extra["WEIGHTS_0"] * 255)
    np.testing.assert_array_equal(weight.sum(axis=1), 255)
    np.testing.assert_allclose(back.extra["WEIGHTS_0"], bending().extra["WEIGHTS_0"], atol=1 / 254)
    assert (back.extra["JOINTS_0"][weight == 0] == 0).all()


def test_bones_are_read_back_where_they_stand_in_the_world(tmp_path):
    write_gltf(tmp_path / "t.glb", Asset.of([bending()], armature=bones()))
    back = read_asset(tmp_path / "t.glb").armature
    assert back.name == ("trunk", "limb") and back.parent.tolist() == [-1, 0]
    for column in ("position", "rotation", "length"):
        np.testing.assert_allclose(getattr(back, column), getattr(bones(), column), atol=1e-12)


def test_inverse_bind_matrices_undo_the_rest():
    from sketchtree.export.pose import inverse_bind

    undone = inverse_bind(bones()) @ np.array([0, 0.5, 0, 1.0])
    np.testing.assert_allclose(undone[1], [0, 0, 0, 1], atol=1e-12)  # the limb's joint is its own origin
    upright = inverse_bind(bones()) @ np.array([0.4, 0.5, 0, 1.0])
    np.testing.assert_allclose(upright[1], [0, 0.4, 0, 1], atol=1e-12)  # its +y runs along the limb, sideways in the world


def test_bones_and_levels_together_keep_every_skinned_mesh_a_root(tmp_path):
    asset = Asset((Level((bending(), leafy()), 0.5), Level((square("card"),))), armature=bones())
    content = document(asset)
    assert named(content, "wood_LOD0")["extensions"]["MSFT_lod"]["ids"] == [content["nodes"].index(named(content, "card_LOD1"))]
    assert "mesh" not in named(content, "none_LOD1")  # the leaves end where the card begins
    write_gltf(tmp_path / "t.glb", asset)
    assert [level.triangle_count for level in read_asset(tmp_path / "t.glb").levels] == [4, 2]


def test_without_bones_no_mesh_names_joints():
    content = document(Asset.of([bending()]))
    assert not {"JOINTS_0", "WEIGHTS_0"} & set(content["meshes"][0]["primitives"][0]["attributes"])


def test_further_columns_are_read_back(tmp_path):
    write_gltf(tmp_path / "t.glb", Asset.of([bending()]))
    (back,) = read_asset(tmp_path / "t.glb").parts
    for name in ("TEXCOORD_1", "COLOR_1", "_PIVOT"):
        np.testing.assert_allclose(back.extra[name], bending().extra[name], atol=0.002)
    assert (back.color == 1).all()  # colours are counted from 0 without a gap


def test_a_column_that_gltf_has_no_name_for_is_named():
    odd = dataclasses.replace(square(), extra={"sway": np.zeros((4, 1))})
    with pytest.raises(ExportError, match="Mesh `wood` has a column `sway` that glTF has no name for. Begin names of your own with `_`, in capitals."):
        asset_bytes(Asset.of([odd]))


def test_capsules_stand_in_the_extras_and_as_meshes_by_the_names_given(tmp_path):
    asset = Asset.of([square()], capsules=bars())
    content = document(asset, collision=["collision_0-colonly", "UCP_tree_01"])
    assert content["scenes"][0]["extras"]["capsules"][1] == {"start": [1, 0, 0], "end": [1, 0, 0], "radius": 0.2, "joint": None}
    assert [content["nodes"][child]["name"] for child in content["nodes"][0]["children"]] == ["wood", "collision_0-colonly", "UCP_tree_01"]
    write_gltf(tmp_path / "t.glb", asset, collision=["a", "b"])
    back = read_asset(tmp_path / "t.glb")
    assert [part.name for part in back.parts] == ["wood"] and back.capsules.joint.tolist() == [0, -1]


def test_a_capsule_is_closed_and_faces_outwards():
    import trimesh

    from sketchtree.export.capsules import capsule_meshes

    upright, ball = capsule_meshes(bars(), ["a", "b"])
    for mesh, volume in ((upright, np.pi * 0.01 * (1 + 0.4 / 3)), (ball, 4 / 3 * np.pi * 0.008)):
        shape = trimesh.Trimesh(mesh.position, mesh.triangle, process=False)
        assert shape.is_watertight and 0.8 * volume < shape.volume < volume


def test_the_scene_says_what_it_was_made_with(tmp_path):
    write_gltf(tmp_path / "t.glb", detailed())
    back = read_asset(tmp_path / "t.glb")
    assert back.about == {"seed": 3} and len(back.skeleton) == len(curved()) and back.name == "tree"


def test_light_that_passes_through_is_an_extension_that_a_reader_may_know(tmp_path):
    through = np.full((4, 4, 3), 90, np.uint8)
    material = dataclasses.replace(leafy().material, translucency=0.4, translucency_texture=through)
    asset = Asset.of([dataclasses.replace(leafy(), material=material)])
    content = document(asset)
    assert content["materials"][0]["extensions"]["KHR_materials_diffuse_transmission"]["diffuseTransmissionFactor"] == 0.4
    assert content["extensionsUsed"] == ["KHR_materials_diffuse_transmission"] and "extensionsRequired" not in content
    write_gltf(tmp_path / "t.glb", asset)
    back = read_asset(tmp_path / "t.glb").parts[0].material
    assert back.translucency == 0.4 and abs(int(back.translucency_texture[0, 0, 0]) - 90) < 3


def test_loose_files_are_named_after_the_json_and_hold_the_same(tmp_path):
    write_gltf(tmp_path / "my tree.gltf", Asset.of([textured(), leafy()], skeleton=curved()))
    assert sorted(path.name for path in tmp_path.iterdir()) == [
        "my tree.bin", "my tree.gltf", "my tree_leaf_checks_albedo.png",
        "my tree_wood_checks_albedo.jpg", "my tree_wood_checks_normal.jpg", "my tree_wood_checks_roughness.jpg",
    ]  # fmt: skip
    back = read_asset(tmp_path / "my tree.gltf")
    assert [part.name for part in back.parts] == ["wood", "leaf"] and len(back.skeleton) == len(curved())
    np.testing.assert_array_equal(back.parts[1].material.base_color_texture, leafy().material.base_color_texture)


def test_same_asset_same_bytes():
    asset = Asset((Level((bending(), scattered()), 0.5), Level((square(),))), curved(), armature=bones(), capsules=bars())
    assert asset_bytes(asset) == asset_bytes(asset)


@pytest.mark.parametrize(
    ("asset", "message"),
    [
        (lambda: Asset.of([dataclasses.replace(scattered(), scale=np.full((5, 3), np.nan))]), "The scale of a place of `leaf` is not a finite number."),
        (lambda: Asset.of([dataclasses.replace(bending(), extra={"_PIVOT": np.full((4, 3), np.inf)})]), "The _PIVOT of a vertex of mesh `wood` is not a finite number."),
        (lambda: Asset.of([bending()], armature=dataclasses.replace(bones(), position=np.full((2, 3), np.nan))), "A bone's place, turn or length is not a finite number."),
        (lambda: Asset.of([bending()], armature=dataclasses.replace(bones(), parent=np.array([-1, 1]))), "The bones are no tree with one root that stands first."),
    ],
    ids=["place", "column", "bone", "circle"],
)
def test_numbers_that_can_not_stand_in_a_file_are_named(tmp_path, asset, message):
    with pytest.raises(ExportError, match=message):
        write_gltf(tmp_path / "t.gltf", asset())
    assert list(tmp_path.iterdir()) == []


def test_a_damaged_file_is_named(tmp_path):
    (tmp_path / "t.gltf").write_text("{")
    with pytest.raises(ExportError, match="is not a glTF file that can be shown. Give a .gltf file with its buffers and textures beside it."):
        read_asset(tmp_path / "t.gltf")
    with pytest.raises(ExportError, match="is damaged: its JSON can't be read. Write it again."):
        read_glb_skeleton(tmp_path / "t.gltf")
    with pytest.raises(ExportError, match="can't be read: no such file or directory. Check the path."):
        read_glb_skeleton(tmp_path / "none.glb")


def test_a_moved_and_mirrored_node_of_another_program_is_put_in_the_world(tmp_path):
    write_gltf(tmp_path / "t.gltf", Asset.of([square()]))
    content = json.loads((tmp_path / "t.gltf").read_text())
    content["nodes"][1] |= {"translation": [0, 2, 0], "scale": [-1, 1, 1]}
    (tmp_path / "t.gltf").write_text(json.dumps(content))
    (mesh,) = read_glb(tmp_path / "t.gltf")
    np.testing.assert_allclose(mesh.position.max(axis=0), [0, 3, 0])
    a, b, c = mesh.position[mesh.triangle[0]]
    assert np.cross(b - a, c - a)[2] > 0  # still faces the viewer


def test_an_armature_of_none_is_refused():
    none = Armature((), np.zeros(0, int), np.zeros((0, 3)), np.zeros((0, 4)), np.zeros(0))
    with pytest.raises(ExportError, match="no tree with one root"):
        asset_bytes(Asset.of([square()], armature=none))
