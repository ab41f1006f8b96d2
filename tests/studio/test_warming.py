"""What is slow only the first time is made ready aside: what points need goes first, and nothing is made twice."""

import threading

from sketchtree.studio.making.warm import FOR_POINTS, LIMBS
from sketchtree.studio.making.warming import Warming

PATIENCE = 60.0


class Shop:
    """A warming whose programs are made when a test lets them be."""

    def __init__(self):
        self.made, self.free, self.done = [], threading.Semaphore(0), threading.Semaphore(0)
        self.warming = Warming(True, lambda: None, self.make)

    def make(self, quick, limbs, *, seen):
        assert self.free.acquire(timeout=PATIENCE) and quick
        self.made.append((limbs, seen))
        self.done.release()

    def let(self, count: int) -> list:
        """All that is made once so many more are."""
        for _ in range(count):
            self.free.release()
        for _ in range(count):
            assert self.done.acquire(timeout=PATIENCE)
        return self.made


def test_without_points_the_sizes_met_first_come_first():
    shop = Shop()
    shop.warming.begin()
    assert shop.let(len(LIMBS)) == [(limbs, False) for limbs in LIMBS]


def test_points_go_before_all_that_is_not_begun():
    shop = Shop()
    shop.warming.begin()
    shop.let(1)
    shop.warming.for_points(lambda: None)
    made = shop.let(len(LIMBS) + len(FOR_POINTS) - 1)
    at = [seen for _, seen in made].index(True)
    assert at <= 2 and made[at : at + len(FOR_POINTS)] == [(limbs, True) for limbs in FOR_POINTS]


def test_it_is_told_once_there_is_a_program_for_the_first_strokes_and_at_once_where_there_was_one():
    shop, told = Shop(), threading.Semaphore(0)
    shop.warming.for_points(told.release)
    assert not told.acquire(blocking=False)
    shop.let(1)
    assert told.acquire(timeout=PATIENCE)
    shop.warming.for_points(told.release)
    assert told.acquire(blocking=False)
    assert shop.let(len(FOR_POINTS) - 1) == [(limbs, True) for limbs in FOR_POINTS]
