"""Blender, three.js and NeuroM see in our files what we see. Each runs where it is found; benchmarks/README.md says how to name it."""

import dataclasses
from importlib.util import find_spec
from pathlib import Path

import numpy as np
import pytest
from shapes import bending, bones, curved, detailed, keys, leafy, moved, moving, scattered, square, textured

from benchmarks.real_programs import blender_opens, moves, neurom_opens, ours, three_opens
from sketchtree.asset import Asset, Level
from sketchtree.commands.app import run
from sketchtree.export.read import read_contents
from sketchtree.export.write import write_asset

OAK = Path(__file__).parents[2] / "examples" / "oak.svg"
ASSETS = {
    "plain": lambda: Asset.of([textured(), leafy()], skeleton=curved()),
    "places": lambda: Asset.of([textured(), scattered()]),
    "levels": detailed,
    "bones": lambda: Asset.of([bending(), leafy()], armature=bones()),
    "bones_and_levels": lambda: Asset((Level((bending(), leafy()), 0.5), Level((square("card"),))), armature=bones()),
}


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A file of each asset and kind, and a small oak."""
    place = tmp_path_factory.mktemp("files")
    for name, asset in ASSETS.items():
        for suffix in ("glb", "gltf", "obj"):
            write_asset(place / f"{name}.{suffix}", asset())
    assert run(["build", str(OAK), "-o", str(place / "oak.glb"), "--skeleton", str(place / "oak.swc"), "--generations", "1", "--quiet"]) == 0
    for suffix in ("obj", "usdz") if find_spec("pxr") else ("obj",):
        assert run(["convert", str(place / "oak.glb"), str(place / f"oak.{suffix}"), "--quiet"]) == 0
    return place


def needs(program):
    """Skipped, with the reason, where the program can't be run."""
    return pytest.mark.skipif(program.missing() is not None, reason=program.missing() or "")


def test_what_differs_is_told(tmp_path):
    write_asset(tmp_path / "t.glb", Asset.of([textured(), leafy()]))
    seen = ours.holds(tmp_path / "t.glb")
    assert seen["triangles"] == 4 and seen["materials"] == ["leaf_checks", "wood_checks"]
    assert ours.differences(seen | {"materials": ["leaf_checks", "leaf_checks_2", "wood_checks.001"]}, tmp_path / "t.glb") == []
    wrong = {"triangles": 3, "materials": ["leaf_checks", "moss"], "bounds": [[0, 0, 0], [1, 1, 1]]}
    assert ours.differences(wrong, tmp_path / "t.glb") == [
        "3 triangles, not 4",
        "materials ['leaf_checks', 'moss'], not ['leaf_checks', 'wood_checks']",
        "bounds [[0, 0, 0], [1, 1, 1]], not [[0.0, 0.0, 0.0], [1.0, 1.0, 0.0]]",
    ]


@needs(blender_opens)
@pytest.mark.parametrize("name", ["oak.glb", "oak.obj", "oak.usdz", "places.gltf", "bones.glb"])
def test_blender_sees_what_we_see(folder, name):
    if not (folder / name).exists():
        pytest.skip("usd-core is not installed")
    seen = blender_opens.seen_by_blender(folder / name)
    assert blender_opens.differences(seen, folder / name) == []
    assert seen["bones"] == (2 if name == "bones.glb" else 0)


@needs(three_opens)
def test_three_sees_what_we_see_and_has_nothing_to_say(folder):
    paths = [folder / f"{name}.{suffix}" for name in ASSETS for suffix in ("glb", "gltf")] + [folder / "oak.glb"]
    for path, seen in zip(paths, three_opens.seen_by_three(paths), strict=True):
        assert "error" not in seen, (path.name, seen)
        assert three_opens.differences(seen, path) + seen["said"] == [], path.name
        assert seen["bones"] == (2 if "bones" in path.name else 0)


def gently():
    """What moves, its turn in steps so small that the shorter arc and a straight line between them are one."""
    time, angle = np.linspace(0, 2, 33), np.radians(np.linspace(-45, 0, 33))
    turn = keys(1, time, *np.stack([0 * angle, 0 * angle, np.sin(angle), np.cos(angle)], axis=1))
    return dataclasses.replace(moved(), animation=moving(rotation=turn, morphs=moved().animation.morphs))


@needs(three_opens)
def test_three_moves_it_as_we_do(tmp_path):
    write_asset(tmp_path / "moving.glb", gently())
    asset = read_contents(tmp_path / "moving.glb").asset
    seen = moves.in_three(tmp_path / "moving.glb", asset)
    assert moves.differences(seen, asset) == [] and seen["bones"] == 2 and len(seen["off"]) == 5 * 8


@needs(blender_opens)
@pytest.mark.parametrize("suffix", ["glb", "usdc"])
def test_blender_moves_it_as_we_do(tmp_path, suffix):
    write_asset(tmp_path / f"moving.{suffix}", gently())
    asset = read_contents(tmp_path / f"moving.{suffix}").asset
    seen = moves.in_blender(tmp_path / f"moving.{suffix}", asset)
    assert moves.differences(seen, asset) == [] and seen["bones"] == 2


@needs(neurom_opens)
def test_neurom_sees_what_we_see(folder):
    assert neurom_opens.differences(neurom_opens.seen_by_neurom(folder / "oak.swc"), folder / "oak.swc") == []
