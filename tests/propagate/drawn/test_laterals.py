import numpy as np
from tests.propagate.worlds import drawn_tree

from sketchtree.axes import NULL
from sketchtree.propagate.drawn.laterals import split_long
from sketchtree.propagate.blocks.open_branch import arc_length, limb_arcs
from sketchtree.skeleton import TreeSkeleton


def split(tree, spacing=0.37):
    return split_long(tree, np.full(len(tree), spacing), np.ones(len(tree), bool))


def pieces(result, old, row):
    """Rows of the new tree that make up one old row."""
    at, found = result.row[row], [result.row[row]]
    while result.tree.parent[at] != result.row[old.parent[row]]:
        at = result.tree.parent[at]
        found.append(at)
    return found[::-1]


def test_drawn_nodes_are_bit_identical():
    tree = drawn_tree(6)
    result = split(tree)
    np.testing.assert_array_equal(result.tree.tip[result.row], tree.tip)
    for name in ("radius", "order", "limb", "stroke", "tree", "kind"):
        np.testing.assert_array_equal(getattr(result.tree, name)[result.row], getattr(tree, name))


def test_every_drawn_point_is_still_a_point_of_the_tree():
    tree = drawn_tree(6)
    result = split(tree)
    points = {tuple(p) for p in np.concatenate([result.tree.tip, result.tree.curve_points])}
    assert all(tuple(point) in points for point in tree.curve_points)


def test_the_pieces_of_a_row_trace_the_drawn_curve():
    tree = drawn_tree(6)
    result = split(tree)
    for row in range(1, len(tree)):
        rows = pieces(result, tree, row)
        joined = np.concatenate([result.tree.curve(r)[:-1] for r in rows] + [result.tree.tip[rows[-1]][None]])
        drawn = tree.curve(row)
        s = np.r_[0, np.cumsum(np.linalg.norm(np.diff(drawn, axis=0), axis=1))]
        t = np.r_[0, np.cumsum(np.linalg.norm(np.diff(joined, axis=0), axis=1))]
        on = np.column_stack([np.interp(t, s, drawn[:, axis]) for axis in range(3)])
        np.testing.assert_allclose(joined, on, atol=1e-12)


def test_arc_length_is_kept():
    tree = drawn_tree(6)
    result = split(tree)
    total = np.bincount(np.unique(result.tree.limb, return_inverse=True)[1], arc_length(result.tree))
    before = np.bincount(np.unique(tree.limb, return_inverse=True)[1], arc_length(tree))
    np.testing.assert_allclose(total, before, rtol=1e-12)


def test_nodes_lie_near_every_multiple_of_the_spacing():
    result = split(drawn_tree(6), 0.37)
    arc, whole = limb_arcs(result.tree)
    for limb in np.unique(result.tree.limb):
        rows = np.flatnonzero((result.tree.limb == limb) & (result.number != NULL))
        numbers = result.number[rows]
        assert len(set(numbers.tolist())) == len(numbers)
        np.testing.assert_array_less(np.abs(arc[rows] / 0.37 - numbers), 0.3 + 1e-9)
        assert set(range(1, int(whole[rows[0]] / 0.37 - 0.3) + 1)) <= set(numbers.tolist())


def test_nodes_do_not_move_when_a_stroke_is_added():
    few, more = split(drawn_tree(5)), split(drawn_tree(6))
    for limb in np.setdiff1d(np.unique(few.tree.limb), few.tree.limb[0]):
        one, two = few.tree.limb == limb, more.tree.limb == limb
        np.testing.assert_array_equal(few.number[one], more.number[two])


def test_rows_that_are_not_eligible_stay_whole():
    tree = drawn_tree(4)
    eligible = tree.order == 1
    result = split_long(tree, np.full(len(tree), 0.3), eligible)
    assert np.sum(result.tree.order == 0) == np.sum(tree.order == 0)
    assert (result.number[result.tree.order == 0] == NULL).all()


def test_radius_runs_from_parent_to_tip():
    tip = np.array([[0, 0, 0], [0, 4.0, 0]])
    tree = TreeSkeleton.from_columns(np.array([-1, 0]), tip, np.array([0.4, 0.2]))
    result = split(tree, 1.0)
    np.testing.assert_allclose(result.tree.radius, [0.4, 0.35, 0.3, 0.25, 0.2])


def test_unknown_depth_sd_and_age_stay_unknown():
    tree = drawn_tree(4)
    tree = tree.replace(age=np.arange(float(len(tree))))
    result = split(tree)
    assert np.isnan(result.tree.depth_sd).all()
    assert np.isfinite(result.tree.age).all()
