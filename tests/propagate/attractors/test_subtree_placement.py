import numpy as np
import pytest
from tests.propagate.attractors.attractor_worlds import TARGET, predefined, straight, tree

from sketchtree.axes import NULL
from sketchtree.errors import OptionError
from sketchtree.propagate.attractors.library import MOST, library_of, visible
from sketchtree.propagate.attractors.placement import TURNS, placed
from sketchtree.propagate.attractors.predefined import type_one, type_two
from sketchtree.propagate.attractors.pruning import BACK, within_foliage
from sketchtree.propagate.attractors.revolved import Axes
from sketchtree.propagate.attractors.wood import Stretch, Wood, frames

UP = np.array([0.0, 1.0, 0.0])
WHOLE = Stretch(0, 0.0, 2.0, 7)
ALL = [*type_one(), *type_two()]


@pytest.mark.parametrize("subtree", type_one(), ids=lambda one: one.name)
def test_type_one_grows_at_the_end_of_its_supporting_branch(subtree):
    assert subtree.is_type_one and (subtree.share == 1.0).all()


@pytest.mark.parametrize("subtree", type_two(), ids=lambda one: one.name)
def test_type_two_grows_along_its_supporting_branch(subtree):
    assert not subtree.is_type_one and np.ptp(subtree.share) > 0.3 and (subtree.share > 0).all() and (subtree.share < 1).all()


@pytest.mark.parametrize("subtree", ALL, ids=lambda one: one.name)
def test_predefined_branches_are_shorter_than_what_bears_them_and_leave_it_forward(subtree):
    assert len(ALL) == len({one.name for one in ALL}) and 2 <= subtree.branches
    first = np.flatnonzero(subtree.parent == NULL)
    for piece in first:
        pieces = subtree.vector[subtree.branch == subtree.branch[piece]]
        assert 0.1 < np.linalg.norm(pieces.sum(axis=0)) < 1.0 and pieces[0, 1] > 0


@pytest.mark.parametrize("length", [0.4, 1.5])
def test_the_supporting_branch_is_as_long_as_the_branch_replaced(length):
    library = predefined()
    at = placed(library, straight(), Stretch(0, 0.5, 0.5 + length, 7), UP, 0.0)
    for k, subtree in enumerate(library.subtrees):
        first = np.flatnonzero(subtree.parent == NULL)
        foot = at.start[k, 0, first]
        assert foot == pytest.approx(np.array([0.0, 1.5, 0.0]) + length * subtree.share[first, None] * UP)
        assert np.linalg.norm(at.end[k] - at.start[k], axis=-1)[:, : len(subtree)] == pytest.approx(
            np.tile(length * np.linalg.norm(subtree.vector, axis=1), (TURNS, 1))
        )


def test_twelve_turns_about_the_supporting_branch():
    at = placed(predefined(), straight(), WHOLE, UP, 0.0)
    assert at.end.shape[1] == TURNS == 12
    around = np.degrees(np.unwrap(np.arctan2(at.end[0, :, 0, 2], at.end[0, :, 0, 0])))
    assert np.abs(np.diff(around)) == pytest.approx(np.full(11, 30.0))
    assert np.ptp(at.end[0, :, 0, 1]) == pytest.approx(0, abs=1e-9)


def test_branches_bow_to_the_light_and_keep_their_lengths():
    light = np.array([1.0, 0.0, 0.0])
    flat, bowed = (placed(predefined(), straight(), WHOLE, light, rise) for rise in (0.0, 0.5))
    there = flat.there
    assert np.linalg.norm(bowed.end - bowed.start, axis=-1)[there] == pytest.approx(np.linalg.norm(flat.end - flat.start, axis=-1)[there])
    assert ((bowed.end - bowed.start) @ light)[there].mean() > ((flat.end - flat.start) @ light)[there].mean()


def test_a_subtree_follows_the_line_of_a_bent_limb():
    wood = straight(((0.0, 0, 0), (0.0, 1, 0), (1.0, 1, 0)))
    at = placed(library_of(wood, ("II",)), wood, WHOLE, UP, 0.0)
    foot = at.start[:, :, 0].reshape(-1, 3)
    assert (np.abs(foot[:, 0] * (1 - foot[:, 1])) < 1e-9).all(), "every branch starts on the limb"


def test_frames_are_right_handed_and_their_second_column_is_the_direction():
    direction = np.random.default_rng(0).normal(size=(30, 3))
    direction[0] = [0, 2, 0]
    frame = frames(direction)
    assert np.linalg.det(frame) == pytest.approx(np.ones(30))
    assert frame[..., 1] == pytest.approx(direction / np.linalg.norm(direction, axis=1, keepdims=True))


def test_pruned_branches_stay_within_the_foliage_and_stand_on_what_is_left():
    library, wood = predefined(), straight(((0.2, 4.0, 0.0), (0.2, 7.6, 0.0)))
    axes = Axes.about_crown(TARGET, wood.trunk())
    at = placed(library, wood, Stretch(0, 0.0, 3.6, 7), UP, 0.2)
    left = within_foliage(at, library, TARGET, TARGET, axes, UP, 0.05)
    assert 0 < left.there.sum() < at.there.sum()
    assert TARGET.inside(left.end[left.there]).all()
    vector = (left.end - left.start)[left.there]
    assert (vector @ UP >= BACK * np.linalg.norm(vector, axis=1)).all()
    for k, subtree in enumerate(library.subtrees):
        for turn in range(TURNS):
            there = left.there[k, turn, : len(subtree)]
            above = subtree.parent[there]
            assert there[above[above != NULL]].all()
            assert (np.bincount(subtree.branch, there)[np.unique(subtree.branch[there])] >= 2).all(), "no stump"


def test_visible_subtrees_are_the_limbs_with_what_they_bear():
    found = visible(Wood.of(tree()))
    assert 1 <= len(found) <= MOST
    assert found[0].branches == 4 and (found[0].share > 0).all() and (found[0].share < 1).all()


def test_a_visible_subtree_laid_on_its_own_limb_is_itself():
    wood = Wood.of(tree())
    [subtree] = visible(wood)
    low = 0.5 * min(limb.at for limb in wood.limbs if limb.parent == 0)
    library = library_of(wood, ("visible",))
    at = placed(library, wood, Stretch(0, low, wood.limbs[0].length, 0), UP, 0.0)
    tips = np.array([limb.point[-1] for limb in wood.limbs[1:]])
    last = np.flatnonzero(subtree.along == 1.0)
    assert np.sort(at.end[0, 0, last], axis=0) == pytest.approx(np.sort(tips, axis=0), abs=1e-9)


def test_a_library_is_what_its_names_say():
    wood = Wood.of(tree())
    count = [len(library_of(wood, names)) for names in (("I",), ("II",), ("visible",), ("visible", "I", "II"))]
    assert count[3] == sum(count[:3])
    assert len(library_of(straight(), ("visible",))) == len(type_two()), "where none is visible, type II serves"


@pytest.mark.parametrize(("names", "said"), [(("III",), "III"), ((), "empty")])
def test_a_wrong_library_is_named(names, said):
    with pytest.raises(OptionError) as error:
        library_of(straight(), names)
    assert str(error.value) == f"library is {said}, but must name some of visible, I, II. 'visible,I,II' takes all there are."
