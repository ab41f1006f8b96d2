"""Strokes of turned pages keep their course there, and join the tree in space."""

import numpy as np
import pytest
from drawn_by_hand import FOOT, HEIGHT, document, limb, line, made

from sketchtree.editing.turning import in_front, on_page
from sketchtree.sketch.strokes import StrokeKind

SIDE = line("side", (FOOT + 1, 55), (FOOT + 15, 60), (FOOT + 30, 75), (FOOT + 34, 88), view_deg=90.0)


@pytest.fixture(scope="module")
def turned():
    """The little drawing, and one stroke on the page at its side."""
    _, after = made(document())
    return made(after.replace(strokes={**after.strokes, "side": SIDE}))


def _course(drawn, name: str, view_deg: float):
    """A limb's points, as the page at that azimuth has them; sketch units."""
    rows = np.flatnonzero(drawn.skeleton.limb == limb(name))
    points = np.concatenate([drawn.skeleton.curve(row) for row in rows])
    return on_page(drawn.similarity.to_sketch(points), view_deg, FOOT)


def test_there_and_back_is_nothing():
    points = np.random.default_rng(0).normal(size=(7, 3))
    np.testing.assert_allclose(in_front(on_page(points, 33.0, 4.0), 33.0, 4.0), points, atol=1e-12)


def test_at_90_degrees_one_looks_from_the_right():
    np.testing.assert_allclose(on_page(np.array([FOOT + 2.0, 5.0, 3.0]), 90.0, FOOT), [FOOT - 3.0, 5.0, 2.0], atol=1e-12)


def test_only_the_new_stroke_is_solved(turned):
    drawn, _ = turned
    assert drawn.touched == {limb("side")}


def test_its_course_on_its_page_is_kept(turned):
    drawn, _ = turned
    course = _course(drawn, "side", 90.0)
    for point in SIDE.points[1:]:
        assert np.abs(course[:, :2] - point).max(axis=1).min() < 1e-6 * HEIGHT


def test_it_grows_from_the_limb_that_it_starts_at(turned):
    drawn, after = turned
    assert after.settled.limbs[limb("side")].parent == limb("trunk")
    np.testing.assert_allclose(_course(drawn, "side", 0.0)[0, [0, 2]], [FOOT, 0.0], atol=1e-9)


def test_the_front_page_is_as_it_was(turned):
    drawn, _ = turned
    front, _ = made(document())
    for name in ("trunk", "left", "right", "high", "twig"):
        ends = [one.skeleton.tip[np.flatnonzero(one.skeleton.limb == limb(name))[-1]] for one in (drawn, front)]
        np.testing.assert_allclose(ends[0], ends[1], atol=1e-9)


def test_once_settled_it_is_not_solved_again(turned):
    drawn, after = turned
    again, _ = made(after)
    assert again.touched == frozenset()
    np.testing.assert_allclose(again.skeleton.tip, drawn.skeleton.tip, atol=1e-12)


def test_the_direction_of_the_pen_does_not_matter(turned):
    drawn, _ = turned
    _, after = made(document())
    back = line("side", *SIDE.points[::-1].tolist(), view_deg=90.0)
    other, _ = made(after.replace(strokes={**after.strokes, "side": back}))
    np.testing.assert_allclose(_course(other, "side", 90.0)[-1, :2], SIDE.points[-1], atol=1e-6)


def test_a_stroke_may_grow_from_another_of_a_turned_page(turned):
    _, after = turned
    more = line("more", SIDE.points[2].tolist(), (FOOT + 40, 78), view_deg=90.0)
    drawn, again = made(after.replace(strokes={**after.strokes, "more": more}))
    assert again.settled.limbs[limb("more")].parent == limb("side") and drawn.touched == {limb("more")}


def test_a_stroke_far_from_any_limb_is_joined_to_the_nearest_and_said(turned):
    _, after = turned
    far = line("far", (FOOT + 60, 50), (FOOT + 70, 60), view_deg=90.0)
    drawn, _ = made(after.replace(strokes={**after.strokes, "far": far}))
    assert limb("far") in drawn.skeleton.limb
    assert "Stroke far starts far from any limb on its page; it was joined to the nearest." in drawn.warnings


def test_a_crown_on_a_turned_page_does_not_count_and_that_is_said(turned):
    _, after = turned
    crown = line("ring", (0, 0), (80, 0), (80, 90), (0, 90), view_deg=90.0, kind=StrokeKind.CROWN, closed=True)
    drawn, _ = made(after.replace(strokes={**after.strokes, "ring": crown}))
    assert not drawn.graph.crown
    assert "Stroke ring is a crown or an obstacle on a turned page; only those of the front page count." in drawn.warnings
