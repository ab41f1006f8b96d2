"""Everything a game needs of a tree, in files that belong together."""

import dataclasses
import json

import jsonschema
import numpy as np
import pytest

from sketchtree.asset import Level
from sketchtree.errors import ExportError
from sketchtree.export.gltf.document import read_glb_json
from sketchtree.export.gltf.read import read_glb_skeleton
from sketchtree.foliage.leaves import Leaves
from sketchtree.geometry.instances import Instances
from sketchtree.rig.engines import NOTES
from sketchtree.rig.manifest import pack_schema
from sketchtree.rig.pack import game_pack, pack_files, write_pack
from sketchtree.skeleton_files import read_skeleton_json
from tests.geometry.growing import stick
from tests.rig.rigged_trees import coarser, dressed, model


@pytest.fixture(scope="module")
def packed():
    _, _, _, _, wood, leaf = dressed()
    levels = (Level((wood, leaf), 0.5), Level((coarser(wood, 0.5), coarser(leaf, 0.5)), 0.2), Level((coarser(wood, 0.2),), 0.05))
    return game_pack(model(), levels, coarser(leaf, 0.01), name="oak", about={"seed": 0})


@pytest.fixture(scope="module")
def files(packed, tmp_path_factory):
    folder = tmp_path_factory.mktemp("pack")
    return {path.name: path for path in write_pack(folder, packed)}


def test_the_files_of_a_pack(files):
    assert list(files) == [
        "oak.glb", "oak_LOD1.glb", "oak_LOD2.glb", "oak_impostor.glb", "oak_collision.glb", "oak_PivotPos_Index.exr",
        "oak_XVector_Extent.png", "oak.skeleton.json", "oak.pack.json",
    ]  # fmt: skip
    assert all(path.stat().st_size > 50 for path in files.values())


def test_the_manifest_keeps_its_schema_and_names_every_file(files):
    content = json.loads(files["oak.pack.json"].read_text())
    jsonschema.validate(content, pack_schema())
    assert [row["name"] for row in content["files"]] == list(files)
    assert [row["file"] for row in content["levels"]] == ["oak.glb", "oak_LOD1.glb", "oak_LOD2.glb"]
    assert [row["coverage"] for row in content["levels"]] == [0.5, 0.2, 0.05]
    assert content["about"] == {"seed": 0} and set(content["engines"]) == set(NOTES)


def test_the_manifest_counts_what_the_files_hold(files):
    content = json.loads(files["oak.pack.json"].read_text())
    for row in content["levels"]:
        document = read_glb_json(files[row["file"]])
        count = {}
        for mesh in document["meshes"]:
            kind = "leaf" if mesh["name"].startswith("leaf") else "wood"
            count[kind] = count.get(kind, 0) + document["accessors"][mesh["primitives"][0]["indices"]]["count"] // 3
        assert row["triangles"] == {"wood": 0, "leaf": 0} | count


def test_every_level_has_wind_pivots_and_bones(files):
    for name in ("oak.glb", "oak_LOD1.glb", "oak_LOD2.glb"):
        document = read_glb_json(files[name])
        for mesh in document["meshes"]:
            columns = set(mesh["primitives"][0]["attributes"])
            assert {"COLOR_0", "COLOR_1", *(f"TEXCOORD_{k}" for k in range(6)), "JOINTS_0", "WEIGHTS_0"} <= columns
        assert len(document["skins"]) == 1 and document["nodes"][document["skins"][0]["joints"][0]]["name"] == "bone_trunk_0"
    columns = read_glb_json(files["oak_impostor.glb"])["meshes"][0]["primitives"][0]["attributes"]
    assert "COLOR_1" in columns and "JOINTS_0" not in columns


def test_collision_meshes_are_named_for_unreal_and_godot(files, packed):
    names = [node["name"] for node in read_glb_json(files["oak_collision.glb"])["nodes"]]
    assert "oak-noimp" in names
    bars = [name for name in names if name.startswith("UCP_oak-noimp_") and name.endswith("-convcolonly")]
    assert len(bars) == len(packed.asset.capsules) > 3


def test_ranges_of_the_wind_are_told(packed):
    wind = packed.content["wind"]
    assert wind["channels"]["sway"] == {"texture_set": "TEXCOORD_2", "component": 0, "color_component": 0, "min": 0.0, "max": 1.0}
    assert wind["channels"]["flutter"]["max"] == 1.0 and wind["height"] > 5 and wind["reach"] > 1
    assert wind["formula"]["lean"] > 0


def test_bones_capsules_and_pivots_are_told_by_name(packed):
    bones = {row["name"]: row for row in packed.content["bones"]}
    assert bones["bone_trunk_0"]["parent"] is None and all(row["parent"] in bones for name, row in bones.items() if name != "bone_trunk_0")
    assert all(row["bone"] in bones for row in packed.content["capsules"]["rows"])
    pivots = packed.content["pivots"]
    assert len(pivots["parent"]) == len(pivots["position"]) == len(pivots["extent"]) <= np.prod(pivots["size"])


def test_skeletons_are_in_the_finest_level_and_beside_it(files, packed):
    tree = packed.asset.skeleton
    assert np.array_equal(read_skeleton_json(files["oak.skeleton.json"]).parent, tree.parent)
    assert np.array_equal(read_glb_skeleton(files["oak.glb"]).parent, tree.parent)


def test_the_same_tree_gives_the_same_bytes(packed):
    _, _, _, _, wood, leaf = dressed()
    again = game_pack(model(), packed_levels(wood, leaf), coarser(leaf, 0.01), name="oak", about={"seed": 0})
    assert pack_files(again) == pack_files(packed)


def packed_levels(wood, leaf):
    return (Level((wood, leaf), 0.5), Level((coarser(wood, 0.5), coarser(leaf, 0.5)), 0.2), Level((coarser(wood, 0.2),), 0.05))


def test_instances_are_merged():
    _, _, _, leaves, wood, leaf = dressed()
    size = (len(leaf.position) - 6 * len(leaves.shoot)) // len(leaves)
    card = dataclasses.replace(leaf, position=leaf.position[:size] - leaves.position[0], normal=leaf.normal[:size], uv=leaf.uv[:size], triangle=leaf.triangle[:6], color=None)
    many = Instances(card, leaves.position, np.tile([[0.0, 0, 0, 1]], (len(leaves), 1)), np.ones((len(leaves), 3)))
    pack = game_pack(model(), (Level((wood, many)),))
    assert pack.name == "tree" and pack.content["impostor"] is None
    assert pack.asset.parts[1].triangle_count == many.triangle_count and pack.asset.parts[1].extra["COLOR_1"][:, 3].max() == 1.0


def test_a_tree_without_leaves_is_packed_too():
    tree, _, _, _, wood, _ = dressed()
    bare = model()
    bare.leaves = Leaves.none("oak")
    assert game_pack(bare, (Level((wood,)),)).content["levels"][0]["triangles"]["leaf"] == 0


@pytest.mark.parametrize("levels", [(), (Level(()),)])
def test_no_wood_is_refused(levels):
    with pytest.raises(ExportError) as told:
        game_pack(model(), levels)
    assert str(told.value) == "There is no wood to make a game pack of. Draw a stem."


def test_nothing_is_left_where_one_file_cannot_be_written(packed, tmp_path):
    (tmp_path / "oak_collision.glb").mkdir()
    with pytest.raises(ExportError, match="oak_collision.glb: it is a folder"):
        write_pack(tmp_path, packed)
    assert [path.name for path in tmp_path.iterdir()] == ["oak_collision.glb"]


def test_a_single_stem_is_packed():
    from sketchtree.geometry.wood import wood_mesh
    from tests.rig.rigged_trees import KEY

    bare = model()
    bare.skeleton = stick([[0, 0, 0], [0, 1, 0], [0, 2, 0]], 0.1)
    bare.leaves = Leaves.none("oak")
    pack = game_pack(bare, (Level((wood_mesh(bare.skeleton, bark="oak", key=KEY),)),), name="post")
    jsonschema.validate(pack.content, pack_schema())
    assert pack.content["wind"]["reach"] == 0.0 and len(pack.content["pivots"]["parent"]) == 1
