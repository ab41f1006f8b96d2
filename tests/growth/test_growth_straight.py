"""A tree of curved rows as one of straight pieces, and back."""

import numpy as np
import pytest
from growth_trees import crown, curved, same

from sketchtree.growth.straight import Straight, straightened


def test_every_drawn_point_becomes_a_row():
    tree = curved()
    pieces = straightened(tree)
    assert len(pieces) == len(tree) + len(tree.curve_points) and len(pieces.curve_points) == 0
    assert np.array_equal(pieces.tip[[1, 2, 3]], tree.curve(1)[1:])


def test_radii_between_are_between():
    pieces = straightened(curved())
    assert (np.diff(pieces.radius[[0, 1, 2, 3]]) < 0).all() and pieces.radius[3] == 0.06


def test_pieces_keep_limb_stroke_and_kind():
    tree = curved()
    straight = Straight.of(tree)
    for name in ("limb", "stroke", "kind", "order", "tree"):
        assert np.array_equal(getattr(straight.pieces, name), getattr(tree, name)[straight.row])


def test_a_tree_without_curves_is_its_own_pieces():
    tree = crown()
    assert straightened(tree) is tree


def test_back_again_it_is_the_same_tree():
    tree = curved()
    straight = Straight.of(tree)
    assert same(straight.back(straight.pieces.tip, straight.pieces.radius, np.ones(len(straight.row))), tree)


def test_a_row_ends_where_its_last_piece_has_grown_to():
    straight = Straight.of(curved())
    grown = np.array([1, 1, 0.5, 0, 0, 0])
    tip = straight.pieces.tip.copy()
    tip[2:] = [0.1, 1.5, 0]
    young = straight.back(tip, straight.pieces.radius, grown)
    assert len(young) == 2
    assert young.curve(1) == pytest.approx(np.array([[0, 0, 0], [0.1, 1, 0], [0.1, 1.5, 0]]))
