"""The Khronos validator has nothing to say about our files; it does not know EXT_mesh_gpu_instancing, MSFT_lod and
KHR_materials_diffuse_transmission, and its remarks on those are no warnings.

It runs where Node is installed and knows the npm package `gltf-validator`: globally, in a `node_modules` folder above
the repository, or in the folder that the variable GLTF_VALIDATOR names.
"""

import dataclasses
from pathlib import Path

import numpy as np
import pytest
from shapes import bars, bending, bones, curved, detailed, leafy, scattered, square, textured

from benchmarks.real_programs.validators import gltf_issues, gltf_validator
from sketchtree.asset import Asset, Level
from sketchtree.commands.app import run
from sketchtree.export.gltf import write_gltf

EXAMPLES = sorted(path for path in (Path(__file__).parents[2] / "examples").iterdir() if path.suffix in (".svg", ".json"))


def translucent():
    """A leaf with everything a leaf can have."""
    flat = np.broadcast_to(np.array([128, 128, 255], np.uint8), (8, 8, 3))
    through = np.full((8, 8, 3), 90, np.uint8)
    material = dataclasses.replace(leafy().material, normal_texture=flat, translucency=0.4, translucency_texture=through)
    return dataclasses.replace(leafy(), material=material)


ASSETS = {
    "plain": lambda: Asset.of([square()]),
    "wood": lambda: Asset.of([textured()]),
    "leaf": lambda: Asset.of([translucent()]),
    "both": lambda: Asset.of([textured(), leafy()], skeleton=curved(), about={"seed": 0}),
    "none": lambda: Asset.of([]),
    "places": lambda: Asset.of([textured(), scattered()]),
    "levels": detailed,
    "bones, two texture sets, two colour sets": lambda: Asset.of([bending(), translucent()], armature=bones(), capsules=bars()),
    "bones and levels": lambda: Asset((Level((bending(), scattered()), 0.5), Level((square("card"),))), curved(), armature=bones()),
}


@pytest.fixture(scope="module", autouse=True)
def validator():
    if why := gltf_validator():
        pytest.skip(why)


@pytest.mark.parametrize("suffix", ["glb", "gltf"])
@pytest.mark.parametrize("name", ASSETS)
def test_no_error_and_no_warning(tmp_path, name, suffix):
    write_gltf(tmp_path / f"t.{suffix}", ASSETS[name](), collision=["collision_0", "collision_1"])
    (found,) = gltf_issues(tmp_path / f"t.{suffix}")
    assert (found["numErrors"], found["numWarnings"]) == (0, 0), found["messages"]


def test_no_error_and_no_warning_on_any_example(tmp_path):
    made = [tmp_path / f"{path.stem}.glb" for path in EXAMPLES]
    for path, target in zip(EXAMPLES, made, strict=True):
        assert run(["build", str(path), "-o", str(target), "--generations", "1", "--method", "flat", "--quiet"]) == 0
    for path, found in zip(made, gltf_issues(*made), strict=True):
        assert (found["numErrors"], found["numWarnings"]) == (0, 0), (path.name, found["messages"])
