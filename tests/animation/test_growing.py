"""A growing tree is the final tree's own meshes, moved: at the end they stand where they were given, before that where the plan has the wood."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from growing_models import area, growing, model

from sketchtree.animation.growing import Growing
from sketchtree.animation.posing import joint_frames
from sketchtree.animation.wanted import LEAST_JOINTS
from sketchtree.errors import OptionError
from sketchtree.foliage.cards import leaf_mesh
from sketchtree.growth.plan import MODES, GrowthPlan


def together(meshes, kind):
    return np.vstack([mesh.position[np.unique(mesh.triangle)] for mesh in meshes if mesh.name.startswith(kind) and mesh.triangle_count])


@pytest.mark.parametrize("mode", MODES)
@pytest.mark.parametrize("wood", ["tubes", "one-piece"])
def test_at_the_end_the_tree_is_the_one_that_was_given(mode, wood):
    grown, given = growing(mode, wood=wood).at(1.0), model(wood=wood).meshes
    for mesh in (mesh for mesh in given if mesh.name.startswith("wood")):
        moved = next(one for one in grown if one.name == mesh.name)
        assert np.allclose(moved.position[: len(mesh.position)], mesh.position, atol=1e-5)
        assert moved.triangle_count == mesh.triangle_count
    assert sum(mesh.triangle_count for mesh in grown) == sum(mesh.triangle_count for mesh in given)
    assert np.isclose(sum(map(area, grown)), sum(map(area, given)), rtol=1e-6)


@pytest.mark.parametrize("bend", [0.0, -25.0])
@pytest.mark.parametrize("time", [0.2, 0.5, 0.8, 1.0])
def test_the_wood_stands_where_the_plan_has_it(bend, time):
    tree = growing("full", bend)
    plan = tree.plan.at(time)
    wood = together(tree.at(time), "wood")
    assert np.allclose(wood.max(axis=0), plan.tip.max(axis=0), atol=0.12)
    assert np.isclose(wood[:, 1].max(), plan.tip[:, 1].max(), atol=0.05)


@pytest.mark.parametrize("bend", [0.0, 15.0])
def test_joints_at_nodes_are_where_the_plan_has_those_nodes(bend):
    tree = growing("full", bend)
    asset = tree.asset(seconds=1.0)
    limb = int(np.flatnonzero(tree.hosts.by_nodes)[0])
    nodes = slice(tree.nodes.start[limb], tree.nodes.start[limb + 1])
    joints = 2 + tree.hosts.first[limb] + 1 + np.arange(tree.nodes.count[limb])
    for time in (0.3, 0.7):
        frames, _ = joint_frames(asset.armature, asset.animation, time)
        pose = tree.plan.poses([time], pieces=True)
        piece = tree.nodes.piece[nodes]
        assert np.allclose(frames[joints, :3, 3], pose.tip[0, piece], atol=0.1 * tree.plan.tree.radius.max() + 0.005)
        begun = pose.grown[0, piece] > 0.05
        size = np.linalg.norm(frames[joints, :3, 0], axis=1)
        assert np.allclose(size[begun], (pose.radius[0, piece] / tree.plan.straight.pieces.radius[piece])[begun], atol=0.03)


@pytest.mark.parametrize("mode", ["age", "full"])
def test_at_the_beginning_there_is_nothing(mode):
    assert sum(mesh.triangle_count for mesh in growing(mode).at(0.0)) == 0


@pytest.mark.parametrize("mode", MODES)
def test_bark_and_the_final_leaves_only_become_more(mode):
    tree = growing(mode)
    times = np.linspace(0, 1, 13)
    for of in (lambda name: name.startswith("wood"), lambda name: name.startswith("leaf") and "young" not in name):
        course = [sum(area(mesh) for mesh in tree.at(time) if of(mesh.name)) for time in times]
        assert (np.diff(course) >= -0.01 * course[-1]).all(), course
        assert course[-1] > course[len(course) // 2] > 0


@pytest.mark.parametrize("bend", [0.0, -20.0])
def test_a_young_tree_has_leaves_on_wood_that_is_bare_later_and_sheds_them(bend):
    tree = growing("full", bend)
    young = [mesh for mesh in tree.at(0.3) if mesh.name.startswith("leaf_young")]
    assert sum(map(area, young)) > 0
    feet = np.vstack([mesh.position[np.unique(mesh.triangle)] for mesh in young if mesh.triangle_count])
    top = tree.plan.at(0.34).tip.max(axis=0) + 0.3
    assert (feet <= top).all() and (feet[:, 1] > 0).all()
    assert not any(mesh.triangle_count for mesh in tree.at(1.0) if mesh.name.startswith("leaf_young"))
    rest = [mesh for mesh in tree.asset().parts if mesh.name.startswith("leaf_young")]
    assert sum(map(area, rest)) < 1e-9
    again = growing("full", bend)
    assert all(np.array_equal(one.position, other.position) for one, other in zip(tree.at(0.3), again.at(0.3), strict=True))


def test_bark_is_smooth_where_a_branch_is_yet_to_come():
    tree = growing("age")
    child = int(np.flatnonzero(tree.lines.parent == 0)[-1])
    born = tree.plan.birth[tree.lines.first_row[child]]
    out, radius = tree.lines.at(np.array([child]), tree.limbs.buried[[child]])
    wood = tree.at(float(born) - 0.01)[0].position
    near = wood[np.abs(wood[:, 1] - out[0, 1]) < radius[0]]
    assert len(near) and np.linalg.norm(near[:, [0, 2]], axis=1).max() < 1.1 * tree.plan.tree.radius[0]


def test_leaves_unfold_from_their_feet_and_not_before_their_wood():
    tree = growing("age")
    asset = tree.asset(seconds=1.0)
    final = [morph for morph in asset.animation.morphs if "young" not in asset.parts[morph.part].name]
    for morph in final:
        assert morph.weight[0] == 1.0 and morph.weight[-1] == 0.0
        assert (np.diff(morph.weight) <= 0).all()
    held = [morph.time[np.flatnonzero(morph.weight == 1.0)[-1]] for morph in final]
    assert min(held) >= tree.plan.end[tree.model.leaves.segment].min() - 1e-9
    assert len({mesh.name for mesh in asset.parts}) == len(asset.parts)


@pytest.mark.parametrize("most", [LEAST_JOINTS, 100, 400])
def test_there_are_no_more_joints_than_asked_for_and_the_end_is_the_same(most):
    tree = growing("full", levels=2, most_joints=most)
    assert tree.hosts.count <= most
    born = tree.hosts.first >= 0
    assert born[tree.lines.parent[born & (tree.lines.parent >= 0)]].all()
    grown, given = tree.at(1.0), model(2).meshes
    assert np.allclose(grown[0].position, given[0].position, atol=1e-5)
    course = [together(tree.at(time), "wood")[:, 1].max() for time in (0.2, 0.5, 0.9)]
    assert course == sorted(course)


def test_a_bent_tree_keeps_to_its_joints_with_the_shoots_of_its_young_leaves():
    tree = growing("full", -20.0, levels=2, most_joints=300)
    assert len(tree.asset().armature) <= 300 + 2


def test_at_rest_the_file_shows_the_final_tree():
    asset = growing("full").asset()
    assert np.array_equal(asset.parts[0].position, model().meshes[0].position)
    assert asset.animation.seconds == 10.0
    assert max(keys.time.max() for keys in (asset.animation.translation, asset.animation.scale)) <= 10.0


def test_the_same_tree_gives_the_same_animation():
    from sketchtree.export.gltf import asset_bytes

    made = model()
    one, other = (Growing.of(made, GrowthPlan.of(made.skeleton, mode="full", bend=-10.0)).asset(seconds=4.0) for _ in range(2))
    assert asset_bytes(one) == asset_bytes(other)


@pytest.mark.parametrize(
    "ask, message",
    [
        (lambda: growing("age", most_joints=3), "can't do with 3 joints"),
        (lambda: growing("age").asset(seconds=0), "growth of 0 seconds can't be made"),
        (lambda: growing("age").at(1.5), "not a number from 0 to 1"),
    ],
)
def test_what_can_not_be_is_refused(ask, message):
    with pytest.raises(OptionError, match=message):
        ask()


def test_young_leaves_have_the_colours_that_the_final_ones_were_seen_in():
    made = model()
    seen = np.random.default_rng(1).uniform(0.1, 0.3, (len(made.leaves), 3))
    leaves = replace(made.leaves, seen=seen)
    photo = SimpleNamespace(**{**vars(made), "leaves": leaves, "meshes": (*made.meshes[:-1], leaf_mesh(leaves))})
    parts = Growing.of(photo, GrowthPlan.of(photo.skeleton, mode="full")).asset().parts
    worn = [mesh for mesh in parts if mesh.name.startswith("leaf")]
    old, young = ({tuple(colour) for mesh in worn if mesh.name.startswith("leaf_young") == is_young for colour in mesh.color.round(6).tolist()} for is_young in (False, True))
    assert young and young <= old
    assert len({id(mesh.material.base_color_texture) for mesh in worn}) == 1
