"""Small lines and drawings to put to the joining, and the graph they make. Shared by this folder's tests."""

import numpy as np

from sketchtree.sketch.joining.attach import Hanging, attach
from sketchtree.sketch.joining.cleaning import clean
from sketchtree.sketch.joining.joints import Limb, limbs_of
from sketchtree.sketch.joining.lines import Line, extent
from sketchtree.sketch.joining.segments import Rows, columns
from sketchtree.sketch.reading import sketch_graph
from sketchtree.sketch.strokes import Sketch, Stroke

TRUNK = [(0, 0), (0, 100)]  # most small drawings here have it: H is 100


def line(points, name="s0", row=0, width=np.nan, begun=np.nan) -> Line:
    """A line of those points; `width` one for all, or one a point."""
    points = np.array(points, float)
    return Line(row, name, points, np.broadcast_to(np.asarray(width, float), len(points)).copy(), begun)


def lines(*strokes, **columns) -> list[Line]:
    """Lines named s0, s1, …; a column holds one value a line."""
    rows = [{name: values[k] for name, values in columns.items()} for k in range(len(strokes))]
    return [line(points, f"s{k}", k, **rows[k]) for k, points in enumerate(strokes)]


def random_lines(seed: int, count: int, points: int = 5) -> list[Line]:
    """A trunk and lines that wander about it, in a drawing about 100 high; some touch, some cross, some are far off."""
    rng = np.random.default_rng(seed)
    made = [np.array([(0, 0), (1, 30), (-1, 70), (0, 100)], float)]
    for _ in range(count - 1):
        near = made[rng.integers(len(made))]
        foot = near[rng.integers(len(near))] + rng.normal(0, rng.choice([0.1, 1.0, 5.0]), 2)
        turn = rng.uniform(0, 2 * np.pi) + np.cumsum(rng.normal(0, 0.3, points - 1))
        step = rng.uniform(3, 12) * np.stack([np.cos(turn), np.sin(turn)], 1)
        walk = foot + np.vstack([np.zeros(2), np.cumsum(step, axis=0)])
        made.append(walk[::-1] if rng.random() < 0.5 else walk)
    return lines(*made)


def hung(parent, end=None, s=None) -> Hanging:
    """How lines hang, where only that matters."""
    count = len(parent)
    zeros = np.zeros(count)
    end = np.zeros(count, int) if end is None else np.array(end)
    s = zeros.copy() if s is None else np.array(s, float)
    return Hanging(np.array(parent), end, s, zeros, zeros, ((),) * count)


def grown(*strokes) -> tuple[list[Limb], dict[str, np.ndarray], Rows]:
    """(limbs, columns, rows) of strokes, joined as the reader joins them."""
    cleaned = clean(lines(*strokes)).lines
    limbs = limbs_of(cleaned, attach(cleaned))
    return (limbs, *columns(limbs, extent(cleaned)))


def read(*strokes, **options):
    """The sketch graph of strokes s0, s1, …, given by their points."""
    return sketch_graph(Sketch(tuple(Stroke(f"s{k}", points) for k, points in enumerate(strokes))), **options)


def parent_of(graph) -> dict[str, str | None]:
    """The parent of every stroke, as reported."""
    return {a.stroke: a.parent for a in graph.attachments}
