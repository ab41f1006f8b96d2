import numpy as np
import pytest
from drawn import box, cloud, edge, graph_of, measured, painted, ring, roles

from sketchtree.sketch.roles.shadow import shadows

TREE = [[(0, 0), (0, 100)], [(0, 50), (35, 85)]]
FLAT = ring(30, (6, -2), high=7)


@pytest.mark.parametrize("shape", [FLAT, painted(ring(18, (6, -2), high=5)[:-1]), ring(30, (33, 1), high=7), painted(ring(12, (0, 0), high=4)[:-1])])
def test_a_flat_shape_around_or_beside_the_foot_is_a_shadow(shape):
    graph = graph_of(*TREE, shape)
    assert roles(graph) == {"s2": "shadow"} and len(graph.limb_id) == 2


@pytest.mark.parametrize("shape", [ring(8, (0, 0)), ring(30, (0, 60), high=7), ring(20, (120, 0), high=5), ring(4, (0, 0), high=1)])
def test_round_high_distant_and_tiny_shapes_are_none(shape):
    m, free = measured(*TREE, shape)
    assert shadows(m, free, free) == []


def test_a_shadow_under_a_trunk_of_two_edges():
    graph = graph_of(cloud(40), edge(-8), edge(8), ring(45, (20, -2), high=9))
    assert roles(graph) == {"s0": "crown", "s3": "shadow"} and len(graph.limb_id) == 1


def test_a_shadow_far_wider_than_a_painted_tree_is_ground():
    graph = graph_of(*TREE, painted(box(200, 12, y=-10)))
    assert roles(graph) == {"s2": "ground"}


def test_mirror_and_scale_do_not_matter():
    for turn in (np.array([-1.0, 1.0]), np.array([300.0, 300.0])):
        graph = graph_of(*(np.array(line) * turn for line in TREE), FLAT * turn)
        assert roles(graph) == {"s2": "shadow"}
