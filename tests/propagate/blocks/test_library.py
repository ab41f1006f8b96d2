import dataclasses

import numpy as np
from tests.propagate.worlds import HABIT, THETA, drawn_tree

from sketchtree.parameters import TreeParameters
from sketchtree.propagate.blocks.block import blocks_of, blocks_of_parameters
from sketchtree.propagate.blocks.library import library

SUPPLEMENT = blocks_of_parameters(THETA, HABIT)
NONE = SUPPLEMENT.select(np.zeros(len(SUPPLEMENT), bool))


def test_blocks_of_the_order_asked_for_are_chosen():
    lib = library(NONE, SUPPLEMENT, THETA, HABIT.max_order, None)
    order, place = np.repeat(np.arange(4), 50), np.tile(np.linspace(0, 0.999, 50), 4)
    block = lib.choose(lib.lateral, order, place, np.full(200, 0.5))
    np.testing.assert_array_equal(lib.blocks.order[block], order)


def test_blocks_from_a_similar_place_are_chosen():
    lib = library(NONE, SUPPLEMENT, THETA, HABIT.max_order, None)
    rng = np.random.default_rng(0)
    place = rng.uniform(0, 1, 2000)
    block = lib.choose(lib.lateral, np.ones(2000, int), place, rng.uniform(0, 1, 2000))
    assert np.abs(lib.blocks.zone[block] - place).mean() < 0.1


def test_likelier_blocks_are_chosen_more_often():
    at_node = (SUPPLEMENT.order == 1) & (np.abs(SUPPLEMENT.position - 0.45) < 0.01)
    same = SUPPLEMENT.select(at_node)
    lean = np.where(same.apical, THETA.mu_alpha, THETA.mu_beta)
    off = np.where(same.owner % 2 == 0, 0.0, 1.5 * THETA.sigma_beta)
    blocks = dataclasses.replace(same, divergence=lean + np.where(same.apical, 0.0, off))
    lib = library(NONE, blocks, THETA, 1, None)
    rng = np.random.default_rng(0)
    block = lib.choose(lib.lateral, np.ones(4000, int), np.full(4000, 0.45), rng.uniform(0, 1, 4000))
    share = np.mean(block % 2 == 0)
    assert 0.55 < share < 0.75  # exp(−0.5 · 1.5² / 2) = 0.57 to one


def test_the_trees_own_blocks_claim_their_part():
    own = blocks_of(drawn_tree(8))
    theta = TreeParameters(1.0, 0.5, 0.2, 0.5, 0.9, 0.5, 0.0, 1.0)
    lib = library(own, SUPPLEMENT, theta, HABIT.max_order, None)
    trunk = lib.lateral[0]
    share = np.mean(trunk < len(own))
    assert 0.2 < share < 1.0
    assert np.mean(lib.lateral[2] < len(own)) == 0.0  # a sketch of trunk and limbs says nothing about twigs


def test_one_stroke_more_changes_few_choices():
    few, more = blocks_of(drawn_tree(6)), blocks_of(drawn_tree(7))
    one, two = (library(own, SUPPLEMENT, THETA, HABIT.max_order, None) for own in (few, more))
    same = one.blocks.id[one.lateral] == two.blocks.id[two.lateral]
    assert same[1:].all()
    assert same[0].mean() > 0.7


def test_part_of_a_whorl_claims_less_than_a_whole_one():
    whorled = blocks_of_parameters(THETA, dataclasses.replace(HABIT, arrangement="whorled", whorl=5))
    own = blocks_of(drawn_tree(8))
    single = library(own, SUPPLEMENT, THETA, HABIT.max_order, None)
    fifth = library(own, whorled, THETA, HABIT.max_order, None)
    assert np.mean(fifth.lateral[0] < len(own)) < np.mean(single.lateral[0] < len(own))


def test_an_exemplar_tells_the_spacing_and_the_length_of_limbs():
    tree = drawn_tree(12, height=9.0)
    blocks = blocks_of(tree)
    lib = library(NONE, blocks, THETA, 3, tree)
    assert 0 < lib.spacing[0] < 0.2 and np.isnan(lib.spacing[2])
    assert lib.longest[1] <= 3.5 * np.sqrt(1.64) / tree.height + 0.1
    assert 0.2 < lib.bare[0] < 0.6 and lib.bare[1] == 0.15


def test_deeper_orders_than_known_are_served_by_the_deepest():
    blocks = blocks_of(drawn_tree(12))
    lib = library(NONE, blocks, THETA, 5, None)
    assert (lib.blocks.lateral_count[lib.lateral] > 0).all()
    assert lib.blocks.has_apical[lib.apical].all()
