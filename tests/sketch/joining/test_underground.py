"""Drawn roots: read upside down, turned back, hung on the nearest base, after all rows of the tree."""

import numpy as np
import pytest
from hands import EXAMPLES
from little_lines import grown

from sketchtree.axes import NULL
from sketchtree.sketch.formats import read_sketch
from sketchtree.sketch.joining.underground import with_roots
from sketchtree.sketch.reading import sketch_graph
from sketchtree.sketch.strokes import Sketch, Stroke

TREE = ([(0, 0), (0, 100)], [(0, 50), (40, 80)])
ROOTS = ([(0, 0), (-20, -10), (-50, -15)], [(0, 0), (15, -25)], [(-20, -10), (-30, -25)])


def turned(strokes):
    return [np.array(points) * (1, -1) for points in strokes]


def joined(tree=TREE, roots=ROOTS):
    """(the tree's columns, the whole, how many limbs the tree has)."""
    limbs, table, _ = grown(*tree)
    return table, with_roots(table, grown(*turned(roots))[1], len(limbs)), len(limbs)


def curve(table, row):
    inner = table["curve_points"][table["curve_start"][row] : table["curve_start"][row + 1]]
    return [tuple(p) for p in np.vstack([table["xy"][table["parent"][row]], inner, table["xy"][row]]).tolist()]


def test_the_rows_of_the_tree_are_unchanged_and_stand_first():
    tree, whole, _ = joined()
    count = len(tree["parent"])
    assert whole["root"].tolist() == [False] * count + [True] * (len(whole["root"]) - count) and whole["root"].sum() >= 3
    for name in ("parent", "xy", "limb", "stroke", "tree", "joined"):
        assert (whole[name][:count] == tree[name]).all()
    assert (whole["curve_start"][: count + 1] == tree["curve_start"]).all()


def test_roots_hang_on_the_base_and_lead_down():
    _, whole, _ = joined()
    rows = np.flatnonzero(whole["root"])
    assert (whole["parent"][rows] < rows).all() and (whole["parent"] == NULL).sum() == 1
    assert (whole["xy"][rows, 1] < 0).all() and (whole["tree"][rows] == 0).all()
    assert whole["parent"][rows[0]] == np.flatnonzero(whole["parent"] == NULL)[0]


def test_drawn_points_of_roots_are_kept():
    _, whole, _ = joined()
    drawn = {tuple(map(float, p)) for points in ROOTS for p in points}
    read = {p for row in np.flatnonzero(whole["root"]) for p in curve(whole, row)}
    assert drawn <= read


def test_limbs_of_roots_are_numbered_on():
    tree, whole, count = joined()
    assert set(tree["limb"].tolist()) == set(range(count))
    assert set(whole["limb"][whole["root"]].tolist()) == set(range(count, count + 3))


def test_each_root_hangs_on_the_nearest_stem_and_is_of_its_tree():
    tree = ([(0, 0), (0, 100)], [(150, 0), (150, 100)])
    _, whole, _ = joined(tree, ([(1, 0), (-20, -20)], [(149, 0), (170, -20)]))
    rows = np.flatnonzero(whole["root"])
    bases = {tuple(whole["xy"][row]): whole["tree"][row] for row in np.flatnonzero(whole["parent"] == NULL)}
    for row in rows:
        assert whole["tree"][row] == bases[(0.0, 0.0) if whole["xy"][row, 0] < 75 else (150.0, 0.0)]


def test_a_gap_to_the_foot_is_bridged_and_the_drawn_point_kept():
    _, whole, _ = joined(roots=([(3, -4), (20, -30)],))
    row = int(np.flatnonzero(whole["root"])[0])
    assert curve(whole, row) == [(0.0, 0.0), (3.0, -4.0), (20.0, -30.0)]


def test_a_roots_own_root_hangs_on_it():
    _, whole, _ = joined()
    rows = np.flatnonzero(whole["root"])
    assert any(whole["limb"][whole["parent"][row]] != whole["limb"][row] and whole["root"][whole["parent"][row]] for row in rows)


def drawing(*kinds):
    named = {"tree": TREE, "root": ROOTS, "ground": ([(-60, 0), (60, 0)],)}
    return Sketch(tuple(Stroke(f"{kind}{k}", points, layer="Roots" if kind == "root" else None) for kind in kinds for k, points in enumerate(named[kind])))


@pytest.mark.parametrize("kinds", [("tree", "root", "ground"), ("ground", "root", "tree")])
def test_below_a_drawn_ground_line_are_roots_reported_as_such(kinds):
    graph = sketch_graph(drawing(*kinds))
    reported = {a.stroke: a for a in graph.attachments}
    assert graph.root.sum() >= 3 and len(graph.ground) == 1
    assert reported["root0"].parent == "tree0" and reported["root0"].reason == "a root: it starts at the foot of that stem"
    assert reported["root2"].parent == "root0" and reported["root2"].reason.startswith("a root; ")
    assert reported["root1"].point == pytest.approx((0, 0))
    assert not graph.above_ground().root.any() and len(graph.above_ground().limb_id) == 2


def test_the_examples_have_no_roots():
    assert not any(sketch_graph(read_sketch(path)).root.any() for path in EXAMPLES.glob("*.svg"))
