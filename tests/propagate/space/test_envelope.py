import numpy as np
import pytest
from tests.propagate.worlds import circle

from sketchtree.errors import OptionError
from sketchtree.propagate.space.envelope import Envelope, Lobe


def ball(count=4000, size=7.0, seed=0):
    return np.random.default_rng(seed).uniform(-size, size, (count, 3)) + [0, 5.5, 0]


def test_a_circle_makes_a_sphere():
    envelope = Envelope.from_outlines([circle(x=1.0, points=2000)])
    point = ball()
    radius = np.linalg.norm(point - [1.0, 5.5, 0.0], axis=1)
    clear = np.abs(radius - 4.5) > 1e-3
    np.testing.assert_array_equal(envelope.inside(point)[clear], (radius < 4.5)[clear])


def test_on_the_page_the_surface_is_the_outline():
    outline = np.array([[-2, 1], [3, 2], [2.5, 6], [0, 8], [-1, 5]], float)
    lobe = Lobe.from_outline(outline)
    on = np.concatenate([outline * t + np.roll(outline, -1, axis=0) * (1 - t) for t in (0.2, 0.5, 0.9)])
    np.testing.assert_allclose(lobe.margin(np.column_stack([on, np.zeros(len(on))])), 0.0, atol=1e-9)


def test_left_and_right_half_widths_blend_by_azimuth():
    """w(θ) = w_r (1 + cos θ)/2 + w_l (1 − cos θ)/2 about the outline's own axis."""
    outline = np.array([[-1, 0], [1, 0], [3, 2], [3, 6], [1, 8], [-1, 8]], float)
    lobe = Lobe.from_outline(outline)
    left, right = lobe.axis + 1.0, 3.0 - lobe.axis
    assert left != pytest.approx(right)
    theta = np.linspace(0, 2 * np.pi, 37)
    wide = right * (1 + np.cos(theta)) / 2 + left * (1 - np.cos(theta)) / 2
    ring = np.column_stack([lobe.axis + wide * np.cos(theta), np.full(37, 4.0), wide * np.sin(theta)])
    np.testing.assert_allclose(lobe.margin(ring), 0.0, atol=1e-12)


def test_the_orientation_of_an_outline_does_not_matter():
    outline = circle(points=50)
    there, back = Envelope.from_outlines([outline]), Envelope.from_outlines([outline[::-1]])
    np.testing.assert_array_equal(there.inside(ball()), back.inside(ball()))


def test_several_outlines_make_the_union_of_their_surfaces():
    one, two = circle(x=-2.0, radius=2.0), circle(x=2.0, y=7.0, radius=2.5)
    both = Envelope.from_outlines([one, two]).inside(ball())
    apart = Envelope.from_outlines([one]).inside(ball()) | Envelope.from_outlines([two]).inside(ball())
    np.testing.assert_array_equal(both, apart)


def test_a_leaning_outline_revolves_about_an_axis_that_lies_within_it():
    outline = np.array([[0, 0], [1, 0], [9, 8], [8, 8]], float)
    lobe = Lobe.from_outline(outline)
    middle = np.array([[0.5 + y, y, 0.0] for y in (0.5, 4.0, 7.5)])
    assert (lobe.margin(middle) > 0).all()


def test_a_notched_outline_counts_by_its_outer_ends():
    outline = np.array([[0, 0], [6, 0], [6, 6], [3, 2], [0, 6]], float)
    assert Lobe.from_outline(outline).margin(np.array([[3.0, 4.0, 0.0]]))[0] > 0


def test_far_from_the_origin_nothing_changes():
    near, far = circle(), circle() + [1e5, 0.0]
    point = ball()
    same = Envelope.from_outlines([near]).inside(point) == Envelope.from_outlines([far]).inside(point + [1e5, 0, 0])
    assert same.mean() > 0.999


def test_the_exit_lies_on_the_surface():
    envelope = Envelope.from_outlines([circle(points=720)])
    rng = np.random.default_rng(1)
    way = rng.normal(size=(300, 3))
    start = np.tile([0.3, 5.0, 0.2], (300, 1))
    end = start + 20.0 * way / np.linalg.norm(way, axis=1)[:, None]
    fraction = envelope.exit_fraction(start, end)
    at = start + fraction[:, None] * (end - start)
    assert envelope.inside(at).all()
    assert np.abs(np.linalg.norm(at - [0.0, 5.5, 0.0], axis=1) - 4.5).max() < 1e-3


def test_the_bounds_hold_the_surface():
    envelope = Envelope.from_outlines([circle(x=-1.0), circle(x=3.0, radius=1.0)])
    low, high = envelope.bounds
    point = ball(size=12.0)
    held = ((point >= low) & (point <= high)).all(axis=1)
    assert not envelope.inside(point)[~held].any()


def test_a_segment_that_stays_inside_has_fraction_one():
    envelope = Envelope.from_outlines([circle()])
    start = np.array([[0.0, 5.0, 0.0]])
    assert envelope.exit_fraction(start, start + [[0.5, 0.5, 0.5]])[0] == 1.0


def test_a_branch_outside_may_grow_in_but_not_on():
    envelope = Envelope.from_outlines([circle()])
    start = np.array([[8.0, 5.5, 0.0], [8.0, 5.5, 0.0]])
    end = np.array([[3.0, 5.5, 0.0], [9.0, 5.5, 0.0]])
    np.testing.assert_array_equal(envelope.exit_fraction(start, end), [1.0, 0.0])


def test_an_envelope_that_does_not_bind_lets_what_is_outside_grow():
    envelope = Envelope.from_outlines([circle()])
    free = Envelope(envelope.lobes, binding=False)
    start = np.array([[8.0, 5.5, 0.0]])
    assert free.exit_fraction(start, start + 1.0)[0] == 1.0


@pytest.mark.parametrize(
    "outline", [[[0, 0], [1, 1]], [[0, 0], [1, 0], [2, 0]], [[0, 0], [1, np.nan], [2, 1]], [[1, 0], [1, 1], [1, 2]]]
)
def test_an_outline_without_area_is_refused(outline):
    with pytest.raises(OptionError) as caught:
        Envelope.from_outlines([np.array(outline, float)])
    assert str(caught.value) == (
        "A crown outline needs at least three finite points that enclose an area. "
        "Draw the crown as a closed curve, or build with `--crown off`."
    )


def test_a_crown_that_crosses_itself_still_has_an_inside():
    eight = np.array([[-2, 2], [2, 6], [-2, 6], [2, 2]], float)
    envelope = Envelope.from_outlines([eight])
    assert envelope.inside(np.array([[0.0, 2.2, 0.0]]))[0]


def test_the_page_shows_a_point_inside_whatever_its_depth():
    envelope = Envelope.from_outlines([circle(radius=2.0), circle(x=9.0, radius=1.0)])
    points = np.array([[0.0, 5.5, 40.0], [9.5, 5.5, -40.0], [5.0, 5.5, 0.0], [0.0, 9.0, 0.0]])
    np.testing.assert_array_equal(envelope.on_page(points), [True, True, False, False])
