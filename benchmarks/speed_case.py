"""Which drawing has about so many segments? One for `speed`, from our own families."""

import numpy as np

from benchmarks.drawing import Hand, draw
from benchmarks.families import FAMILIES
from sketchtree.sketch.graph import SketchGraph

NEAR = 0.04  # share of the segments asked for
_SEEDS = range(4)  # trees of a family that are tried


def tree_of_segments(segments: int) -> SketchGraph:
    """The exact graph of a drawn tree with about `segments` drawn segments (from 10 to some hundreds).

    Of the grown families, in a fixed order, the first drawing within `NEAR` is taken, else the nearest.
    """
    trees = (grow(np.random.default_rng(seed)) for grow in FAMILIES.values() for seed in _SEEDS)
    nearest = None
    for tree in trees:
        for graph in _bisected(tree, segments):
            if nearest is None or _miss(graph, segments) < _miss(nearest, segments):
                nearest = graph
            if _miss(nearest, segments) <= NEAR * segments:
                return nearest
    return nearest


def _miss(graph: SketchGraph, segments: int) -> int:
    return abs(graph.segment_count - segments)


def _bisected(tree, segments: int):
    """Drawings of one tree, their counts of segments ever nearer to `segments`: more strokes are more segments."""
    low, high = 1, segments
    while high - low > 1:
        middle = (low + high) // 2
        graph = _drawn(tree, middle)
        yield graph
        low, high = (middle, high) if graph.segment_count < segments else (low, middle)


def _drawn(tree, strokes: int) -> SketchGraph:
    hand = Hand(azimuth=0.5, strokes=strokes)
    return draw(tree, hand, name="speed", family="grown", rng=np.random.default_rng(0)).graph
