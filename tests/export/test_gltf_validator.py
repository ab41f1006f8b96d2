"""The Khronos validator has nothing to say about our files.

It runs where Node is installed and knows the npm package `gltf-validator`: globally, in a `node_modules` folder above
the repository, or in the folder that the variable GLTF_VALIDATOR names.
"""

import json
import os
import shutil
import subprocess

import pytest
from shapes import leafy, square, textured

from sketchtree.export.gltf import write_glb

SCRIPT = """
const validator = require('gltf-validator');
const bytes = new Uint8Array(require('fs').readFileSync(process.argv[1]));
validator.validateBytes(bytes).then((report) => console.log(JSON.stringify(report.issues)));
"""


def node(*arguments):
    places = [os.environ.get("GLTF_VALIDATOR", ""), os.environ.get("NODE_PATH", "")]
    if shutil.which("npm"):
        places.append(subprocess.run(["npm", "root", "-g"], capture_output=True, text=True, check=False).stdout.strip())
    places += [os.path.join(place, "node_modules") for place in places if place]
    environment = os.environ | {"NODE_PATH": os.pathsep.join(filter(None, places))}
    return subprocess.run(["node", "-e", *arguments], capture_output=True, text=True, env=environment, check=False)


@pytest.fixture(scope="module")
def validate():
    if not shutil.which("node"):
        pytest.skip("Node is not installed")
    if node("require('gltf-validator')").returncode:
        pytest.skip("the npm package gltf-validator is not installed (set GLTF_VALIDATOR to its folder)")

    def issues(path):
        result = node(SCRIPT, str(path))
        assert result.returncode == 0, result.stderr
        return json.loads(result.stdout)

    return issues


@pytest.mark.parametrize("meshes", [[square()], [textured()], [leafy()], [textured(), leafy()], []], ids=["plain", "wood", "leaf", "both", "none"])
def test_no_error_and_no_warning(validate, tmp_path, meshes):
    write_glb(tmp_path / "t.glb", meshes, extras={"seed": 0})
    found = validate(tmp_path / "t.glb")
    assert (found["numErrors"], found["numWarnings"]) == (0, 0), found["messages"]


def test_a_whole_tree_passes(validate, tmp_path):
    import jax
    import numpy as np

    from sketchtree.geometry.wood import wood_mesh
    from sketchtree.skeleton import TreeSkeleton

    tree = TreeSkeleton.from_columns(np.array([-1, 0, 1, 1]), np.array([(0, 0, 0), (0, 1, 0), (0.2, 2, 0), (0.8, 1.5, 0.4)]), np.array([0.1, 0.09, 0.03, 0.02]), limb=np.array([0, 0, 0, 1]))
    write_glb(tmp_path / "t.glb", [wood_mesh(tree, bark="oak", key=jax.random.key(0))])
    found = validate(tmp_path / "t.glb")
    assert (found["numErrors"], found["numWarnings"]) == (0, 0), found["messages"]
