"""Which curve is the crown? What the file says, else a closed or nearly closed outline around the branches.

A stroke is a crown by its shape if its ends nearly meet, it is round rather than a thin loop (4πA/P² of its hull
times the part of the hull it fills ≥ ROUND), it is large and reaches high, and at least half of the other strokes'
upper ends lie in it or near it.
"""

import numpy as np
import shapely
from jaxtyping import Float

from sketchtree.sketch.roles.silhouette import is_blob
from sketchtree.sketch.strokes import Stroke

OPEN = 0.35  # widest opening of a nearly closed outline, of its larger side
ROUND = 0.2  # least 4πA/P² of the outline's convex hull, times its share of the hull's area
LARGE = 0.3  # least size of a crown, of the drawing's
HIGH = 0.6  # of the drawing's height: a crown reaches above it (a shadow on the ground does not)
NEAR = 0.1  # of the drawing's size: a tip this near to the outline counts as inside


def crown_strokes(strokes: list[Stroke]) -> list[int]:
    """Which of these unlabelled branch strokes are crown outlines by their shape."""
    if len(strokes) < 2:
        return []
    size = float(np.ptp(np.concatenate([s.points for s in strokes]), axis=0).max())
    tips = np.array([_upper_end(stroke) for stroke in strokes])
    found = [k for k, s in enumerate(strokes) if not s.labelled and _is_outline(s.points, size) and not (s.filled and not is_blob(s))]
    high = _level(strokes, HIGH)
    around = [k for k in found if strokes[k].points[:, 1].max() >= high and _encloses(strokes[k].points, np.delete(tips, found, 0), size)]
    return around if len(around) < len(strokes) else []


def outline(points: Float[np.ndarray, "point 2"]) -> Float[np.ndarray, "point 2"]:
    """A closed outline: the first point is not repeated at the end."""
    points = np.asarray(points)
    kept = np.r_[True, (np.diff(points, axis=0) != 0).any(1)]
    points = points[kept]
    return points[:-1] if len(points) > 1 and (points[0] == points[-1]).all() else points


def has_area(stroke: Stroke) -> bool:
    """Whether a labelled crown or obstacle encloses anything."""
    return len(outline(stroke.points)) >= 3 and shapely.convex_hull(shapely.MultiPoint(stroke.points)).area > 0


def _is_outline(points: Float[np.ndarray, "point 2"], size: float) -> bool:
    side = float(np.ptp(points, axis=0).max())
    if side < LARGE * size or len(points) < 4:
        return False
    hull = shapely.convex_hull(shapely.MultiPoint(points))
    area = abs(float(shapely.area(shapely.Polygon(points))))
    compact = 4 * np.pi * hull.area / hull.length**2
    opening = float(np.hypot(*(points[0] - points[-1])))
    return opening <= OPEN * side and compact * min(area / hull.area if hull.area else 0.0, 1.0) >= ROUND


def _encloses(points: Float[np.ndarray, "point 2"], tips: Float[np.ndarray, "stroke 2"], size: float) -> bool:
    region = shapely.make_valid(shapely.Polygon(points)).buffer(NEAR * size)
    return len(tips) > 0 and float(shapely.contains_xy(region, tips).mean()) >= 0.5


def _level(strokes: list[Stroke], part: float) -> float:
    y = np.concatenate([stroke.points[:, 1] for stroke in strokes])
    return float(y.min() + part * np.ptp(y))


def _upper_end(stroke: Stroke) -> Float[np.ndarray, " 2"]:
    ends = stroke.points if stroke.filled or stroke.closed else stroke.points[[0, -1]]
    return ends[np.argmax(ends[:, 1])]


