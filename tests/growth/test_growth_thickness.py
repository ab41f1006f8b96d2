"""How thick is wood that is still growing?"""

import numpy as np
import pytest
from growth_trees import crown, trunk_and_branch

from sketchtree.growth.layers import Layers
from sketchtree.growth.thickness import borne_share, radii
from sketchtree.traverse import generation, sum_to_root

TIMES = np.linspace(0, 1, 21)


def grown_at(tree, times):
    depth = generation(tree.parent)
    return np.clip(times * (depth.max() + 1) - depth[:, None] + 1, 0, 1)


def test_layers_keep_every_row_once_with_its_parent_in_an_earlier_layer():
    tree = crown()
    layers = Layers.of(tree.parent)
    assert np.array_equal(np.sort(layers.order), np.arange(len(tree)))
    rows = layers.order[1:]
    assert np.array_equal(layers.order[layers.parent[1:]], tree.parent[rows])
    assert all((np.diff(layers.parent[layer]) >= 0).all() for layer in layers.downwards())


def test_sums_over_layers_are_those_of_the_tree():
    tree = crown()
    layers, value = Layers.of(tree.parent), np.random.default_rng(0).random(len(tree))
    total = value[layers.order][:, None].copy()
    layers.sum_to_root(total)
    assert total[layers.place, 0] == pytest.approx(sum_to_root(tree.parent, value))


def test_a_growing_pieces_section_goes_with_the_wood_it_bears():
    tree = trunk_and_branch()
    layers = Layers.of(tree.parent)
    share = borne_share(layers, tree.length[layers.order], grown_at(tree, TIMES)[layers.order])[layers.place]
    assert share[1] == pytest.approx(sum_to_root(tree.parent, 1.0 * ~tree.is_base)[1] ** -1 * sum(grown_at(tree, TIMES)[1:]))
    radius = radii(layers, tree.radius[layers.order], share[layers.order])[layers.place]
    assert radius[2] ** 2 == pytest.approx(0.01**2 + (0.06**2 - 0.01**2) * share[2])


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_radii_never_shrink_and_end_as_they_were_given(dtype):
    tree = crown()
    layers = Layers.of(tree.parent)
    final = tree.radius[layers.order].astype(dtype)
    share = borne_share(layers, tree.length[layers.order].astype(dtype), grown_at(tree, TIMES)[layers.order].astype(dtype))
    radius = radii(layers, final, share)
    assert (np.diff(radius, axis=1) >= 0).all()
    assert np.array_equal(radius[:, -1], final)


def test_no_piece_is_thicker_than_its_parent_at_any_time():
    tree = trunk_and_branch().replace(radius=np.array([0.1, 0.09, 0.09, 0.09, 0.08, 0.08]))
    layers = Layers.of(tree.parent)
    share = borne_share(layers, tree.length[layers.order], grown_at(tree, TIMES)[layers.order])
    radius = radii(layers, tree.radius[layers.order], share)[layers.place]
    assert (radius[1:] <= radius[tree.parent[1:]]).all()
