import dataclasses

import numpy as np
import pytest
from tests.propagate.worlds import HABIT, THETA, drawn_tree

from sketchtree import keys
from sketchtree.parameters import TreeParameters
from sketchtree.propagate.blocks.attach_block import Nodes, attach
from sketchtree.propagate.blocks.block import Blocks, blocks_of, blocks_of_parameters, habit_reach, log_likelihood
from sketchtree.propagate.blocks.open_branch import direction, frames, levelled, limb_positions, turn
from sketchtree.skeleton import TreeSkeleton
from sketchtree.traverse import children

KEY = keys.root_key(0)


def test_every_segment_with_children_is_a_block():
    tree = drawn_tree()
    blocks = blocks_of(tree)
    child, start = children(tree.parent)
    parents = [row for row in range(1, len(tree)) if start[row + 1] > start[row]]
    assert len(blocks) == len(parents)
    assert np.diff(blocks.start).sum() == sum(start[row + 1] - start[row] for row in parents)
    np.testing.assert_array_equal(blocks.order, tree.order[parents])


def test_the_apical_child_comes_first():
    blocks = blocks_of(drawn_tree())
    assert not blocks.apical[np.setdiff1d(np.arange(len(blocks.apical)), blocks.start[:-1])].any()


def test_section4_a_block_attached_to_its_own_parent_reproduces_its_children():
    """v_c = s R_y(ϕ) R_x(φ) v_p in the parent's frame (Chen §4)."""
    tree = drawn_tree(9, seed=3)
    blocks, frame = blocks_of(tree), levelled(frames(tree), tree.order)
    child, start = children(tree.parent)
    parents = [row for row in range(1, len(tree)) if start[row + 1] > start[row]]
    for block, row in enumerate(parents):
        own = slice(blocks.start[block], blocks.start[block + 1])
        local = direction(blocks.divergence[own], blocks.orientation[own])
        vectors = blocks.scale[own, None] * tree.length[row] * (local @ frame[row].T)
        rows = child[start[row] : start[row + 1]]
        rows = rows[np.argsort(tree.limb[rows] != tree.limb[row], kind="stable")]
        np.testing.assert_allclose(vectors, tree.vector[rows], atol=1e-12)


def test_a_lateral_attached_without_spread_points_as_in_its_block():
    tree = drawn_tree(8, seed=1)
    blocks, frame = blocks_of(tree), frames(tree)
    position, whole = limb_positions(tree)
    theta = dataclasses.replace(THETA, sigma_gamma=3.0, sigma_beta=1.0)
    bearing = np.flatnonzero((blocks.order == 0) & (blocks.lateral_count > 0))
    rows = [row for row in range(1, len(tree)) if tree.order[row] == 0 and np.sum(tree.parent == row) == 2]
    nodes = Nodes(
        row=np.array(rows), tip=tree.tip[rows], frame=frame[rows], limb=tree.limb[rows], order=np.ones(len(rows), int),
        tree=tree.tree[rows], number=np.arange(len(rows)), position=position[rows], zone=position[rows],
        whole=whole[rows], radius=tree.radius[rows],
    )  # fmt: skip
    new = attach(nodes, bearing, blocks, dataclasses.replace(HABIT, lateral_ratio=10.0), theta, KEY, spread=0.0)
    laterals = [child for row in rows for child in np.flatnonzero(tree.parent == row) if tree.order[child] == 1]
    heading = tree.vector[laterals] / tree.length[laterals, None]
    mirrored = heading - 2 * np.einsum("bi,bi->b", heading, nodes.frame[:, :, 0])[:, None] * nodes.frame[:, :, 0]
    off = np.minimum(
        np.linalg.norm(new.frame[:, :, 1] - heading, axis=1), np.linalg.norm(new.frame[:, :, 1] - mirrored, axis=1)
    )
    np.testing.assert_allclose(off, 0.0, atol=1e-12)


def test_reach_is_the_limbs_length_over_its_parent_limbs():
    tree = drawn_tree(5)
    blocks = blocks_of(tree)
    _, whole = limb_positions(tree)
    ratios = sorted(np.unique(whole[tree.order == 1]) / whole[tree.order == 0][0])
    np.testing.assert_allclose(sorted(blocks.reach[~blocks.apical]), ratios, rtol=1e-12)
    assert np.isnan(blocks.reach[blocks.apical]).all()


def test_droop_is_the_turn_to_the_ground_a_metre():
    tip = np.array([[0, 0, 0], [1, 0, 0], [1 + np.cos(0.3), -np.sin(0.3), 0]], float)
    limb = TreeSkeleton.from_columns(np.array([-1, 0, 1]), tip, np.ones(3))
    blocks = blocks_of(limb)
    np.testing.assert_allclose(blocks.droop, [0.3], atol=1e-12)


def test_block_ids_do_not_move_when_a_stroke_is_added():
    few, more = blocks_of(drawn_tree(5)), blocks_of(drawn_tree(6))
    shared = np.isin(few.id, more.id)
    assert shared.sum() >= len(few) - 1


def test_zone_counts_from_the_first_lateral():
    blocks = blocks_of(drawn_tree(6))
    trunk = blocks.order == 0
    assert blocks.zone[trunk].min() == 0.0
    assert (blocks.zone[trunk] <= blocks.position[trunk]).all()


def test_blocks_of_parameters_follow_section4_labels():
    theta = TreeParameters(0.8, 0.1, 0.1, 0.05, 1.0, 0.1, 0.0, 0.5)
    blocks = blocks_of_parameters(theta, dataclasses.replace(HABIT, arrangement="whorled", whorl=4))
    assert (blocks.lateral_count == 4).all() and blocks.has_apical.all()
    first = slice(blocks.start[0], blocks.start[1])
    gaps = np.diff(blocks.orientation[first][1:])
    np.testing.assert_allclose(gaps, np.pi / 2, atol=1e-9)


def test_habit_reach_is_longest_near_the_tip_or_near_the_base():
    at = np.array([0.2, 0.6])
    decurrent = habit_reach(dataclasses.replace(HABIT, apical_control=0.0), at)
    excurrent = habit_reach(dataclasses.replace(HABIT, apical_control=1.0), at)
    assert decurrent[0] < decurrent[1] and excurrent[0] > excurrent[1]
    assert habit_reach(HABIT, np.array([1.0]))[0] <= 0.12


def test_log_likelihood_is_zero_at_the_means_and_falls_with_the_angle():
    theta = TreeParameters(0.8, 0.1, 0.1, 0.2, 1.0, 0.2, 0.0, 0.5)
    tree = drawn_tree(6)
    blocks = blocks_of(tree)
    at_mean = dataclasses.replace(blocks, divergence=np.where(blocks.apical, 0.1, 1.0))
    np.testing.assert_allclose(log_likelihood(at_mean, theta), 0.0, atol=1e-15)
    off = dataclasses.replace(blocks, divergence=np.where(blocks.apical, 0.3, 1.2))
    np.testing.assert_allclose(log_likelihood(off, theta), -0.5)


def test_selecting_blocks_keeps_their_children():
    blocks = blocks_of(drawn_tree(6))
    keep = blocks.order == 0
    chosen = blocks.select(keep)
    assert isinstance(chosen, Blocks) and len(chosen) == keep.sum()
    np.testing.assert_array_equal(chosen.divergence, blocks.divergence[keep[blocks.owner]])


@pytest.mark.parametrize("apical", [True, False])
def test_turned_frames_are_rotations_with_the_child_as_y(apical):
    rng = np.random.default_rng(0)
    divergence, orientation = rng.uniform(0, 2, 50), rng.uniform(-3, 3, 50)
    frame = turn(np.tile(np.eye(3), (50, 1, 1)), divergence, orientation, np.full(50, apical))
    np.testing.assert_allclose(np.einsum("bij,bik->bjk", frame, frame), np.tile(np.eye(3), (50, 1, 1)), atol=1e-12)
    np.testing.assert_allclose(np.linalg.det(frame), 1.0)
    np.testing.assert_allclose(frame[:, :, 1], direction(divergence, orientation), atol=1e-15)
