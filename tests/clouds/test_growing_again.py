"""A tree that grew toward points gives itself cycle after cycle, and similar ones by other figures."""

import numpy as np
import pytest
from scanned import bark

from sketchtree.cloud_growing import after, cycles, variation
from sketchtree.cloud_tree import CloudOptions, cloud_to_tree
from sketchtree.clouds.cloud import PointCloud
from sketchtree.clouds.growing.estimated import KILL
from sketchtree.clouds.growing.figures import changes
from sketchtree.clouds.tracing.traced import traced
from sketchtree.errors import OptionError
from sketchtree.keys import root_key
from sketchtree.options import TreeOptions

GROWN = CloudOptions(method="grown", up="y", figures=("internode=0.12",))


def made(wanted):
    return cloud_to_tree(PointCloud(bark(0.08)), key=root_key(0), wanted=wanted, tree=TreeOptions(leaf="none", wood="tubes"))


@pytest.fixture(scope="module")
def tree():
    return made(GROWN)


def test_angles_and_thickness_are_those_of_the_wood_that_was_traced(tree):
    seen = traced(tree.prepared.cloud.xyz, tree.feet.rows, foot_radius=tree.trunks[0].root / 2)
    assert tree.species.name == "estimated"
    assert tree.species.gamma == seen.gamma
    assert tree.species.growing.kill == KILL


def test_a_named_species_keeps_its_own_figures():
    assert made(CloudOptions(method="grown", up="y", species="peach", figures=("internode=0.12",))).species.gamma == 0.50


def test_cycles_go_from_the_first_shoot_to_the_whole_tree(tree):
    at = cycles(tree, 6)
    assert len(at) == 6 and (np.diff(at) >= 0).all()
    assert at[0] >= 1 and at[-1] == tree.grows.cycles
    assert after(tree, int(at[0])).skeleton.length.sum() > 0
    assert after(tree, int(at[-1])) is tree.model


def test_it_becomes_higher_from_tree_to_tree(tree):
    high = [after(tree, int(cycle)).skeleton.height for cycle in cycles(tree, 4)]
    assert high[0] < high[1] < high[-1]


def test_a_variation_stands_in_the_same_points_and_differs_in_one_figure(tree):
    other = variation(tree, changes("branching=1.4x")[0]).tree
    assert other.species.branching == pytest.approx(1.4 * tree.species.branching)
    assert (other.species.internode, other.species.gamma) == (tree.species.internode, tree.species.gamma)
    assert other.skeleton.height == pytest.approx(tree.skeleton.height, abs=0.3)
    assert other.skeleton.tip.shape != tree.skeleton.tip.shape or abs(other.skeleton.tip - tree.skeleton.tip).max() > 1e-3


def test_a_traced_tree_has_no_cycles():
    with pytest.raises(OptionError) as refused:
        cycles(made(CloudOptions(up="y")), 3)
    assert str(refused.value) == "A traced tree is where its points are: it did not grow. Make it by the method `grown`."
