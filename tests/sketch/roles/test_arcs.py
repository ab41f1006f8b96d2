import numpy as np
from drawn import edge, graph_of, measured, ring, roles

from sketchtree.sketch.roles.arcs import crown_of_arcs

ARCS = [
    ring(25, (-35, 70), 20, 0.7 * np.pi - 0.8, 1.6 * np.pi),
    ring(30, (0, 100), 20, -0.1 * np.pi, 1.1 * np.pi),
    ring(25, (35, 70), 20, -0.6 * np.pi, 0.45 * np.pi),
]
EDGES = [edge(-8, high=55), edge(8, high=55)]


def test_three_bows_around_a_trunk_are_one_crown():
    graph = graph_of(*ARCS, *EDGES)
    assert roles(graph) == {"s0": "crown", "s1": "crown", "s2": "crown"}
    assert len(graph.crown) == 1 and len(graph.limb_id) == 1
    assert (np.ptp(graph.crown[0], axis=0) >= (110, 80)).all()


def test_the_direction_of_an_arc_and_their_order_do_not_matter():
    one = graph_of(*ARCS, *EDGES).crown[0]
    other = graph_of(ARCS[2][::-1], EDGES[1], ARCS[0], EDGES[0], ARCS[1][::-1]).crown[0]
    np.testing.assert_allclose(one.min(0), other.min(0), atol=1e-6)
    np.testing.assert_allclose(one.max(0), other.max(0), atol=1e-6)


def test_two_bows_far_apart_close_nothing():
    m, free = measured(ARCS[0], ARCS[2], *EDGES)
    assert crown_of_arcs(m, free, free) is None


def test_limbs_that_bow_outward_from_a_trunk_are_no_crown():
    angle = np.linspace(0, 0.6 * np.pi, 20)
    limbs = [np.c_[sign * 40 * np.sin(angle), 20 + k * 15 + 30 * (1 - np.cos(angle))] for sign in (-1, 1) for k in range(3)]
    m, free = measured([(0, 0), (0, 110)], *limbs)
    assert crown_of_arcs(m, free, free) is None
    assert len(graph_of([(0, 0), (0, 110)], *limbs).limb_id) == 7


def test_flat_pieces_between_the_bows_are_part_of_the_outline():
    flat = np.c_[np.linspace(-25, 25, 12), 120 + 2 * np.sin(np.linspace(0, np.pi, 12))]
    bows = [ring(28, (sign * 28, 92), 20, *((0.5 * np.pi, 1.55 * np.pi) if sign < 0 else (-0.55 * np.pi, 0.5 * np.pi))) for sign in (-1, 1)]
    graph = graph_of(*bows, flat, *EDGES)
    assert roles(graph) == {"s0": "crown", "s1": "crown", "s2": "crown"} and len(graph.limb_id) == 1
