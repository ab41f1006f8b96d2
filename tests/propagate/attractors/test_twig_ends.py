"""Single twigs to what is still far: b(t) = (1 − t)² p + 2 t (1 − t) (p + c u) + t² q (`ends`)."""

import numpy as np
import pytest

from tests.propagate.attractors.attractor_worlds import KEY, straight
from sketchtree import keys
from sketchtree.propagate.attractors import ends

DRAW = keys.draw_key(KEY)
LEAF = 0.2


def twigs(place):
    """Twigs from a straight limb that rises from (0, 1, 0) to (0, 3, 0)."""
    wood = straight()
    samples = wood.limbs[0].samples(0.1)
    arc = np.arange(1, len(samples) + 1) / len(samples) * wood.limbs[0].length
    return ends.ways(np.array(place, float), samples, np.zeros(len(samples), int), arc, wood, LEAF, DRAW, 0)


def test_eq_a_twig_is_a_quadratic_curve_from_its_limb_to_the_attractor():
    _, at, (point,) = twigs([[0.6, 2.4, 0.3]])
    foot, heading, target = np.array([0.0, 1.0 + at[0], 0.0]), np.array([0.0, 1.0, 0.0]), np.array([0.6, 2.4, 0.3])
    aside = (target - foot) * [1.0, 0.0, 1.0]
    wide = np.linalg.norm(aside)
    leave = heading + min(wide / (target - foot)[1], 1.0) * aside / wide
    control = foot + 0.5 * np.linalg.norm(target - foot) * leave / np.linalg.norm(leave)
    t = np.linspace(0, 1, ends.PIECES + 1)[:, None]
    np.testing.assert_allclose(point, (1 - t) ** 2 * foot + 2 * t * (1 - t) * control + t**2 * target, atol=1e-9)


def test_a_twig_starts_towards_the_foot_of_its_limb_and_runs_forward():
    limb, at, point = twigs([[0.6, 2.4, 0.3], [-0.5, 2.0, 0.0]])
    assert limb.tolist() == [0, 0]
    assert (1.0 + at < point[:, -1, 1]).all() and (np.diff(point[..., 1], axis=1) > 0).all()


def test_a_twig_has_a_longest_length_and_stops_on_its_way():
    _, _, (point,) = twigs([[3.0, 3.0, 0.0]])
    assert np.linalg.norm(point[-1] - point[0]) == pytest.approx(6.0 * LEAF)


def test_where_the_page_gives_no_depth_twigs_stand_before_and_behind():
    side = np.stack([np.full(60, 0.5), np.linspace(1.6, 3.0, 60)], axis=1)
    _, _, point = twigs(side)
    np.testing.assert_allclose(point[:, -1, 0], 0.5, atol=1e-9)
    assert point[:, -1, 2].min() < -0.02 and point[:, -1, 2].max() > 0.02


def test_one_twig_grows_from_each_leaf_length_of_a_limb_and_that_is_the_shortest():
    _, at, point = twigs([[0.9, 2.4, 0.0], [0.5, 2.4, 0.0], [0.7, 2.4, 0.0]])
    assert len(np.unique(np.floor(at / LEAF))) == len(at)
    np.testing.assert_allclose(point[0, -1], [0.5, 2.4, 0.0])


def test_what_is_as_near_as_a_leaf_gets_no_twig():
    assert len(twigs([[0.05, 2.0, 0.0]])[2]) == 0


def test_the_farthest_attractor_of_every_cell_is_taken_first():
    place = np.array([[0.1, 0.1], [0.4, 0.4], [1.5, 0.2], [2.5, 2.5]])
    distance = np.array([0.5, 0.8, 0.9, 0.1])
    assert ends.farthest(place, distance, 0.2, 1.0).tolist() == [2, 1]
