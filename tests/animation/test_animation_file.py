"""A GLB of a growing tree moves as `Growing.at` says, in any program: it is read back and posed again."""

import json

import numpy as np
import pytest
from growing_models import growing

from sketchtree.animation.posing import posed
from sketchtree.export.gltf import asset_bytes, read_asset
from sketchtree.export.write import write_asset


@pytest.fixture(scope="module")
def read(tmp_path_factory):
    path = tmp_path_factory.mktemp("growing") / "tree.glb"
    path.write_bytes(asset_bytes(growing("full", -20.0).asset(seconds=6.0)))
    return path, read_asset(path)


@pytest.mark.parametrize("time", [0.15, 0.5, 0.85, 1.0])
def test_it_moves_as_it_was_made(read, time):
    for mine, other in zip(growing("full", -20.0).at(time), posed(read[1], 6.0 * time), strict=True):
        assert mine.name == other.name
        assert np.allclose(mine.position, other.position, atol=1e-4)  # shares of joints are 65535ths in the file


def test_every_channel_of_a_joint_is_one_sampler_with_times_that_rise(read):
    data = read[0].read_bytes()
    content = json.loads(data[20 : 20 + int.from_bytes(data[12:16], "little")])
    (animation,) = content["animations"]
    targets = [(channel["target"]["node"], channel["target"]["path"]) for channel in animation["channels"]]
    assert len(set(targets)) == len(targets)
    for sampler in animation["samplers"]:
        times, values = content["accessors"][sampler["input"]], content["accessors"][sampler["output"]]
        assert times["count"] == values["count"] and isinstance(times["min"], list) and times["min"][0] >= 0
        assert times["max"][0] <= 6.0 + 1e-6
    moment = read[1].animation
    for keys in (moment.translation, moment.rotation, moment.scale):
        inner = np.ones(len(keys.time), bool)
        inner[keys.start[:-1]] = False
        assert (np.diff(keys.time)[inner[1:]] > 0).all()


def test_a_file_that_can_not_move_says_so(tmp_path):
    told = write_asset(tmp_path / "tree.obj", growing("age").asset())
    assert any("does not move" in line for line in told)


def test_shares_of_joints_are_16_bits_that_sum_to_one_and_a_mesh_of_whole_ones_has_bytes(read):
    data = read[0].read_bytes()
    content = json.loads(data[20 : 20 + int.from_bytes(data[12:16], "little")])
    kinds = {mesh["name"]: content["accessors"][mesh["primitives"][0]["attributes"]["WEIGHTS_0"]]["componentType"] for mesh in content["meshes"]}
    assert kinds["wood"] == 5123 and {kind for name, kind in kinds.items() if name.startswith("leaf_young")} == {5121}
    for part in read[1].parts:
        assert np.allclose(part.extra["WEIGHTS_0"].sum(axis=1), 1.0, atol=1e-12)
