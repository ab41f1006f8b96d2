import numpy as np
import pytest
from tests.propagate.worlds import circle

from sketchtree.errors import OptionError
from sketchtree.propagate.attractors.target import Target


def test_a_mask_counts_rows_from_the_top_and_the_world_from_below():
    mask = np.zeros((3, 4), bool)
    mask[0, 3] = True
    target = Target(mask, left=10.0, top=6.0, pixel=2.0)
    assert target.inside(np.array([[17.0, 5.0], [17.0, 3.9], [15.9, 5.0], [19.0, 5.0]])).tolist() == [True, False, False, False]
    assert target.inside(np.array([17.0, 5.0, 99.0])), "depth does not matter: the camera is orthographic"


def test_outlines_enclose_their_area_and_overlapping_ones_their_union():
    target = Target.of_outlines([circle(0, 5, 2), circle(1, 5, 2)], pixels=300)
    one = Target.of_outlines([circle(0, 5, 2)], pixels=300)
    assert one.mask.sum() * one.pixel**2 == pytest.approx(np.pi * 4, rel=0.01)
    assert one.mask.sum() * one.pixel**2 < target.mask.sum() * target.pixel**2 < 2 * np.pi * 4
    assert target.highest == pytest.approx(7.0, abs=0.02) and target.height == pytest.approx(4.0, abs=0.04)


def test_gaps_narrower_than_twice_the_leaf_are_closed_and_wider_ones_are_not():
    mask = np.ones((40, 60), bool)
    mask[:, 20:23] = mask[:, 40:52] = False
    closed = Target(mask, 0.0, 40.0, 1.0).closed(2.5)
    at = lambda x: bool(closed.inside(np.array([x, 20.0])))  # noqa: E731
    assert at(21.5) and not at(46.0) and at(10.0) and not at(-1.0)


def test_a_coarser_mask_covers_the_same_place():
    fine = Target.of_outlines([circle(0, 5, 2)], pixels=1500)
    coarse = fine.coarser(200)
    assert max(coarse.mask.shape) <= 200
    assert coarse.mask.sum() * coarse.pixel**2 == pytest.approx(fine.mask.sum() * fine.pixel**2, rel=0.02)


def test_one_pixel_of_foliage_stays_when_the_mask_is_made_coarser():
    mask = np.zeros((1300, 1300), bool)
    mask[700, 300] = True
    assert Target(mask, 0.0, 13.0, 0.01).coarser().mask.sum() == 1


def test_a_piece_may_be_grown_up_to_where_it_leaves_the_foliage():
    target = Target.of_outlines([circle(0, 5, 2)], pixels=400)
    start, end = np.array([[0.0, 5, 0], [0.0, 5, 0], [9.0, 5, 0]]), np.array([[4.0, 5, 0], [1.0, 5, 0], [9.5, 5, 0]])
    assert target.exit_fraction(start, end) == pytest.approx([0.5, 1.0, 1.0], abs=0.07)


@pytest.mark.parametrize(("made", "message"), [
    (lambda: Target(np.zeros((3, 3), bool), 0.0, 0.0, 1.0), "There is no foliage to grow into: the mask has no pixel that is set. Draw the crown around the leaves."),
    (lambda: Target(np.ones((3, 3), bool), 0.0, 0.0, 0.0), "A pixel of the mask is 0 m. Give a size above zero."),
    (lambda: Target.of_outlines([np.zeros((5, 2))]), "The crown encloses nothing. Draw it as a closed line around the leaves."),
])  # fmt: skip
def test_what_can_not_be_a_target_is_named(made, message):
    with pytest.raises(OptionError) as error:
        made()
    assert str(error.value) == message


def test_leaves_are_at_home_where_most_of_what_is_round_them_is_foliage():
    mask = np.zeros((60, 80), bool)
    mask[10:50, 5:50] = True
    mask[25, 50:56] = True  # a hair
    dense = Target(mask, 0.0, 60.0, 1.0).dense(4.0)
    at = lambda x, y: bool(dense.inside(np.array([x, y])))  # noqa: E731
    assert at(25.0, 30.0) and at(48.5, 30.0) and not at(55.5, 34.5) and not at(58.0, 30.0)


def test_foliage_that_is_dense_nowhere_is_all_home():
    mask = np.zeros((60, 80), bool)
    mask[::12, ::12] = True
    target = Target(mask, 0.0, 60.0, 1.0)
    assert target.dense(4.0) is target
