"""`sketchtree build --lod, --levels, --leaves, --pack`: what of a tree goes into its file."""

import json

import pytest

from benchmarks.levels import leaf_area
from sketchtree.commands import app
from sketchtree.export.gltf import read_asset
from sketchtree.geometry.instances import Instances
from sketchtree.levels import make, spend
from sketchtree.levels.impostor import impostor
from sketchtree.levels.make import SHARES
from sketchtree.options import FileOptions

SKETCH = """<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 100"><path d="M50 95 L50 40" stroke="black" fill="none" stroke-width="4"/><path d="M50 70 L25 40" stroke="black" fill="none" stroke-width="2"/>
<path d="M50 60 L75 30" stroke="black" fill="none" stroke-width="2"/><path d="M50 50 L35 15" stroke="black" fill="none" stroke-width="2"/></svg>"""


@pytest.fixture(scope="module")
def sketch(tmp_path_factory):
    path = tmp_path_factory.mktemp("sketch") / "t.svg"
    path.write_text(SKETCH)
    return path


@pytest.fixture(scope="module", autouse=True)
def coarse():
    """Small pictures: how good they are is tested elsewhere."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(make, "impostor", lambda meshes: impostor(meshes, pixels=64))
        patch.setattr(make, "_PIXELS", 96)
        patch.setattr(spend, "_PIXELS", 96)
        yield


def build(sketch, out, *more):
    return app.run(["build", str(sketch), "-o", str(out), "--template", "apple", "--generations", "1", "--quiet", *more])


@pytest.fixture(scope="module")
def together(sketch, tmp_path_factory):
    out = tmp_path_factory.mktemp("together") / "t.glb"
    assert build(sketch, out, "--levels", "together") == 0
    return read_asset(out)


def test_levels_keep_their_budgets_and_the_impostor_is_last(together):
    count = [level.triangle_count for level in together.levels]
    assert len(count) == 5 and count[4] <= 16
    assert all(few <= share * count[0] for few, share in zip(count[1:4], SHARES, strict=True))
    assert [part.name for part in together.levels[4].parts][0].startswith("impostor")


def test_coverages_fall_to_nothing(together):
    coverage = [level.coverage for level in together.levels]
    assert coverage == sorted(coverage, reverse=True) and coverage[-1] == 0 < coverage[0] <= 1


def test_the_area_of_the_leaves_is_kept(together):
    """What alpha leaves of it: within 10 % on LOD1-3."""
    full = leaf_area(together.levels[0].parts)
    assert [leaf_area(level.parts) / full for level in together.levels[1:4]] == pytest.approx([1, 1, 1], abs=0.1)


def test_apart_each_level_is_a_file(sketch, tmp_path):
    assert build(sketch, tmp_path / "t.obj", "--levels", "apart", "--leaf", "none") == 0
    names = {path.name for path in tmp_path.iterdir()}
    assert {"t_LOD0.obj", "t_LOD1.obj", "t_LOD2.obj", "t_LOD3.obj", "t_impostor.obj"} <= names and "t.obj" not in names


def test_one_level_is_that_of_the_set(sketch, together, tmp_path):
    assert build(sketch, tmp_path / "t.glb", "--lod", "2", "--report", str(tmp_path / "r.json")) == 0
    asset = read_asset(tmp_path / "t.glb")
    assert asset.levels[0].triangle_count == together.levels[2].triangle_count
    assert json.loads((tmp_path / "r.json").read_text())["options"]["lod"] == 2


def test_a_tree_has_at_most_as_many_triangles_as_are_asked_for(sketch, together, tmp_path):
    wanted = together.levels[0].triangle_count // 3
    assert build(sketch, tmp_path / "t.glb", "--triangles", str(wanted), "--report", str(tmp_path / "r.json")) == 0
    assert 0.5 * wanted < read_asset(tmp_path / "t.glb").levels[0].triangle_count <= wanted
    assert json.loads((tmp_path / "r.json").read_text())["options"]["triangles"] == wanted


def test_the_preview_shows_the_level_that_is_written(sketch, tmp_path, monkeypatch):
    seen = []
    monkeypatch.setattr("sketchtree.view.preview", lambda meshes, path: (seen.append(sum(mesh.triangle_count for mesh in meshes)), (True, ""))[1])
    assert build(sketch, tmp_path / "t.glb", "--lod", "3", "--leaf", "none", "--preview", str(tmp_path / "p.png")) == 0
    assert seen == [read_asset(tmp_path / "t.glb").levels[0].triangle_count]


def test_instanced_leaves_are_few_meshes_at_many_places(sketch, together, tmp_path):
    assert build(sketch, tmp_path / "t.glb", "--leaves", "instanced") == 0
    places = [part for part in read_asset(tmp_path / "t.glb").parts if isinstance(part, Instances)]
    assert places and sum(part.triangle_count for part in places) == pytest.approx(sum(p.triangle_count for p in together.parts if p.name.startswith("leaf")), rel=0.02)


def test_a_game_pack_is_a_set_of_files_that_its_manifest_lists(sketch, tmp_path):
    assert build(sketch, tmp_path / "t.glb", "--pack", "game", "--leaf", "none") == 0
    said = json.loads((tmp_path / "t.pack.json").read_text())
    listed = {row["name"] if isinstance(row, dict) else row for row in said["files"]}
    assert {path.name for path in tmp_path.iterdir()} == listed and {"t.glb", "t_LOD3.glb", "t_impostor.glb", "t_collision.glb", "t.skeleton.json"} <= listed


@pytest.mark.parametrize(("out", "more", "said"), [
    ("t.usda", ["--pack", "game"], "`--pack game` writes GLB files, not `.usda`. Name the output t.glb."),
    ("t.obj", ["--levels", "together"], "`.obj` files hold one level of detail. Write .glb, .gltf or .usd, or ask for `--levels apart`."),
    ("t.stl", ["--leaves", "instanced"], "`.stl` files can't hold instanced leaves. Write .glb, .gltf or .usd, or leave `--leaves instanced` out."),
    ("t.swc", ["--lod", "1"], "`.swc` files hold no mesh, and so no level of detail. Leave `--lod`, `--triangles` and `--levels` out, or write a mesh."),
    ("t.glb", ["--lod", "1", "--pack", "game"], "`--lod 1` asks for one level of detail, `--pack game` for all of them. Leave one of the two out."),
    ("t.glb", ["--lod", "1", "--levels", "apart"], "`--lod 1` asks for one level of detail, `--levels apart` for all of them. Leave one of the two out."),
    ("t.glb", ["--leaves", "instanced", "--lod", "3"], "`--leaves instanced` can't be had with `--lod 3`, whose leaves are one mesh. Leave one of the two out."),
    ("t.glb", ["--lod", "1", "--triangles", "900"], "`--lod 1` and `--triangles 900` both say how fine the meshes are. Leave one of the two out."),
    ("t.glb", ["--triangles", "900", "--pack", "game"], "`--triangles 900` asks for one level of detail, `--pack game` for all of them. Leave one of the two out."),
    ("t.glb", ["--triangles", "3"], "`--triangles 3` are too few for a tree. Give 12 or more."),
    ("t.glb", ["--pack", "game", "--levels", "apart"], "`--pack game` writes all levels of detail in any case. Leave `--levels apart` out."),
    ("t.glb", ["--pixel-error", "0"], "`--pixel-error 0` is out of range. Give pixels above 0, at most 100."),
])  # fmt: skip
def test_what_can_not_be_had_is_refused_before_the_work(sketch, tmp_path, capsys, out, more, said):
    assert build(sketch, tmp_path / out, *more) == 2
    assert said in capsys.readouterr().err and not list(tmp_path.iterdir())


def test_the_defaults_are_one_whole_level():
    assert FileOptions() == FileOptions(lod=0, levels="one", leaves="merged", pack=None)
