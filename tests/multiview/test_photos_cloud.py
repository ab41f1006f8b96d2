"""A folder of photos becomes a cloud; what can't be used is named."""

import json
from dataclasses import replace

import numpy as np
import pytest
import written_poses
from PIL import Image
from ring import camera_at, distance_to_surface, painted_room, rendered
from scipy.spatial.transform import Rotation

from sketchtree.errors import OptionError, ViewsError
from sketchtree.keys import root_key
from sketchtree.multiview import sfm
from sketchtree.multiview.photos_cloud import FEW, photos_cloud
from sketchtree.watch import Watch

CAMERAS = [camera_at(14.0 * k, size=(90, 90)) for k in range(4)]


def saved(folder, pictures, **options):
    folder.mkdir(exist_ok=True)
    for k, rgb in enumerate(pictures, 1):
        Image.fromarray(np.round(255 * np.asarray(rgb)).astype(np.uint8)).save(folder / f"photo {k}.png", **options)
    return folder


@pytest.fixture(scope="module")
def scene(tmp_path_factory):
    place = tmp_path_factory.mktemp("scene")
    photos = saved(place / "photos", [rendered(camera)[0] for camera in CAMERAS])
    written_poses.colmap_text(place / "model", CAMERAS, np.zeros((0, 3)))
    listed = place / "model" / "images.txt"
    listed.write_text(listed.read_text().replace(".jpg", ".png"))
    return photos, place / "model"


def test_photos_and_poses_are_a_cloud_in_metres_with_y_up(scene):
    watch = Watch()
    found = photos_cloud(scene[0], poses=scene[1], key=root_key(0), watch=watch, up=(0, 1, 0))
    assert found.metric and len(found.placed) == 4 and not found.left_out
    assert np.median(distance_to_surface(found.cloud.xyz + [0, 0.5, 0])) < 0.02  # the place looked at is the origin
    assert found.confirmed > 0.45 and not found.notices
    assert list(found.seconds) == ["cameras", "photos", "patchmatch", "coherence", "filter", "fuse", "ground"]


def test_a_height_makes_it_as_high(scene):
    found = photos_cloud(scene[0], poses=scene[1], key=root_key(0), height=7.0, up=(0, 1, 0))
    assert found.cloud.height == pytest.approx(7.0)


def test_poses_that_are_off_are_doubted(scene, tmp_path):
    turns = Rotation.from_rotvec(np.random.default_rng(0).normal(0, 0.1, (4, 3))).as_matrix()
    off = [replace(camera, rotation=turn @ camera.rotation) for camera, turn in zip(CAMERAS, turns, strict=True)]
    written_poses.transforms(tmp_path / "transforms.json", off)
    found = photos_cloud(scene[0], poses=tmp_path / "transforms.json", key=root_key(0), up=(0, 1, 0))
    assert found.confirmed < FEW and found.notices[0] == (
        f"Only {found.confirmed:.0%} of the depths in the photos are confirmed by others: cameras may be wrong, or the plant moved. "
        "Check that poses belong to these photos, and that there was no wind."
    )


def test_masks_are_carved(tmp_path):
    cameras = [camera_at(27.7 * k, size=(120, 120)) for k in range(13)]
    masks = saved(tmp_path / "masks", [np.repeat((rendered(camera)[1] > 0)[..., None], 3, axis=2) for camera in cameras])
    written_poses.transforms(tmp_path / "transforms.json", cameras)
    told = json.loads((tmp_path / "transforms.json").read_text())
    (tmp_path / "transforms.json").write_text(json.dumps(told | {"k1": 0.0}))
    found = photos_cloud(masks, poses=tmp_path / "transforms.json", key=root_key(0), up=(0, 1, 0))
    assert "carve" in found.seconds and np.median(distance_to_surface(found.cloud.xyz + [0, 0.5, 0])) < 0.04


def refused(message, kind, *arguments, **options):
    with pytest.raises(kind) as error:
        photos_cloud(*arguments, key=root_key(0), **options)
    assert str(error.value) == message


def test_options_out_of_range_are_named(scene):
    refused("There is no quality called 'best'. Choose one of: preview, full.", OptionError, scene[0], quality="best")
    refused("A height of -1 m is none. Give metres above 0, or leave it out.", OptionError, scene[0], height=-1)


def test_two_photos_are_too_few(tmp_path):
    saved(tmp_path, [rendered(camera)[0] for camera in CAMERAS[:2]])
    refused(f"There are only 2 photos. 4 are the least that can be placed. {sfm.ADVICE}", ViewsError, tmp_path)


def test_photos_of_nothing_can_not_be_placed(tmp_path):
    saved(tmp_path, [np.full((80, 80, 3), 0.1 * k) for k in range(5)])
    refused(f"None of the 5 photos could be placed: too few of their details were found again in others. {sfm.ADVICE}", ViewsError, tmp_path)


@pytest.fixture(scope="module")
def placed(tmp_path_factory):
    """Six photos of a ball in a cave, one of them larger and one of something else, without EXIF."""
    folder = tmp_path_factory.mktemp("ball")
    cameras = [camera_at(12.0 * k, size=(300, 300), height=0.5 + 0.15 * (k % 2)) for k in range(6)]
    saved(folder, [painted_room(camera) for camera in cameras])
    Image.open(folder / "photo 2.png").resize((420, 420), Image.Resampling.BICUBIC).save(folder / "photo 2.png")
    other = np.random.default_rng(0).uniform(size=(40, 40, 3))
    Image.fromarray(np.round(255 * other).astype(np.uint8)).resize((300, 300)).save(folder / "stranger.png")
    return cameras, sfm.structure_from_motion(folder)


def test_cameras_are_found_again(placed):
    cameras, found = placed
    assert found.poses.error < 1.0 and len(found.poses) == 6
    ours, truth = (np.array([camera.centre for camera in group]) for group in ([photo.camera for photo in found.poses.photos], cameras))
    ours, truth = (np.linalg.norm(centre[:, None] - centre[None], axis=2) for centre in (ours, truth))
    assert np.abs(ours / ours.mean() - truth / truth.mean()).max() < 0.03


def test_a_photo_of_another_size_keeps_its_size(placed):
    assert [photo.camera.size for photo in placed[1].poses.photos] == [(300, 300), (420, 420), (300, 300), (300, 300), (300, 300), (300, 300)]


def test_a_photo_of_something_else_is_left_out_and_that_is_said(placed):
    assert placed[1].left_out == ("stranger.png",)
    assert "Left out, since too little in them was found again: stranger.png." in placed[1].notices
    assert placed[1].notices[0].startswith("6 of 7 photos were placed, ")


def test_photos_without_exif_are_told(placed):
    assert "7 photos don't tell their focal length (EXIF); it was found with the rest." in placed[1].notices
