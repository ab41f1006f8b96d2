"""The lines of the report: where every stroke hangs, how far it was moved, what else was considered, and why."""

import numpy as np
import pytest
from little_lines import TRUNK, parent_of, random_lines, read

from sketchtree.sketch.graph import DOUBT, Attachment
from sketchtree.sketch.joining.attach import FORBIDDEN

BRANCH = [(0, 50), (40, 80)]


def lines_of(graph):
    return {a.stroke: a for a in graph.attachments}


def test_every_stroke_has_a_line_in_the_order_of_the_file():
    graph = read(BRANCH, TRUNK, [(20, 65), (30, 95)])
    assert [a.stroke for a in graph.attachments] == ["s0", "s1", "s2"]
    assert parent_of(graph) == {"s0": "s1", "s1": None, "s2": "s0"}


@pytest.mark.parametrize("turned", [False, True])
def test_the_point_is_the_junction_and_the_gap_how_far_the_foot_was_moved(turned):
    short = [(0.9, 50), (40, 80)]
    one = lines_of(read(TRUNK, short[::-1] if turned else short))["s1"]
    assert one.point == pytest.approx((0, 50)) and one.gap == pytest.approx(0.9)


def test_a_foot_past_its_parent_was_moved_back_by_what_it_overshot():
    one = lines_of(read(TRUNK, [(-1, 50), (40, 50), (60, 80)]))["s1"]
    assert one.point == pytest.approx((0, 50)) and one.gap == pytest.approx(1.0)


def test_a_stem_hangs_on_nothing_at_its_foot():
    one = lines_of(read(TRUNK[::-1], BRANCH))["s0"]
    assert (one.parent, one.point, one.gap, one.reason) == (None, (0.0, 0.0), 0.0, "stands on the ground")
    assert 0 <= one.cost < FORBIDDEN / 100


@pytest.mark.parametrize("seed", range(6))
def test_alternatives_are_other_parents_cheapest_first(seed):
    graph = read(*[one.points for one in random_lines(seed, 12)])
    for a in graph.attachments:
        names, costs = [name for name, _ in a.alternatives], [cost for _, cost in a.alternatives]
        assert costs == sorted(costs) and len(names) == len(set(names)) <= 2
        assert a.stroke not in names and set(names) <= set(graph.stroke_ids)


def alternatives(*more):
    return tuple((f"s{k}", 5.0 + extra) for k, extra in enumerate(more))


@pytest.mark.parametrize(("more", "doubtful"), [((), False), ((0.99 * DOUBT,), True), ((DOUBT,), False), ((2.0, 3.0), False), ((-1.0,), True)])
def test_doubtful_if_and_only_if_the_next_best_costs_less_than_one_more(more, doubtful):
    assert Attachment("s", "p", (0, 0), 0.0, 5.0, alternatives(*more), "").doubtful == doubtful


@pytest.mark.parametrize(("x", "doubtful"), [(-30, True), (-27, False)])
def test_a_foot_midway_between_two_limbs_is_doubtful_and_names_the_other(x, doubtful):
    twig = lines_of(read(TRUNK, [(0, 40), (-60, 70)], [(0, 46), (-60, 76)], [(x, 58), (x - 2, 90)]))["s3"]
    assert (twig.parent, twig.alternatives[0][0], twig.doubtful) == ("s2", "s1", doubtful)


def test_reasons_say_what_decided():
    graph = read(TRUNK, BRANCH, [(0, 100), (5, 130)], [(2, 70), (40, 100)], [(60, 20), (90, 30)])
    reason = {a.stroke: a.reason for a in graph.attachments}
    assert reason["s0"] == "stands on the ground" and reason["s1"] == "a lateral"
    assert reason["s2"] == "carries that stroke on from its tip"
    assert reason["s3"] == "a lateral, nearest and at a likely angle"
    assert reason["s4"] == "a lateral, far off: the most likely of its neighbours"


def test_a_start_far_from_any_other_is_warned_of():
    warnings = read(TRUNK, [(60, 70), (90, 90)]).warnings
    assert warnings == ("Stroke s1 starts 60 % of the drawing's height away from stroke s0, the likeliest it could grow from.",)


def test_more_than_five_far_starts_are_counted():
    turn = np.linspace(0.2, np.pi - 0.2, 8)
    strokes = [[(60 * np.cos(a), 50 + 60 * np.sin(a)), (63 * np.cos(a), 50 + 63 * np.sin(a))] for a in turn]
    warnings = read(TRUNK, *strokes).warnings
    named = [w for w in warnings if "% of the drawing's height away" in w]
    rest = [w for w in warnings if w.endswith("more strokes start far from any other.")]
    assert len(named) == 5 and len(rest) == 1 and rest[0].split()[0].isdigit()


def test_dots_are_warned_of():
    warnings = read(TRUNK, BRANCH, [(30, 30), (30.2, 30)]).warnings
    assert warnings == ("1 dot(s) smaller than 0.5 % of the drawing were left out (strokes s2).",)


def test_many_are_named_by_their_first_five():
    warnings = read(TRUNK, BRANCH, *[[(30 + k, 30), (30.2 + k, 30)] for k in range(7)]).warnings
    assert "7 dot(s)" in warnings[0] and "(strokes s2, s3, s4, s5, s6, …)" in warnings[0]
