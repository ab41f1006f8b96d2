"""What a person does to the tree by hand."""

import numpy as np
import pytest
from drawn_by_hand import HEIGHT, document, limb, made, tip_depth

from sketchtree.editing import operations
from sketchtree.editing.edits import Adopted
from sketchtree.errors import OptionError


@pytest.fixture(scope="module")
def after():
    """The little drawing, settled."""
    return made(document())[1]


def test_a_flipped_limb_goes_to_the_other_side_of_its_foot_with_all_it_bears(after):
    flipped = operations.flip(after, limb("left"))
    own, was = flipped.settled.limbs[limb("left")], after.settled.limbs[limb("left")]
    np.testing.assert_allclose(own.depth, 2 * was.depth[0] - was.depth)
    np.testing.assert_allclose(tip_depth(flipped, "twig"), 2 * was.depth[0] - tip_depth(after, "twig"))
    drawn, again = made(flipped)
    assert drawn.touched == frozenset()
    assert tip_depth(again, "left") == pytest.approx(tip_depth(flipped, "left"), abs=1e-6 * HEIGHT)


def test_flipping_twice_is_nothing(after):
    twice = operations.flip(operations.flip(after, limb("left")), limb("left"))
    np.testing.assert_allclose(tip_depth(twice, "left"), tip_depth(after, "left"), atol=1e-9)


def test_a_flip_outlives_seed_and_template(after):
    flipped = operations.flip(after, limb("left"))
    _, again = made(flipped.replace(seed=7, settled=operations.settle_anew(flipped).settled))
    assert tip_depth(again, "left") == pytest.approx(tip_depth(flipped, "left"), abs=1e-6 * HEIGHT)


def test_the_mirrored_tree_is_the_same_seen_from_behind(after):
    drawn, _ = made(after)
    turned, _ = made(operations.mirror(after))
    np.testing.assert_allclose(turned.fit.depth, -drawn.fit.depth, atol=1e-9)


def test_a_trunk_has_no_other_side(after):
    with pytest.raises(OptionError, match="^A trunk has no other side. Mirror the whole tree instead.$"):
        operations.flip(after, limb("trunk"))


def test_what_is_not_there_can_not_be_held(after):
    with pytest.raises(OptionError, match="^That limb is not there any more. Wait until the tree is ready, then pick the limb again.$"):
        operations.hold(after, 12, 1.0, 0.0)


def test_two_places_are_held_in_order_and_one_twice_is_one(after):
    held = operations.hold(operations.hold(after, limb("left"), 1.0, 3.0), limb("left"), 0.5, 1.0)
    held = operations.hold(held, limb("left"), 0.99, 4.0)
    assert held.edits.held[limb("left")].share.tolist() == [0.5, 0.99]
    assert held.edits.held[limb("left")].depth.tolist() == [1.0, 4.0]


def test_a_locked_limb_that_is_dragged_bends_from_its_foot(after):
    locked = operations.lock(after, limb("left"), True)
    dragged = operations.hold(locked, limb("left"), 1.0, 30.0)
    held = dragged.edits.held[limb("left")]
    assert held.whole and held.depth[-1] == pytest.approx(30.0) and held.depth[0] == after.settled.limbs[limb("left")].depth[0]


def test_unlocking_gives_the_limb_free(after):
    assert not operations.lock(operations.lock(after, limb("left"), True), limb("left"), False).edits


def test_deleting_a_limb_takes_its_strokes_and_what_grows_on_it(after):
    left = operations.delete(after, limb("left"))
    assert set(left.strokes) == {"trunk", "right", "high"} and limb("twig") not in left.settled.limbs
    drawn, _ = made(left)
    assert drawn.touched == frozenset()


ADOPTED = Adopted(77, limb("right"), 0.5, np.array([[0.0, 0, 0], [3, 4, 5], [6, 9, 11]]), 0.4, was=5)


def test_an_adopted_limb_stands_where_it_stood_and_moves_with_what_it_grows_on(after):
    adopted = operations.adopt(after, ADOPTED)
    drawn, again = made(adopted)
    rows = np.flatnonzero(drawn.skeleton.limb == 77)
    points = drawn.similarity.to_sketch(np.concatenate([drawn.skeleton.curve(row) for row in rows]))
    np.testing.assert_allclose(points[-1] - points[0], [6, 9, 11], atol=1e-6)
    flipped, _ = made(operations.flip(again, limb("right")))
    moved = flipped.similarity.to_sketch(flipped.skeleton.curve(np.flatnonzero(flipped.skeleton.limb == 77)[0]))[0]
    np.testing.assert_allclose(moved[2], 2 * again.settled.limbs[limb("right")].depth[0] - points[0][2], atol=1e-3)


def test_an_adopted_limb_is_known_by_the_id_it_had(after):
    adopted = operations.adopt(after, ADOPTED)
    assert operations.limb_now(adopted, 5) == 77
    bent = operations.hold(adopted, 5, 1.0, 0.0)
    assert bent.settled.limbs[77].depth[-1] == pytest.approx(0.0, abs=1e-9)


def test_a_limb_is_adopted_with_the_undrawn_one_it_grows_on(after):
    twig = Adopted(78, 77, 1.0, np.array([[0.0, 0, 0], [1, 1, 1]]), 0.2, was=6, on=ADOPTED)
    assert {77, 78} <= set(operations.adopt(after, twig).settled.limbs)


def test_giving_up_an_adopted_limb_gives_up_what_was_adopted_on_it(after):
    twig = Adopted(78, 77, 1.0, np.array([[0.0, 0, 0], [1, 1, 1]]), 0.2, was=6, on=ADOPTED)
    assert not operations.lock(operations.adopt(after, twig), 77, False).edits


def test_a_limb_that_stood_on_a_branch_that_is_gone_is_left_out_and_said(after):
    adopted = operations.adopt(after, ADOPTED)
    gone = adopted.replace(strokes={name: stroke for name, stroke in adopted.strokes.items() if name != "right"})
    drawn, _ = made(gone)
    assert 77 not in drawn.skeleton.limb
    assert drawn.warnings[-1] == "A limb that was kept by hand stood on a branch that is gone; it is left out until that comes back."
