import numpy as np
import pytest
import shapely
from little_lines import TRUNK, grown, hung, line, lines, random_lines

from sketchtree.axes import NULL
from sketchtree.sketch.joining.attach import attach
from sketchtree.sketch.joining.cleaning import clean
from sketchtree.sketch.joining.joints import CROSSES, OVERSHOOT, STRAIGHT_ON, beyond, limbs_of


def joined(*strokes, parent, end=None, s=None):
    """The limbs of lines that hang so."""
    return limbs_of(lines(*strokes), hung(parent, end, s))


def turned(degrees, foot=(0, 100), length=30):
    """A line that leaves the vertical by so much."""
    turn = np.radians(degrees)
    return [foot, (foot[0] + length * np.sin(turn), foot[1] + length * np.cos(turn))]


@pytest.mark.parametrize("end", [0, 1])
def test_every_line_is_turned_foot_first(end):
    stroke = [(0, 50), (20, 60), (40, 80)]
    stem, branch = joined(TRUNK, stroke[::-1] if end else stroke, parent=[NULL, 0], end=[0, end], s=[0, 50])
    assert stem.parent == NULL and branch.parent == 0 and branch.s == 50
    assert branch.points.tolist() == [list(p) for p in stroke]


def test_a_stem_drawn_from_the_top_grows_from_the_ground():
    (stem,) = joined(TRUNK[::-1], parent=[NULL], end=[1])
    assert stem.points.tolist() == [[0, 0], [0, 100]] and stem.along.tolist() == [0, 100]


@pytest.mark.parametrize("past", [0.2, 1.0, 1.7])
def test_an_overshoot_is_cut_where_it_crosses(past):
    _, branch = joined(TRUNK, [(-past, 50 - past), (40, 90)], parent=[NULL, 0], s=[0, 50 - past])
    assert branch.points[0] == pytest.approx([0, 50]) and branch.s == pytest.approx(50)


def test_of_two_crossings_the_last_is_the_junction():
    _, branch = joined(TRUNK, [(0.5, 48), (-0.5, 49), (0.5, 50), (40, 80)], parent=[NULL, 0], s=[0, 48])
    assert branch.points[0] == pytest.approx([0, 49.5]) and branch.s == pytest.approx(49.5)


def test_a_foot_farther_past_than_an_overshoot_reaches_is_not_cut():
    past = 100 * OVERSHOOT * 1.1
    _, branch = joined(TRUNK, [(-past, 50), (40, 50)], parent=[NULL, 0], s=[0, 50])
    assert branch.points.tolist() == [[0, 50], [-past, 50], [40, 50]] and branch.s == 50


def test_lines_that_run_side_by_side_are_not_cut_where_they_touch():
    slant = 0.8 * CROSSES
    foot = np.array([-np.sin(slant), 50 - np.cos(slant)])
    _, branch = joined(TRUNK, [foot, foot * (-1, 1) + (0, 2 * np.cos(slant)), (40, 90)], parent=[NULL, 0], s=[0, 49])
    assert branch.points[0].tolist() == [0, 49] and branch.s == 49


def test_what_hangs_on_an_overshot_line_counts_from_the_cut():
    _, branch, twig = joined(TRUNK, [(-1, 50), (40, 50)], [(20, 50), (25, 70)], parent=[NULL, 0, 1], s=[0, 50, 21])
    assert branch.points[0] == pytest.approx([0, 50]) and twig.s == pytest.approx(20)


@pytest.mark.parametrize("degrees", [0, 40, np.degrees(STRAIGHT_ON) - 1])
def test_a_line_from_a_tip_carries_it_on(degrees):
    (limb,) = joined(TRUNK, turned(degrees), parent=[NULL, 0], s=[0, 100])
    assert limb.lines == [0, 1] and limb.joins == [100] and limb.along[-1] == pytest.approx(130)
    assert [limb.line_at(s) for s in (0, 99, 100, 101, 130)] == [0, 0, 0, 1, 1]
    assert limb.row.tolist() == [0, 0, 1]


def test_a_line_that_leaves_a_tip_at_a_wide_angle_is_a_lateral_there():
    stem, branch = joined(TRUNK, turned(np.degrees(STRAIGHT_ON) + 1), parent=[NULL, 0], s=[0, 100])
    assert stem.lines == [0] and branch.parent == 0 and branch.s == 100


@pytest.mark.parametrize("order", [(20, -10), (-10, 20)])
def test_of_several_the_one_that_bends_least_carries_on(order):
    limbs = joined(TRUNK, *[turned(degrees) for degrees in order], parent=[NULL, 0, 0], s=[0, 100, 100])
    assert len(limbs) == 2 and limbs[0].lines == [0, 1 + order.index(-10)]
    assert limbs[1].parent == 0 and limbs[1].s == pytest.approx(100)


def test_a_foot_near_a_tip_is_at_the_tip():
    (limb,) = joined(TRUNK, turned(5, foot=(0, 99.6)), parent=[NULL, 0], s=[0, 99.6])
    assert limb.lines == [0, 1] and limb.joins == [100]


def test_a_chain_of_three_is_one_limb_and_knows_where_each_begins():
    (limb,) = joined([(0, 0), (0, 40)], [(0, 40), (0, 70)], [(0, 70), (0, 100)], parent=[NULL, 0, 1], s=[0, 40, 30])
    assert limb.lines == [0, 1, 2] and limb.joins == [40, 70] and limb.along[-1] == 100


def test_what_hangs_on_a_line_further_up_a_limb_counts_from_the_limbs_foot():
    limbs = joined([(0, 0), (0, 40)], [(0, 40), (0, 100)], [(0, 60), (30, 80)], parent=[NULL, 0, 1], s=[0, 40, 20])
    assert limbs[1].parent == 0 and limbs[1].s == pytest.approx(60)


def test_a_line_from_the_foot_of_a_branch_is_its_sibling():
    limbs = joined(TRUNK, [(0, 50), (40, 80)], [(0, 50), (-40, 80)], parent=[NULL, 0, 1], s=[0, 50, 0])
    assert [limb.parent for limb in limbs] == [NULL, 0, 0] and [limb.s for limb in limbs[1:]] == [50, 50]


def test_siblings_of_siblings_hang_on_the_same_parent():
    limbs = joined(TRUNK, *[[(0, 50), (40, y)] for y in (60, 80, 95)], parent=[NULL, 0, 1, 2], s=[0, 50, 0, 0.1])
    assert [limb.parent for limb in limbs] == [NULL, 0, 0, 0]


def test_what_rises_from_the_foot_of_a_stem_is_a_second_stem():
    limbs = joined(TRUNK, [(0, 0), (50, 80)], parent=[NULL, 0])
    assert [limb.parent for limb in limbs] == [NULL, NULL]


def test_what_runs_level_from_the_foot_of_a_stem_is_its_branch():
    limbs = joined(TRUNK, [(0, 0), (50, 3)], parent=[NULL, 0])
    assert [limb.parent for limb in limbs] == [NULL, 0] and limbs[1].s == 0


@pytest.mark.parametrize(("slack", "kept"), [(0.5, 0), (1.5, 2)])
def test_to_close_a_gap_first_points_are_dropped_to_bridge_one_none(slack, kept):
    one = line([(1, 0), (1.5, 0), (3, 0), (9, 0)])
    assert beyond(one.points, one.along, np.zeros(2), slack) == kept


def test_closing_a_gap_keeps_the_tip():
    one = line([(1, 0), (1.5, 0)])
    assert beyond(one.points, one.along, np.zeros(2), 2.0) == 1


@pytest.mark.parametrize(("ink", "closed"), [(6.0, True), (1.0, False)])
def test_a_gap_within_the_ink_of_the_parent_is_closed_a_wider_one_bridged(ink, closed):
    strokes = [line(TRUNK, width=ink), line([(5, 50), (20, 60), (40, 80)], "s1", 1, width=1.0)]
    branch = limbs_of(strokes, hung([NULL, 0], s=[0, 50]))[1]
    assert branch.points.tolist() == [[0, 50], *([] if closed else [[5, 50]]), [20, 60], [40, 80]]


@pytest.mark.parametrize(("twig", "parent_s"), [([(30, 50), (40, 80)], 20), ([(12, 50), (20, 80)], 2)])
def test_lengths_along_a_bridged_limb_count_from_its_junction(twig, parent_s):
    limbs = joined(TRUNK, [(10, 50), (50, 50)], twig, parent=[NULL, 0, 1], s=[0, 50, parent_s])
    assert limbs[2].s == parent_s + 10 and limbs[1].at(limbs[2].s).tolist() == list(twig[0])


def test_lengths_along_a_closed_limb_count_from_its_junction():
    first = np.hypot(4, 0.5)
    limbs = joined(TRUNK, [(1, 50), (5, 50.5), (50, 50.5)], [(30, 50.5), (40, 80)], parent=[NULL, 0, 1], s=[0, 50, first + 25])
    assert limbs[1].points.tolist() == [[0, 50], [5, 50.5], [50, 50.5]]
    assert limbs[1].at(limbs[2].s) == pytest.approx([30, 50.5])


def test_lengths_beyond_a_limbs_ends_are_its_ends():
    (stem,) = joined([(0, 0), (0, 40), (0, 100)], parent=[NULL])
    assert [stem.at(s).tolist() for s in (-5, 0, 20, 40, 100, 105)] == [[0, 0], [0, 0], [0, 20], [0, 40], [0, 100], [0, 100]]


def test_crossings_are_kept_apart():
    limbs, table, _ = grown(TRUNK, [(0, 20), (60, 80)], [(0, 80), (70, 50)])
    crossing = shapely.LineString([(0, 20), (60, 80)]).intersection(shapely.LineString([(0, 80), (70, 50)]))
    assert [limb.parent for limb in limbs] == [NULL, 0, 0]
    assert np.hypot(*(table["xy"] - [crossing.x, crossing.y]).T).min() > 10


@pytest.mark.parametrize("seed", range(8))
def test_parents_come_before_children_and_every_line_is_in_one_limb(seed):
    made = clean(random_lines(seed, 14)).lines
    limbs = limbs_of(made, attach(made))
    assert all(limb.parent < k for k, limb in enumerate(limbs))
    assert sorted(k for limb in limbs for k in limb.lines) == list(range(len(made)))
    for limb in limbs:
        assert limb.parent == NULL or 0 <= limb.s <= limbs[limb.parent].along[-1] + 1e-9
        assert len(limb.points) == len(limb.width) == len(limb.row) and len(limb.joins) == len(limb.lines) - 1
