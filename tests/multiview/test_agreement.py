"""Cameras are held against what every two photos share: true ones agree, a camera that was laid onto another's place is contradicted."""

from dataclasses import replace

import numpy as np
import pytest
from ring import camera_at

from sketchtree.errors import ViewsError
from sketchtree.multiview import sfm
from sketchtree.multiview.agreement import DOUBT, LEAST, Pair, agreeing, agrees, contradictions
from sketchtree.multiview.poses.posed import Posed, Poses

CAMERAS = [camera_at(30.0 * k, size=(400, 400), height=0.5 + 0.2 * (k % 2)) for k in range(12)]
PLACES = np.random.default_rng(3).uniform([-0.6, 0.0, -0.6], [0.6, 1.0, 0.6], (60, 3))
FALSE = [CAMERAS[k % 6] if k < 9 else CAMERAS[k] for k in range(12)]  # the seventh to ninth were taken for the first three, as of a plant that looks alike from behind
ONE_FALSE = [CAMERAS[3] if k == 8 else CAMERAS[k] for k in range(12)]


def seen(camera, noise=0.0, places=PLACES):
    """Places in focal lengths from the middle, so many pixels beside."""
    pixel = camera.project(places)[0] + noise * np.random.default_rng(0).normal(size=(len(places), 2))
    return (pixel - camera.matrix[:2, 2]) / camera.matrix[[0, 1], [0, 1]]


def shared(noise=0.5, count=60, reach=3):
    """What every two of the true photos share that stand up to so many places apart."""
    near = [(j, k) for j in range(12) for k in range(j) if min(j - k, 12 - j + k) <= reach]
    return [Pair((j, k), seen(CAMERAS[j], noise)[:count], seen(CAMERAS[k])[:count]) for j, k in near]


def kept(cameras, pairs):
    return agreeing(len(cameras), *contradictions(cameras, pairs))


def test_true_cameras_are_not_contradicted():
    assert kept(CAMERAS, shared()) == (list(range(12)), 0.0)


def test_photos_that_were_placed_wrongly_are_left_out():
    left, share = kept(ONE_FALSE, shared())
    assert share == pytest.approx(1 / 6)
    assert left == [0, 1, 2, 3, 4, 5, 6, 7, 9, 10, 11]


def test_where_too_much_contradicts_nothing_is_trusted():
    assert kept(FALSE, shared()) == ([], pytest.approx(1 / 3))


def test_photos_that_nothing_joins_to_the_rest_are_left_out_too():
    pairs = [pair for pair in shared() if (pair.rows[0] in (9, 10)) == (pair.rows[1] in (9, 10)) or 8 in pair.rows]
    assert kept(ONE_FALSE, pairs)[0] == [0, 1, 2, 3, 4, 5, 6, 7, 11]


def test_a_false_pair_or_two_leaves_nobody_out():
    pairs = shared()
    false = [Pair((k, k + 6), seen(CAMERAS[k]), seen(CAMERAS[k + 5])) for k in range(3)]
    left, share = kept(CAMERAS, pairs + false)
    assert 0 < share < DOUBT and left == list(range(12))


def test_a_detail_must_lie_on_the_line_of_the_other_within_some_pixels():
    one, other = CAMERAS[:2]
    first, second = seen(one), seen(other)
    assert agrees(one, other, Pair((0, 1), first, second)).all()
    lines = np.array([0.0, 1.0])  # the cameras stand beside each other, so that lines run across
    for pixels, near in ((2.0, True), (12.0, False)):
        moved = second + pixels / other.matrix[0, 0] * lines
        assert agrees(one, other, Pair((0, 1), first, moved)).mean() == pytest.approx(float(near), abs=0.05)


def test_and_before_both_cameras():
    behind = camera_at(0.0, size=(400, 400), distance=-3.0)
    back = replace(behind, rotation=np.diag([-1.0, 1.0, -1.0]) @ behind.rotation)  # looks away from the places, along the same lines
    assert not agrees(CAMERAS[1], back, Pair((0, 1), seen(CAMERAS[1]), seen(behind) * [-1.0, -1.0])).any()


def test_what_is_far_away_may_seem_to_lie_behind():
    one, other = CAMERAS[0], replace(CAMERAS[0], centre=CAMERAS[0].centre + [0.2, 0.0, 0.0])
    far = PLACES * [20, 20, 1] + [0, 0, -9000.0]
    assert agrees(one, other, Pair((0, 1), seen(one, 0.5, far), seen(other, 0.5, far))).all()


def test_pairs_of_few_details_have_no_say():
    assert kept(FALSE, shared(count=LEAST - 1)) == (list(range(12)), 0.0)


def found(cameras, pairs):
    poses = Poses(tuple(Posed(f"photo {k:02d}.png.jpg", camera) for k, camera in enumerate(cameras)), error=0.5)
    files = [type("File", (), {"name": photo.name.removesuffix(".jpg")}) for photo in poses.photos]
    return sfm._found(poses, pairs, files, {file.name: 1.0 for file in files}, [], 0)


def test_photos_that_contradict_are_told():
    told = found(ONE_FALSE, shared())
    assert told.left_out == ("photo 08.png",) and len(told.poses) == 11
    assert told.notices[-1] == "Left out, since what they share with other photos contradicts where they were placed: photo 08.png."
    assert len(found(CAMERAS, shared()).notices) == 1


def test_false_cameras_are_refused_in_one_paragraph():
    with pytest.raises(ViewsError) as error:
        found(FALSE, shared())
    assert str(error.value) == (
        "The cameras that were found can't be true: 33% of the pairs of photos that share details tell other places than all of them together. "
        f"Alike parts of the plant were taken for one another. {sfm.ADVICE} Or give the poses, if something else knows them."
    )
