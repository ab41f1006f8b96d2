"""A bundle answers for every line at once what a `Line` answers by itself."""

import numpy as np
import pytest
from little_lines import line, lines, random_lines

from sketchtree.sketch.joining.bundle import Bundle, taper, typical_width
from sketchtree.sketch.joining.lines import extent, unit

SEEDS = pytest.mark.parametrize("seed", range(4))


def asked(seed, bundle):
    """(line, length) of places on all lines: at random, at drawn points, at and beyond both ends."""
    rng = np.random.default_rng(seed)
    which = np.repeat(np.arange(len(bundle)), 8)
    part = rng.choice([-0.1, 0.0, 0.25, 0.5, 1.0, 1.1], len(which)) + rng.uniform(0, 0.05, len(which)) * rng.integers(0, 2, len(which))
    s = part * bundle.length[which]
    points = [(k, a) for k in range(len(bundle)) for a in bundle.along[bundle.first[k] : bundle.first[k + 1]]]
    return np.r_[which, [k for k, _ in points]], np.r_[s, [a for _, a in points]]


@SEEDS
def test_lengths_and_ends_are_those_of_the_lines(seed):
    made = random_lines(seed, 9)
    bundle = Bundle.of(made)
    assert len(bundle) == 9 and bundle.height == extent(made)
    assert bundle.length == pytest.approx([one.length for one in made], rel=1e-12)
    assert bundle.ends.tolist() == [p for one in made for p in one.points[[0, -1]].tolist()]
    assert [shape.coords[:] for shape in bundle.shapes] == [one.shape.coords[:] for one in made]


@SEEDS
def test_places_are_those_of_the_lines(seed):
    made = random_lines(seed, 9)
    bundle = Bundle.of(made)
    which, s = asked(seed, bundle)
    assert bundle.at(which, s) == pytest.approx(np.array([made[k].at(t) for k, t in zip(which, s, strict=True)]), abs=1e-9)


@SEEDS
def test_directions_are_those_of_the_lines(seed):
    made = random_lines(seed, 9)
    bundle = Bundle.of(made)
    which, s = asked(seed, bundle)
    s = np.clip(s, 0, bundle.length[which])
    twin = np.array([made[k].direction(t, 1.5) for k, t in zip(which, s, strict=True)])
    assert bundle.direction(which, s, 1.5) == pytest.approx(twin, abs=1e-7)


@SEEDS
def test_leaving_goes_from_each_end_into_the_line(seed):
    made = random_lines(seed, 9)
    bundle = Bundle.of(made)
    reach = 0.3 * bundle.length
    twin = [unit(one.at(s) - one.points[end]) for one, r in zip(made, reach, strict=True) for end, s in ((0, r), (-1, one.length - r))]
    assert bundle.leaving(reach) == pytest.approx(np.array(twin), abs=1e-9)


def test_the_point_after_a_place_ends_its_piece():
    bundle = Bundle.of(lines([(0, 0), (1, 0), (3, 0)], [(0, 5), (2, 5), (2, 9)]))
    assert bundle.after(np.array([0, 0, 0, 0, 1, 1, 1]), np.array([-1.0, 0.5, 1.5, 9.0, 0.0, 2.5, 6.0])).tolist() == [1, 1, 2, 2, 4, 5, 5]


def test_run_grows_from_line_to_line():
    bundle = Bundle.of(random_lines(0, 6))
    assert (np.diff(bundle.run) > 0).all()


def test_a_line_of_pieces_a_thousand_times_unlike_is_measured_all_the_same():
    bundle = Bundle.of(lines([(0, 0), (1e-3, 0), (1e3, 0)], [(0, 1), (5, 1)]))
    assert bundle.at(np.array([0, 1]), np.array([5e-4, 2.5])) == pytest.approx(np.array([(5e-4, 0), (2.5, 1)]))


def test_times_and_widths_are_one_a_line():
    bundle = Bundle.of([line([(0, 0), (0, 9), (0, 10)], width=[1.0, 2.0, 9.0], begun=40.0), line([(0, 5), (4, 7)])])
    assert bundle.width.tolist()[:1] == [2.0] and np.isnan(bundle.width[1])
    assert bundle.time.tolist()[:1] == [40.0] and np.isnan(bundle.time[1])


def test_widths_that_say_nothing_are_left_out_of_the_middle_one():
    assert typical_width(np.array([np.nan, 3.0, 1.0, np.nan, 2.0])) == 2.0
    assert np.isnan(typical_width(np.array([np.nan])))


def test_a_width_of_nothing_says_nothing():
    assert typical_width(np.array([0.0, 0.0, 3.0])) == 3.0 and taper(line([(0, 0), (0, 9), (0, 10)], width=[0.0, 1.0, 2.0])) == 0.0


def test_taper_is_the_log_ratio_of_the_widths_toward_both_ends():
    y = np.linspace(0, 10, 101)
    one = line(np.stack([0 * y, y], 1), width=np.where(y < 5, 4.0, 1.0))
    assert taper(one) == pytest.approx(-np.log(4)) and taper(one.reversed()) == pytest.approx(np.log(4))
    assert Bundle.of([one, one.reversed()]).thicker_away() == pytest.approx(np.log(4) * np.array([-1, 1, 1, -1]))


def test_a_light_touch_at_the_very_ends_is_no_taper():
    y = np.linspace(0, 10, 101)
    pressed = line(np.stack([0 * y, y], 1), width=np.where((y < 0.4) | (y > 9.7), 0.5, 3.0))
    assert taper(pressed) == pytest.approx(0.0)


def test_without_widths_there_is_no_taper():
    assert taper(line([(0, 0), (0, 10)])) == 0.0
