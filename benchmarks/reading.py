"""How good is depth when the program has to read the drawing itself?

The reader's segments need not be the truth's. Every true node is sought on the drawn lines that the reader
took from the same stroke (from any stroke where it kept none), and takes the inferred depth there.
"""

import tempfile
from pathlib import Path

import numpy as np
from jaxtyping import Float

from benchmarks.drawing import Case
from sketchtree.mrf.lift import curve_depth
from sketchtree.sketch.graph import SketchGraph

FARTHEST = 0.03  # a node farther than this from any line was not read, H


def read_graph(case: Case) -> SketchGraph:
    """The case's SVG through the reader that the command line uses. Needs `case.svg`."""
    from sketchtree.sketch.formats import read_sketch
    from sketchtree.sketch.reading import sketch_graph

    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / f"{case.name}.svg"
        path.write_text(case.svg)
        return sketch_graph(read_sketch(path))


def matched_depth(
    case: Case, read: SketchGraph, depth: Float[np.ndarray, " read_segment"]
) -> tuple[Float[np.ndarray, " segment"], float]:
    """The read tree's depth at every true node, 0 at the root, and the share of nodes that were found."""
    point, stroke = _points(read, depth)
    found, seen = np.zeros(len(case.graph)), np.zeros(len(case.graph), bool)
    for row in range(len(case.graph)):
        name = case.graph.stroke_ids[case.graph.stroke[row]]
        own = stroke == (read.stroke_ids.index(name) if name in read.stroke_ids else -2)
        near = _nearest(point[own] if own.any() else point, case.graph.xy[row])
        if near[0] > FARTHEST * case.height and own.any():
            near = _nearest(point, case.graph.xy[row])
        seen[row] = near[0] <= FARTHEST * case.height
        found[row] = near[1] if seen[row] else found[max(case.graph.parent[row], 0)]
    return found - found[0], float(seen.mean())


def _points(read, depth):
    """Points along every drawn line, at most .5 % H apart, with their depth and stroke."""
    between = curve_depth(read, depth)
    step = 0.005 * read.height
    points, strokes = [], []
    for row in range(len(read)):
        above = max(int(read.parent[row]), 0)
        inner = between[read.curve_start[row] : read.curve_start[row + 1]]
        line = np.c_[read.curve(row), np.r_[depth[above] if read.parent[row] >= 0 else depth[row], inner, depth[row]]]
        count = np.maximum(1, np.ceil(np.linalg.norm(np.diff(line[:, :2], axis=0), axis=1) / step)).astype(int)
        index = np.r_[0, np.cumsum(count)]
        at = np.arange(index[-1] + 1)
        points.append(np.stack([np.interp(at, index, column) for column in line.T], axis=1))
        strokes.append(np.full(len(at), read.stroke[row]))
    return np.concatenate(points), np.concatenate(strokes)


def _nearest(point, target):
    distance = np.linalg.norm(point[:, :2] - target, axis=1)
    best = int(np.argmin(distance))
    return distance[best], point[best, 2]
