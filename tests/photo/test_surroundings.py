"""What the background looks like near by, b(I | x) = Σ_j r_j(x) N_j(I), and what is left for leaves, π f / (π f + (1 − π) b)."""

import numpy as np
import pytest

from sketchtree.keys import root_key
from sketchtree.photo.appearance import Mixture
from sketchtree.photo.foliage_colours import leaf_probability, learn_leaves, without_blur
from sketchtree.photo.pixels import Pixels
from sketchtree.photo.surroundings import Surroundings, learn_surroundings, ring_around

KEY = root_key(0)
SKY, WALL, LEAF = (150, 190, 235), (180, 150, 130), (220, 170, 40)


@pytest.fixture(scope="module")
def scene() -> tuple[np.ndarray, np.ndarray]:
    """(sky above a wall, a yellow crown before both; where the crown is)."""
    draw = np.random.default_rng(0)
    picture = np.empty((120, 120, 3))
    picture[:60], picture[60:] = SKY, WALL
    row, column = np.mgrid[:120, :120]
    crown = np.hypot(row - 60, column - 60) < 30
    picture[crown & (draw.random((120, 120)) < 0.8)] = LEAF
    return np.clip(picture + draw.normal(0, 3, picture.shape), 0, 255).astype(np.uint8), crown


@pytest.fixture(scope="module")
def around(scene) -> Surroundings:
    picture, crown = scene
    return learn_surroundings(Pixels.of(picture, crown), Pixels.of(picture, ring_around(crown, 53.0)), crown.shape, 53.0, key=KEY)


def test_eq_density_near_by_is_the_sum_of_shares_times_gaussians(around, scene):
    picture, crown = scene
    pixels = Pixels.of(picture, crown)
    row, column = np.divmod(pixels.at, pixels.width)
    parts = np.exp(around.colours.log_parts(pixels.colours())) * len(around.colours)  # N_j: the weights of the mixture are equal
    here = around.share[:, row // around.cell, column // around.cell].T
    np.testing.assert_allclose(around.log_density(pixels), np.log((parts * here).sum(axis=1) + 1e-300), rtol=1e-9)


def test_shares_of_what_is_near_by_sum_to_one(around):
    assert not around.leafy.any()
    np.testing.assert_allclose(around.share.sum(axis=0), 1.0)


def test_sky_is_likelier_above_and_the_wall_below(around):
    picture = np.broadcast_to(np.array(SKY, np.uint8), (120, 120, 3)).copy()
    density = around.log_density(Pixels.of(picture, np.ones((120, 120), bool))).reshape(120, 120)
    assert density[20, 60] > density[100, 60] + 1.0


def test_the_ring_begins_beside_the_region_and_is_as_wide_as_said(scene):
    _, crown = scene
    ring = ring_around(crown, 53.0)
    row, column = np.nonzero(ring)
    away = np.hypot(row - 60, column - 60)
    assert not (ring & crown).any() and away.min() < 32 and 40 < away.max() < 45


def test_eq_probability_of_foliage_weighs_both_mixtures():
    leaf, background, share = np.log([0.2, 0.01]), np.log([0.1, 0.3]), 0.4
    wanted = 0.4 * np.exp(leaf) / (0.4 * np.exp(leaf) + 0.6 * np.exp(background))
    np.testing.assert_allclose(leaf_probability(leaf, background, share), wanted)


def test_leaves_are_learnt_beside_a_background_that_is_known(around, scene):
    picture, crown = scene
    own = Pixels.of(picture, crown)
    yellow = np.flatnonzero(own.colours()[:, 2] < 90)
    leaf, share = learn_leaves(own.colours(), around.log_density(own), yellow, key=KEY)
    np.testing.assert_allclose(leaf.weight @ leaf.mean, LEAF, atol=8)
    assert abs(share - 0.8) < 0.08


def test_what_is_nearly_the_sky_is_given_back():
    mean = np.array([LEAF, (158, 188, 215)], float)
    mixture = Mixture(np.array([0.8, 0.2]), mean, np.stack([100 * np.eye(3)] * 2))
    assert without_blur(mixture, np.array([SKY], float)).mean.tolist() == [list(map(float, LEAF))]
