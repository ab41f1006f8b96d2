import numpy as np
import pytest
from little_lines import TRUNK, line, lines, random_lines, read

from sketchtree.errors import SketchError
from sketchtree.sketch.joining import cleaning
from sketchtree.sketch.joining.cleaning import AGAIN_OVER, as_line, clean, without_doubles
from sketchtree.sketch.joining.folding import DOT

LIMB = [(0, 40), (20, 55), (45, 60)]


def cleaned(*strokes):
    return clean(lines(*strokes))


def kept(*strokes):
    return [one.id for one in cleaned(*strokes).lines]


def arc(radius, start, end, count=30, center=(0, 0)):
    turn = np.radians(np.linspace(start, end, count))
    return np.array(center) + radius * np.stack([np.cos(turn), np.sin(turn)], 1)


def test_of_doubled_points_the_first_is_kept():
    points = np.array([(0, 0), (0, 0), (0, 5), (0, 5 + 1e-12), (0, 5), (0, 9)], float)
    assert without_doubles(points, 10.0).tolist() == [True, False, True, False, False, True]


def test_points_that_creep_are_no_doubles_for_long():
    points = np.stack([np.zeros(50), np.arange(50) * 4e-10], 1)
    mask = without_doubles(points, 1.0)
    assert 10 < mask.sum() < 50 and (np.diff(points[mask, 1]) > 1e-9).all()


def test_a_stroke_of_one_point_is_no_line():
    assert as_line(0, "a", np.array([(3.0, 4.0)] * 5), np.nan) is None


def test_a_line_keeps_the_widths_of_the_points_it_keeps_and_when_it_was_begun():
    one = as_line(7, "a", np.array([(0, 0), (0, 0), (0, 5.0)]), np.array([1.0, 2.0, 3.0]), 12.0)
    assert (one.row, one.id, one.begun) == (7, "a", 12.0) and one.width.tolist() == [1.0, 3.0] and len(one.points) == 2


def test_dots_are_left_out_and_named():
    small = 0.9 * DOT * 100
    found = cleaned(TRUNK, [(10, 50), (10 + small, 50)], LIMB)
    assert found.dots == ("s1",) and {one.id for one in found.lines} == {"s0", "s2"}


def test_strokes_too_far_apart_are_refused_and_the_farthest_is_named():
    with pytest.raises(SketchError, match="so far from the others that all strokes are dots beside that distance") as error:
        cleaned([(0, 0), (0, 1)], [(1, 0), (1, 1)], [(1e6, 0), (1e6, 1)])
    assert error.value.stroke == "s2" and "move it back" in error.value.remedy


def test_a_stroke_that_goes_back_over_itself_is_unfolded():
    found = cleaned([(0, 0), (0, 50), (0, 100), (0.2, 60), (0, 20)], LIMB)
    assert [one.id for one in found.lines] == ["s0", "s1"] and found.lines[0].length == pytest.approx(100, abs=0.1)


@pytest.mark.parametrize("again", [np.array(LIMB) + (0.2, 0.1), np.array(LIMB)[::-1] + (0.1, -0.2), LIMB, [(0, 40), (20, 55), (40, 58.9)]])
def test_a_repeated_stroke_is_merged_and_reported(again):
    found = cleaned(TRUNK, LIMB, again)
    assert [(one.id, owner, why) for one, owner, why in found.merged] in ([("s2", 1, AGAIN_OVER)], [("s1", 2, AGAIN_OVER)])
    assert len(found.lines) == 2


def test_in_the_report_a_repeated_stroke_hangs_on_what_it_repeats():
    graph = read(TRUNK, LIMB, np.array(LIMB) + (0.1, 0.1))
    one = next(a for a in graph.attachments if a.reason == AGAIN_OVER)
    assert {one.stroke, one.parent} == {"s1", "s2"} and "1 stroke(s) drawn over others were merged with them" in graph.warnings[0]


def test_a_piece_drawn_again_in_the_ink_of_a_limb_is_merged():
    assert kept(TRUNK, [(0.05, 30), (0.05, 50)]) == ["s0"]


def test_a_stroke_as_long_beside_another_is_a_branch_of_its_own():
    assert len(kept(TRUNK, LIMB, np.array(LIMB) + (0, 3))) == 3


@pytest.mark.parametrize("degrees", [10, 20, 40])
@pytest.mark.parametrize("length", [1.5, 4.0, 20.0])
def test_a_twig_along_a_limb_is_not_merged(degrees, length):
    turn = np.radians(90 - degrees)
    twig = [(0, 50), (0.5 * length * np.cos(turn), 50 + 0.5 * length * np.sin(turn)), (length * np.cos(turn), 50 + length * np.sin(turn))]
    assert set(kept(TRUNK, twig)) == {"s0", "s1"}


def test_a_branch_that_leaves_late_is_not_merged():
    assert len(kept(TRUNK, [(0.1, 30), (0.1, 60), (8, 75)])) == 2


def test_what_is_merged_is_merged_with_a_line_that_stays():
    found = cleaned(TRUNK, LIMB, *[np.array(LIMB) + 0.1 * k for k in range(1, 6)])
    rows = {one.row for one in found.lines}
    assert len(found.lines) + len(found.merged) == 7 and all(owner in rows for _, owner, _ in found.merged)


@pytest.mark.parametrize("seed", range(6))
def test_neither_order_nor_direction_changes_the_lines(seed):
    made = random_lines(seed, 10)
    rng = np.random.default_rng(seed)
    other = [made[k].reversed() if rng.random() < 0.5 else made[k] for k in rng.permutation(10)]
    first, second = clean(made), clean(other)
    assert [one.points.tolist() for one in first.lines] == [one.points.tolist() for one in second.lines]
    assert [one.id for one in first.lines] == [one.id for one in second.lines] and set(first.dots) == set(second.dots)


def test_lines_come_longest_first_and_from_their_lower_end():
    found = cleaned([(0, 100), (0, 0)], [(30, 70), (0, 50)], [(-60, 90), (0, 60)]).lines
    assert [one.id for one in found] == ["s0", "s2", "s1"] and all(one.points[0, 1] < one.points[-1, 1] for one in found)


@pytest.mark.parametrize("batch", [1, 2, 3, 7])
def test_lines_compared_batch_after_batch_find_the_owners_they_find_all_at_once(batch, monkeypatch):
    rng = np.random.default_rng(batch)
    strokes = [TRUNK, *(np.array(LIMB) + rng.normal(0, 0.2, 2) + (0, 20 * (k % 3)) for k in range(12))]
    whole = cleaned(*strokes)
    monkeypatch.setattr(cleaning, "BATCH", batch)
    found = cleaned(*strokes)
    assert [(one.id, owner) for one, owner, _ in found.merged] == [(one.id, owner) for one, owner, _ in whole.merged]
    assert [one.id for one in found.lines] == [one.id for one in whole.lines] and len(whole.merged) >= 6


def test_thousands_of_strokes_nearly_over_one_another_are_one_limb_and_each_is_accounted_for():
    rng = np.random.default_rng(0)
    graph = read(TRUNK, *(np.array(LIMB) + rng.normal(0, 0.02, (3, 2)) for _ in range(6000)))
    assert len(graph.limb_id) == 2 and len(graph.attachments) == 6001
    assert sum(a.reason == AGAIN_OVER for a in graph.attachments) == 5999


def test_a_trembling_stroke_is_stilled():
    y = np.arange(0, 100, 0.5)
    shaky = np.stack([0.3 * (-1.0) ** np.arange(len(y)), y], 1)
    assert cleaned(shaky).lines[0].length < 0.75 * line(shaky).length


@pytest.mark.parametrize("scale", [1e-6, 1e6])
def test_scale_changes_nothing(scale):
    strokes = [TRUNK, LIMB, np.array(LIMB) + (0.2, 0.1), [(0, 0), (0, 40), (0, 20)], [(5, 5), (5.2, 5)], arc(10, 0, 350, center=(20, 80))]
    plain, other = cleaned(*strokes), cleaned(*[np.array(points) * scale for points in strokes])
    assert [one.id for one in plain.lines] == [one.id for one in other.lines] and plain.dots == other.dots
    assert [owner for _, owner, _ in plain.merged] == [owner for _, owner, _ in other.merged]
