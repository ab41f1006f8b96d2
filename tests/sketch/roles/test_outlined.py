import numpy as np
import pytest
from drawn import graph_of

from sketchtree.sketch.joining.cleaning import as_line
from sketchtree.sketch.roles import outlined
from sketchtree.sketch.roles.outlined import limbs_of_outlines


def frond(tip, foot=(0.0, 100.0), width=8.0, rise=25.0):
    """Both sides of an arching leaf: out along one, back along the other."""
    foot, tip = np.array(foot), np.array(tip)
    t = np.linspace(0, 1, 20)[:, None]
    middle = foot + (tip - foot) * t + np.c_[np.zeros(20), rise * np.sin(np.pi * t[:, 0])]
    half = np.c_[np.zeros(20), 0.5 * width * np.sin(np.pi * (0.04 + 0.96 * t[:, 0])) ** 0.5]
    return middle + half, middle - half


def lines(*points):
    return [as_line(k, f"s{k}", np.asarray(line, float), np.nan) for k, line in enumerate(points)]


def test_a_line_out_and_back_is_one_limb():
    upper, lower = frond((70, 80))
    found = limbs_of_outlines(lines([(0, 0), (0, 100)], np.vstack([upper, lower[::-1]])), [False, False])
    (trunk, limb) = found.lines
    assert trunk.length == pytest.approx(100)
    ends = limb.points[[0, -1]][np.argsort(limb.points[[0, -1], 0])]
    assert ends[0] == pytest.approx((0, 100), abs=5) and ends[1] == pytest.approx((70, 80), abs=3)


def test_an_outline_that_comes_back_to_its_start_half_way_is_two_limbs():
    right, left = frond((70, 80)), frond((-70, 80))
    both = np.vstack([right[0], right[1][::-1], left[0], left[1][::-1]])
    graph = graph_of([(0, 0), (0, 100)], both)
    tips = graph.xy[graph.limb_tip]
    assert {1, -1} == set(np.sign(tips[np.abs(tips[:, 0]) > 50, 0].round()))
    feet = graph.xy[graph.parent[graph.limb_first]]
    assert all(np.hypot(*(foot - (0, 100))) < 12 or foot[1] < 1 for foot in feet)


def test_pairs_of_sides_are_limbs_where_much_is_drawn_so():
    sides = [line for tip in ((70, 80), (-70, 80), (45, 125)) for line in frond(tip)]
    found = limbs_of_outlines(lines([(0, 0), (0, 100)], *sides), [False] * 7)
    assert len(found.lines) == 4 and len(found.sides) == 3


def test_one_pair_of_limbs_whose_tips_meet_stays_two():
    upper, lower = frond((70, 80), width=14)
    others = [[(0, 0), (0, 100)], [(0, 40), (-60, 90)], [(0, 60), (-40, 110)], [(0, 30), (60, 50)]]
    assert len(limbs_of_outlines(lines(*others, upper, lower), [False] * 6).lines) == 6


def test_a_limb_gone_over_twice_encloses_nothing_and_stays():
    there = np.c_[np.linspace(0, 60, 20), np.linspace(50, 90, 20)]
    (_, limb) = limbs_of_outlines(lines([(0, 0), (0, 100)], np.vstack([there, there[::-1] + 0.2])), [False, False]).lines
    assert limb.length > 120


def test_what_lies_inside_a_closed_limb_is_bark():
    trunk = [(-6, 0), (6, 0), (5, 100), (-5, 100)]
    found = limbs_of_outlines(lines(trunk, [(0, 20), (0, 50)], [(0, 98), (30, 130)]), [True, False, False])
    assert [line.id for line in found.bark] == ["s1"] and {line.id for line in found.lines} == {"s0", "s2"}


def test_nothing_comes_of_nothing():
    assert limbs_of_outlines([], []).lines == []


def test_looking_for_crowds_first_pairs_the_same_tips(monkeypatch):
    fronds = [side for k in range(8) for side in frond((70 * np.cos(k), 100 + 70 * np.sin(k)))]
    crowd = [[(90, 10), (95, 13 + 1e-3 * k)] for k in range(12)]
    drawn = lines([(0, 0), (0, 100)], *fronds, *crowd)
    plain = limbs_of_outlines(drawn, [False] * len(drawn))
    monkeypatch.setattr(outlined, "FEW", 0)
    found = limbs_of_outlines(drawn, [False] * len(drawn))
    assert len(found.sides) == 6 and [(a.id, b.id) for a, b in found.sides] == [(a.id, b.id) for a, b in plain.sides]


TRUNK = [(0, 0), (0, 100)]
NEXT = [(15, 108), (30, 104), (45, 85), (50, 60)]


@pytest.mark.parametrize("turned", [False, True])
def test_an_outline_from_which_the_pen_goes_on_is_a_limb_and_the_next(turned):
    upper, lower = frond((-80, 80), width=14.0)
    stroke = np.vstack([upper, lower[::-1], NEXT])
    found = limbs_of_outlines(lines(TRUNK, stroke[::-1] if turned else stroke), [False, False])
    assert [one.id for one in found.lines] == ["s0", "s1", "s1"]
    ends = {tuple(end) for one in found.lines[1:] for end in one.points[[0, -1]].round(-1).tolist()}
    assert ends == {(-80.0, 80.0), (0.0, 100.0), (50.0, 60.0)}


def test_fronds_of_one_stroke_hang_side_by_side_at_the_head():
    upper, lower = frond((-80, 80), width=14.0)
    graph = graph_of(TRUNK, np.vstack([upper, lower[::-1], NEXT]))
    tips = graph.xy[graph.limb_tip]
    assert {tuple(tip) for tip in tips.round(-1).tolist()} >= {(-80.0, 80.0), (50.0, 60.0)} and len(tips) <= 3


@pytest.mark.parametrize("width", [0.0, 2.0])
def test_a_line_gone_over_from_which_the_pen_goes_on_is_no_outline(width):
    upper, lower = frond((-80, 80), width=width)
    drawn = lines(TRUNK, np.vstack([upper, lower[::-1], NEXT]))
    assert limbs_of_outlines(drawn, [False, False]).lines == drawn


def test_a_limb_that_curls_past_its_foot_stays_one_line():
    turn = np.radians(np.linspace(90, 450, 40))
    curl = np.c_[30 * np.cos(turn), 70 + 30 * np.sin(turn)]
    drawn = lines(TRUNK, np.vstack([curl, [(20, 105), (60, 115)]]))
    assert limbs_of_outlines(drawn, [False, False]).lines == drawn
