import numpy as np
import pytest
from tests.propagate.after.crossings import crossing, post_with, twig
from tests.propagate.after.hanging import grown
from tests.propagate.worlds import circle

from sketchtree.propagate.after.sag import rotation
from sketchtree.propagate.after.settling import Settling, Wood
from sketchtree.propagate.space.envelope import Envelope
from sketchtree.propagate.space.space import Space


def settling(tree, spaces=None, crotch=3.0):
    return Settling(tree, spaces or {}, 1.0, crotch)


def test_a_row_is_clear_up_to_where_it_is_as_near_to_another_as_asked():
    tree = crossing()
    now = settling(tree)
    row, other = np.array([11]), np.array([7])
    share = now.clear_share(row, other, 1.5)[0]
    end = tree.start[11] + share * tree.vector[11]
    assert tree.limb[row] == 101 and tree.limb[other] == 100 and 0 < share < 1
    assert abs(end[1] - 3.0) == pytest.approx(1.5 * 0.04, abs=2e-3)


def test_what_would_leave_the_space_is_found_and_its_wood_is_what_a_cut_then_loses():
    tree = grown(crown=(circle(points=90),))
    now = settling(tree, {0: Space((Envelope.from_outlines((circle(points=90),)),))})
    branch = np.flatnonzero(now.branches.size[now.branches.first] > 5)[:12]
    turns = rotation(np.tile([1.0, 0, 0], (len(branch), 1)), np.full(len(branch), np.radians(25.0)))
    rows, share, lost = now.outside(branch, turns)
    assert lost.max() > 0
    for one, turn, wood in zip(branch, turns, lost, strict=True):
        alone = settling(tree, now.spaces)
        its, part, _ = alone.outside(np.array([one]), turn[None])
        before = tree.length[alone.branches.borne(alone.branches.first[[one]])[1]].sum()
        alone.cut(its, part)
        borne = alone.branches.borne(alone.branches.first[[one]])[1]
        left = (tree.length * alone.share * alone.there)[borne].sum()
        assert before - left == pytest.approx(wood * 1e-6, abs=1e-4)
    assert np.isin(rows, now.branches.borne(now.branches.first[branch])[1]).all() and ((share >= 0) & (share < 1)).all()


def test_as_it_grew_nothing_is_outside_that_was_not():
    tree = grown(crown=(circle(points=90),))
    now = settling(tree, {0: Space((Envelope.from_outlines((circle(radius=2.0, points=90),)),))})
    branch = np.arange(len(now.branches.first))
    assert now.outside(branch, now.unturned(branch))[2].sum() == 0


def test_a_sharp_fork_is_no_knot_within_the_crotch():
    tree = post_with(twig(3, [0.2, 3.8, 0], [0.5, 4.5, 0]), radius=0.03, thick=0.4)
    for crotch, count in ((3.0, 0), (1.5, 1)):
        now = settling(tree, crotch=crotch)
        wood = Wood.of(now.wood_of(now.take_up(int(now.branches.rank[0]))))
        assert len(now.overlaps(wood, wood)) == count
