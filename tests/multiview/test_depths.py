"""Depth maps of a known world: near the truth, fewer pixels astray with what the paper adds, and the same for the same seed."""

from dataclasses import replace

import numpy as np
import pytest
from ring import distance_to_surface, rendered, ring

from sketchtree.errors import ViewsError
from sketchtree.keys import root_key
from sketchtree.multiview import fuse
from sketchtree.multiview.coherence import ENOUGH, SIGMA, back_and_forth
from sketchtree.multiview.cost import SIDE, patch_of, source_cost
from sketchtree.multiview.depths import Quality, depth_maps
from sketchtree.multiview.fuse import gathered, seen_through, thinned
from sketchtree.multiview.patchmatch import finer, starting, sweep
from sketchtree.multiview.refine import SMOOTH, carried_over, disparity_unit, likeliest, refined, scored
from sketchtree.multiview.segments import planes_of, segments_of
from sketchtree.multiview.sources import Sources, looked_at, sources_of
from sketchtree.multiview.workplace import level_of, partners

VIEWS = ring(5, 12.0)
CAMERAS = [view.camera for view in VIEWS]
NONE = np.zeros((0, 3))
SOURCES = sources_of(CAMERAS, 4, NONE, [np.zeros(0, np.int64)] * len(VIEWS))
SMALL = Quality(longest=96, sources=4, shrinks=(2, 1), rounds=(3, 2))
PLAIN = replace(SMALL, segments=False, coherence=False, guided=0)
TRUTH = [rendered(camera)[1] for camera in CAMERAS]


def made(quality, seed=0):
    return depth_maps(VIEWS, SOURCES, quality, key=root_key(seed))


@pytest.fixture(scope="module")
def ours():
    return made(SMALL)


@pytest.fixture(scope="module")
def plain():
    return made(PLAIN)


@pytest.fixture
def true_levels():
    """Levels whose planes are the truth, facing the camera."""
    levels = [level_of(view, one, 1) for view, one in zip(VIEWS, SOURCES, strict=True)]
    for level, depth in zip(levels, TRUTH, strict=True):
        level.used &= depth > 0
        level.plane[..., 0] = np.where(depth > 0, 1 / np.where(depth > 0, depth, 1), 0)
        level.plane[..., 1:] = np.stack([np.gradient(level.plane[..., 0], axis=axis) for axis in (1, 0)], axis=2)
        level.plane[..., 1:] = np.clip(level.plane[..., 1:], -0.01, 0.01)
    return levels


def off(levels, row=2):
    """How far a depth map is from the truth, metres."""
    there = levels[row].used & (TRUTH[row] > 0)
    return np.abs(1 / levels[row].plane[..., 0] - TRUTH[row])[there]


def test_depths_are_near_the_truth(ours):
    assert np.median(off(ours)) < 0.012  # of 3 m
    assert (off(ours) < 0.03).mean() > 0.85


def test_what_the_paper_adds_leaves_fewer_astray(ours, plain):
    assert (off(ours) > 0.05).mean() < 0.8 * (off(plain) > 0.05).mean()
    assert off(ours).mean() < 0.8 * off(plain).mean()


def test_the_same_seed_gives_the_same_bytes(ours):
    again = made(SMALL)
    assert all(one.plane.tobytes() == two.plane.tobytes() for one, two in zip(ours, again, strict=True))


def test_the_cloud_lies_on_the_bark_and_looks_outwards(ours):
    points = gathered(ours)
    cloud = thinned(points, points.size)
    assert distance_to_surface(cloud.xyz).mean() < 0.02 and len(cloud) > 1500
    trunk = cloud.select((np.abs(cloud.xyz[:, 0]) < 0.2) & (cloud.xyz[:, 1] < 0.2))
    outwards = trunk.xyz * [1, 0, 1] / np.linalg.norm(trunk.xyz * [1, 0, 1], axis=1, keepdims=True)
    assert np.median((outwards * trunk.normal).sum(axis=1)) > 0.8
    assert cloud.colour.min() >= 0 and cloud.colour.max() <= 1


def test_a_voxel_has_one_point(ours):
    points = gathered(ours)
    cloud = thinned(points, 0.1)
    cells = np.floor((cloud.xyz - points.xyz.min(axis=0)) / 0.1).astype(int)
    assert len(np.unique(cells, axis=0)) == len(cloud) < 400


def test_a_point_far_from_all_others_is_a_stray(ours):
    points = gathered(ours)
    far = replace(points, **{name: np.concatenate([getattr(points, name), getattr(points, name)[:1] + shift]) for name, shift in (("xyz", 3.0), ("colour", 0.0), ("normal", 0.0), ("trust", 0.0))})
    assert len(thinned(far, points.size)) == len(thinned(points, points.size))


def test_half_a_chessboard_may_be_worked_on_in_pieces():
    level = level_of(VIEWS[2], SOURCES[2], 1)
    levels = [level_of(view, one, 1) for view, one in zip(VIEWS, SOURCES, strict=True)]
    near = partners(level, levels)
    start = starting(level.shape, level.sources.low, level.sources.high, np.random.default_rng(0))
    found = []
    for pieces in ((0, 96), (0, 31, 50, 96)):
        plane, energy = start.copy(), np.zeros(level.shape, np.float32)
        for first, last in zip(pieces, pieces[1:], strict=False):
            sweep(
                0, first, last, level.grey, level.used, plane, energy, np.zeros_like(plane), level.sources.low, level.sources.high, float(level.camera.matrix[0, 0]),
                near.transfers, near.others, near.sizes, 2, 2, 0.05, 2, np.uint64(1),
            )
        found.append(plane.tobytes())
    assert found[0] == found[1]


def test_eq3_is_the_sum_of_photo_consistency_times_coherence(true_levels):
    level = true_levels[2]
    near = partners(level, true_levels)
    likely, agreeing = scored(level, true_levels, near, level.plane, 2)
    inside = level.used
    assert np.median(likely[inside]) > 0.9 and np.median(agreeing[inside]) >= ENOUGH
    shifted = level.plane.copy()
    shifted[..., 0] += 3 * disparity_unit(level, true_levels)
    assert np.median(scored(level, true_levels, near, shifted, 2)[0][inside]) < 0.1


def test_eq3_by_hand(true_levels):

    level = true_levels[2]
    near = partners(level, true_levels)
    others = [true_levels[row] for row in level.sources.rows]
    likely, _ = scored(level, true_levels, near, level.plane, 2)
    y, x = np.argwhere(level.used & (likely > 0.3) & (likely < 0.95))[5]
    weight, value = np.empty(SIDE * SIDE, np.float32), np.empty(SIDE * SIDE, np.float32)
    total, mean, variance, middle = patch_of(level.grey, x, y, 2, weight, value)
    found = 0.0
    for k, other in enumerate(others):
        e = back_and_forth(x, y, level.plane[y, x, 0], near.transfers[k], near.backs[k], other.plane, other.used, 96, 96)
        m = 1 - source_cost(x, y, *level.plane[y, x], near.transfers[k], other.grey, 96, 96, 2, weight, value, total, mean, variance, middle)
        found += max(m, 0) * np.exp(-(e**2) / (2 * SIGMA**2)) * (e < 4 * SIGMA)
    assert likely[y, x] == pytest.approx(min(1, found / ENOUGH), abs=1e-3)


def test_eq4_and_its_pairs_fall_from_move_to_move(plain):
    level = plain[2]
    label = segments_of(level.rgb, level.used)
    plane, energies = refined(level, plain, partners(level, plain), label, 2)
    assert len(energies) == len(level.sources.rows) + 4
    assert all(later <= earlier + 1e-9 for earlier, later in zip(energies, energies[1:], strict=False)) and energies[-1] < 0.97 * energies[0]
    likely, _ = scored(level, plain, partners(level, plain), plane, 2)
    rho, unit, pair = plane.astype(float), disparity_unit(level, plain), 0.0
    for one, two, k in ((np.s_[:, :-1], np.s_[:, 1:], 1), (np.s_[:-1], np.s_[1:], 2)):
        weight = np.exp(-np.abs(level.grey[one] - level.grey[two]) / 0.08) * (level.used[one] & level.used[two])
        apart = (rho[one][..., 0] + 0.5 * rho[one][..., k]) - (rho[two][..., 0] - 0.5 * rho[two][..., k])
        pair += (weight * np.minimum(np.abs(apart) / unit, 2.0)).sum()
    assert energies[-1] == pytest.approx((1 - likely[level.used]).sum() + SMOOTH * pair, rel=1e-3)


def test_segments_have_planes_where_enough_of_them_matches():
    label = np.zeros((20, 20), int)
    label[:, 10:] = 1
    label[0, 0] = -1
    y, x = np.indices((20, 20))
    plane = np.dstack([0.5 + 0.001 * x - 0.002 * y, np.zeros((20, 20)), np.zeros((20, 20))]).astype(np.float32)
    plane[3, 4, 0] = 0.9  # does not count much
    energy = np.where(label == 0, 0.1, 0.9)
    found = planes_of(label, plane, energy, 0.2, 0.9)
    np.testing.assert_allclose(found[5, 5], [0.5 + 0.005 - 0.01, 0.001, -0.002], atol=3e-4)
    assert not found[:, 10:].any() and not found[0, 0].any()


def test_segments_keep_within_colours():
    rgb = np.zeros((40, 40, 3), np.float32)
    rgb[:, 20:] = [0.8, 0.3, 0.2]
    label = segments_of(rgb, np.ones((40, 40), bool))
    assert not set(label[:, :20].ravel()) & set(label[:, 20:].ravel())


def test_planes_for_a_finer_picture_are_the_same_planes():
    y, x = np.indices((10, 12)) + 0.5
    plane = np.dstack([0.5 + 0.01 * x - 0.02 * y, np.full(x.shape, 0.01), np.full(x.shape, -0.02)]).astype(np.float32)
    found = finer(plane, (20, 24))
    y, x = (np.indices((20, 24)) + 0.5) / 2
    np.testing.assert_allclose(found[..., 0], 0.5 + 0.01 * x - 0.02 * y, atol=1e-6)
    np.testing.assert_allclose(found[..., 1:], np.broadcast_to([0.005, -0.01], (20, 24, 2)), atol=1e-7)


def test_the_likeliest_plane_near_by_is_carried_on():
    plane, likely = np.zeros((9, 9, 3), np.float32), np.full((9, 9), 0.1, np.float32)
    plane[4, 4], likely[4, 4] = [0.5, 0.01, 0.02], 0.9
    found = likeliest(plane, likely, 2)
    np.testing.assert_allclose(found[6, 3], [0.5 - 0.01 + 0.04, 0.01, 0.02], atol=1e-6)
    assert not found[7, 4].any()


def test_depth_maps_are_carried_over_to_where_they_belong(true_levels):
    found = carried_over(true_levels[1], true_levels[2], true_levels[2].plane)[..., 0]
    both = true_levels[2].used & (found > 0)
    assert both.sum() > 400 and np.median(np.abs(1 / found[both] - TRUTH[2][both])) < 0.02


def test_a_place_before_the_bark_is_seen_through(true_levels):
    for level in true_levels:
        level.likely, level.agreeing = np.ones(level.shape), np.full(level.shape, 4)
    y, x = np.argwhere(true_levels[2].used)[200:230].T
    pixel = np.column_stack([x, y]) + 0.5
    bark, before = (CAMERAS[2].unproject(pixel, by * TRUTH[2][y, x]) for by in (1.0, 0.8))
    assert seen_through(bark, true_levels[2], true_levels).mean() < 0.5 < seen_through(before, true_levels[2], true_levels).mean()


def test_what_the_plant_hardly_fills_of_a_pixel_is_no_point(true_levels, monkeypatch):
    for level in true_levels:
        level.likely, level.agreeing = np.ones(level.shape), np.full(level.shape, 4)
    hardly, count = true_levels[2], []
    for share in (1.0, 0.4, 0.3):
        monkeypatch.setattr(fuse, "filled", lambda rgb, empty, share=share: np.where(rgb is hardly.rgb, share, 1.0) * np.ones(empty.shape, np.float32))
        count.append(len(gathered(true_levels).xyz))
    assert count[0] == count[1] > count[2] + 0.5 * hardly.used.sum()


def test_partners_stand_about_ten_degrees_further():
    assert set(SOURCES[0].rows[:2].tolist()) == {1, 2} and set(SOURCES[2].rows[:2].tolist()) == {1, 3}
    np.testing.assert_allclose(looked_at(CAMERAS), [0, 0.5, 0], atol=1e-4)


def test_depths_are_sought_where_points_are():
    points = np.random.default_rng(0).uniform(-0.2, 0.2, (50, 3)) + [0, 0.5, 0]
    (one, *_) = sources_of(CAMERAS, 4, points, [np.arange(50)] * 5)
    depth = CAMERAS[0].project(points)[1]
    assert 0.5 * depth.min() < 1 / one.high < depth.min() and depth.max() < 1 / one.low < 1.5 * depth.max()


def test_without_partners_there_is_no_depth():
    alone = Sources(np.zeros(0, np.int64), 0.1, 1.0)
    with pytest.raises(ViewsError) as error:
        depth_maps(VIEWS[:2], [alone, alone], SMALL, key=root_key(0))
    assert str(error.value) == "No two photos look at the same place from near enough. Take photos every 10-15° round the plant, and check the poses."


def test_where_nothing_agrees_that_is_named(true_levels):
    for level in true_levels:
        level.likely, level.agreeing = np.zeros(level.shape), np.zeros(level.shape, int)
    with pytest.raises(ViewsError) as error:
        gathered(true_levels)
    assert str(error.value) == (
        "No place of the plant was found again in enough photos. Check that poses belong to these photos; take more photos, nearer to one another, sharp and without wind."
    )
