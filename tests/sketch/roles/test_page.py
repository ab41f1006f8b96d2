import dataclasses

import numpy as np
import pytest
from drawn import box, closed, drawing, painted, roles

from sketchtree.sketch.reading import sketch_graph

PAGE = (-60.0, -10.0, 60.0, 120.0)
STEM = [(0, 0), (0, 90)]


def read(*things, page=PAGE):
    return sketch_graph(dataclasses.replace(drawing(*things), page=page))


@pytest.mark.parametrize(
    "tip, edge, place", [((90, 80), "right", (60, 70)), ((-90, 80), "left", (-60, 70)), ((0, 150), "top", (0, 120)), ((70, 50), "right", (60, 50))]
)
def test_a_limb_that_runs_out_over_the_edge_is_reported_where_it_leaves(tip, edge, place):
    graph = read(STEM, [(0, 50), tip])
    (cut,) = graph.cuts
    assert cut.edge == edge and cut.stroke == "s1" and cut.point == pytest.approx(place, abs=0.5)
    assert f"({edge})" in " ".join(graph.warnings) and "cuts the tree at 1 place" in " ".join(graph.warnings)


def test_several_tips_on_one_edge_are_cut_and_one_alone_is_not():
    graph = read(STEM, [(0, 50), (60, 70)], [(0, 60), (60, 95)])
    assert {cut.edge for cut in graph.cuts} == {"right"} and len(graph.cuts) == 2
    assert read(STEM, [(0, 50), (60, 70)]).cuts == ()


def test_limbs_along_the_edge_and_the_foot_on_it_are_not_cut():
    assert read([(0, -10), (0, 90)], [(0, 50), (59.9, 60), (59.9, 80)], [(0, 60), (59.9, 70), (59.9, 95)]).cuts == ()


def test_without_a_page_nothing_is_cut():
    assert read(STEM, [(0, 50), (900, 80)], page=None).cuts == ()


@pytest.mark.parametrize("made", [closed, painted])
def test_a_rectangle_around_everything_is_paper(made):
    graph = read(made(box(140, 140, y=-20)), STEM, [(0, 50), (40, 80)])
    assert roles(graph) == {"s0": "paper"} and len(graph.limb_id) == 2


def test_a_rectangle_that_leaves_something_out_is_none():
    graph = read(closed(box(100, 95, y=-5)), STEM, [(0, 50), (80, 80)], page=None)
    assert "paper" not in roles(graph).values()


def test_order_and_scale_do_not_matter():
    lines = [np.array(STEM, float), np.array([(0, 50), (90, 80)], float), np.array([(0, 60), (-90, 90)], float)]
    for other, factor in ((lines[::-1], 1.0), ([line[::-1] for line in lines], 1.0), ([line * 1e3 for line in lines], 1e3)):
        graph = read(*other, page=tuple(factor * value for value in PAGE))
        assert sorted(cut.edge for cut in graph.cuts) == ["left", "right"]
