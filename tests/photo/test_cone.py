"""A conifer is known by its silhouette: a cone down to the ground whose leader is seen to the tip. All else is a broadleaf."""

import numpy as np
import pytest

from sketchtree.photo.cone import CrownShape
from sketchtree.photo.marked import Marked
from sketchtree.photo.trace.traced import Traced

FOOT = (200.0, 290.0)


def shape(width, *, low: float = 285.0, trunk_to: float = 15.0) -> CrownShape:
    """Of a crown from row 10 to row `low`, `width` giving pixels at shares of its height from the top."""
    mask = np.zeros((300, 400), bool)
    for row in range(10, int(low)):
        half = 0.5 * width((row - 10) / (low - 10))
        mask[row, int(200 - half) : int(200 + half)] = True
    trunk = np.array([FOOT, (200.0, trunk_to)])
    traced = Traced(np.array([-1, 0]), trunk, np.array([3.0, 1.0]), np.zeros(2, int), np.zeros(2, int))
    return CrownShape.of(mask, Marked(np.array([(0, 0), (399, 0), (399, 299), (0, 299)], float), (trunk,)), traced)


def cone(down):
    return 10 + 150 * down


def egg(down):
    return 150 * np.sqrt(max(1 - (2 * down - 1) ** 2, 0.0))


def test_a_cone_to_the_ground_with_its_leader_is_a_conifers():
    found = shape(cone)
    assert found.is_cone
    assert found.narrows < 0.5 and found.leader == pytest.approx(1.0, abs=0.03) and found.widest == 0.95


@pytest.mark.parametrize("why, found", [
    ("it is as wide above as below", shape(egg)),
    ("its trunk is bare for a quarter", shape(cone, low=215.0)),
    ("its trunk is lost in the crown", shape(cone, trunk_to=150.0)),
    ("it is as wide as high", shape(lambda down: 20 + 240 * down)),
    ("it is a thin shoot on a ball", shape(lambda down: 8 if down < 0.4 else egg((down - 0.4) / 0.6))),
])
def test_a_crown_that_lacks_one_trait_is_none(why, found):
    assert not found.is_cone, why


def test_of_no_foliage_nothing_is_said():
    trunk = np.array([FOOT, (100.0, 15.0)])
    assert CrownShape.of(np.zeros((300, 200), bool), Marked(trunk, (trunk,)), Traced(np.array([-1]), trunk[:1], np.ones(1), np.zeros(1, int), np.zeros(1, int))) is None
