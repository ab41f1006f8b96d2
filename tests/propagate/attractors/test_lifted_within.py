"""Visible limbs keep to the depth of their crown, and to their places on the page."""

import numpy as np
import pytest
from tests.propagate.worlds import circle

from sketchtree.axes import NULL
from sketchtree.propagate.attractors.lifted_within import REACH, lifted_within
from sketchtree.propagate.attractors.revolved import Axes
from sketchtree.propagate.attractors.target import Target
from sketchtree.skeleton import Kind, TreeSkeleton

CROWN = Target.of_outlines([circle(0.0, 5, 2)], pixels=200)
TRUNK = np.array([[0.0, 0, 0], [0.0, 7, 0]])


def tree(forward: float) -> TreeSkeleton:
    """A trunk, a limb that comes `forward` metres while it goes 1 m aside, and a twig on it that comes half a metre more."""
    tip = [(0, 0, 0), (0, 4, 0), (0, 6.5, 0), (1, 5, forward), (1.2, 5.4, forward + 0.5)]
    curve = [(0.5, 4.4, 0.4 * forward)]
    return TreeSkeleton.from_columns(
        np.array([NULL, 0, 1, 1, 3]), np.array(tip, float), np.full(5, 0.05), order=np.array([0, 0, 0, 1, 2]), limb=np.array([1, 1, 1, 2, 3]), kind=np.full(5, int(Kind.DRAWN)),
        curve_points=np.array(curve), curve_start=np.array([0, 0, 0, 0, 1, 1]),
    )  # fmt: skip


def test_limbs_within_the_crown_stay_as_they_are():
    given = tree(1.0)
    kept = lifted_within(given, CROWN)
    np.testing.assert_array_equal(kept.tip, given.tip)
    np.testing.assert_array_equal(kept.curve_points, given.curve_points)


@pytest.mark.parametrize("forward", [2.5, 6.0, -4.0])
def test_a_limb_that_is_deeper_than_its_crown_is_laid_flatter_with_all_it_bears(forward):
    given = tree(forward)
    kept = lifted_within(given, CROWN)
    assert (Axes.about_crown(CROWN, TRUNK).out(kept.tip[3:4]) <= REACH + 0.02).all()
    assert abs(kept.tip[3, 2]) > 1.2 and np.sign(kept.tip[3, 2]) == np.sign(forward)
    np.testing.assert_allclose(kept.curve_points[0, 2] / kept.tip[3, 2], 0.4)
    assert abs(kept.tip[4, 2] - kept.tip[3, 2]) <= 0.5 + 1e-9


@pytest.mark.parametrize("forward", [0.5, 6.0])
def test_nothing_moves_on_the_page_and_the_trunk_not_at_all(forward):
    given = tree(forward)
    kept = lifted_within(given, CROWN)
    np.testing.assert_array_equal(kept.tip[:, :2], given.tip[:, :2])
    np.testing.assert_array_equal(kept.curve_points[:, :2], given.curve_points[:, :2])
    np.testing.assert_array_equal(kept.tip[:3], given.tip[:3])


def test_limbs_outside_the_foliage_keep_their_depths():
    """Of what no leaf is near, nobody knows how deep it is."""
    aside = Target.of_outlines([circle(20.0, 5, 2)], pixels=100)
    np.testing.assert_array_equal(lifted_within(tree(6.0), aside).tip, tree(6.0).tip)
