"""An animation that can't be played is refused at the door of every writer, by name."""

import dataclasses

import numpy as np
import pytest
from shapes import bending, bones, keys, leafy, moved, moving, scattered, square

from sketchtree.animation.posing import posed
from sketchtree.asset import Asset, Keys, Level, Morph
from sketchtree.errors import ExportError
from sketchtree.export.checks import check_asset

MORPH = moved().animation.morphs[0]


def with_animation(**changed):
    return lambda: dataclasses.replace(moved(), animation=moving(**changed))


def with_morph(**changed):
    return with_animation(morphs=(dataclasses.replace(MORPH, **changed),))


def beyond():
    """A mesh that goes with a third bone of two."""
    mesh = bending()
    return Asset.of([dataclasses.replace(mesh, extra=mesh.extra | {"JOINTS_0": mesh.extra["JOINTS_0"] + 1})], armature=bones())


@pytest.mark.parametrize(
    ("asset", "message"),
    [
        (lambda: dataclasses.replace(moved(), armature=None), "The animation `growth` moves joints, and there are no bones."),
        (beyond, "A vertex of mesh `wood` goes with a joint that is not among the 2 bones."),
        (with_animation(scale=keys(2, [0.0], (1, 1, 1))), "The animation's scale moves a joint that is not among the 2 bones."),
        (with_animation(translation=keys(-1, [0.0], (1, 1, 1))), "The animation's translation moves a joint that is not among the 2 bones."),
        (with_animation(translation=keys(1, [0.0, 1.0], (0, 0, 0), (0, np.nan, 0))), "A key of the animation's translation is not a finite number."),
        (with_animation(scale=keys(0, [0.0, np.inf], (1, 1, 1), (1, 1, 1))), "A key of the animation's scale is not a finite number."),
        (with_animation(scale=keys(0, [0.5, 0.5], (1, 1, 1), (1, 1, 1))), "The times of the animation's scale don't rise from 0 on."),
        (with_animation(scale=keys(0, [-0.5, 0.5], (1, 1, 1), (1, 1, 1))), "The times of the animation's scale don't rise from 0 on."),
        (with_animation(rotation=keys(1, [0.0], (0, 0, 0))), "The tracks of the animation's rotation don't fit its 1 keys."),
        (with_animation(scale=Keys(np.array([0, 1]), np.array([0, 0, 1]), np.zeros(1), np.ones((1, 3)))), "The tracks of the animation's scale don't fit its 1 keys."),
        (with_animation(scale=Keys(np.array([0, 0]), np.array([0, 1, 2]), np.zeros(2), np.ones((2, 3)))), "The animation's scale has two tracks for one joint."),
        (with_morph(part=2), "A morph is of part 2, and there is no such mesh."),
        (lambda: dataclasses.replace(with_morph(part=2)(), levels=(Level((*moved().parts, scattered())),)), "A morph is of part 2, and there is no such mesh."),
        (with_morph(offset=np.zeros((3, 3))), "The morph of mesh `leaf` moves 3 vertices, and there are 4."),
        (with_morph(offset=np.full((4, 3), np.nan)), "A number of the morph of mesh `leaf` is not finite."),
        (with_morph(time=np.array([0.0, 1.0, 1.0])), "The times of the morph of mesh `leaf` don't rise from 0 on, a weight each."),
        (with_morph(weight=np.ones(2)), "The times of the morph of mesh `leaf` don't rise from 0 on, a weight each."),
        (with_animation(morphs=(MORPH, MORPH)), "A mesh has more than one morph."),
    ],
)
def test_an_animation_that_can_not_be_played_is_named(asset, message):
    with pytest.raises(ExportError, match=message.replace("(", r"\(")):
        check_asset(asset())


def test_one_that_can_is_let_through():
    check_asset(moved())


def test_what_no_joint_moves_stays_and_places_are_drawn_where_they_are():
    still, places = square("still"), scattered()
    asset = dataclasses.replace(moved(), levels=(Level((*moved().parts, still, places)),))
    wood, _, same, leaves = posed(asset, 1.5)
    assert np.array_equal(same.position, still.position) and np.array_equal(same.triangle, still.triangle)
    assert np.array_equal(leaves.position, places.merged().position) and not np.allclose(wood.position, bending().position)


def test_a_mesh_that_no_joint_moves_still_unfolds():
    leaf = leafy()
    asset = Asset.of([bending(), leaf], armature=bones(), animation=moving(morphs=(Morph(1, -leaf.position, np.array([0.0, 1.0]), np.array([1.0, 0.0])),)))
    folded, open_ = (posed(asset, second)[1] for second in (0.0, 1.0))
    assert folded.triangle_count == 0 and np.array_equal(open_.position, leaf.position)
