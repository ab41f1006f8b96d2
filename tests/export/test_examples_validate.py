"""One small tree of every kind of file, as the command line writes it, before the formats' validators: they have nothing to say.

Each runs where it is found (benchmarks/README.md says how to name it). Levels of detail are made of the same meshes here: what they look like is tested in `levels`.
"""

import json
from importlib.util import find_spec

import pytest

from benchmarks.real_programs import three_opens
from benchmarks.real_programs.validators import gltf_issues, gltf_validator, usd_issues
from sketchtree import tree_asset
from sketchtree.asset import Level
from sketchtree.commands.app import run
from sketchtree.levels import make

SKETCH = """<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 100"><path d="M50 95 L50 40" stroke="black" fill="none" stroke-width="4"/>
<path d="M50 70 L25 40" stroke="black" fill="none" stroke-width="2"/><path d="M50 60 L75 30" stroke="black" fill="none" stroke-width="2"/></svg>"""
SMALL = ["--method", "flat", "--generations", "1", "--quiet"]
KINDS = {
    "broadleaf": ["--template", "apple"],
    "spring": ["--template", "apple", "--season", "spring"],
    "bare": ["--template", "apple", "--season", "bare"],
    "conifer": ["--template", "norway_spruce_young"],
    "palm": ["--template", "coconut_palm"],
    "tubes": ["--template", "apple", "--wood", "tubes"],
    "instanced": ["--template", "apple", "--season", "spring", "--leaves", "instanced"],
    "together": ["--template", "apple", "--levels", "together"],
    "together_instanced": ["--template", "apple", "--levels", "together", "--leaves", "instanced"],
    "nothing": ["--template", "apple", "--generations", "0", "--leaf", "none"],
}


def levels(model, **_):
    """Two levels of the same meshes, instead of those that take long."""
    return Level(model.meshes, 0.5), Level(model.meshes)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """Every kind as GLB, some as glTF and USD, a game pack, and what `convert` makes of them."""
    place = tmp_path_factory.mktemp("kinds")
    (place / "t.svg").write_text(SKETCH)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(tree_asset, "make_levels", levels)
        patch.setattr(make, "make_levels", levels)
        for name, how in KINDS.items():
            assert run(["build", str(place / "t.svg"), "-o", str(place / f"{name}.glb"), *SMALL, *how]) == 0
        assert run(["build", str(place / "t.svg"), "-o", str(place / "game.glb"), "--template", "apple", "--pack", "game", *SMALL]) == 0
    for name in ("instanced", "together", "game"):
        for suffix in ("gltf", "usdz", "usda") if find_spec("pxr") else ("gltf",):
            assert run(["convert", str(place / f"{name}.glb"), str(place / f"{name}_again.{suffix}"), "--quiet"]) == 0
    return place


@pytest.mark.skipif(gltf_validator() is not None, reason=gltf_validator() or "")
def test_the_gltf_validator_has_no_error_and_no_warning(folder):
    paths = sorted(path for path in folder.iterdir() if path.suffix in (".glb", ".gltf"))
    assert len(paths) >= len(KINDS) + 3 + 3
    for path, found in zip(paths, gltf_issues(*paths), strict=True):
        assert (found["numErrors"], found["numWarnings"]) == (0, 0), (path.name, found["messages"])


@pytest.mark.skipif(find_spec("pxr") is None, reason="usd-core is not installed")
@pytest.mark.parametrize("suffix", ["usdz", "usda"])
@pytest.mark.parametrize("name", ["instanced", "together", "game"])
def test_the_validators_of_usd_have_nothing_to_say(folder, name, suffix):
    assert usd_issues(folder / f"{name}_again.{suffix}") == []


@pytest.mark.skipif(three_opens.missing() is not None, reason=three_opens.missing() or "")
def test_three_sees_what_we_see(folder):
    paths = [*(folder / f"{name}.glb" for name in KINDS), folder / "game.glb", folder / "instanced_again.gltf"]
    for path, seen in zip(paths, three_opens.seen_by_three(paths), strict=True):
        assert "error" not in seen, (path.name, seen)
        assert three_opens.differences(seen, path) + seen["said"] == [], path.name


def test_every_file_of_the_pack_is_there_and_named_in_it(folder):
    listed = {row["name"] for row in json.loads((folder / "game.pack.json").read_text())["files"]}
    assert listed == {path.name for path in folder.iterdir() if path.name.startswith("game") and "again" not in path.name}
