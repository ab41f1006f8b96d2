"""The guided filter smooths depths, but for edges that the photo shows, and flattens nothing."""

import numpy as np

from sketchtree.multiview.guided import MOST, guided, smoothed

CHANCE = np.random.default_rng(3)
Y, X = np.indices((40, 40)).astype(float)


def by_hand(value, guide, weight, radius, epsilon):
    """The definition, window by window, at one pixel of the middle."""
    def window(y, x):
        return np.s_[y - radius : y + radius + 1, x - radius : x + radius + 1]

    slope, rest = np.zeros_like(value), np.zeros_like(value)
    for y in range(10, 31):
        for x in range(10, 31):
            i, v, w = (column[window(y, x)].ravel() for column in (guide, value, weight))
            mi, mv = np.average(i, weights=w), np.average(v, weights=w)
            slope[y, x] = np.average((i - mi) * (v - mv), weights=w) / (np.average((i - mi) ** 2, weights=w) + epsilon)
            rest[y, x] = mv - slope[y, x] * mi
    near = window(20, 20)
    return np.average(slope[near], weights=weight[near]) * guide[20, 20] + np.average(rest[near], weights=weight[near])


def test_it_is_the_filter_of_its_paper_with_weights():
    value, guide, weight = CHANCE.normal(size=(40, 40)), CHANCE.uniform(size=(40, 40)), CHANCE.uniform(0.1, 1, (40, 40))
    np.testing.assert_allclose(guided(value, guide, weight, 2, 0.01)[20, 20], by_hand(value, guide, weight, 2, 0.01), atol=1e-9)


def test_noise_falls_and_edges_of_the_photo_stay():
    step = np.where(X < 20, 0.0, 5.0)
    noisy = step + CHANCE.normal(0, 0.3, step.shape)
    found = guided(noisy, np.where(X < 20, 0.2, 0.8), np.ones_like(step), 3)
    assert np.abs(found - step).std() < 0.4 * 0.3
    assert np.abs(found - step)[:, 18:22].max() < 0.5


def test_nothing_flows_in_from_where_there_is_no_depth():
    value = np.where(X < 20, 1.0, 99.0)
    found = guided(value, np.full_like(value, 0.5), (X < 20).astype(float), 3)
    np.testing.assert_allclose(found[:, :20], 1.0, atol=1e-6)


def test_a_round_limb_is_neither_flattened_nor_bulged():
    plane = np.dstack([1.0 - 0.01 * (X - 20) ** 2, -0.02 * (X - 20), np.zeros_like(X)])
    found, flat = smoothed(plane, np.full_like(X, 0.5), np.ones_like(X), 1.0, 3), guided(plane[..., 0], np.full_like(X, 0.5), np.ones_like(X), 3)
    inner = np.s_[8:32, 8:32]
    assert np.abs(found - plane[..., 0])[inner].max() < 0.1 * np.abs(flat - plane[..., 0])[inner].max()


def test_a_slanted_limb_is_levelled_less_at_its_edges():
    plane = np.dstack([0.05 * X, np.full_like(X, 0.05), np.zeros_like(X)])
    there = (X < 25).astype(float)
    found, levelled = smoothed(plane, np.full_like(X, 0.5), there, 1.0, 3), guided(plane[..., 0], np.full_like(X, 0.5), there, 3)
    assert np.abs(found - plane[..., 0])[5:-5, 24].max() < 0.6 * np.abs(levelled - plane[..., 0])[5:-5, 24].min()


def test_a_pixel_at_an_edge_that_the_photo_does_not_show_keeps_its_depth():
    plane = np.dstack([np.where(X < 20, 0.0, 30.0), np.zeros_like(X), np.zeros_like(X)])
    found = smoothed(plane, np.full_like(X, 0.5), np.ones_like(X), 1.0, 3)
    assert np.abs(found - plane[..., 0]).max() <= MOST
