import numpy as np
import pytest
from drawn import cloud, edge, graph_of, painted, ring, roles

TREE = [[(0, 0), (0, 100)], [(0, 50), (45, 85)], [(0, 40), (-45, 75)]]
CROWN = [cloud(50, (0, 100)), edge(-8, high=60), edge(8, high=60)]


@pytest.mark.parametrize("made", [lambda points: points, lambda points: painted(points[:-1])])
def test_several_small_closed_shapes_are_leaves(made):
    shapes = [made(ring(3, place, 14)) for place in ((48, 88), (-48, 78), (0, 104), (30, 70))]
    graph = graph_of(*TREE, *shapes)
    assert roles(graph) == {f"s{k}": "leaves" for k in range(3, 7)} and len(graph.limb_id) == 3


def test_two_may_be_anything():
    graph = graph_of(*TREE, ring(3, (48, 88), 14), ring(3, (-48, 78), 14))
    assert "leaves" not in roles(graph).values()


def test_fruit_in_a_crown_is_no_wood():
    fruit = [ring(4, place, 12) for place in ((-20, 95), (10, 115), (22, 85), (-5, 75))]
    graph = graph_of(*CROWN, *fruit)
    assert len(graph.limb_id) == 1 and [roles(graph)[f"s{k}"] for k in range(3, 7)] == ["leaves"] * 4


def test_an_arc_in_the_crown_that_touches_no_branch_is_foliage():
    graph = graph_of(*CROWN, ring(12, (25, 110), 16, 0.2, 2.8))
    assert roles(graph)["s3"] == "leaves" and len(graph.limb_id) == 1


def test_lobes_that_hang_together_end_to_end_are_foliage_too():
    lobes = [ring(9, (-20 + 18 * k, 115), 14, np.pi, 0.0) for k in range(3)]
    graph = graph_of(*CROWN, *lobes)
    assert [roles(graph).get(f"s{k}") for k in (3, 4, 5)] == ["leaves"] * 3


def test_curved_limbs_in_a_crown_stay_and_so_do_those_on_them():
    bow = np.c_[-40 * np.sin(np.linspace(0, 1.3, 20)), 55 + 40 * np.linspace(0, 1, 20)]
    at = bow[8]
    on_it = at + np.c_[-15 * (1 - np.cos(np.linspace(0, 1.4, 15))), 25 * np.sin(np.linspace(0, 1.4, 15))]
    graph = graph_of(cloud(50, (0, 100)), [(0, 0), (0, 120)], bow, on_it)
    assert roles(graph) == {"s0": "crown"} and len(graph.limb_id) == 3


def test_dashes_in_a_bare_crown_are_foliage_and_twigs_on_a_limb_are_not():
    dashes = [[(x, y), (x + 5, y + 3)] for x, y in ((-25, 100), (5, 120), (20, 95), (-10, 85))]
    graph = graph_of(*CROWN, *dashes)
    assert len(graph.limb_id) == 1 and [roles(graph).get(f"s{k}") for k in range(3, 7)] == ["leaves"] * 4
    limbed = graph_of(cloud(50, (0, 100)), [(0, 0), (0, 140)], [(0, 80), (5, 90)], [(0, 90), (-5, 100)], [(0, 100), (5, 110)])
    assert roles(limbed) == {"s0": "crown"} and len(limbed.limb_id) == 4
