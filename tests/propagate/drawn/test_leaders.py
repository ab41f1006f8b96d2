import dataclasses

import numpy as np
import pytest
from tests.propagate.worlds import HABIT, THETA, circle, drawn_tree

from sketchtree import keys
from sketchtree.axes import NULL
from sketchtree.propagate.space.envelope import Envelope, Lobe
from sketchtree.propagate.generations import propagate
from sketchtree.propagate.drawn.leaders import leaders, unled
from sketchtree.skeleton import Kind, TreeSkeleton

KEY = keys.root_key(0)


def trunk(*tips, foot=2.0):
    """A drawn trunk up to `foot` metres, and a drawn limb from there to every further tip (the first goes on the trunk)."""
    parent, tip, limb, order, stroke = [NULL, 0], [[0, 0, 0], [0, foot, 0]], [1, 1], [0, 0], [0, 0]
    for rank, end in enumerate(tips):
        parent.append(1)
        tip.append(end)
        limb.append(1 + rank)
        order.append(int(rank > 0))
        stroke.append(rank)
    return TreeSkeleton.from_columns(
        np.array(parent), np.array(tip, float), np.linspace(0.2, 0.1, len(parent)),
        limb=np.array(limb), order=np.array(order), stroke=np.array(stroke), kind=np.full(len(parent), int(Kind.DRAWN)),
    )  # fmt: skip


def grown(tree, *outlines, **options):
    return propagate(tree, HABIT, THETA, crown=outlines, key=KEY, **options)


@pytest.mark.parametrize("tree", [trunk(), trunk((-0.6, 3.0, 0.1), (0.5, 2.9, 0.4)), trunk((0, 4.5, 0))])
def test_a_trunk_below_or_barely_in_a_crown_fills_it(tree):
    crown = circle(y=7.0, radius=3.0)
    result = grown(tree, crown)
    assert not result.warnings and result.skeleton.segment_count > 300
    rng = np.random.default_rng(0)
    point = rng.uniform(-1, 1, (4000, 3))
    point = 2.6 * point[np.linalg.norm(point, axis=1) < 1] + [0, 7.0, 0]
    gap = np.linalg.norm(point[:, None] - result.skeleton.tip[None], axis=2).min(axis=1)
    assert np.quantile(gap, 0.95) < 2.8 * HABIT.lateral_spacing


def test_the_drawn_rows_stay_and_the_trunk_goes_on_as_the_same_limb():
    tree = trunk()
    result = grown(tree, circle(y=7.0, radius=3.0))
    found = result.skeleton
    np.testing.assert_array_equal(found.tip[result.drawn_row], tree.tip)
    lead = (found.limb == 1) & (found.kind == int(Kind.PROPAGATED))
    assert lead.sum() >= 3 and (found.order[lead] == 0).all() and (result.generation[lead] == 1).all()
    above = found.parent[np.flatnonzero(lead)]
    assert (found.limb[above] == 1).all()


def test_once_inside_nothing_leaves_the_crown():
    crown = circle(y=7.0, radius=3.0)
    result = grown(trunk(), crown)
    within = Envelope.from_outlines((crown,)).inside(result.skeleton.tip)
    new = result.generation > 0
    bridge = new & (result.skeleton.limb == 1) & (result.skeleton.tip[:, 1] < 4.3)
    assert within[new & ~bridge].all()


def test_every_outline_gets_its_share():
    outlines = [circle(x, 6.5, 1.6) for x in (-2.5, 0.0, 2.5)]
    result = grown(trunk(), *outlines)
    for outline in outlines:
        inside = Lobe.from_outline(outline).margin(result.skeleton.tip) >= 0
        assert inside.sum() > 60


def test_an_excurrent_leader_ends_higher_than_a_decurrent_one():
    ends = []
    for control in (0.0, 1.0):
        tree = trunk()
        habit = dataclasses.replace(HABIT, apical_control=control)
        envelope = Envelope.from_outlines((circle(y=7.0, radius=3.0),))
        found = leaders(tree, envelope, habit, np.full(len(tree), 0.4), KEY, most=1000)
        ends.append(found.nodes.tip[-1, 1])
    assert ends[0] < 8.5 and 9.2 < ends[1] < 10.0


def test_a_crown_with_drawn_limbs_in_it_has_no_leader():
    tree = drawn_tree(6)
    envelope = Envelope.from_outlines((circle(),))
    assert not unled(tree, envelope.lobes[0])
    assert leaders(tree, envelope, HABIT, np.full(len(tree), 0.4), KEY, most=1000) is None


def test_without_a_crown_there_is_no_leader():
    tree = trunk()
    assert leaders(tree, None, HABIT, np.full(len(tree), 0.4), KEY, most=1000) is None


@pytest.mark.parametrize("most", [1, 5, 40])
def test_leaders_count_towards_max_segments(most):
    tree = trunk()
    result = grown(tree, circle(y=7.0, radius=3.0), max_segments=tree.segment_count + most)
    assert result.skeleton.segment_count <= tree.segment_count + most


def test_same_key_same_leaders_another_key_others():
    envelope = Envelope.from_outlines((circle(y=7.0, radius=3.0),))
    tree = trunk()
    one, same, other = (
        leaders(tree, envelope, HABIT, np.full(len(tree), 0.4), keys.root_key(seed), most=1000).nodes.tip for seed in (0, 0, 1)
    )
    np.testing.assert_array_equal(one, same)
    assert not np.allclose(one, other)


def test_a_trunk_leads_though_a_limb_starts_at_its_very_end():
    tree = trunk((0, 2.5, 0), (2.5, 1.5, -2.0))
    tree = tree.replace(limb=np.array([1, 1, 5, 6]), order=np.array([0, 0, 1, 1]))
    result = grown(tree, circle(y=6.0, radius=2.0))
    assert ((result.skeleton.limb == 5) & (result.generation == 1)).any()
    bent = TreeSkeleton.from_columns(
        np.array([NULL, 0, 1]), np.array([[0, 0, 0], [0, 2.8, 0], [2.0, 2.3, -2.3]], float), np.array([0.2, 0.15, 0.1]),
        limb=np.array([1, 1, 2]), order=np.array([0, 0, 1]), stroke=np.array([0, 0, 1]), kind=np.full(3, int(Kind.DRAWN)),
    )  # fmt: skip
    found = grown(bent, circle(y=5.0, radius=1.5))
    assert ((found.skeleton.limb == 1) & (found.generation == 1)).any()


def test_a_palm_takes_its_head_into_the_crown():
    habit = dataclasses.replace(HABIT, max_order=1, leaf_arrangement="frond")
    result = propagate(trunk(), habit, THETA, crown=(circle(y=4.5, radius=2.0),), key=KEY)
    assert (result.skeleton.order == 1).sum() > 10
