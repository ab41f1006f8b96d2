"""Bones of the main limbs, what they move, and how the tree bends."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from sketchtree.axes import NULL
from sketchtree.geometry.limbs import centre_lines
from sketchtree.rig.bones import bones, upright_to
from sketchtree.rig.boughs import boughs
from sketchtree.rig.islands import welded
from sketchtree.rig.pose import pose, posed
from sketchtree.rig.weights import Weights, strongest, whole
from tests.geometry.growing import bushy, stick
from tests.rig.rigged_trees import dressed, edges, grown, rigged


def weights_of(mesh):
    return Weights(mesh.extra["JOINTS_0"].astype(int), mesh.extra["WEIGHTS_0"].astype(float))


def made(tree, **given):
    lines = centre_lines(tree)
    return bones(lines, boughs(tree, lines), **given)


def test_the_trunks_root_stands_first_and_parents_before_children():
    armature = rigged()[0].bones.armature
    assert armature.name[0] == "bone_trunk_0" and armature.parent[0] == NULL
    assert np.all(armature.parent[1:] >= 0) and np.all(armature.parent[1:] < np.arange(1, len(armature)))


def test_each_limb_has_two_to_five_joints_and_all_no_more_than_asked_for():
    for most in (3, 12, 64):
        found = made(bushy(levels=3), most=most)
        count = found.count[found.count > 0]
        assert len(found.armature) <= most and count.min() >= 2 and count.max() <= 5
    crooked = np.array([[0, 0, 0], [0, 1, 0], [1, 1.5, 0], [0, 2.5, 0], [1, 3, 0], [0, 4, 0.0]])
    straight = np.column_stack([np.zeros(6), np.linspace(0, 4, 6), np.zeros(6)])
    assert made(stick(crooked, 0.1)).count[0] > made(stick(straight, 0.1)).count[0]


def test_limbs_that_carry_most_wood_have_bones_and_what_they_grow_from_has_too():
    tree = bushy(levels=3)
    lines = centre_lines(tree)
    limbs = boughs(tree, lines)
    found = bones(lines, limbs, most=30)
    has = found.count > 0
    assert np.all(has[lines.parent[has & (lines.parent != NULL)]])
    able = ~has & (lines.parent != NULL) & has[np.maximum(lines.parent, 0)]
    assert limbs.carried[able].max() <= limbs.carried[has].min() * 1.5


def test_bones_run_along_their_limbs():
    found = rigged()[0].bones
    armature = found.armature
    ahead = Rotation.from_quat(armature.rotation).apply([0.0, 1.0, 0.0])
    end = armature.position + armature.length[:, None] * ahead
    for joint in range(len(armature) - 1):
        if found.limb[joint] == found.limb[joint + 1]:
            assert np.allclose(end[joint], armature.position[joint + 1])
    lines = rigged()[0].lines
    last = [np.flatnonzero(found.limb == limb)[-1] for limb in np.unique(found.limb)]
    assert np.allclose(end[last], lines.point[lines.start[found.limb[last] + 1] - 1])


def test_names_belong_to_limbs_whatever_else_grows():
    names = set(made(grown()).armature.name)
    fewer = set(made(grown(without=1)).armature.name)
    assert fewer < names and {int(name.split("_")[1], 16) for name in names - fewer} <= {101, 1010, 1011, 1012}
    ids = grown().replace(limb=(grown().limb + 1) << 40)
    assert f"bone_{((101 + 1) << 40) >> 31:08x}_0" in made(ids).armature.name


def test_several_stems_hang_from_one_root():
    left, right = stick([[0, 0, 0], [0, 1, 0], [0, 2, 0]], 0.1), stick([[1, 0, 0], [1, 1, 0], [1.2, 2, 0]], 0.1)
    both = left.append({"parent": np.r_[NULL, 3, 4], "tip": right.tip, "radius": right.radius, "limb": np.full(3, 9)})
    armature = made(both).armature
    assert armature.name[0] == "bone_root" and [name.rsplit("_", 1)[1] for name in np.array(armature.name)[armature.parent == 0]] == ["0", "0"]
    assert np.allclose(armature.position[0], [0.5, 0, 0], atol=0.05)


def test_quaternions_turn_upright_to_the_vectors():
    vector = np.array([[0.0, 2, 0], [0, -1, 0], [1, 0, 0], [0.3, -0.9, 0.2]])
    found = Rotation.from_quat(upright_to(vector)).apply([0.0, 1, 0])
    assert np.allclose(found, vector / np.linalg.norm(vector, axis=1, keepdims=True))


def test_four_weights_at_most_that_sum_to_one_and_are_whole_bytes():
    rigging, wood, leaf = rigged()
    for mesh in (wood, leaf):
        found = weights_of(mesh)
        assert found.joint.shape == found.weight.shape == (len(mesh.position), 4)
        part = 255 * found.weight
        assert np.allclose(part, np.round(part), atol=1e-4) and np.all(np.round(part).sum(axis=1) == 255)
        assert found.joint.min() >= 0 and found.joint.max() < len(rigging.bones.armature) and np.all(found.joint[found.weight == 0] == 0)


def test_the_strongest_four_are_kept_and_a_bone_named_twice_counts_once():
    found = strongest(np.array([[3, 1, 3, 2, 5, 4]]), np.array([[0.2, 0.1, 0.2, 0.3, 0.15, 0.05]]))
    assert found.joint.tolist() == [[3, 2, 5, 1]] and np.allclose(found.weight, np.array([[0.4, 0.3, 0.15, 0.1]]) / 0.95)
    assert (255 * whole(found).weight).sum() == 255


def test_copies_of_a_vertex_move_together():
    _, wood, _ = rigged()
    one = welded(wood.position)
    assert np.array_equal(wood.extra["WEIGHTS_0"], wood.extra["WEIGHTS_0"][one]) and np.array_equal(wood.extra["JOINTS_0"], wood.extra["JOINTS_0"][one])


def test_a_leaf_rides_rigidly():
    _, _, leaf = rigged()
    _, _, _, leaves, _, _ = dressed()
    cards = len(leaf.position) - 6 * len(leaves.shoot)
    for name in ("JOINTS_0", "WEIGHTS_0"):
        each = leaf.extra[name][:cards].reshape(len(leaves), -1, 4)
        assert np.all(each == each[:, :1])


def test_at_rest_nothing_moves():
    rigging, wood, _ = rigged()
    armature = rigging.bones.armature
    assert np.allclose(posed(armature, np.zeros((len(armature), 3)), weights_of(wood), wood.position), wood.position, atol=1e-12)


@pytest.mark.parametrize("joint", ["bone_trunk_1", "bough"])
def test_a_bent_joint_tears_nothing_keeps_the_volume_and_leaves_the_rest_still(joint):
    rigging, wood, _ = rigged()
    armature = rigging.bones.armature
    number = armature.name.index(joint) if joint in armature.name else int(np.flatnonzero(rigging.limbs.depth[np.maximum(rigging.bones.limb, 0)] == 1)[0])
    turn = np.zeros((len(armature), 3))
    turn[number] = [0.0, 0.1, np.radians(25.0)]
    bent = posed(armature, turn, weights_of(wood), wood.position)
    pair = edges(wood)
    rest = np.linalg.norm(wood.position[pair[:, 0]] - wood.position[pair[:, 1]], axis=1)
    now = np.linalg.norm(bent[pair[:, 0]] - bent[pair[:, 1]], axis=1)
    assert np.all(now <= 1.6 * rest + 0.01)
    assert volume(bent, wood.triangle) == pytest.approx(volume(wood.position, wood.triangle), rel=0.02)
    below = ~moved_by(armature, number)
    still = (below[wood.extra["JOINTS_0"].astype(int)] | (wood.extra["WEIGHTS_0"] == 0)).all(axis=1)
    assert 0.05 < still.mean() < 1.0 and np.allclose(bent[still], wood.position[still], atol=1e-9)
    far = np.linalg.norm(bent - wood.position, axis=1)
    assert far.max() > 0.3


def test_a_turn_is_handed_on_to_all_that_hangs_from_a_joint():
    armature = rigged()[0].bones.armature
    turn = np.zeros((len(armature), 3))
    turn[0] = [0.0, np.pi / 2, 0.0]
    rotation, moved = pose(armature, turn)
    assert np.allclose(moved, Rotation.from_rotvec([0, np.pi / 2, 0]).apply(armature.position - armature.position[0]) + armature.position[0])
    assert np.allclose(rotation, rotation[0])


def volume(position, triangle):
    a, b, c = (position[triangle[:, k]] for k in range(3))
    return np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6.0


def moved_by(armature, joint):
    moved = np.zeros(len(armature), bool)
    moved[joint] = True
    for k in range(joint + 1, len(armature)):
        moved[k] = moved[armature.parent[k]]
    return moved
