import dataclasses

import numpy as np
import pytest
from drawn import cloud, drawing, graph_of, roles

from sketchtree.sketch.reading import sketch_graph

TREE = [[(0, 0), (0, 100)], [(0, 60), (30, 95)], [(0, 50), (-32, 85)]]
ROOTS = [[(0, 0), (-30, -25)], [(0, 0), (28, -28)], [(-15, -12), (-20, -30)]]
GROUND = [(-70, 0), (70, 0)]


def rooted(graph):
    """(limbs above the ground, limbs below it)."""
    below = graph.root[graph.limb_first]
    return int((~below).sum()), int(below.sum())


def test_what_falls_to_both_sides_of_a_foot_is_root():
    graph = graph_of(*TREE, *ROOTS)
    assert rooted(graph) == (3, 3) and graph.xy[0] == pytest.approx((0, 0))
    assert "taken for roots" in graph.warnings[0]
    assert len(graph.above_ground().limb_id) == 3


@pytest.mark.parametrize("roots", [ROOTS[:1], [ROOTS[0], [(0, 0), (-20, -30)]], [[(0, 0), (-30, 8)], [(0, 0), (30, 9)]]])
def test_on_one_side_or_upward_they_are_none(roots):
    assert rooted(graph_of(*TREE, *roots))[1] == 0


def test_below_a_ground_line_everything_that_hangs_together_is_root():
    graph = graph_of(*TREE, GROUND, *ROOTS, [(-18, -24), (-38, -27)])
    assert rooted(graph) == (3, 4) and roles(graph) == {"s3": "ground"}


def test_lines_are_cut_where_they_pass_the_ground():
    graph = graph_of([(0, -40), (0, 100)], *TREE[1:], GROUND, [(0, -15), (25, -35)], [(0, -20), (-25, -38)])
    assert rooted(graph) == (3, 3) and graph.xy[graph.is_base][0] == pytest.approx((0, 0), abs=1)


def test_a_foot_a_little_below_the_ground_is_no_root():
    graph = graph_of([(0, -4), (0, 100)], *TREE[1:], GROUND)
    assert rooted(graph) == (3, 0)


def test_under_a_trunk_of_two_edges_roots_hang_on_its_middle():
    graph = graph_of(cloud(45, (0, 110)), [(-8, 65), (-8, 0)], [(8, 0), (8, 65)], [(-8, 0), (-30, -25)], [(0, 0), (2, -35)], [(8, 0), (35, -22)], GROUND)
    assert rooted(graph) == (1, 3) and graph.xy[0, 0] == pytest.approx(0, abs=1)


def test_names_win():
    sketch = drawing(*TREE, [(0, 0), (-30, -25)])
    named = dataclasses.replace(sketch.strokes[3], id="root left")
    graph = sketch_graph(dataclasses.replace(sketch, strokes=(*sketch.strokes[:3], named)))
    assert rooted(graph) == (3, 1)


def test_a_hanging_tree_s_drooping_limbs_are_no_roots():
    arms = [np.c_[np.linspace(0, x, 20), 80 + 25 * np.sin(np.linspace(0, np.pi, 20)) - np.linspace(0, 50, 20)] for x in (-50, -30, 30, 50)]
    assert rooted(graph_of([(0, 0), (0, 80)], *arms))[1] == 0


def test_order_direction_and_mirror_do_not_matter():
    lines = [np.array(line, float) for line in (*TREE, GROUND, *ROOTS)]
    for other in (lines[::-1], [line[::-1] for line in lines], [line * (-1, 1) for line in lines], [line * 1e4 for line in lines]):
        assert rooted(graph_of(*other)) == (3, 3)
