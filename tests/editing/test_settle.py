"""Depths follow what was changed by hand, and only that."""

import dataclasses

import numpy as np
import pytest
from drawn_by_hand import HEIGHT, STROKES, document, limb, line, made, tip_depth

from sketchtree.editing import operations
from sketchtree.options import ReadingOptions


@pytest.fixture(scope="module")
def settled():
    """The little drawing, inferred once."""
    return made(document())


def test_a_drawing_that_nobody_touched_is_inferred_as_ever(settled):
    drawn, after = settled
    assert drawn.touched == frozenset(map(limb, ("trunk", "left", "right", "high", "twig")))
    assert drawn.fit.posterior is not None and set(after.settled.limbs) == drawn.touched


def test_what_is_settled_is_not_solved_again_and_stays_to_the_last_bit(settled):
    drawn, after = settled
    again, _ = made(after)
    assert again.touched == frozenset()
    np.testing.assert_array_equal(again.fit.depth, drawn.fit.depth)
    np.testing.assert_array_equal(again.skeleton.tip, drawn.skeleton.tip)
    np.testing.assert_array_equal(again.fit.depth_sd, drawn.fit.depth_sd)
    assert again.theta == drawn.theta


@pytest.mark.parametrize("quick", [True, False])
def test_one_stroke_more_leaves_every_other_limb_where_it_was(quick):
    _, before = made(document(*(stroke for stroke in STROKES if stroke.id != "high")))
    drawn, after = made(before.replace(strokes=document().strokes), quick=quick)
    assert drawn.touched == {limb("high")}
    for name in ("trunk", "left", "right", "twig"):
        assert tip_depth(after, name) == pytest.approx(tip_depth(before, name), abs=1e-9 * HEIGHT)
    assert np.isfinite(tip_depth(after, "high"))


def test_a_limb_drawn_elsewhere_is_solved_again_and_no_other(settled):
    _, after = settled
    moved = line("high", (50, 70), (42, 90), (43, 98))
    drawn, _ = made(after.replace(strokes={**after.strokes, "high": moved}))
    assert drawn.touched == {limb("high")}


def test_a_held_depth_is_met_and_the_projection_kept(settled):
    _, after = settled
    drawn, held = made(operations.hold(after, limb("left"), 1.0, 12.5))
    assert tip_depth(held, "left") == pytest.approx(12.5, abs=1e-6 * HEIGHT)
    before, _ = settled
    np.testing.assert_allclose(drawn.skeleton.tip[:, :2], before.skeleton.tip[:, :2], atol=1e-9)


def test_holding_one_limb_solves_it_again_with_what_it_bears_and_those_beside_it(settled):
    _, after = settled
    drawn, held = made(operations.hold(after, limb("left"), 1.0, 12.5))
    assert {limb("left"), limb("twig")} <= drawn.touched and limb("trunk") not in drawn.touched
    assert made(held)[0].touched == frozenset()


def test_another_template_question_solves_all_again_and_keeps_what_is_held(settled):
    _, after = settled
    held = made(operations.hold(after, limb("left"), 1.0, 12.5))[1]
    other = held.replace(reading=ReadingOptions(template="none", planar=True))
    drawn, again = made(other)
    assert len(drawn.touched) == len(STROKES)
    assert tip_depth(again, "left") == pytest.approx(12.5, abs=1e-6 * HEIGHT)


def test_a_locked_limb_stays_whole_whatever_else_is_solved(settled):
    _, after = settled
    locked = operations.lock(after, limb("right"), True)
    _, again = made(locked.replace(settled=dataclasses.replace(locked.settled, asked="another question")))
    np.testing.assert_allclose(again.settled.limbs[limb("right")].depth[1:], after.settled.limbs[limb("right")].depth[1:], atol=1e-6 * HEIGHT)


def test_what_no_line_can_reach_is_held_as_far_as_it_goes_and_said(settled):
    _, after = settled
    drawn, again = made(operations.hold(after, limb("twig"), 1.0, 40 * HEIGHT))
    assert 0 < tip_depth(again, "twig") < 5 * HEIGHT
    assert drawn.warnings[-1] == "Stroke twig is held farther from the page than its line can reach; it goes as far as it can."


def test_other_methods_infer_as_ever(settled):
    _, after = settled
    drawn, _ = made(after.replace(reading=ReadingOptions(template="none", method="okabe")))
    assert drawn.fit.method == "okabe"


def test_theta_stays_while_the_drawing_is_about_as_large(settled):
    drawn, after = settled
    again, _ = made(operations.hold(after, limb("left"), 1.0, 12.5))
    assert again.theta == drawn.theta
    fewer, _ = made(after.replace(strokes={name: after.strokes[name] for name in ("trunk", "left", "right")}))
    assert fewer.settled.manner.limbs == {limb("trunk"), limb("left"), limb("right")}


def test_what_was_settled_steeper_than_a_lock_may_be_stays_all_the_same():
    _, before = made(document(*(stroke for stroke in STROKES if stroke.id != "high")))
    steep = dataclasses.replace(before.settled.limbs[limb("right")], depth=np.linspace(0.0, 30 * HEIGHT, len(before.settled.limbs[limb("right")].depth)))
    settled = dataclasses.replace(before.settled, limbs={**before.settled.limbs, limb("right"): steep})
    drawn, after = made(before.replace(strokes=document().strokes, settled=settled))
    assert drawn.touched == {limb("high")}
    assert tip_depth(after, "right") == pytest.approx(30 * HEIGHT, rel=1e-3)
    assert abs(tip_depth(after, "high")) < HEIGHT
