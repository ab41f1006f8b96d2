"""Boughs to far parts of a crown, thick limbs that nothing runs through, and twigs along bare limbs (`boughs`, `thick`, `state`)."""

import numpy as np
import pytest
from tests.propagate.attractors.attractor_worlds import KEY, TARGET, straight, tree
from tests.propagate.worlds import circle

from sketchtree.axes import NULL
from sketchtree.propagate.attractors.boughs import LEAST, SPANS, grow_boughs
from sketchtree.propagate.attractors.places import Places
from sketchtree.propagate.attractors.state import State
from sketchtree.propagate.attractors.target import Target
from sketchtree.propagate.attractors.thick import Thick
from sketchtree.propagate.attractors.wanted import Wanted
from sketchtree.propagate.attractors.wood import Limb, Wood

LEAF = 0.2
LOBED = Target.of_outlines([circle(0.2, 5.4, 2.0), circle(4.5, 5.0, 1.8), [(0.0, 4.6), (4.5, 4.2), (4.5, 5.6), (0.0, 6.0)]], pixels=200)


def state(target=TARGET, wood=None, **wanted) -> State:
    return State(Wood.of(tree()) if wood is None else wood, target, Wanted(in_space=400, **wanted), LEAF, KEY)


def test_boughs_come_to_a_lobe_that_no_drawn_limb_goes_to():
    at = state(LOBED)
    before = at.space.distance.max()
    grow_boughs(at, lambda: None)
    new = at.wood.limbs[at.wood.given :]
    assert new and max(limb.point[-1, 0] for limb in new) > 3.5
    assert at.space.distance.max() < 0.6 * before and set(at.course.driver) == {"boughs"}


def test_boughs_are_seen_in_the_foliage_go_on_as_their_limb_and_run_through_no_thick_one():
    at = state(LOBED)
    grow_boughs(at, lambda: None)
    for limb in at.wood.limbs[at.wood.given :]:
        assert at.target.inside(limb.point[1:]).all()
        bearer = at.wood.limbs[limb.parent]
        along = bearer.place(np.clip([limb.at - 0.01, limb.at + 0.01], 0, bearer.length))
        assert (limb.point[1] - limb.point[0]) @ (along[1] - along[0]) > 0
        pieces = np.full(len(limb.point) - 1, limb.parent)
        assert not at.thick.struck(limb.point[:-1], limb.point[1:], pieces, np.full(len(pieces), limb.at)).any()


def test_what_subtrees_reach_gets_no_bough():
    near = Target.of_outlines([circle(0.2, 6.4, 1.0)], pixels=100)
    at = state(near)
    assert max(SPANS) * at.axes.half.max() < LEAST * LEAF
    grow_boughs(at, lambda: None)
    assert at.grown == 0 and at.course.driver == []


def _thick(radius):
    wood = straight(((0.0, 0.0, 0.0), (0.0, 4.0, 0.0)))
    wood.limbs[0].row_end, wood.limbs[0].row_radius = np.array([0.0, 4.0]), np.array([radius, radius])
    return Thick.of(wood, LEAF)


@pytest.mark.parametrize(("start", "end", "limb", "at", "struck"), [
    ((-1, 2, 0), (1, 2, 0), 5, 0.0, True),  # of another limb, through it
    ((-1, 2, 0), (1, 2, 0.9), 5, 0.0, False),  # past it
    ((0, 2, 0), (1, 3, 0), 0, 2.0, False),  # leaves it
    ((-1, 3.5, 0), (1, 3.5, 0), 0, 0.5, True),  # leaves it farther down and comes back
])  # fmt: skip
def test_a_branch_runs_through_a_thick_limb_unless_it_leaves_it_there(start, end, limb, at, struck):
    assert _thick(0.3).struck(np.array([start], float), np.array([end], float), np.array([limb]), np.array([at])).tolist() == [struck]


def test_thin_limbs_stop_nothing():
    assert not _thick(0.1 * LEAF).struck(np.array([[-1.0, 2, 0]]), np.array([[1.0, 2, 0]]), np.array([5]), np.array([0.0])).any()


def test_a_place_is_as_far_as_the_nearest_of_all_that_were_added():
    rng = np.random.default_rng(0)
    places, all_ = Places(), np.zeros((0, 3))
    point = rng.uniform(0, 1, (50, 3))
    for many in (40, 3, 5, 30, 1, 2):
        new = rng.uniform(0, 1, (many, 3))
        places.add(new)
        all_ = np.concatenate([all_, new])
        slow = np.linalg.norm(point[:, None] - all_, axis=-1).min(axis=1)
        np.testing.assert_allclose(places.distance(point, 9.0), slow)
    assert np.isinf(places.distance(np.array([[9.0, 9.0, 9.0]]), 0.5)).all()


def test_foliage_along_a_thin_drawn_limb_counts_as_bare_until_a_twig_grows_and_along_a_thick_one_never():
    def along(radius):
        wood = Wood([Limb(7, NULL, 0.0, np.array([[0.2, 0.0, 0.0], [0.2, 8.0, 0.0]]), 1, radius, 0, (0, 1), np.array([0.0, 8.0]), np.full(2, radius))])
        return state(wood=wood)

    thin = along(0.5 * LEAF)
    assert len(thin.along) and np.isinf(thin.along.distance).all() and len(along(1.5 * LEAF).along) == 0
    thin.bear(0, 5.0, np.array([[0.2, 5.0, 0.0], [0.4, 5.6, 0.1]]))
    thin.take_up()
    assert np.isfinite(thin.along.distance).any()
