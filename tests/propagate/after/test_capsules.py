import numpy as np
import pytest

from sketchtree.propagate.after import capsules
from sketchtree.propagate.after.capsules import Balls, Capsules


def wood(count, seed=0):
    rng = np.random.default_rng(seed)
    start = rng.uniform(0, 3, (count, 3))
    end = start + rng.normal(0, 0.3, (count, 3))
    radius = np.where(np.arange(count) % 40 == 0, 0.9, 10 ** rng.uniform(-2.5, -0.7, count))
    return Capsules.cut(np.arange(count), start, end, radius, 0.3)


def meeting(one, other):
    between = np.linalg.norm(one.middle[:, None] - other.middle[None], axis=2)
    return between < one.reach[:, None] + other.reach[None]


@pytest.fixture(params=["at once", "in chunks"])
def size(request, monkeypatch):
    if request.param == "in chunks":
        monkeypatch.setattr(capsules, "_CHUNK", 7)
        monkeypatch.setattr(capsules, "_AT_ONCE", 11)


def test_every_pair_of_balls_that_meet_is_named_once(size):
    balls = Balls.of(wood(120))
    named = [tuple(sorted(pair)) for i, j in balls.each_other() for pair in zip(i.tolist(), j.tolist(), strict=True)]
    assert len(balls.classes) > 2 and len(set(named)) == len(named)
    assert set(named) == set(zip(*np.nonzero(np.triu(meeting(balls, balls), 1)), strict=True))


def test_every_pair_of_two_sets_is_named_once(size):
    one, other = Balls.of(wood(90)), Balls.of(wood(70, seed=1))
    named = [pair for i, j in one.meeting(other) for pair in zip(i.tolist(), j.tolist(), strict=True)]
    assert len(set(named)) == len(named)
    assert set(named) == set(zip(*np.nonzero(meeting(one, other)), strict=True))


def test_balls_hold_their_pieces():
    pieces = wood(50)
    balls = Balls.of(pieces)
    for at in (pieces.start, pieces.start + pieces.vector):
        assert (np.linalg.norm(at - balls.middle, axis=1) <= balls.reach - pieces.radius + 1e-12).all()


def test_long_pieces_are_cut_and_cover_the_same_way():
    start, end = np.zeros((3, 3)), np.array([[0, 1.0, 0], [0, 0.05, 0], [0, 0, 0]])
    cut = Capsules.cut(np.array([7, 8, 9]), start, end, np.array([0.01, 0.01, 0.01]), 0.3)
    assert cut.row.tolist() == [7, 7, 7, 7, 8] and cut.owner.tolist() == [0, 0, 0, 0, 1]
    np.testing.assert_allclose(cut.start[:4, 1], [0, 0.25, 0.5, 0.75])
    np.testing.assert_allclose(cut.vector[:4, 1], 0.25)


def test_thick_wood_is_cut_no_shorter_than_it_is_thick():
    cut = Capsules.cut(np.zeros(1, int), np.zeros((1, 3)), np.array([[0, 2.0, 0]]), np.array([0.5]), 0.1)
    assert len(cut) == 2


def test_nothing_meets_nothing():
    none = Balls.of(wood(0))
    assert list(none.each_other()) == [] and list(none.meeting(Balls.of(wood(5)))) == [] and list(Balls.of(wood(5)).meeting(none)) == []
