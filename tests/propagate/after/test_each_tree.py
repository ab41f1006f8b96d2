"""Trees of one skeleton sag each as it would alone."""

import numpy as np

from sketchtree.propagate.after.each_tree import sagged
from sketchtree.propagate.after.sag import Sag
from sketchtree.propagate.space.space import Space
from sketchtree.skeleton import Kind
from sketchtree.skeleton_joined import joined
from tests.propagate.worlds import HABIT, drawn_tree

A = drawn_tree()
A = A.replace(kind=np.where(A.order > 0, int(Kind.PROPAGATED), A.kind))
BOTH = joined([A, A.replace(tree=np.ones(len(A), int))])


class Wall:
    """A barrier at x."""

    def __init__(self, x: float):
        self.x = x

    def inside(self, point):
        return point[:, 0] < self.x

    def exit_fraction(self, start, end, bisections=9):
        return self.inside(end).astype(float)


def test_each_tree_hangs_as_alone():
    alone = Sag(1.0, HABIT).run(A).skeleton
    found = sagged(BOTH, 1.0, HABIT, {0: Space(), 1: Space()})
    np.testing.assert_array_equal(found.rows, np.arange(len(BOTH)))
    np.testing.assert_array_equal(found.skeleton.tip, np.concatenate([alone.tip, alone.tip]))


def test_each_tree_is_cut_at_its_own_barriers():
    found = sagged(BOTH, 1.0, HABIT, {0: Space((Wall(1.0),)), 1: Space()})
    left = np.bincount(BOTH.tree[found.rows])
    assert left[0] < left[1] == len(A)
    np.testing.assert_array_equal(found.skeleton.tree, BOTH.tree[found.rows])


def test_without_strength_nothing_changes():
    assert sagged(BOTH, 0.0, HABIT, {}).skeleton is BOTH
