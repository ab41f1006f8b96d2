import numpy as np
from tests.propagate.worlds import drawn_tree

from sketchtree.propagate.blocks.open_branch import (
    OpenBranches,
    arc_length,
    direction,
    frames,
    limb_arcs,
    limb_positions,
    polar,
)
from sketchtree.skeleton import TreeSkeleton


def test_polar_is_the_inverse_of_direction():
    rng = np.random.default_rng(0)
    divergence, orientation = rng.uniform(0.01, 3.1, 100), rng.uniform(-3.1, 3.1, 100)
    back = polar(direction(divergence, orientation))
    np.testing.assert_allclose(back[0], divergence, atol=1e-12)
    np.testing.assert_allclose(back[1], orientation, atol=1e-12)


def test_every_frame_is_a_rotation_whose_y_is_the_segment():
    tree = drawn_tree(8)
    frame = frames(tree)
    np.testing.assert_allclose(np.linalg.det(frame), 1.0, atol=1e-12)
    rows = ~tree.is_base
    np.testing.assert_allclose(frame[rows, :, 1], tree.vector[rows] / tree.length[rows, None], atol=1e-12)


def test_a_base_stands_upright():
    np.testing.assert_array_equal(frames(drawn_tree())[0], np.eye(3))


def test_along_a_limb_nothing_spins():
    """Parallel transport: a planar bend leaves the axis normal to the plane where it was."""
    tip = np.array([[0, 0, 0], [0, 1, 0], [0.5, 1.8, 0], [1.4, 2.0, 0]], float)
    frame = frames(TreeSkeleton.from_columns(np.array([-1, 0, 1, 2]), tip, np.ones(4)))
    np.testing.assert_allclose(frame[:, :, 2], np.tile([0.0, 0.0, 1.0], (4, 1)), atol=1e-12)


def test_a_laterals_x_is_normal_to_the_plane_of_limb_and_lateral():
    tree = drawn_tree(8)
    frame = frames(tree)
    above = np.maximum(tree.parent, 0)
    rows = np.flatnonzero((tree.parent >= 0) & (tree.limb != tree.limb[above]))
    x = frame[rows, :, 0]
    np.testing.assert_allclose(np.einsum("bi,bi->b", x, frame[above[rows], :, 1]), 0.0, atol=1e-12)
    np.testing.assert_allclose(np.einsum("bi,bi->b", x, frame[rows, :, 1]), 0.0, atol=1e-12)


def test_a_row_of_zero_length_keeps_its_parents_frame():
    tip = np.array([[0, 0, 0], [1, 1, 0], [1, 1, 0], [2, 1, 0]], float)
    frame = frames(TreeSkeleton.from_columns(np.array([-1, 0, 1, 2]), tip, np.ones(4)))
    np.testing.assert_array_equal(frame[2], frame[1])
    assert np.isfinite(frame).all()


def test_arc_length_follows_the_drawn_curve():
    tree = drawn_tree(4)
    for row in range(1, len(tree)):
        steps = np.linalg.norm(np.diff(tree.curve(row), axis=0), axis=1)
        np.testing.assert_allclose(arc_length(tree)[row], steps.sum(), rtol=1e-12)


def test_arcs_count_from_a_limbs_insertion():
    tree = drawn_tree(3)
    arc, whole = limb_arcs(tree)
    for limb in np.unique(tree.limb):
        rows = np.flatnonzero(tree.limb == limb)
        np.testing.assert_allclose(arc[rows], np.cumsum(arc_length(tree)[rows]), rtol=1e-12)
        np.testing.assert_allclose(whole[rows], arc[rows].max())
    assert limb_positions(tree)[0].max() == 1.0


def test_joining_and_selecting_open_branches():
    one = OpenBranches(*(np.arange(3) for _ in range(11)))
    assert len(one.join(one)) == 6
    np.testing.assert_array_equal(one.select(np.array([True, False, True])).row, [0, 2])
