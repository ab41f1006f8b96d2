import numpy as np
import pytest
from drawn import cloud, graph_of, measured, ring, roles, scribble

from sketchtree.sketch.roles.scribble import scribbles

zigzag = np.c_[np.tile([-4.0, 4.0], 15), np.linspace(0, 60, 30)]  # a trunk shaded back and forth


def test_a_scribble_on_a_stem_is_the_crown():
    graph = graph_of([(0, 0), (0, 60)], scribble())
    assert roles(graph) == {"s1": "crown"} and len(graph.limb_id) == 1
    assert np.ptp(graph.crown[0], axis=0) == pytest.approx((80, 80), rel=0.2)


def test_a_scribble_inside_an_outline_is_foliage():
    graph = graph_of([(0, 0), (0, 45)], cloud(45, (0, 85)), scribble(25, (0, 85)))
    assert roles(graph) == {"s1": "crown", "s2": "leaves"} and len(graph.crown) == 1


def test_a_trunk_drawn_back_and_forth_is_a_trunk():
    graph = graph_of(cloud(40), np.vstack([zigzag, zigzag[::-1] + (1.0, 1.0), zigzag + (0.5, -0.5)]))
    assert roles(graph) == {"s0": "crown"} and len(graph.limb_id) == 1
    assert np.abs(graph.xy[:, 0]).max() < 4


@pytest.mark.parametrize("line", [cloud(40, lobes=19), ring(40), np.c_[20 * np.sin(np.linspace(0, 12, 80)), np.linspace(0, 100, 80)]])
def test_lobes_circles_and_wavy_limbs_are_no_scribbles(line):
    m, free = measured([(0, 0), (0, 50)], line)
    assert len(scribbles(m, free)) == 0


def test_small_scribbles_at_twigs_are_leaves():
    limbs = [[(0, 0), (0, 120)], [(0, 50), (50, 90)], [(0, 60), (-50, 100)]]
    graph = graph_of(*limbs, scribble(9, (55, 95)), scribble(9, (-55, 105)))
    assert roles(graph) == {"s3": "leaves", "s4": "leaves"} and len(graph.limb_id) == 3


def test_scale_and_direction_do_not_matter():
    m, free = measured([(0, 0), (0, 60)], scribble())
    big, _ = measured([(0, 0), (0, 6000)], 100 * scribble()[::-1])
    np.testing.assert_array_equal(scribbles(m, free), scribbles(big, free))
