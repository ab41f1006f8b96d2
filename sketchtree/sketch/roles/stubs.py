"""Which stout shape under a crown is its trunk? Cartoons give a tree a trunk as broad as it is long.

Such a shape is closed or painted, stands at the foot of the drawing, is narrower than the crown, and its top is in the crown or
at its lower edge. The trunk is the line up its middle, as wide as the shape on average. What is drawn inside it is bark. A slender
shape is left to `silhouette` and `outlined`.
"""

import dataclasses

import numpy as np
import shapely
from jaxtyping import Float, Int

from sketchtree.sketch.roles.brush import slenderness
from sketchtree.sketch.roles.found import Found
from sketchtree.sketch.roles.measures import Measures

OPEN = 0.15  # widest opening of an outline that counts as closed, of its size
STANDS = 0.06  # of the drawing's height: it comes this near to the foot
NARROW = 0.7  # of the crown's width: it is narrower
SLIM = (3.2, 5.0)  # length over mean width from which a drawn, a painted shape is no stub
SOLID = 0.5  # least part of its bounding box that it fills
NEAR = 0.06  # of the drawing's size: its top is this near to the crown
INSIDE = 0.9  # least part of a stroke inside a stub that makes it bark


@dataclasses.dataclass(frozen=True, eq=False)
class Stub:
    """A stout trunk."""

    row: int
    middle: Float[np.ndarray, "2 2"]  # from the ground up
    width: float
    inner: tuple[Found, ...]  # what is drawn inside it


def stubs(m: Measures, rows: Int[np.ndarray, " row"], crowns: list[Float[np.ndarray, "point 2"]]) -> list[Stub]:
    """The trunks among these strokes, under these outlines; the largest first."""
    low, high = m.drawing
    size, side = float((high - low).max()), m.high - m.low
    crown = shapely.union_all([shapely.make_valid(shapely.Polygon(points)).buffer(NEAR * size) for points in crowns])
    width = crown.bounds[2] - crown.bounds[0] - 2 * NEAR * size
    slim = slenderness(m.area, m.around) >= np.where(m.filled, SLIM[1], SLIM[0])
    fits = (m.low[:, 1] <= low[1] + STANDS * (high[1] - low[1])) & (side[:, 0] <= NARROW * width) & ~slim
    fits &= (m.opening <= OPEN * m.size) & (m.area >= SOLID * side.prod(1)) & (m.area > 0) & (np.diff(m.first_point) >= 3)
    found: list[Stub] = []
    for row in sorted(rows[fits[rows]].tolist(), key=lambda row: (-m.area[row], m.strokes[row].id)):
        points = m.strokes[row].points
        middle = np.array([[_middle(points, m.low[row, 1]), m.low[row, 1]], [_middle(points, m.high[row, 1]), m.high[row, 1]]])
        known = any(row == one.row for stub in found for one in stub.inner)
        if not known and shapely.contains_xy(crown, *middle[1]) and m.low[row, 1] < crown.bounds[1] + NEAR * size:
            found.append(Stub(row, middle, float(m.area[row] / side[row, 1]), _inner(m, rows, row)))
    return found


def _middle(points: Float[np.ndarray, "point 2"], level: float) -> float:
    """x in the middle of a shape's edge at this level, its top or foot."""
    near = points[np.abs(points[:, 1] - level) <= 0.1 * np.ptp(points[:, 1])]
    return float(0.5 * (near[:, 0].min() + near[:, 0].max()))


def _inner(m: Measures, rows, stub: int) -> tuple[Found, ...]:
    area = shapely.make_valid(shapely.Polygon(m.strokes[stub].points)).buffer(0.02 * m.size[stub])
    shapes = m.shapes(rows)
    within = shapely.length(shapely.intersection(shapes, area)) >= INSIDE * shapely.length(shapes)
    return tuple(Found(int(row), "hatching", "drawn inside the trunk", (("branch", 0.6),)) for row in rows[within & (rows != stub)])
