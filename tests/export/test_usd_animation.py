"""What moves in a USD file: joints, blend shapes, the extent."""

import dataclasses

import numpy as np
import pytest
from shapes import bones, keys, leafy, moved, moving, no_keys, square

from sketchtree.asset import Asset, Level
from sketchtree.export.write import write_asset

pxr = pytest.importorskip("pxr", reason="usd-core is not installed")

from pxr import Usd, UsdGeom, UsdSkel  # noqa: E402

from sketchtree.export.usd.read import read_usd  # noqa: E402
from sketchtree.export.usd.sampled import sample_times, sampled  # noqa: E402


def with_still() -> Asset:
    """And a square that nothing moves."""
    return dataclasses.replace(moved(), levels=(Level((*moved().parts, square("still"))),))


def opened(folder, asset, suffix="usda"):
    write_asset(folder / f"t.{suffix}", asset)
    return Usd.Stage.Open(str(folder / f"t.{suffix}"))


def at(stage, second):
    """(translations, rotations x y z w, scales) as UsdSkel takes them at that moment."""
    query = UsdSkel.Cache().GetSkelQuery(UsdSkel.Skeleton(stage.GetPrimAtPath("/tree/bones"))).GetAnimQuery()
    translation, rotation, scale = query.ComputeJointLocalTransformComponents(second * stage.GetTimeCodesPerSecond())
    return np.array(translation), np.array([[*q.GetImaginary(), q.GetReal()] for q in rotation]), np.array(scale, float)


@pytest.mark.parametrize("suffix", ["usda", "usdc", "usdz"])
@pytest.mark.parametrize("levels", [False, True])
def test_no_validator_has_anything_to_say(tmp_path, suffix, levels):
    validation = pytest.importorskip("pxr.UsdValidation", reason="this usd-core has no validators")
    asset = with_still()
    if levels:
        asset = dataclasses.replace(asset, levels=(Level(asset.parts, 0.5), Level((square("card"),))))
    context = validation.ValidationContext(validation.ValidationRegistry().GetOrLoadAllValidators())
    assert [error.GetMessage() for error in context.Validate(opened(tmp_path, asset, suffix))] == []


def test_same_asset_same_bytes(tmp_path):
    for folder in ("a", "b"):
        (tmp_path / folder).mkdir()
        write_asset(tmp_path / folder / "t.usdc", moved())
    assert (tmp_path / "a" / "t.usdc").read_bytes() == (tmp_path / "b" / "t.usdc").read_bytes()


def test_the_stage_says_when_it_begins_and_ends(tmp_path):
    made = opened(tmp_path, moved())
    assert (made.GetStartTimeCode(), made.GetEndTimeCode(), made.GetTimeCodesPerSecond(), made.GetFramesPerSecond()) == (0, 48, 24, 24)
    assert UsdSkel.BindingAPI(made.GetPrimAtPath("/tree/bones")).GetAnimationSourceRel().GetTargets() == ["/tree/bones/growth"]


@pytest.mark.parametrize("second", [0.0, 1.0, 2.0])
def test_keys_are_met_exactly_and_held_after_the_last(tmp_path, second):
    translation, rotation, scale = at(opened(tmp_path, moved()), second)
    np.testing.assert_allclose(translation[1], [0, 0.5 + min(second, 1.0), 0], atol=1e-6)
    angle = np.radians(-90 + 45 * second) / 2
    np.testing.assert_allclose(rotation[1] * np.sign(rotation[1, 3]), [0, 0, np.sin(angle), np.cos(angle)], atol=1e-6)
    np.testing.assert_allclose(scale, [(0.5 + 0.25 * second,) * 3, (1, 1, 1)], atol=1e-3)


def test_the_scale_of_a_joint_that_only_bears_others_is_handed_down():
    """Half precision is too coarse for what moves whole trees; the world's frames of what moves vertices stay the same."""
    kept, handed = (sampled(bones(), moving(), np.array(moves)) for moves in ([True, True], [False, True]))
    assert np.ptp(handed.scale[:, 0]) == 0 and np.ptp(kept.scale[:, 0]) == 0.5
    for k in range(len(kept.time)):
        np.testing.assert_allclose(kept.frames(bones(), k)[1], handed.frames(bones(), k)[1], atol=1e-12)


def test_a_scale_that_would_shear_is_kept_where_it_is():
    uneven = moving(scale=keys(0, [0.0, 2.0], (0.5, 1, 1), (1, 1, 1)))
    made = sampled(bones(), uneven, np.array([False, True]))
    np.testing.assert_allclose(made.scale[0, 0], [0.5, 1, 1])


def test_no_scale_is_so_small_that_readers_cannot_take_the_frame_apart():
    nothing = moving(scale=keys(1, [0.0, 2.0], (0, 0, 0), (1, 1, 1)))
    made = sampled(bones(), nothing, np.array([False, True]))
    np.testing.assert_allclose(made.scale[[0, -1], 1], [[1e-3] * 3, [1] * 3])


def test_times_are_those_of_the_keys_or_a_grid_where_they_are_too_many():
    np.testing.assert_allclose(sample_times(2.0, [np.array([0.3, 1.1]), np.array([0.3])]), [0, 0.3, 1.1, 2.0])
    many = np.sort(np.random.default_rng(0).uniform(0, 2, 1000))
    assert len(sample_times(2.0, [many])) == 256 and len(sample_times(60.0, [30 * many])) == 1002 and len(sample_times(30.0, [15 * many])) == 721


def test_a_blend_shape_is_drawn_back_to_the_foot_and_let_go(tmp_path):
    made = opened(tmp_path, moved())
    shape = UsdSkel.BlendShape(made.GetPrimAtPath("/tree/leaf/morph_1"))
    np.testing.assert_allclose(np.array(shape.GetOffsetsAttr().Get()), -leafy().position)
    weights = UsdSkel.Animation(made.GetPrimAtPath("/tree/bones/growth")).GetBlendShapeWeightsAttr()
    assert [weights.Get(24 * second)[0] for second in (0.0, 0.5, 1.0, 1.5, 2.0)] == [1.0, 1.0, 0.5, 0.0, 0.0]


def test_the_extent_holds_what_is_moved_and_what_is_not(tmp_path):
    made = opened(tmp_path, with_still())
    extent = UsdGeom.Boundable(made.GetDefaultPrim()).GetExtentAttr()
    assert len(extent.GetTimeSamples()) == 3
    low, high = np.array(extent.Get(24.0))
    assert (low <= 0).all() and high[1] > 1.5  # the limb has risen


def test_a_joint_that_does_not_move_has_one_value(tmp_path):
    made = opened(tmp_path, dataclasses.replace(moved(), animation=moving(scale=no_keys(3), rotation=no_keys(4))))
    animation = UsdSkel.Animation(made.GetPrimAtPath("/tree/bones/growth"))
    assert animation.GetRotationsAttr().GetTimeSamples() == [] and animation.GetScalesAttr().GetTimeSamples() == []
    assert len(animation.GetTranslationsAttr().GetTimeSamples()) == 3
    np.testing.assert_allclose(at(made, 0.0)[1][1], bones().rotation[1], atol=1e-6)


@pytest.mark.parametrize("levels", [False, True])
def test_what_moves_is_read_back(tmp_path, levels):
    asset = with_still()
    if levels:
        asset = dataclasses.replace(asset, levels=(Level(asset.parts, 0.5), Level((square("card"),))))
    write_asset(tmp_path / "t.usdc", asset)
    back = read_usd(tmp_path / "t.usdc").animation
    assert back.name == "growth" and back.seconds == 2.0
    assert back.translation.joint.tolist() == [1] and back.scale.joint.tolist() == [0]
    np.testing.assert_allclose(back.translation.time, [0, 1, 2])
    np.testing.assert_allclose(back.translation.value, [(0, 0.5, 0), (0, 1.5, 0), (0, 1.5, 0)], atol=1e-6)
    (morph,) = back.morphs
    assert morph.part == 1 and np.interp(1.0, morph.time, morph.weight) == 0.5
    np.testing.assert_allclose(morph.offset, -leafy().position)


def test_what_does_not_move_has_no_animation(tmp_path):
    write_asset(tmp_path / "t.usdc", dataclasses.replace(moved(), animation=None))
    assert read_usd(tmp_path / "t.usdc").animation is None
