"""`sketchtree convert A B`: every kind of file into every other, and what it refuses."""

import json
from pathlib import Path

import numpy as np
import pytest

from sketchtree.commands.app import run
from sketchtree.export.files import MESHES, SKELETONS
from sketchtree.export.gltf import read_asset, read_glb
from sketchtree.export.read import read_contents
from sketchtree.export.write import write_asset, write_skeleton
from sketchtree.skeleton import TreeSkeleton
from tests.export.shapes import curved, detailed, leafy, textured

OAK = Path(__file__).parents[2] / "examples" / "oak.svg"
READ_MESHES = [suffix for suffix in MESHES if suffix != ".3mf"]


def without(suffix):
    if suffix.startswith(".usd"):
        pytest.importorskip("pxr", reason="usd-core is not installed")


def converted(source, target, *options):
    assert run(["convert", str(source), str(target), "--quiet", *options]) == 0
    return target


def said(arguments, capfd):
    status = run(["convert", *map(str, arguments)])
    return status, capfd.readouterr().err.strip().splitlines()[-1]


@pytest.fixture(scope="module")
def project(tmp_path_factory):
    """A small tree in autumn leaves, as a project and as what `build` makes of it."""
    folder = tmp_path_factory.mktemp("project")
    how = ["--template", "english_oak", "--method", "flat", "--generations", "0", "--season", "autumn", "--seed", "5", "--quiet"]
    for name in ("t.sketchtree", "built.glb"):
        assert run(["build", str(OAK), "-o", str(folder / name), *how]) == 0
    return folder


@pytest.mark.parametrize("b", SKELETONS)
@pytest.mark.parametrize("a", SKELETONS)
def test_skeletons_keep_their_nodes(tmp_path, a, b):
    write_skeleton(tmp_path / f"a{a}", curved(), header={"units": "metres", "seed": 7})
    back = read_contents(converted(tmp_path / f"a{a}", tmp_path / f"b{b}")).skeleton
    points = np.concatenate([back.tip, back.curve_points])
    given = np.concatenate([curved().tip, curved().curve_points])
    np.testing.assert_allclose(points[np.lexsort(np.round(points, 6).T)], given[np.lexsort(np.round(given, 6).T)], atol=1e-8)


def test_units_and_seed_are_carried_over(tmp_path):
    write_skeleton(tmp_path / "a.swc", curved(), header={"units": "sketch units", "frame": "sketch", "seed": 7})
    for name in ("b.json", "c.mtg", "d.swc", "e.h5"):
        converted(tmp_path / "a.swc", tmp_path / name)
        assert read_contents(tmp_path / name).header == {"units": "sketch units", "frame": "sketch", "seed": "7"}


@pytest.mark.parametrize("b", MESHES)
@pytest.mark.parametrize("a", READ_MESHES)
def test_meshes_keep_their_triangles(tmp_path, a, b):
    without(a), without(b)
    write_asset(tmp_path / f"a{a}", detailed() if a in (".glb", ".usdz") else detailed().of([textured(), leafy()]))
    converted(tmp_path / f"a{a}", tmp_path / f"b{b}")
    if b != ".3mf":
        before, after = (read_contents(tmp_path / name).asset for name in (f"a{a}", f"b{b}"))
        assert after.levels[0].triangle_count == before.levels[0].triangle_count
        if a in (".glb", ".usdz") and b in (".gltf", ".usda"):
            assert len(after.levels) == 3 and len(after.skeleton) == len(curved())


@pytest.mark.parametrize("b", [".gltf", ".usdz", ".obj"])
def test_materials_are_kept(tmp_path, b):
    without(b)
    write_asset(tmp_path / "a.glb", detailed().of([textured(), leafy()]))
    wood, leaf = read_contents(converted(tmp_path / "a.glb", tmp_path / f"b{b}")).asset.parts
    assert wood.material.name == "wood_checks" and wood.material.normal_texture is not None and wood.material.roughness_texture is not None
    assert leaf.material.alpha_cutoff == 0.5 and leaf.material.double_sided
    np.testing.assert_array_equal(leaf.material.base_color_texture[..., 3], leafy().material.base_color_texture[..., 3])


@pytest.mark.parametrize("a", [".glb", ".usda"])
def test_a_mesh_of_ours_holds_its_skeleton(tmp_path, a):
    without(a)
    write_asset(tmp_path / f"a{a}", detailed())
    back = read_contents(converted(tmp_path / f"a{a}", tmp_path / "b.json"))
    np.testing.assert_allclose(back.skeleton.tip, curved().tip, atol=1e-6)
    assert back.header == {"units": "metres", "frame": "world", "seed": 3}


def test_a_skeleton_becomes_bare_wood_unless_leaves_are_asked_for(tmp_path, capfd):
    write_skeleton(tmp_path / "a.swc", curved(), header={})
    status, line = said([tmp_path / "a.swc", tmp_path / "b.glb"], capfd)
    assert status == 0 and ", bark oak, no leaves (`--leaf MODEL` adds them), " in line
    assert all(mesh.name.startswith("wood") for mesh in read_glb(tmp_path / "b.glb"))
    write_skeleton(tmp_path / "thin.swc", curved().replace(radius=curved().radius * 0.05), header={})
    status, line = said([tmp_path / "thin.swc", tmp_path / "c.glb", "--leaf", "maple", "--bark", "beech", "--season", "autumn"], capfd)
    assert status == 0 and ", bark beech, leaves maple, " in line
    assert {mesh.material.name.split("_")[0] for mesh in read_glb(tmp_path / "c.glb")} == {"wood", "leaf"}


def test_leaves_that_find_no_twig_are_told(tmp_path, capfd):
    write_skeleton(tmp_path / "a.swc", curved(), header={})
    assert run(["convert", str(tmp_path / "a.swc"), str(tmp_path / "b.glb"), "--leaf", "maple"]) == 0
    assert "Note: No leaf grew: no branch of " in capfd.readouterr().err


def test_other_units_are_taken_for_metres_and_told(tmp_path, capfd):
    write_skeleton(tmp_path / "a.swc", curved(), header={"units": "sketch units"})
    assert run(["convert", str(tmp_path / "a.swc"), str(tmp_path / "b.glb")]) == 0
    assert "a.swc is in sketch units; they were taken for metres." in capfd.readouterr().err


def test_a_project_wears_what_it_was_built_with(project, tmp_path):
    converted(project / "t.sketchtree", tmp_path / "b.glb")
    assert (tmp_path / "b.glb").read_bytes() == (project / "built.glb").read_bytes()


def test_another_seed_turns_the_leaves_of_a_project(project, tmp_path):
    converted(project / "t.sketchtree", tmp_path / "b.glb", "--seed", "6")
    assert read_asset(tmp_path / "b.glb").about["seed"] == 6
    assert (tmp_path / "b.glb").read_bytes() != (project / "built.glb").read_bytes()


def test_a_project_can_be_built_again(project, tmp_path):
    how = ["--template", "english_oak", "--method", "flat", "--generations", "0", "--season", "autumn", "--seed", "5", "--quiet"]
    assert run(["build", str(project / "t.sketchtree"), "-o", str(tmp_path / "b.glb"), *how]) == 0
    assert (tmp_path / "b.glb").read_bytes() == (project / "built.glb").read_bytes()


def test_the_report_says_what_was_done(tmp_path):
    write_skeleton(tmp_path / "a.json", curved(), header={})
    converted(tmp_path / "a.json", tmp_path / "b.glb", "--report", str(tmp_path / "r.json"))
    report = json.loads((tmp_path / "r.json").read_text())
    assert report["command"] == "convert" and report["segments"] == 4 and report["warnings"] == []
    assert report["triangles"] == {"wood": read_asset(tmp_path / "b.glb").levels[0].triangle_count, "leaf": 0}


def test_what_the_format_can_not_hold_is_told(tmp_path, capfd):
    write_asset(tmp_path / "a.glb", detailed())
    assert run(["convert", str(tmp_path / "a.glb"), str(tmp_path / "b.obj")]) == 0
    assert "holds the finest of 3 levels of detail; `.obj` has no place for more." in capfd.readouterr().err


@pytest.mark.parametrize(
    ("a", "b", "options", "message"),
    [
        ("a.glb", "a.glb", [], "a.glb is what is to be read, too. Give the new file another name."),
        ("a.glb", "b.fbx", [], "`.fbx` files are not written."),
        ("a.glb", "b.sketchtree", [], "`.sketchtree` files are not written."),
        ("a.fbx", "b.glb", [], "`.fbx` files are not converted. Give a file that ends in one of .glb, .gltf,"),
        ("a", "b.glb", [], "it has no extension to tell the format."),
        ("none.glb", "b.swc", [], "none.glb can't be read"),
        ("none.usda", "b.swc", [], "none.usda can't be read: no such file or directory. Check the path."),
        ("none.swc", "b.glb", [], "no such file or directory. Check the path."),
        ("a.obj", "b.swc", [], "a.obj holds no skeleton. Give a skeleton, a project, or a glTF or USD file that `sketchtree build` wrote."),
        ("a.glb", "b.obj", ["--leaf", "oak"], "`--leaf` changes nothing in"),
        ("a.swc", "b.mtg", ["--bark", "oak"], "a skeleton wears nothing. Leave it out, or convert a skeleton to a mesh."),
        ("a.swc", "b.glb", ["--bark", "steel"], "There is no bark called “steel”."),
        ("a.swc", "b.glb", ["--leaf", "steel"], "There is no leaf called “steel”."),
        ("a.swc", "no/b.glb", [], "does not exist. Create it, or choose another path."),
    ],
)
def test_what_can_not_be_done_is_refused(tmp_path, capfd, monkeypatch, a, b, options, message):
    without(Path(a).suffix)
    write_asset(tmp_path / "a.glb", detailed().of([textured()]))
    write_asset(tmp_path / "a.obj", detailed().of([textured()]))
    write_skeleton(tmp_path / "a.swc", curved(), header={})
    (tmp_path / "a.fbx").write_bytes(b"")
    (tmp_path / "a").write_bytes(b"")
    was = sorted(tmp_path.iterdir())
    status, line = said([tmp_path / a, tmp_path / b, *options], capfd)
    assert status == 2 and message in line
    assert sorted(tmp_path.iterdir()) == was


def test_a_skeleton_of_nothing_becomes_a_file_of_nothing(tmp_path):
    empty = TreeSkeleton.from_columns(np.zeros(0, int), np.zeros((0, 3)), np.zeros(0))
    write_skeleton(tmp_path / "a.json", empty, header={})
    assert read_glb(converted(tmp_path / "a.json", tmp_path / "b.glb")) == []


def test_without_usd_core_the_remedy_is_named(tmp_path, capfd, monkeypatch):
    from sketchtree.export import files

    monkeypatch.setattr(files, "find_spec", lambda name: None)
    (tmp_path / "a.usda").write_text("#usda 1.0")
    status, line = said([tmp_path / "a.usda", tmp_path / "b.glb"], capfd)
    assert status == 2 and "a.usda: USD needs the package `usd-core`. Install it: pip install 'sketchtree[usd]'." in line


@pytest.mark.parametrize("far", ["1e30", "2e5"])
def test_a_stray_point_is_named(tmp_path, capfd, far):
    (tmp_path / "a.swc").write_text(f"1 0 0 0 0 0.1 -1\n2 0 0 1 0 0.1 1\n3 0 {far} {far} 0 0.1 2\n")
    assert said([tmp_path / "a.swc", tmp_path / "b.glb"], capfd) == (2, (
        f"sketchtree: Row 2: it lies {float(far):.3g} m away from the origin, farther than any tree. Scale the skeleton to metres, or take the stray point out."
    ))  # fmt: skip
    assert run(["view", str(tmp_path / "a.swc"), "--screenshot", str(tmp_path / "b.png")]) == 2
    assert [path.name for path in tmp_path.iterdir()] == ["a.swc"]


def test_a_length_whose_square_is_no_number_is_named(tmp_path, capfd):
    (tmp_path / "a.swc").write_text("1 0 0 0 0 0.1 -1\n2 0 0 1e308 0 0.1 1\n")
    told = f"sketchtree: {tmp_path / 'a.swc'}: a node lies at 1e+308; lengths beyond 1e+100 can't be reckoned with. Take the stray point out."
    assert said([tmp_path / "a.swc", tmp_path / "b.json"], capfd) == (2, told)


@pytest.mark.parametrize("rest", ["", "2 0 0 0 0 0.1 1\n"], ids=["one node", "one segment without length"])
def test_that_there_is_nothing_to_draw_is_told(tmp_path, capfd, rest):
    (tmp_path / "a.swc").write_text("1 0 0 0 0 0.1 -1\n" + rest)
    assert run(["convert", str(tmp_path / "a.swc"), str(tmp_path / "b.glb"), "--leaf", "oak"]) == 0
    assert f"Note: {tmp_path / 'a.swc'} has no branch of any length, so there is nothing to draw." in capfd.readouterr().err


def test_a_file_that_was_cut_short_is_told(tmp_path, capfd):
    write_asset(tmp_path / "a.glb", detailed())
    data = (tmp_path / "a.glb").read_bytes()
    (tmp_path / "c.glb").write_bytes(data[: len(data) // 2])
    told = f"sketchtree: {tmp_path / 'c.glb'} is cut short: it has {len(data) // 2:,} bytes of {len(data):,}. Write it again, or copy it again."
    assert said([tmp_path / "c.glb", tmp_path / "b.obj"], capfd) == (2, told)


def test_what_is_missing_beside_a_gltf_is_named(tmp_path, capfd):
    write_asset(tmp_path / "a.gltf", detailed())
    (tmp_path / "a.bin").unlink()
    assert said([tmp_path / "a.gltf", tmp_path / "b.obj"], capfd) == (2, f"sketchtree: {tmp_path / 'a.gltf'} can't be read: a.bin: no such file or directory. Check the path.")
    (tmp_path / "a.gltf").write_text("{")
    told = f"sketchtree: {tmp_path / 'a.gltf'} is not a glTF file that can be shown. Give a .gltf file with its buffers and textures beside it."
    assert said([tmp_path / "a.gltf", tmp_path / "b.obj"], capfd) == (2, told)


def test_what_can_not_be_printed_is_not(tmp_path, capfd):
    (tmp_path / "a.swc").write_bytes(b"\x00\x1b[31m 5\n")
    assert "got `??[31m 5`." in said([tmp_path / "a.swc", tmp_path / "b.obj"], capfd)[1]
