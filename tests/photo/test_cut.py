"""The cut is the labelling of least energy (`photo/cut`)."""

import itertools

import numpy as np
import pytest
from scipy.sparse import csr_array
from scipy.sparse.csgraph import maximum_flow

from sketchtree.errors import OptionError
from sketchtree.photo.cut import STEPS, greatest_flow, grid_links, least_energy


def energy(label, zero, one, links):
    """The twin: term by term."""
    own = sum(one[x] if label[x] else zero[x] for x in range(len(label)))
    return own + sum(w for a, b, w in zip(links.first, links.second, links.weight, strict=True) if label[a] != label[b])


def grid(rng, rows, columns, region=None):
    region = np.ones((rows, columns), bool) if region is None else region
    links = grid_links(rng.uniform(0, 2, (rows, columns - 1)), rng.uniform(0, 2, (rows - 1, columns)), region)
    return rng.uniform(0, 3, region.sum()), rng.uniform(0, 3, region.sum()), links


@pytest.mark.parametrize("seed", range(8))
def test_no_labelling_of_a_tiny_grid_has_less_energy(seed):
    zero, one, links = grid(np.random.default_rng(seed), 3, 4)
    least = min(energy(label, zero, one, links) for label in itertools.product((False, True), repeat=12))
    found = least_energy(zero, one, links)
    assert energy(found, zero, one, links) <= least + 29 / STEPS  # a rounding for each of 12 pixels and 17 links


def test_the_flow_is_that_of_scipy():
    rng = np.random.default_rng(5)
    tail, head = rng.integers(0, 40, 300), rng.integers(0, 40, 300)
    kept = tail != head
    pairs, place = np.unique(tail[kept] * 40 + head[kept], return_inverse=True)
    capacity = np.bincount(place, rng.integers(1, 50, kept.sum())).astype(np.int64)
    tail, head = pairs // 40, pairs % 40
    side = greatest_flow(tail, head, capacity, 0, 39)
    through = capacity[side[tail] & ~side[head]].sum()
    assert side[0] and not side[39] and through == maximum_flow(csr_array((capacity.astype(np.int32), (tail, head)), shape=(40, 40)), 0, 39).flow_value


def test_links_join_the_four_neighbours_within_a_region():
    region = np.array([[1, 1, 0], [0, 1, 1]], bool)
    links = grid_links(np.array([[1.0, 2.0], [3.0, 4.0]]), np.array([[5.0, 6.0, 7.0]]), region)
    assert sorted(zip(links.first.tolist(), links.second.tolist(), links.weight.tolist(), strict=True)) == [(0, 1, 1.0), (1, 2, 6.0), (2, 3, 4.0)]


def test_without_links_every_pixel_has_its_own_preference():
    links = grid_links(np.zeros((1, 2)), np.zeros((0, 3)), np.ones((1, 3), bool))
    assert least_energy(np.array([0.0, 2.0, 1.0]), np.array([1.0, 0.0, 5.0]), links).tolist() == [False, True, False]


def test_where_all_agree_nothing_is_cut():
    links = grid_links(np.ones((1, 2)), np.zeros((0, 3)), np.ones((1, 3), bool))
    assert not least_energy(np.zeros(3), np.ones(3), links).any()
    assert least_energy(np.ones(3), np.zeros(3), links).all()


def test_a_certain_preference_does_not_overflow():
    links = grid_links(np.full((1, 1), 1e300), np.zeros((0, 2)), np.ones((1, 2), bool))
    assert least_energy(np.array([0.0, 0.0]), np.array([1e300, 1.0]), links).tolist() == [False, False]


def test_without_ortools_the_remedy_is_named(monkeypatch):
    monkeypatch.setitem(__import__("sys").modules, "ortools.graph.python.max_flow", None)
    with pytest.raises(OptionError) as error:
        least_energy(np.zeros(2), np.ones(2), grid_links(np.ones((1, 1)), np.zeros((0, 2)), np.ones((1, 2), bool)))
    assert str(error.value) == "Finding foliage in a photo needs the package `ortools`. Install it with pip install 'sketchtree[photo]'."
