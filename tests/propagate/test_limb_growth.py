import numpy as np
from tests.propagate.worlds import HABIT, THETA, circle

from sketchtree import keys
from sketchtree.propagate.blocks.block import blocks_of_parameters
from sketchtree.propagate.space.envelope import Envelope
from sketchtree.propagate.space.space import Space
from sketchtree.propagate.blocks.library import library
from sketchtree.propagate.limb_growth import NODES, gravity, grow, plan
from sketchtree.propagate.blocks.open_branch import OpenBranches, direction, turn

KEY = keys.root_key(0)
BLOCKS = blocks_of_parameters(THETA, HABIT)
LIBRARY = library(BLOCKS.select(np.zeros(len(BLOCKS), bool)), BLOCKS, THETA, HABIT.max_order, None)


def open_branches(count=60, length=2.0, height=5.0, order=2):
    rng = np.random.default_rng(0)
    frame = turn(
        np.tile(np.eye(3), (count, 1, 1)), rng.uniform(0.3, 1.5, count), rng.uniform(-3, 3, count), np.zeros(count, bool)
    )
    return OpenBranches(
        row=np.zeros(count, int), origin=np.tile([0.0, height, 0.0], (count, 1)), frame=frame, limb=np.arange(100, 100 + count),
        order=np.full(count, order), tree=np.zeros(count, int), length=np.full(count, length), grown=np.zeros(count),
        node=np.zeros(count, int), radius=np.full(count, 0.05), bends=np.zeros(count, bool),
    )  # fmt: skip


def grown(open_, envelope=None, ground=-100.0, spacing=0.3):
    nodes = plan(open_, LIBRARY, np.full(len(open_), spacing), KEY)
    ground = np.full(len(open_), ground)
    return nodes, *grow(open_, nodes, LIBRARY, HABIT, THETA, Space() if envelope is None else Space((envelope,)), ground, KEY, first_row=1)


def test_a_limb_is_several_segments_that_sum_to_its_length():
    open_ = open_branches()
    nodes, made, parent = grown(open_)
    start = np.where((parent > 0)[:, None], made.tip[np.maximum(parent - 1, 0)], open_.origin[0])
    steps = np.linalg.norm(made.tip - start, axis=1)
    total = np.bincount(nodes.owner, steps)
    np.testing.assert_allclose(total, 2.0, rtol=1e-9)
    assert (np.bincount(nodes.owner) >= 2).all() and np.bincount(nodes.owner).max() <= NODES


def test_rows_are_chains_with_parents_first():
    _, made, parent = grown(open_branches())
    assert (parent < made.row).all()
    inner = parent > 0
    np.testing.assert_array_equal(made.limb[parent[inner] - 1], made.limb[inner])
    assert inner.sum() == len(made) - 60


def test_a_new_lateral_starts_the_way_it_was_attached():
    open_ = open_branches()
    _, made, parent = grown(open_)
    first = made.tip[parent == 0] - open_.origin
    heading = first / np.linalg.norm(first, axis=1)[:, None]
    np.testing.assert_allclose(heading, open_.frame[:, :, 1], atol=1e-12)


def test_limbs_curve():
    _, made, _ = grown(open_branches())
    bend = np.einsum("bi,bi->b", made.frame[1:, :, 1], made.frame[:-1, :, 1])[made.limb[1:] == made.limb[:-1]]
    assert (bend < 1 - 1e-6).mean() > 0.9


def test_at_the_crown_a_branch_stops_on_the_surface():
    envelope = Envelope.from_outlines([circle(y=5.0, radius=1.0, points=720)])
    nodes, made, parent = grown(open_branches(), envelope)
    assert envelope.inside(made.tip).all()
    last = np.r_[made.limb[1:] != made.limb[:-1], True]
    margin = envelope.lobes[0].margin(made.tip[last])
    assert np.median(margin) < 2e-5 and len(made) < len(nodes.owner)


def test_nothing_grows_below_the_ground():
    _, made, _ = grown(open_branches(height=0.4, length=4.0), ground=0.1)
    assert made.tip[:, 1].min() >= 0.1 - 1e-12


def test_gravity_turns_towards_the_ground_and_never_past_it():
    heading = direction(np.array([0.5, 1.5, 3.0]), np.array([0.3, 1.0, 2.0]))
    bent = gravity(heading, np.full(3, 0.4))
    np.testing.assert_allclose(np.linalg.norm(bent, axis=1), 1.0)
    fall = np.arccos(bent[:, 1]) - np.arccos(heading[:, 1])
    np.testing.assert_allclose(fall[:2], 0.4, atol=1e-9)
    assert np.arccos(bent[2, 1]) <= np.pi
    level = heading[:, [0, 2]] / np.linalg.norm(heading[:, [0, 2]], axis=1)[:, None]
    np.testing.assert_allclose(bent[:2, [0, 2]] / np.linalg.norm(bent[:2, [0, 2]], axis=1)[:, None], level[:2], atol=1e-9)


def test_negative_gravity_lifts_and_plumb_headings_stay():
    lifted = gravity(direction(np.array([1.0]), np.array([0.0])), np.array([-0.4]))
    np.testing.assert_allclose(np.arccos(lifted[0, 1]), 0.6)
    down = np.array([[0.0, -1.0, 0.0]])
    np.testing.assert_array_equal(gravity(down, np.array([0.5])), down)


def test_no_open_branch_makes_no_row():
    _, made, parent = grown(open_branches().select(slice(0, 0)))
    assert len(made) == len(parent) == 0
