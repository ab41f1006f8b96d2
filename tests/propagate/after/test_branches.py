import numpy as np
import pytest
from tests.propagate.after.crossings import crossing, drawn, post_with, twig
from tests.propagate.after.hanging import grown

from sketchtree.axes import NULL
from sketchtree.propagate.after.branches import Branches
from sketchtree.skeleton import Kind


@pytest.fixture(scope="module")
def tree():
    return grown(generations=2)


@pytest.fixture(scope="module")
def branches(tree):
    return Branches.of(tree)


def test_a_branch_is_the_undrawn_part_of_a_limb(tree, branches):
    rows = np.flatnonzero(branches.moves)
    assert len(rows) > 100 and (tree.kind[rows] == Kind.PROPAGATED).all()
    first = branches.first[branches.of_row[rows]]
    np.testing.assert_array_equal(tree.limb[first], tree.limb[rows])
    above = tree.parent[branches.first]
    assert ((tree.limb[above] != tree.limb[branches.first]) | (tree.kind[above] == Kind.DRAWN)).all()


def test_what_is_drawn_or_bears_what_is_drawn_stays():
    tree = post_with(drawn(3, [1, 3, 0]), twig(2, [1, 2, 0], [2, 2, 0]))
    tree = tree.replace(kind=np.r_[tree.kind[:-1], int(Kind.DRAWN)])
    found = Branches.of(tree)
    assert not found.moves.any() and len(found.first) == 0 and (found.of_row == NULL).all() and np.isinf(found.wood).all()


def test_the_bearing_have_lower_ranks_than_the_borne_and_the_heavy_than_the_light(branches):
    borne = np.flatnonzero(branches.above != NULL)
    assert len(borne) > 20 and (branches.rank[borne] > branches.rank[branches.above[borne]]).all()
    wood = branches.wood[branches.first]
    free = np.flatnonzero(branches.above == NULL)
    assert (np.diff(branches.rank[free[np.argsort(wood[free])]]) <= 0).all()


def test_wood_is_counted_in_whole_micrometres_with_all_that_is_borne(tree, branches):
    for row in np.flatnonzero(branches.moves)[::7]:
        _, borne = branches.borne(np.array([row]))
        assert branches.wood[row] == np.rint(tree.length[borne] * 1e6).sum()


def test_all_that_a_row_bears_is_found(tree, branches):
    which, row = branches.borne(np.arange(len(tree)))
    found = {(int(tree_row), int(one)) for tree_row, one in zip(which, row, strict=True)}
    wanted = set()
    for one in range(len(tree)):
        above = one
        while above != NULL:
            wanted.add((int(above), one))
            above = tree.parent[above]
    assert found == wanted


def test_a_stroke_more_elsewhere_leaves_the_ranks():
    alone, more = crossing(), post_with(twig(3, [1.2, 3, 0], [2, 3, 0], [3, 3, 0]), twig(2, [0.5, 2.4, 0], [1.5, 3.6, 0]), twig(5, [-2, 5, 0]))
    np.testing.assert_array_equal(Branches.of(alone).rank, Branches.of(more).rank[:2])
