import dataclasses

import numpy as np
from tests.propagate.worlds import HABIT, THETA, circle, drawn_tree

from sketchtree import keys
from sketchtree.propagate.blocks.block import blocks_of, blocks_of_parameters
from sketchtree.propagate.drawn.drawn_laterals import DrawnLaterals
from sketchtree.propagate.drawn.ends import BEARING, bare_length, drawn_nodes, open_tips, rank_of_drawn
from sketchtree.propagate.drawn.implied import implied_crown
from sketchtree.propagate.space.envelope import Envelope
from sketchtree.propagate.drawn.laterals import split_long
from sketchtree.propagate.blocks.library import library
from sketchtree.propagate.blocks.open_branch import limb_arcs
from sketchtree.traverse import is_tip

KEY = keys.root_key(0)


def world(limbs=6, spacing=0.4, habit=HABIT):
    tree = drawn_tree(limbs)
    lib = library(blocks_of(tree), blocks_of_parameters(THETA, habit), THETA, habit.max_order, None)
    split = split_long(tree, np.full(len(tree), spacing), tree.order < habit.max_order)
    return split, lib, np.full(len(split.tree), spacing)


def test_every_drawn_tip_is_open_and_grows_on_its_own_limb():
    split, _, spacing = world()
    tips = open_tips(split.tree, spacing, dataclasses.replace(HABIT, twig_length=0.05), None, KEY)
    rows = np.flatnonzero(is_tip(split.tree.parent))
    np.testing.assert_array_equal(np.sort(tips.row), rows)
    np.testing.assert_array_equal(tips.limb, split.tree.limb[tips.row])
    assert tips.bends.all()


def test_limbs_of_the_deepest_order_do_not_grow_on():
    split, _, spacing = world()
    tips = open_tips(split.tree, spacing, dataclasses.replace(HABIT, max_order=1, twig_length=0.05), None, KEY)
    assert len(tips) == 0


def test_within_a_crown_tips_grow_to_the_surface_at_most():
    split, _, spacing = world()
    envelope = Envelope.from_outlines([circle(radius=3.6)])
    tips = open_tips(split.tree, spacing, HABIT, envelope, KEY)
    end = tips.origin + tips.length[:, None] * tips.frame[:, :, 1]
    short = tips.origin + (tips.length[:, None] / 1.08) * tips.frame[:, :, 1]
    assert len(tips) and envelope.inside(short - 1e-6 * tips.frame[:, :, 1]).all()
    assert not envelope.inside(end).all()
    assert envelope.inside(tips.origin).all()


def test_the_trunk_is_bare_up_to_its_first_drawn_limb():
    split, lib, _ = world()
    tips = open_tips(split.tree, np.full(len(split.tree), 0.4), HABIT, None, KEY)
    nodes = drawn_nodes(split, tips, lib, HABIT, None)
    arc, whole = limb_arcs(split.tree)
    first = bare_length(split.tree, lib)[split.tree.order == 0].max()
    assert arc[nodes.row[nodes.order == 0]].min() >= first - 1e-9
    assert first > 0.2 * whole[split.tree.order == 0].max()


def test_limbs_bear_along_their_length():
    split, lib, _ = world()
    tips = open_tips(split.tree, np.full(len(split.tree), 0.4), HABIT, None, KEY)
    nodes = drawn_nodes(split, tips, lib, HABIT, None)
    for limb in np.unique(split.tree.limb[split.tree.order == 1]):
        on = nodes.limb == limb
        assert on.sum() >= 3
        assert ((nodes.position[on] > 0) & (nodes.position[on] < 1)).all()
        assert ((nodes.zone[on] >= 0) & (nodes.zone[on] <= 1)).all()


def test_new_laterals_beside_drawn_ones_are_found():
    split, lib, spacing = world()
    tree = split.tree
    drawn = DrawnLaterals.of(tree)
    rows = np.flatnonzero((tree.order == 1) & (tree.order[np.maximum(tree.parent, 0)] == 0))
    copies = open_tips(tree, spacing, dataclasses.replace(HABIT, twig_length=0.05), None, KEY).select(np.zeros(len(rows), int))
    frame = np.zeros((len(rows), 3, 3))
    frame[:, :, 1] = tree.vector[rows] / tree.length[rows, None]
    same = dataclasses.replace(copies, row=tree.parent[rows], frame=frame)
    assert drawn.beside(same, spacing).all()
    away = dataclasses.replace(same, frame=-frame)
    assert not drawn.beside(away, spacing).any()


def test_the_usual_length_is_that_of_the_drawn_laterals_around():
    split, _, spacing = world(8)
    tree = split.tree
    drawn = DrawnLaterals.of(tree)
    tips = open_tips(tree, spacing, dataclasses.replace(HABIT, twig_length=0.05), None, KEY)
    at = tips.select(np.zeros(len(drawn.length), int))
    rows = np.flatnonzero((tree.order == 1) & (tree.order[np.maximum(tree.parent, 0)] == 0))
    usual = drawn.usual_length(dataclasses.replace(at, row=tree.parent[rows]))
    _, whole = limb_arcs(tree)
    np.testing.assert_allclose(usual, whole[rows], rtol=1e-9)
    leaf_limb = dataclasses.replace(tips, row=np.full(len(tips), rows[0]))
    assert np.isnan(drawn.usual_length(leaf_limb)).all()


def test_the_implied_crown_holds_the_drawing_on_the_page():
    tree = drawn_tree(8)
    envelope = implied_crown(tree, HABIT)
    flat = tree.tip[tree.order > 0] * [1, 1, 0]
    assert envelope.inside(flat).all() and not envelope.binding


def test_a_weeping_habit_reaches_the_ground():
    tree = drawn_tree(8)
    upright, weeping = (implied_crown(tree, dataclasses.replace(HABIT, gravitropism=g)) for g in (0.0, 90.0))
    low = np.array([[0.0, 0.1, 0.0]])
    assert weeping.inside(low)[0] and not upright.inside(low)[0]


def test_trunks_and_palms_imply_no_crown():
    assert implied_crown(drawn_tree(0), HABIT) is None
    assert implied_crown(drawn_tree(8), dataclasses.replace(HABIT, max_order=1)) is None


def test_a_long_limb_bears_however_many_forks_lie_below_it():
    tree = drawn_tree(4)
    deep = tree.replace(order=np.where(tree.order > 0, 9, 0))
    _, whole = limb_arcs(deep)
    rank = rank_of_drawn(deep, HABIT)
    long_ = (deep.order > 0) & (whole >= BEARING * HABIT.twig_length)
    assert long_.any() and (rank[long_] < HABIT.max_order).all() and (rank[long_] >= 1).all()
    assert (rank[deep.order == 0] == 0).all()


def test_a_limb_within_the_habits_orders_grows_by_its_own():
    tree = drawn_tree(4)
    np.testing.assert_array_equal(rank_of_drawn(tree, HABIT), tree.order)
