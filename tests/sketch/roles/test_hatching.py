import numpy as np
from drawn import graph_of, measured, roles

from sketchtree.sketch.roles.hatching import hatching

TREE = [[(0, 0), (0, 100)], [(0, 50), (45, 85)], [(0, 40), (-45, 75)]]


def bars(place, count=7, length=8.0, step=2.0, way=(0.7, 0.7)):
    place, way = np.array(place, float), np.array(way)
    across = np.array([-way[1], way[0]])
    return [np.array([place + across * step * k, place + across * step * k + way * length]) for k in range(count)]


def test_short_parallel_strokes_that_grow_from_nothing_are_hatching():
    graph = graph_of(*TREE, *bars((30, 20)))
    assert roles(graph) == {f"s{k}": "hatching" for k in range(3, 10)} and len(graph.limb_id) == 3


def test_few_or_scattered_or_crossing_ways_are_none():
    for strokes in (bars((30, 20), count=4), [bar * (1, 1 if k % 2 else -1) + (9 * k, 0) for k, bar in enumerate(bars((-40, 20)))]):
        m, free = measured(*TREE, *strokes)
        assert hatching(m, free, free, 100.0) == []


def test_the_twigs_of_a_spruce_are_parallel_and_stay():
    limb = [(0, 60), (60, 60)]
    twigs = [[(8 * k + 4, 60), (8 * k + 9, 52)] for k in range(6)]
    graph = graph_of([(0, 0), (0, 100)], limb, *twigs)
    assert roles(graph) == {} and len(graph.limb_id) == 8


def test_direction_order_and_scale_do_not_matter():
    strokes = [np.array(line, float) for line in (*TREE, *bars((30, 20)))]
    for other in ([line[::-1] for line in strokes], [1e3 * line for line in strokes], [line * (-1, 1) for line in strokes]):
        assert list(roles(graph_of(*other))) == [f"s{k}" for k in range(3, 10)]
    assert len(roles(graph_of(*strokes[::-1]))) == 7
