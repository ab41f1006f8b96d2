"""The visual hull of silhouettes."""

import numpy as np
import pytest
from ring import camera_at, distance_to_surface, rendered

from sketchtree.errors import ViewsError
from sketchtree.multiview.carve import carved, silhouette
from sketchtree.multiview.photos import View

CAMERAS = [camera_at(30.0 * k, distance=3.2) for k in range(12)]


def masked(mask=None):
    views = []
    for k, camera in enumerate(CAMERAS):
        rgb, depth = rendered(camera)
        views.append(View(f"{k}", camera, rgb, (depth > 0) if mask is None else mask, cut_out=True))
    return views


def test_the_hull_hugs_the_bark_and_looks_outwards():
    views = masked()
    cloud = carved(views, [view.seen for view in views], voxels=128)
    side = 2 * 0.75 * 3.2 / 128
    assert np.median(distance_to_surface(cloud.xyz)) < side and len(cloud) > 1000
    trunk = cloud.select((np.hypot(cloud.xyz[:, 0], cloud.xyz[:, 2]) < 0.3) & (np.abs(cloud.xyz[:, 1]) < 0.2))
    assert np.mean((trunk.normal * trunk.xyz)[:, [0, 2]].sum(axis=1) > 0) > 0.95
    np.testing.assert_allclose(np.linalg.norm(cloud.normal, axis=1), 1.0)
    assert 0.2 < cloud.colour.mean() < 0.8


def test_one_bad_mask_is_forgiven():
    views = masked()
    masks = [view.seen for view in views]
    masks[3] = np.zeros_like(masks[3])
    assert len(carved(views, masks, voxels=64)) > 300
    with pytest.raises(ViewsError):
        carved(views, masks, voxels=64, spare=0)


def test_masks_that_have_nothing_in_common_are_named():
    views = masked(np.zeros((96, 96), bool))
    with pytest.raises(ViewsError) as error:
        carved(views, [view.seen for view in views])
    assert str(error.value) == "The silhouettes have no place in common. Check that masks are white where the plant is, and that poses belong to them."


def test_a_mask_is_told_from_a_photo():
    rgb, depth = rendered(CAMERAS[0])
    all_seen = np.ones(depth.shape, bool)
    assert silhouette(View("photo", CAMERAS[0], rgb, all_seen)) is None
    assert silhouette(View("with bars", CAMERAS[0], rgb, depth > 0)) is None
    white = np.repeat((depth > 0)[..., None], 3, axis=2).astype(np.float32)
    np.testing.assert_array_equal(silhouette(View("mask", CAMERAS[0], white, all_seen)), depth > 0)
    np.testing.assert_array_equal(silhouette(View("cut out", CAMERAS[0], rgb, depth > 0, cut_out=True)), depth > 0)
