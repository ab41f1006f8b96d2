"""What a stroke is depends neither on where it lies, how large, in what order or direction it was drawn, nor on left and right."""

import dataclasses

import numpy as np
import pytest
from drawn import box, cloud, drawing, edge, painted, ring, roles, scribble, wedge

from sketchtree.sketch.reading import sketch_graph
from sketchtree.sketch.strokes import Sketch

GROUND = [(-90, 0), (95, 1)]
DRAWINGS = {
    "blob and edges": drawing(cloud(40), edge(-8), edge(8.5)),
    "one contour": drawing(np.vstack([edge(-8), ring(40, begin=-1.3, end=1.45 * np.pi)[::-1], edge(8.5)[::-1]])),
    "three arcs": drawing(ring(25, (-35, 70), 20, 1.4, 5.0), ring(30, (0, 100), 20, -0.3, 3.5), ring(25, (35, 70), 20, -1.9, 1.4), edge(-8, high=55), edge(9, high=55)),
    "fir": drawing(*(painted(wedge(*tier)) for tier in ((100, 40, 60), (80, 75, 55), (60, 110, 50))), painted(box(18, 44, x=1))),
    "scribble": drawing(scribble(), [(1, 0), (0, 60)]),
    "roots and ground": drawing([(0, 0), (2, 100)], [(1, 60), (30, 95)], [(1, 50), (-32, 85)], GROUND, [(0, 0), (-30, -25)], [(0, 0), (28, -28)]),
    "shadow and grass": drawing(cloud(40), edge(-8), edge(9), ring(45, (20, -2), high=9), [(-70, 0), (70, 0)], [(-60, 0), (-58, 6)]),
    "crown open on one side": drawing(edge(-12, high=60)[::-1], np.vstack([edge(12, high=60), ring(30, (25, 85), 20, -1.0, 1.5)]), ring(26, (4, 106), 14, 0.3, 3.3)),
    "painted": drawing(painted(cloud(50, (0, 110))), painted([(-8, 0), (8, 0), (6, 60), (40, 110), (34, 114), (0, 75), (-34, 118), (-40, 112), (-6, 60)])),
    "loops on limbs": drawing([(0, 0), (0, 90)], [(0, 50), (40, 85)], [(0, 45), (-38, 80)], ring(18, (0, 105)), ring(18, (52, 95)), ring(18, (-50, 90))),
}


def changed(sketch, points=lambda p: p, order=lambda strokes: strokes):
    return Sketch(tuple(order([dataclasses.replace(stroke, points=points(stroke.points)) for stroke in sketch.strokes])))


def reading(sketch):
    graph = sketch_graph(sketch)
    below = int(graph.root[graph.limb_first].sum())
    return roles(graph), len(graph.crown), len(graph.limb_id), below, int(graph.is_base.sum())


CHANGES = {
    "moved": dict(points=lambda p: p + (1234.5, -987.25)),
    "larger": dict(points=lambda p: 1e4 * p),
    "smaller": dict(points=lambda p: 1e-4 * p),
    "mirrored": dict(points=lambda p: p * (-1.0, 1.0)),
    "the other way round": dict(points=lambda p: p[::-1]),
    "last first": dict(order=lambda strokes: strokes[::-1]),
    "shuffled": dict(order=lambda strokes: [strokes[k] for k in np.random.default_rng(5).permutation(len(strokes))]),
}


@pytest.mark.parametrize("change", CHANGES)
@pytest.mark.parametrize("name", DRAWINGS)
def test_every_drawing_is_read_alike(name, change):
    assert reading(changed(DRAWINGS[name], **CHANGES[change])) == reading(DRAWINGS[name])


@pytest.mark.parametrize("name", DRAWINGS)
def test_nothing_is_dropped_in_silence(name):
    sketch = DRAWINGS[name]
    graph = sketch_graph(sketch)
    told = {a.stroke for a in graph.attachments} | {role.stroke for role in graph.roles}
    assert told == {stroke.id for stroke in sketch.strokes}
    assert all(role.reason for role in graph.roles)


@pytest.mark.parametrize("name", ["blob and edges", "one contour", "three arcs", "fir", "scribble", "crown open on one side"])
def test_a_crown_on_a_trunk_is_one_limb_under_a_crown(name):
    _, crowns, limbs, below, stems = reading(DRAWINGS[name])
    assert crowns >= 1 and (limbs, below, stems) == (1, 0, 1)
