"""USD files: what Pixar's own library and its validators make of them."""

import dataclasses

import numpy as np
import pytest
from shapes import bars, bending, bones, checks, curved, detailed, leafy, scattered, square, textured

from sketchtree.asset import Asset, Level
from sketchtree.errors import ExportError
from sketchtree.export.write import write_asset

pxr = pytest.importorskip("pxr", reason="usd-core is not installed")

from pxr import Usd, UsdGeom, UsdShade, UsdSkel  # noqa: E402

from sketchtree.export.usd.read import read_usd  # noqa: E402
from sketchtree.export.usd.tints import few_tints, nearest  # noqa: E402

ASSETS = {
    "plain": lambda: Asset.of([textured(), leafy()], skeleton=curved(), about={"seed": 3, "template": "oak"}),
    "places": lambda: Asset.of([textured(), scattered()]),
    "levels": detailed,
    "bones": lambda: Asset.of([bending(), leafy()], armature=bones(), capsules=bars()),
    "bones and levels": lambda: Asset((Level((bending(), scattered()), 0.5), Level((square("card"),))), curved(), armature=bones()),
    "nothing": lambda: Asset.of([]),
}
KINDS = ["usda", "usdc", "usd", "usdz"]


def stage(folder, asset, suffix="usda"):
    write_asset(folder / f"t.{suffix}", asset)
    return Usd.Stage.Open(str(folder / f"t.{suffix}"))


@pytest.mark.parametrize("suffix", KINDS)
@pytest.mark.parametrize("name", ASSETS)
def test_no_validator_has_anything_to_say(tmp_path, name, suffix):
    validation = pytest.importorskip("pxr.UsdValidation", reason="this usd-core has no validators")
    context = validation.ValidationContext(validation.ValidationRegistry().GetOrLoadAllValidators())
    assert [error.GetMessage() for error in context.Validate(stage(tmp_path, ASSETS[name](), suffix))] == []


@pytest.mark.parametrize("suffix", KINDS)
@pytest.mark.parametrize("name", ["plain", "bones and levels"])
def test_same_asset_same_bytes(tmp_path, name, suffix):
    for folder in ("a", "b"):
        (tmp_path / folder).mkdir()
        write_asset(tmp_path / folder / f"t.{suffix}", ASSETS[name]())
    assert (tmp_path / "a" / f"t.{suffix}").read_bytes() == (tmp_path / "b" / f"t.{suffix}").read_bytes()


def test_it_stands_in_metres_with_y_up_under_one_component(tmp_path):
    made = stage(tmp_path, ASSETS["plain"]())
    assert UsdGeom.GetStageMetersPerUnit(made) == 1 and UsdGeom.GetStageUpAxis(made) == "Y"
    assert made.GetDefaultPrim().GetPath() == "/tree" and Usd.ModelAPI(made.GetDefaultPrim()).GetKind() == "component"
    assert [prim.GetName() for prim in made.GetDefaultPrim().GetChildren()] == ["wood", "Materials", "leaf"]
    assert UsdGeom.Mesh(made.GetPrimAtPath("/tree/wood")).GetSubdivisionSchemeAttr().Get() == "none"


def test_seed_and_version_stand_in_the_metadata(tmp_path):
    made = stage(tmp_path, ASSETS["plain"]())
    told = made.GetRootLayer().customLayerData
    assert told["seed"] == 3 and told["template"] == "oak" and told["creator"].startswith("SketchTree ")


def test_a_texture_s_first_row_is_at_the_top(tmp_path):
    made = stage(tmp_path, Asset.of([square()]))
    st = np.array(UsdGeom.PrimvarsAPI(made.GetPrimAtPath("/tree/wood")).GetPrimvar("st").Get())
    np.testing.assert_allclose(st, [(0, 0), (1, 0), (1, 1), (0, 1)])


def test_textures_lie_in_a_folder_named_after_the_file(tmp_path):
    write_asset(tmp_path / "t.usda", ASSETS["plain"]())
    assert sorted(path.name for path in (tmp_path / "t_textures").iterdir()) == [
        "leaf_checks_albedo.png", "wood_checks_albedo.jpg", "wood_checks_normal.jpg", "wood_checks_roughness.jpg",
    ]  # fmt: skip


def test_a_package_is_one_file_whose_parts_begin_at_multiples_of_64(tmp_path):
    import zipfile

    write_asset(tmp_path / "t.usdz", ASSETS["plain"]())
    assert [path.name for path in tmp_path.iterdir()] == ["t.usdz"]
    with zipfile.ZipFile(tmp_path / "t.usdz") as package:
        data = (tmp_path / "t.usdz").read_bytes()
        for entry in package.infolist():
            begins = entry.header_offset + 30 + len(entry.filename) + int.from_bytes(data[entry.header_offset + 28 : entry.header_offset + 30], "little")
            assert begins % 64 == 0 and entry.compress_type == zipfile.ZIP_STORED and entry.date_time == (1980, 1, 1, 0, 0, 0)
        assert package.namelist()[0] == "t.usdc"


def test_a_leaf_is_cut_out_two_sided_and_tinted(tmp_path):
    made = stage(tmp_path, ASSETS["plain"]())
    leaf = made.GetPrimAtPath("/tree/leaf")
    material = UsdShade.MaterialBindingAPI(leaf).ComputeBoundMaterial()[0]
    surface = material.ComputeSurfaceSource()[0]
    assert UsdGeom.Mesh(leaf).GetDoubleSidedAttr().Get() and surface.GetInput("opacityThreshold").Get() == 0.5
    albedo = UsdShade.Shader(surface.GetInput("diffuseColor").GetConnectedSources()[0][0].source.GetPrim())
    np.testing.assert_allclose(albedo.GetInput("scale").Get(), (0.5, 1.0, 0.25, 1.0))
    cut = UsdShade.Shader(surface.GetInput("opacity").GetConnectedSources()[0][0].source.GetPrim())
    assert not cut.GetInput("scale")  # Blender takes the alpha of a scaled texture for its colour
    assert np.allclose(UsdGeom.PrimvarsAPI(leaf).GetPrimvar("displayColor").Get(), (0.5, 1.0, 0.25))


def test_many_tints_become_a_few_materials_whose_faces_are_all_there(tmp_path):
    count = 30
    leaf = dataclasses.replace(scattered(count)).merged()
    made = stage(tmp_path, Asset.of([leaf]))
    subsets = UsdShade.MaterialBindingAPI(made.GetPrimAtPath("/tree/leaf")).GetMaterialBindSubsets()
    faces = np.concatenate([np.array(subset.GetIndicesAttr().Get()) for subset in subsets])
    assert len(subsets) == 8 and sorted(faces.tolist()) == list(range(2 * count))
    assert len(made.GetPrimAtPath("/tree/Materials").GetChildren()) == 8


def test_few_tints_are_kept_as_they_are_and_many_are_near_theirs():
    rng = np.random.default_rng(0)
    given = rng.uniform(0.4, 0.9, (3, 3))
    kept = few_tints(np.repeat(given, 4, axis=0))
    np.testing.assert_allclose(kept[nearest(given, kept)], given, atol=1e-4)
    ramp = np.linspace(0, 1, 400)[:, None] * [0.5, 0.2, -0.1] + [0.4, 0.6, 0.3]  # from green to yellow
    kept = few_tints(ramp)
    assert len(kept) == 8 and np.abs(kept[nearest(ramp, kept)] - ramp).max() < 0.04


def test_parts_and_levels_that_wear_one_material_share_its_tints(tmp_path):
    one = scattered(40)
    two = dataclasses.replace(one, color=one.color * [0.9, 0.8, 1.0, 1.0])
    made = stage(tmp_path, Asset((Level((one, two), 0.5), Level((one.merged(),)))))
    assert len(made.GetPrimAtPath("/tree/Materials").GetChildren()) == 8


def test_places_are_an_instancer_with_a_prototype_a_tint(tmp_path):
    made = stage(tmp_path, Asset.of([scattered(20)]))
    places = UsdGeom.PointInstancer(made.GetPrimAtPath("/tree/leaf"))
    assert len(places.GetPrototypesRel().GetTargets()) == 8 and len(places.GetPositionsAttr().Get()) == 20
    np.testing.assert_allclose(np.array(places.GetPositionsAttr().Get()), scattered(20).translation, atol=1e-6)


def test_levels_are_variants_and_the_finest_is_chosen(tmp_path):
    made = stage(tmp_path, detailed())
    levels = made.GetDefaultPrim().GetVariantSet("LOD")
    assert levels.GetVariantNames() == ["LOD0", "LOD1", "LOD2"] and levels.GetVariantSelection() == "LOD0"
    levels.SetVariantSelection("LOD2")
    drawn = [prim.GetName() for prim in made.GetDefaultPrim().GetChildren() if prim.IsA(UsdGeom.Mesh)]
    assert drawn == ["leaf_card"]
    assert UsdShade.MaterialBindingAPI(made.GetPrimAtPath("/tree/leaf_card")).ComputeBoundMaterial()[0]


def test_bones_bend_what_names_them(tmp_path):
    made = stage(tmp_path, ASSETS["bones"]())
    skeleton = UsdSkel.Skeleton(made.GetPrimAtPath("/tree/bones"))
    assert list(skeleton.GetJointsAttr().Get()) == ["trunk", "trunk/limb"] and made.GetDefaultPrim().GetTypeName() == "SkelRoot"
    query = UsdSkel.Cache().GetSkelQuery(skeleton)
    assert query and query.HasBindPose()
    np.testing.assert_allclose(np.array(query.GetJointWorldBindTransforms()[1])[3, :3], [0, 0.5, 0])
    assert UsdSkel.BindingAPI(made.GetPrimAtPath("/tree/wood")).GetSkeletonRel().GetTargets() == ["/tree/bones"]


@pytest.mark.parametrize("suffix", KINDS)
def test_what_is_written_is_read_back(tmp_path, suffix):
    write_asset(tmp_path / f"t.{suffix}", ASSETS["plain"]())
    back = read_usd(tmp_path / f"t.{suffix}")
    wood, leaf = back.parts
    np.testing.assert_allclose(leaf.color, leafy().color)
    np.testing.assert_allclose(wood.uv, textured().uv, atol=1e-6)
    np.testing.assert_array_equal(leaf.material.base_color_texture, leafy().material.base_color_texture)
    assert wood.material.name == "wood_checks" and wood.material.normal_texture is not None and wood.material.roughness_texture.shape == checks().shape[:2]
    assert leaf.material.alpha_cutoff == 0.5 and leaf.material.double_sided and leaf.material.base_color == (1, 1, 1, 1)
    assert len(back.skeleton) == len(curved()) and back.about == {"seed": 3, "template": "oak"}


def test_places_levels_and_bones_are_read_back(tmp_path):
    write_asset(tmp_path / "t.usdc", ASSETS["bones and levels"]())
    back = read_usd(tmp_path / "t.usdc")
    assert [level.triangle_count for level in back.levels] == [12, 2] and [level.coverage for level in back.levels] == [0.5, 0.0]
    assert back.armature.name == bones().name
    np.testing.assert_allclose(back.armature.rotation, bones().rotation, atol=1e-9)
    wood, leaf = back.parts
    np.testing.assert_allclose(wood.extra["WEIGHTS_0"], bending().extra["WEIGHTS_0"], atol=1e-6)
    np.testing.assert_allclose(leaf.rotation * np.sign(leaf.rotation[:, 3:]), scattered().rotation * np.sign(scattered().rotation[:, 3:]), atol=1e-3)
    np.testing.assert_allclose(leaf.color, scattered().color, atol=1e-6)


def test_polygons_of_another_program_are_cut_into_fans(tmp_path):
    made = Usd.Stage.CreateNew(str(tmp_path / "t.usda"))
    mesh = UsdGeom.Mesh.Define(made, "/a")
    mesh.CreatePointsAttr([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)])
    mesh.CreateFaceVertexCountsAttr([4])
    mesh.CreateFaceVertexIndicesAttr([0, 1, 2, 3])
    made.Save()
    (part,) = read_usd(tmp_path / "t.usda").parts
    assert part.triangle.tolist() == [[0, 1, 2], [0, 2, 3]]


def test_what_is_no_usd_is_named(tmp_path):
    (tmp_path / "t.usda").write_text("no usd")
    with pytest.raises(ExportError, match="can't be read as USD. Check the path, or write it again."):
        read_usd(tmp_path / "t.usda")
    Usd.Stage.CreateNew(str(tmp_path / "empty.usda")).Save()
    with pytest.raises(ExportError, match="holds no mesh. Give a USD file with meshes of triangles."):
        read_usd(tmp_path / "empty.usda")


def test_a_number_that_is_not_finite_is_named(tmp_path):
    bad = dataclasses.replace(square(), uv=np.full((4, 2), np.nan))
    with pytest.raises(ExportError, match="The uv of a vertex of mesh `wood` is not a finite number"):
        write_asset(tmp_path / "t.usdz", Asset.of([bad]))
    assert list(tmp_path.iterdir()) == []


def test_names_that_usd_does_not_allow_are_made_so(tmp_path):
    odd = [dataclasses.replace(square(), name="wood 1"), dataclasses.replace(square(), name="wood-1")]
    made = stage(tmp_path, Asset.of(odd, name="7 trees"))
    assert made.GetDefaultPrim().GetName() == "_7_trees"
    assert [prim.GetName() for prim in made.GetDefaultPrim().GetChildren() if prim.IsA(UsdGeom.Mesh)] == ["wood_1", "wood_1_2"]


def test_a_full_folder_for_temporary_files_is_named(tmp_path, monkeypatch):
    from sketchtree.export.usd import write

    monkeypatch.setattr(write.Path, "read_bytes", lambda path: (_ for _ in ()).throw(OSError(28, "No space left on device")))
    with pytest.raises(ExportError, match="USD could not be written to the folder for temporary files, .*Free some space there, or name another folder in TMPDIR."):
        write_asset(tmp_path / "t.usdz", ASSETS["plain"]())
    assert list(tmp_path.iterdir()) == []
