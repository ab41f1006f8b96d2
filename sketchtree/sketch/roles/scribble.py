"""Which strokes are scribbles, and of what: a crown, a shaded trunk, or leaves?

A scribble runs again and again through a small space. What it covers (`masses`) says what it is: inside a crown it is foliage;
a large high one is the crown itself where no other is drawn; one that is slender and stands on the
ground is a trunk drawn back and forth. Small ones elsewhere are leaves.
"""

from dataclasses import dataclass

import numpy as np
import shapely
from jaxtyping import Bool, Float, Int

from sketchtree.sketch.roles.brush import even_border, middles
from sketchtree.sketch.roles.masses import border, bulk_and_trunk, mass
from sketchtree.sketch.roles.measures import Measures

DENSE = 4.0  # least length of a scribble, of its size
CROSSES = 8  # times that a scribble crosses itself …
REVERSALS, BACK = 5, -0.6  # … or turns back, and the cosine between before and after from which it does
LARGE = 0.3  # of the drawing's size: a larger scribble may be the crown itself, a smaller one leaves
INSIDE = 0.8  # least part of a scribble that lies in a crown
STANDS = 0.15  # of the drawing's height: a trunk comes this near to the foot
SLIM = 0.35  # greatest width of a scribbled trunk, of its length
STEPS = 96  # even steps along a scribble in which turning back is sought


@dataclass(frozen=True, eq=False)
class Scribble:
    """What one scribble stands for."""

    row: int
    role: str | None  # crown | leaves; None: wood, as `middle` says, or as it was drawn
    outline: Float[np.ndarray, "point 2"] | None = None  # of the crown
    middle: tuple[Float[np.ndarray, "point 2"], ...] = ()  # of what wood it covers


def scribbles(m: Measures, free: Bool[np.ndarray, " stroke"]) -> Int[np.ndarray, " row"]:
    """The strokes that run again and again through a small space: they cross themselves often, or, where they are
    small, turn back sharply again and again. An outline with many lobes does neither."""
    many = np.diff(m.first_point) > 8
    wild = np.flatnonzero(free & ~m.filled & many & (m.length >= DENSE * m.size) & (m.size > 0))
    if len(wild) == 0:
        return wild
    size = float((m.drawing[1] - m.drawing[0]).max())
    zigzag = (m.size[wild] < LARGE * size) & (_reversals(m.resampled(wild, STEPS)) >= REVERSALS)
    return wild[zigzag | (np.array([_crossings(m.strokes[row].points) for row in wild]) >= CROSSES)]


def _crossings(points: Float[np.ndarray, "point 2"]) -> int:
    """How often a line crosses itself: noded there, it falls into two pieces more each time."""
    line = shapely.LineString(points)
    return 0 if line.is_simple else (shapely.get_num_geometries(shapely.node(line)) - 1) // 2


def _reversals(points: Float[np.ndarray, "row step 2"]) -> Int[np.ndarray, " row"]:
    """How often lines turn back on themselves within two of their steps."""
    ahead, behind = points[:, 4:] - points[:, 2:-2], points[:, 2:-2] - points[:, :-4]
    back = (ahead * behind).sum(-1) < BACK * np.hypot(*np.moveaxis(ahead, -1, 0)) * np.hypot(*np.moveaxis(behind, -1, 0))
    return (np.diff(back.astype(int), axis=1) > 0).sum(1)


def meaning(m: Measures, row: int, crown: shapely.Geometry | None, *, alone: bool) -> Scribble:
    """What this scribble is. `crown`: the area of the crowns that are known; `alone`: nothing else is drawn but scribbles."""
    line = shapely.LineString(m.strokes[row].points)
    if crown is not None and line.intersection(crown).length >= INSIDE * line.length:
        return Scribble(row, "leaves")
    low, high = m.drawing
    size, height = float((high - low).max()), float(high[1] - low[1])
    area = mass(m.strokes[row].points)
    if area.is_empty:
        return Scribble(row, None)
    trunk = None if alone else _slim(area)
    if trunk is not None and m.low[row, 1] <= low[1] + STANDS * height:
        return Scribble(row, None, middle=(trunk,))
    if crown is None and m.size[row] >= LARGE * size and area.centroid.y >= low[1] + 0.35 * height:
        bulk, pieces = bulk_and_trunk(area)
        legs = tuple(leg for piece in pieces if (leg := _slim(piece)) is not None)
        return Scribble(row, "crown", border(bulk or area), legs)
    return Scribble(row, "leaves" if m.size[row] < LARGE * size and not alone else None)


def _slim(area: shapely.Polygon) -> Float[np.ndarray, "point 2"] | None:
    """The middle line of a slender area; None if it is none."""
    found = middles(even_border(border(area))[None])
    length = float(np.hypot(*np.diff(found.points[0], axis=0).T).sum())
    return found.points[0] if found.single[0] and found.width[0].mean() <= SLIM * length else None
