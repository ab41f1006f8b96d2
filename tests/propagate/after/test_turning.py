import numpy as np
import pytest

from sketchtree.propagate.after.sag import rotation
from sketchtree.propagate.after.turning import angle_of, choices

MOST = np.radians(12.0)
STAY, CLEARS, NONE = 0, 1, 2


def asked(missing=0.05, turned=None, star=True):
    rng = np.random.default_rng(0)
    way = rng.normal(size=(20, 3))
    way /= np.linalg.norm(way, axis=1)[:, None]
    away = np.cross(way, rng.normal(size=(20, 3)))
    away /= np.linalg.norm(away, axis=1)[:, None]
    turned = np.broadcast_to(np.eye(3), (20, 3, 3)) if turned is None else turned
    return way, away, *choices(turned, way, 0.8 * way, away, np.full(20, missing), MOST, star)


def test_what_clears_moves_the_nearest_point_by_what_is_missing():
    way, away, turns, angle = asked()
    moved = np.einsum("bij,bj->bi", turns[:, CLEARS], 0.8 * way) - 0.8 * way
    np.testing.assert_allclose(np.einsum("bi,bi->b", moved, away), 0.05, rtol=2e-3)
    np.testing.assert_allclose(angle[:, CLEARS], 0.05 / 0.8, rtol=1e-9)


def test_no_smaller_turn_moves_it_as_far():
    way, away, _, angle = asked()
    rng = np.random.default_rng(1)
    for _ in range(50):
        axis = rng.normal(size=(20, 3))
        axis /= np.linalg.norm(axis, axis=1)[:, None]
        moved = np.einsum("bij,bj->bi", rotation(axis, 0.99 * angle[:, CLEARS]), 0.8 * way) - 0.8 * way
        assert (np.einsum("bi,bi->b", moved, away) < 0.05).all()


def test_a_turn_that_would_be_too_large_is_no_choice():
    _, _, _, angle = asked(missing=0.5)
    assert np.isinf(angle[:, CLEARS]).all() and np.isfinite(np.delete(angle, CLEARS, axis=1)).all()


def test_no_choice_turns_by_more_than_the_most_from_the_way_it_grew():
    before = rotation(np.tile([0, 1.0, 0], (20, 1)), np.full(20, np.radians(10.0)))
    _, _, turns, angle = asked(missing=0.1, turned=before)
    could = np.isfinite(angle)
    np.testing.assert_allclose(angle_of(turns[could]), angle[could], atol=1e-9)
    assert angle[could].max() <= MOST + 1e-9 and not could.all()
    np.testing.assert_array_equal(turns[:, STAY], before)


def test_the_star_goes_to_all_sides():
    way, _, turns, angle = asked()
    around = np.einsum("bcij,bj->bci", turns[:, NONE + 1 :], way)
    across = around - np.einsum("bci,bi->bc", around, way)[..., None] * way[:, None]
    np.testing.assert_allclose(across.sum(axis=1), 0.0, atol=1e-9)
    np.testing.assert_allclose(np.linalg.norm(across, axis=2), np.sin(angle[:, NONE + 1 :]), atol=1e-9)
    assert len(np.unique(np.round(angle[0, NONE + 1 :], 9))) == 2 and turns.shape[1] == 3 + 2 * 6


def test_without_the_star_there_are_two_choices():
    _, _, turns, angle = asked(star=False)
    assert turns.shape == (20, 2, 3, 3) and angle.shape == (20, 2)


@pytest.mark.parametrize("degrees", [0.0, 1e-5, 5.0, 90.0, 180.0])
def test_the_angle_of_a_rotation(degrees):
    turn = rotation(np.array([[0.6, 0.0, 0.8]]), np.radians([degrees]))
    assert angle_of(turn)[0] == pytest.approx(np.radians(degrees), abs=1e-12)
