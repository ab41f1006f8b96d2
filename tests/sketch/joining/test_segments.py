import numpy as np
import pytest
import shapely
from little_lines import TRUNK, grown, line, random_lines

from sketchtree.axes import NULL
from sketchtree.sketch.joining.attach import attach
from sketchtree.sketch.joining.cleaning import clean
from sketchtree.sketch.joining.joints import Limb, limbs_of
from sketchtree.sketch.joining.lines import extent
from sketchtree.sketch.joining.segments import BEND, MERGE, ONE_TREE, columns

SEEDS = pytest.mark.parametrize("seed", range(8))


def curve(table, row):
    inner = table["curve_points"][table["curve_start"][row] : table["curve_start"][row + 1]]
    return np.vstack([table["xy"][table["parent"][row]], inner, table["xy"][row]])


def arc(turn, radius=50.0, count=60):
    """A limb that turns by so much, from the origin upward."""
    angle = np.linspace(0, turn, count)
    return radius * np.stack([1 - np.cos(angle), np.sin(angle)], 1)


def only(points, height=None):
    """(columns, rows) of one stem."""
    points = np.array(points, float)
    limb = Limb([0], points, np.full(len(points), np.nan), np.zeros(len(points), int))
    return columns([limb], height or float(np.ptp(points, axis=0).max()))


def table_of(made):
    cleaned = clean(made).lines
    limbs = limbs_of(cleaned, attach(cleaned))
    table, rows = columns(limbs, extent(cleaned))
    return cleaned, limbs, table, rows


def chords_are_near(table, height):
    for row in np.flatnonzero(table["parent"] != NULL):
        points = curve(table, row)
        chord = shapely.LineString(points[[0, -1]])
        yield float(shapely.distance(shapely.points(points), chord).max()) / height


def test_a_straight_stem_is_a_base_and_one_segment():
    table, rows = only([(0, 0), (0, 40), (0, 100)])
    assert table["parent"].tolist() == [NULL, 0] and table["xy"].tolist() == [[0, 0], [0, 100]]
    assert table["curve_points"].tolist() == [[0, 40]] and table["curve_start"].tolist() == [0, 0, 1]
    assert rows.first == [1] and rows.foot == [0]


@pytest.mark.parametrize("turn", [0.5, 2.0, 3.0, 5.5])
def test_a_curved_stroke_splits_until_no_point_is_farther_from_its_segment_than_bend(turn):
    points = arc(turn)
    height = float(np.ptp(points, axis=0).max())
    table, _ = only(points)
    near = list(chords_are_near(table, height))
    assert max(near) <= BEND + 1e-12 and len(near) > 1
    assert len(near) <= 2 * np.ceil(turn / (2 * np.arccos(1 - BEND * height / 50.0)))  # no more than twice what is needed


@SEEDS
def test_in_any_drawing_points_lie_on_their_segments_but_next_to_a_junction(seed):
    made = random_lines(seed, 12)
    _, _, table, _ = table_of(made)
    assert max(chords_are_near(table, extent(made))) <= BEND + MERGE


@pytest.mark.parametrize("turn", [0.5, 3.0, 5.5])
def test_between_its_ends_the_drawn_line_is_kept_exactly(turn):
    points = arc(turn)
    table, _ = only(points)
    kept = np.vstack([table["xy"][:1]] + [curve(table, row)[1:] for row in range(1, len(table["xy"]))])
    assert kept.tolist() == points.tolist()


def test_a_sharp_bend_is_a_node_at_its_corner():
    table, _ = only([(0, 0), (0, 50), (50, 50)])
    assert table["xy"].tolist() == [[0, 0], [0, 50], [50, 50]]


@SEEDS
def test_no_drawn_point_is_moved_but_at_the_feet(seed):
    made = random_lines(seed, 12)
    cleaned, limbs, table, rows = table_of(made)
    shapes = [shapely.LineString(curve(table, row)) for row in np.flatnonzero(table["parent"] != NULL)]
    read = shapely.union_all(shapes)
    for limb in limbs:
        beyond = limb.along > 2.5
        assert shapely.distance(shapely.points(limb.points[beyond]), read).max(initial=0.0) < 1e-9


@SEEDS
def test_parents_stand_first_and_every_limb_is_a_chain(seed):
    cleaned, limbs, table, rows = table_of(random_lines(seed, 12))
    parent, count = table["parent"], len(table["parent"])
    assert (parent < np.arange(count)).all() and all(len(table[name]) == count for name in table if name not in ("curve_points", "curve_start"))
    for k in range(len(limbs)):
        own = np.flatnonzero((table["limb"] == k) & (parent != NULL))
        assert own.tolist() == list(range(rows.first[k], rows.first[k] + len(rows.s[k])))
        assert parent[own[1:]].tolist() == own[:-1].tolist() and parent[own[0]] == rows.foot[k]
    assert (parent == NULL).sum() == sum(limb.parent == NULL for limb in limbs)


@SEEDS
def test_no_segment_is_without_length(seed):
    _, _, table, _ = table_of(random_lines(seed, 20))
    inner = table["parent"] != NULL
    assert (np.hypot(*(table["xy"][inner] - table["xy"][table["parent"][inner]]).T) > 0).all()


def test_a_junction_is_a_node_that_both_limbs_share():
    _, table, rows = grown(TRUNK, [(0, 50), (40, 80)])
    assert table["xy"][rows.foot[1]].tolist() == [0, 50] and table["parent"].tolist() == [NULL, 0, 1, 1]


@pytest.mark.parametrize(("apart", "nodes"), [(0.9 * MERGE * 100, 1), (1.1 * MERGE * 100, 2)])
def test_junctions_closer_than_merge_are_one_at_their_mean(apart, nodes):
    low, high = 50 - apart / 2, 50 + apart / 2
    _, table, _ = grown(TRUNK, [(0, low), (40, 70)], [(0, high), (-40, 75)])
    between = sorted(y for x, y in table["xy"].tolist() if x == 0 and 0 < y < 100)
    assert between == pytest.approx([50] if nodes == 1 else [low, high])


def test_a_junction_next_to_a_tip_is_the_tip():
    limbs, table, rows = grown(TRUNK, [(0, 99.8), (40, 95)])
    assert len(limbs) == 2 and table["xy"][rows.foot[1]].tolist() == [0, 100]


def test_a_wide_gap_is_bridged_and_the_drawn_foot_kept():
    _, table, _ = grown(TRUNK, [(5, 50), (40, 80)])
    bridge, drawn = np.flatnonzero(table["limb"] == 1)
    assert curve(table, bridge).tolist() == [[0, 50], [5, 50]] and curve(table, drawn).tolist() == [[5, 50], [40, 80]]


def test_a_narrow_gap_is_closed():
    _, table, _ = grown(TRUNK, [(0.8, 50), (20, 65), (40, 80)])
    assert curve(table, len(table["parent"]) - 1).tolist() == [[0, 50], [20, 65], [40, 80]]


def test_a_segment_after_a_join_is_marked():
    _, table, _ = grown([(0, 0), (0, 40)], [(0, 41), (5, 99)], [(0, 20), (30, 60)])
    assert table["xy"][table["joined"]].tolist() == [[5, 99]]


def test_each_segment_knows_the_stroke_that_drew_it_and_its_width():
    strokes = [line([(0, 0), (0, 40)], width=6.0), line([(0, 40), (0, 100)], "s1", 1, width=[4.0, 2.0]), line([(0, 70), (30, 90)], "s2", 2, width=1.0)]
    _, _, table, _ = table_of(strokes)
    told = {tuple(xy): (int(stroke), float(width)) for xy, stroke, width in zip(table["xy"].tolist(), table["stroke"], table["width"], strict=True)}
    assert told == {(0, 0): (0, 6.0), (0, 40): (0, 6.0), (0, 70): (1, 4.0), (0, 100): (1, 2.0), (30, 90): (2, 1.0)}


@pytest.mark.parametrize(("apart", "trees"), [(0.9 * ONE_TREE, 1), (1.1 * ONE_TREE, 2)])
def test_stems_nearer_than_one_tree_are_of_one_tree(apart, trees):
    _, table, _ = grown(TRUNK, [(100 * apart, 0), (100 * apart + 40, 100)])
    assert len(set(table["tree"].tolist())) == trees and (table["parent"] == NULL).sum() == 2


def test_trees_are_numbered_from_the_left_and_what_grows_on_a_stem_is_of_its_tree():
    _, table, _ = grown([(150, 0), (150, 100)], TRUNK, [(0, 50), (-40, 80)], [(150, 50), (180, 80)])
    assert (table["tree"] == (table["xy"][:, 0] > 100)).all()


def test_the_row_nearest_to_a_length_counts_the_foot_as_zero():
    _, rows = only([(0, 0), (0, 50), (50, 50)])
    assert [rows.nearest(0, s) for s in (0, 20, 30, 60, 80, 100, 200)] == [0, 0, 1, 1, 2, 2, 2]
