import numpy as np
import pytest
import shapely
from drawn import painted, roles

from sketchtree.sketch.reading import sketch_graph
from sketchtree.sketch.roles.ink import areas, is_ink
from sketchtree.sketch.roles.measures import Measures
from sketchtree.sketch.strokes import Sketch

PEN = 3.0
CROWNS = [shapely.Point(-14, 105).buffer(34), shapely.Point(26, 112).buffer(30)]
TRUNK = shapely.Polygon([(-8, 0), (8, 0), (6, 78), (-6, 78)])


def drawn_in_ink(shapes, scale=1.0):
    """The lines around these areas as one painted path: its outer border, then its holes."""
    lines = shapely.union_all([shapely.LineString(shape.exterior.coords).buffer(PEN / 2) for shape in shapes])
    outer, holes = lines.exterior, sorted(lines.interiors, key=lambda hole: hole.bounds)
    names = ["ink", *(f"ink-{k}" for k in range(2, len(holes) + 2))]
    return [painted(scale * np.array(ring.coords)[:-1], name) for name, ring in zip(names, [outer, *holes], strict=True)]


@pytest.mark.parametrize("scale", [1.0, 40.0])
def test_the_areas_of_an_ink_drawing_are_its_crown_and_its_trunk(scale):
    strokes = drawn_in_ink([*CROWNS, TRUNK], scale)
    graph = sketch_graph(Sketch(tuple(strokes)))
    assert len(graph.crown) == 1 and graph.is_base.sum() == 1
    both = shapely.union_all(CROWNS)
    assert shapely.Polygon(graph.crown[0] / scale).area == pytest.approx(both.area, rel=0.12)
    assert graph.xy[0] / scale == pytest.approx((0, 1), abs=2)
    assert set(roles(graph).values()) == {"crown"}


def test_ink_covers_little_of_what_it_encloses_and_a_silhouette_with_a_hole_much():
    ink = drawn_in_ink([*CROWNS, TRUNK])
    m = Measures.of(tuple(ink))
    assert is_ink(m, 0, list(range(1, len(ink))))
    ring = [painted(np.array(shapely.Point(0, 50).buffer(50).exterior.coords)[:-1], "a"), painted(np.array(shapely.Point(0, 50).buffer(20).exterior.coords)[:-1], "a-2")]
    assert not is_ink(Measures.of(tuple(ring)), 0, [1])
    assert not is_ink(m, 0, [])


def test_what_lies_between_limbs_is_a_gap():
    fork = shapely.Polygon([(-8, 0), (8, 0), (8, 30), (40, 80), (28, 84), (0, 40), (-28, 84), (-40, 80), (-8, 30)])
    bar = shapely.Polygon([(-36, 72), (36, 72), (36, 80), (-36, 80)]).difference(fork)
    ink = drawn_in_ink([fork, *(piece for piece in shapely.get_parts(bar)), shapely.Point(0, 120).buffer(42)])
    m = Measures.of(tuple(ink))
    found = areas(m, 0, list(range(1, len(ink))), set())
    assert found.wood and found.crown and len(found.gaps) >= 1


def test_without_an_area_on_the_ground_all_is_crown():
    strokes = drawn_in_ink([shapely.Point(0, 40).buffer(40), shapely.Point(40, 50).buffer(36)])
    graph = sketch_graph(Sketch(tuple(strokes)))
    assert graph.crown
