"""Several trees that grow at the same time are one file, in which each moves as it does alone."""

from dataclasses import replace

import numpy as np
import pytest
from growing_models import growing, model

from sketchtree.animation.posing import joint_frames, posed
from sketchtree.animation.together import Together, growing_of
from sketchtree.asset import Asset
from sketchtree.errors import OptionError


@pytest.fixture(scope="module")
def both() -> Together:
    return Together((growing("full", 0.0), growing("age", -20.0)))


@pytest.mark.parametrize("time", [0.0, 0.4, 1.0])
def test_every_mesh_moves_as_it_does_alone(both, time):
    asset = both.asset(seconds=4.0)
    alone = [mesh for one in both.each for mesh in posed(one.asset(seconds=4.0), 4.0 * time)]
    for mesh, other in zip(posed(asset, 4.0 * time), alone, strict=True):
        assert np.allclose(mesh.position, other.position, atol=1e-9) and mesh.triangle_count == other.triangle_count
    assert [mesh.name for mesh in both.at(time)] == [mesh.name for mesh in asset.parts]
    assert len({mesh.name for mesh in asset.parts}) == len(asset.parts)


def test_all_joints_hang_on_one_root_and_none_is_called_as_another(both):
    asset: Asset = both.asset()
    assert (asset.armature.parent == -1).sum() == 1 and len(set(asset.armature.name)) == len(asset.armature)
    assert (asset.armature.parent < np.arange(len(asset.armature))).all()
    _, rest = joint_frames(asset.armature, asset.animation, 0.0)
    assert np.isfinite(rest).all() and len(asset.skeleton) == sum(len(one.plan.tree) for one in both.each)


def test_one_tree_alone_is_itself():
    made = model()
    assert growing_of([made], mode="scale").asset().parts[0].name == "wood"
    with pytest.raises(OptionError, match="There is no tree that could grow. Give one."):
        growing_of([])


def test_what_nobody_wants_any_more_ends_at_the_next_pulse():
    def enough():
        raise StopIteration

    tree = replace(growing_of([model()]), pulse=enough)
    with pytest.raises(StopIteration):
        tree.get_ready()
