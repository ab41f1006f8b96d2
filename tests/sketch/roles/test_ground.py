import dataclasses

import numpy as np
import pytest
from drawn import cloud, drawing, edge, graph_of, measured, painted, ring, roles

from sketchtree.sketch.roles.ground import ground_lines, level_at
from sketchtree.sketch.roles.measures import Measures

TREE = [[(0, 0), (0, 100)], [(0, 50), (35, 85)], [(0, 40), (-30, 75)]]


def ground(*things):
    m, free = measured(*things)
    return [one.row for one in ground_lines(m, free, free)]


@pytest.mark.parametrize(
    "line",
    [
        [(-60, 0), (60, 0)],
        [(-60, 1), (-20, -2), (25, 2), (60, -1)],
        [(-70, -8), (70, 9)],  # a hillside
        np.c_[np.linspace(-80, 80, 30), -0.001 * np.linspace(-80, 80, 30) ** 2],  # a hill
        [(-60, 0), (0, -1)],  # on one side only
    ],
)
def test_a_level_line_that_a_stem_stands_on_is_the_ground(line):
    assert ground(*TREE, line) == [3]
    graph = graph_of(*TREE, line)
    assert len(graph.ground) == 1 and len(graph.limb_id) == 3 and roles(graph) == {"s3": "ground"}


@pytest.mark.parametrize("line", [[(0, 50), (60, 48)], [(-50, 60), (50, 60)], [(-5, 0), (5, 0)], [(-40, 0), (40, 45)], [(100, 0), (160, 0)]])
def test_a_limb_a_crossing_line_a_tick_a_slope_and_what_lies_apart_are_none(line):
    assert 3 not in ground(*TREE, line)


def test_an_ellipse_is_a_shadow_not_the_ground():
    assert ground(*TREE, ring(45, (10, -2), high=9)) == []


def test_grass_is_ground_and_so_is_grass_beside_grass():
    blades = [[(-50 + 3 * k, 0.5), (-49 + 3 * k, 7)] for k in range(3)]
    graph = graph_of(*TREE, [(-60, 0), (60, 0)], *blades, [(-44.5, 6), (-44, 10)])
    assert roles(graph) == {f"s{k}": "ground" for k in range(3, 8)}
    assert len(graph.limb_id) == 3


def test_a_twig_at_the_foot_of_a_stem_is_no_grass():
    graph = graph_of(*TREE, [(-60, 0), (60, 0)], [(0, 3), (5, 9)])
    assert roles(graph) == {"s3": "ground"} and len(graph.limb_id) == 4


def test_a_line_in_two_pieces_with_roots_below_is_the_ground():
    roots = [[(0, -10), (-25, -30)], [(0, -10), (28, -28)], [(0, -20), (10, -45)], [(-15, -22), (-20, -38)]]
    graph = graph_of([(0, -25), (0, 100)], *TREE[1:], [(-70, 0), (-4, -1)], [(4, -1), (70, 0)], *roots)
    assert {roles(graph)[name] for name in ("s3", "s4")} == {"ground"}
    assert graph.root.any() and graph.xy[graph.is_base][0] == pytest.approx((0, 0), abs=2)


def test_two_level_limbs_of_a_whorl_are_no_ground():
    whorls = [[(0, y), (sign * (150 - y) * 0.4, y)] for y in range(30, 130, 20) for sign in (-1, 1)]
    assert ground([(0, 0), (0, 150)], *whorls) == []


def test_a_line_as_thick_as_the_stem_on_it_is_a_limb():
    bough = drawing([(0, 0), (80, 12)], [(30, 5), (45, 60)], [(50, 8), (70, 50)]).strokes
    for width, expected in ((7.0, []), (1.0, [0])):
        strokes = (dataclasses.replace(bough[0], width=width, wood=True), *(dataclasses.replace(s, width=4.0, wood=True) for s in bough[1:]))
        m, free = Measures.of(strokes), np.ones(3, bool)
        assert [one.row for one in ground_lines(m, free, free)] == expected


def test_the_level_between_and_beyond_lines():
    lines = [np.array([(-10, 0), (0, 2)], float), np.array([(10, 4), (5, 4)], float)]
    np.testing.assert_allclose(level_at(lines, np.array([-20, -5, 2, 7, 30])), [0, 1, 2, 4, 4])


def test_a_tree_on_a_hill_keeps_its_two_edges():
    graph = graph_of(cloud(40), edge(-8, flare=2), edge(8, flare=2), np.c_[np.linspace(-120, 120, 30), 6 - 0.0012 * np.linspace(-120, 120, 30) ** 2])
    assert len(graph.limb_id) == 1 and not graph.root.any()


def test_a_painted_meadow_wider_than_the_tree_is_ground():
    graph = graph_of(*TREE, painted([(-90, -14), (90, -14), (90, -1), (-90, 1)]))
    assert roles(graph) == {"s3": "ground"} and len(graph.limb_id) == 3


def test_a_trunk_drawn_down_and_up_again_stands_on_its_lowest_part():
    graph = graph_of(cloud(40), [(-9, 45), (-9, 1), (9, 0), (9, 45)], [(-90, 0), (-20, 1), (90, 0)])
    assert roles(graph) == {"s0": "crown", "s2": "ground"} and len(graph.limb_id) == 1


def test_a_level_limb_to_one_side_of_a_trunk_that_goes_on_below_is_none():
    below = [[(0, 8), (-20, -4)], [(0, 12), (22, -2)], [(0, 4), (15, -10)]]
    assert ground([(0, -30), (0, 100)], [(-3, 22), (60, 24)], *below) == []
