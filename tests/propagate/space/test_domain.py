import numpy as np
import pytest
from tests.propagate.worlds import HABIT, circle, drawn_tree

from sketchtree.propagate.space.domain import Domain
from sketchtree.propagate.space.envelope import Envelope

TREE = drawn_tree()


def test_without_a_drawn_crown_it_reaches_half_the_height_beyond_the_drawing():
    domain = Domain.of(TREE, None, HABIT, 8.0)
    np.testing.assert_allclose(domain.low[[0, 2]], TREE.tip.min(axis=0)[[0, 2]] - 4.0 - domain.influence)
    np.testing.assert_allclose(domain.high, TREE.tip.max(axis=0) + 4.0 + domain.influence)


def test_a_drawn_crown_is_held_and_little_more():
    envelope = Envelope.from_outlines([circle(radius=6.0)])
    domain = Domain.of(TREE, envelope, HABIT, 8.0)
    low, high = envelope.bounds
    assert (domain.low <= low).all() and (domain.high >= high).all()
    assert domain.high[0] <= high[0] + domain.influence + 1e-9


def test_it_holds_points_of_space_and_of_the_page():
    domain = Domain.of(TREE, None, HABIT, 8.0)
    np.testing.assert_array_equal(domain.holds(np.array([[0, 4, 0], [0, 4, 99.0]])), [True, False])
    np.testing.assert_array_equal(domain.holds(np.array([[0, 4], [99.0, 4]])), [True, False])


@pytest.mark.parametrize("most", [2_000, 50_000, 1_000_000])
def test_a_grid_has_no_more_corners_than_asked_and_tells_the_influence_apart(most):
    domain = Domain.of(TREE, None, HABIT, 8.0)
    low, high, pitch, band = domain.grid(np.array([2.0, -50, -50]), np.array([2.0, 50, 50]), most)
    assert np.prod((high - low) / pitch + 3) <= most
    assert band >= domain.influence + 4 * pitch
    assert low[0] == pytest.approx(2.0 - band) and high[1] == pytest.approx(domain.high[1] + 2 * pitch)
