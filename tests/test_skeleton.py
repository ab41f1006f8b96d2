import dataclasses

import numpy as np
import pytest

from sketchtree.axes import NULL
from sketchtree.errors import SkeletonError
from sketchtree.skeleton import Kind, TreeSkeleton


def fork() -> TreeSkeleton:
    """A base, a trunk segment with one curve point, and two children of it."""
    return TreeSkeleton.from_columns(
        parent=[NULL, 0, 1, 1],
        tip=[[0, 0, 0], [0, 1, 0], [0, 2, 0], [1, 1.5, 0.5]],
        radius=[0.2, 0.15, 0.1, 0.05],
        order=[0, 0, 0, 1],
        curve_points=[[0.05, 0.5, 0.0]],
        curve_start=[0, 0, 1, 1, 1],
    )


def broken(**columns):
    tree = fork()
    kept = {field.name: getattr(tree, field.name) for field in dataclasses.fields(tree)}
    return TreeSkeleton(**(kept | columns))


def test_a_base_is_a_point_and_not_a_segment():
    tree = fork()
    assert tree.is_base.tolist() == [True, False, False, False]
    assert tree.length[0] == 0.0
    assert tree.segment_count == 3


def test_vectors_run_from_the_parents_tip_to_the_own_tip():
    tree = fork()
    np.testing.assert_allclose(tree.vector[3], [1, 0.5, 0.5])
    np.testing.assert_allclose(tree.start[3], tree.tip[1])


def test_a_curve_holds_both_ends_and_the_drawn_points_between():
    np.testing.assert_allclose(fork().curve(1), [[0, 0, 0], [0.05, 0.5, 0], [0, 1, 0]])
    np.testing.assert_allclose(fork().curve(2), [[0, 1, 0], [0, 2, 0]])


def test_columns_are_frozen():
    with pytest.raises(ValueError, match="read-only"):
        fork().tip[0, 0] = 1.0


def test_columns_are_copies_of_what_was_given():
    tip = np.zeros((1, 3))
    tree = TreeSkeleton.from_columns([NULL], tip, [0.1])
    tip[:] = 7.0
    assert (tree.tip == 0).all()


@pytest.mark.parametrize(
    ("columns", "row", "message"),
    [
        ({"parent": [NULL, 2, 1, 1]}, 1, "Row 1: its parent does not stand before it."),
        ({"parent": [NULL, 0, 1, -3]}, 3, "Row 3: its parent does not stand before it."),
        ({"tip": [[0, 0, 0], [0, np.nan, 0], [0, 2, 0], [1, 1, 1]]}, 1, "Row 1: its tip is not finite."),
        ({"radius": [0.2, 0.1, 0.0, 0.1]}, 2, "Row 2: its radius is not a positive number."),
        ({"radius": [0.2, 0.1, np.inf, 0.1]}, 2, "Row 2: its radius is not a positive number."),
        ({"order": [0, 0, 0, -1]}, 3, "Row 3: its order is negative."),
        ({"kind": [0, 0, 0, 9]}, 3, "Row 3: its kind is unknown."),
        ({"radius": [0.2, 0.1, 0.1]}, None, "Column `radius` has shape (3,), but there are 4 rows."),
        ({"curve_start": [0, 0, 1, 1, 2]}, None, "`curve_start` does not cut `curve_points` into one piece per row."),
        ({"curve_points": [[0.0, np.inf, 0.0]]}, None, "A curve point is not finite."),
    ],
)
def test_a_broken_requirement_is_named(columns, row, message):
    with pytest.raises(SkeletonError) as caught:
        broken(**columns)
    assert caught.value.row == row
    assert caught.value.message == message
    assert caught.value.remedy


def test_appended_rows_follow_and_old_rows_stay():
    tree = fork()
    more = tree.append({"parent": [3, 4], "tip": [[1, 2, 1], [1, 3, 1]], "radius": [0.04, 0.03]})
    assert len(more) == 6
    np.testing.assert_array_equal(more.tip[:4], tree.tip)
    np.testing.assert_array_equal(more.curve(1), tree.curve(1))
    assert more.kind[4] == Kind.PROPAGATED and more.stroke[4] == NULL


def test_selecting_rows_renumbers_parents_and_keeps_curves():
    tree = fork().select(np.array([True, True, False, True]))
    assert tree.parent.tolist() == [NULL, 0, 1]
    np.testing.assert_array_equal(tree.curve(1), fork().curve(1))
    np.testing.assert_array_equal(tree.tip[2], fork().tip[3])


def test_selecting_a_row_without_its_parent_is_refused():
    with pytest.raises(SkeletonError, match="Row 2: it is kept but its parent is not."):
        fork().select(np.array([True, False, True, False]))


def test_an_empty_skeleton_is_a_skeleton():
    tree = TreeSkeleton.from_columns(np.zeros(0, int), np.zeros((0, 3)), np.zeros(0))
    assert len(tree) == 0 and tree.height == 0.0 and tree.segment_count == 0
