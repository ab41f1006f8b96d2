"""What area do closed outlines enclose, and which part of a stroke lies in it?

A point is inside outlines of winding number w when w ≠ 0 ("nonzero") or w is odd ("evenodd"; SVG 2, §13.4.2). A stroke
is cut where it crosses the area's border; its own points are kept as they are.
"""

import numpy as np
import shapely
from jaxtyping import Float, Int

MOST_EDGES = 2_000  # edges of outlines that cross themselves or each other; beyond, their area is not worked out
MOST_CROSSINGS = 100_000
_SAME = 1e-6  # of an area's size: how far outside a point still counts as on its border

Points = Float[np.ndarray, "point 2"]
Area = shapely.Geometry
NOTHING: Area = shapely.Polygon()


def area(rings: list[Points], rule: str = "nonzero") -> Area:
    """The area inside outlines (first point not repeated). Raises ValueError when they cross each other too often."""
    rings = [ring for ring in rings if len(ring) > 2]
    if len(rings) == 1:
        whole = shapely.Polygon(rings[0])
        if whole.is_valid:
            return whole
    if not rings:
        return NOTHING
    a = np.concatenate(rings)
    b = np.concatenate([np.roll(ring, -1, 0) for ring in rings])
    edges = shapely.linestrings(np.stack([a, b], 1)[(a != b).any(1)])
    if len(edges) > MOST_EDGES or shapely.STRtree(edges).query(edges).shape[1] > MOST_CROSSINGS:
        raise ValueError("the outline crosses itself too often")
    faces = shapely.get_parts(shapely.polygonize(shapely.get_parts(shapely.union_all(edges))))
    turns = _winding(shapely.get_coordinates(shapely.point_on_surface(faces)), a, b)
    return shapely.union_all(faces[turns % 2 == 1 if rule == "evenodd" else turns != 0])


def both(a: Area | None, b: Area | None) -> Area | None:
    """What lies in both areas (None: everywhere); the first alone where numbers are too coarse to tell."""
    if a is None or b is None:
        return b if a is None else a
    try:
        return shapely.intersection(a, b)
    except shapely.errors.GEOSException:
        return a


def _winding(points: Points, a: Points, b: Points) -> Int[np.ndarray, " point"]:
    """How often the edges a → b run around each point."""
    turns = np.zeros(len(points), np.int64)
    for k, (x, y) in enumerate(points):
        side = (b[:, 0] - a[:, 0]) * (y - a[:, 1]) - (x - a[:, 0]) * (b[:, 1] - a[:, 1])
        up = (a[:, 1] <= y) & (b[:, 1] > y) & (side > 0)
        down = (a[:, 1] > y) & (b[:, 1] <= y) & (side < 0)
        turns[k] = up.sum() - down.sum()
    return turns


def inside(points: Points, closed: bool, filled: bool, region: Area) -> list[tuple[Points, bool]]:
    """The parts (points, closed) of a stroke, or of a painted outline, that lie in a region; itself where all of it does,
    or where numbers are too coarse to tell."""
    try:
        return _inside(points, closed, filled, region)
    except shapely.errors.GEOSException:
        return [(points, closed)]


def _inside(points: Points, closed: bool, filled: bool, region: Area) -> list[tuple[Points, bool]]:
    if region.is_empty:
        return []
    low, high = points.min(0), points.max(0)
    left, bottom, right, top = region.bounds
    slack = _SAME * max(right - left, top - bottom)
    if low[0] > right or low[1] > top or high[0] < left or high[1] < bottom:
        return []
    within = low[0] >= left - slack and low[1] >= bottom - slack and high[0] <= right + slack and high[1] <= top + slack
    if within and _is_box(region, slack):
        return [(points, closed)]
    if filled and len(points) > 2:
        return _cut_area(points, region)
    ring = np.concatenate([points, points[:1]]) if closed and len(points) > 2 else points
    return _cut_line(points, ring, closed, region, slack)


def _is_box(region: Area, slack: float) -> bool:
    left, bottom, right, top = region.bounds
    full = (right - left) * (top - bottom)
    return full - region.area <= slack * (right - left + top - bottom)


def _cut_area(points: Points, region: Area) -> list[tuple[Points, bool]]:
    whole = shapely.make_valid(shapely.Polygon(points))
    if region.covers(whole):
        return [(points, True)]
    part = whole.intersection(region)
    pieces = [p for piece in shapely.get_parts(part) for p in shapely.get_parts(piece) if p.geom_type == "Polygon"]
    rings = [ring for piece in pieces for ring in (piece.exterior, *piece.interiors)]
    return [(shapely.get_coordinates(ring)[:-1], True) for ring in rings]


def _cut_line(points: Points, ring: Points, closed: bool, region: Area, slack: float) -> list[tuple[Points, bool]]:
    """Runs of the line between its crossings of the region's border whose middles lie inside."""
    near = region.buffer(slack, join_style="mitre") if slack > 0 else region
    if near.covers(shapely.LineString(ring) if len(ring) > 1 else shapely.Point(ring[0])):
        return [(points, closed)]
    if len(ring) == 1:
        return []
    ring = _with_crossings(ring, region.boundary)
    middle = (ring[:-1] + ring[1:]) / 2
    kept = shapely.intersects_xy(region, middle[:, 0], middle[:, 1])
    if kept.all():
        return [(points, closed)]
    if closed and kept[0] and kept[-1]:  # the seam lies inside: start at a gap instead
        shift = int(np.argmin(kept))
        ring, kept = np.concatenate([ring[shift:-1], ring[: shift + 1]]), np.roll(kept, -shift)
    edges = np.flatnonzero(np.diff(np.r_[False, kept, False].astype(np.int8)))
    return [(ring[first : last + 1], False) for first, last in zip(edges[::2], edges[1::2], strict=True)]


def _with_crossings(ring: Points, border) -> Points:
    """The polyline with a point at every crossing of the border put in."""
    steps = shapely.linestrings(np.stack([ring[:-1], ring[1:]], 1))
    shapely.prepare(border)
    crossing = np.flatnonzero(shapely.intersects(border, steps))
    hits, of = shapely.get_coordinates(shapely.intersection(steps[crossing], border), return_index=True)
    step = crossing[of]
    along = shapely.line_locate_point(steps[step], shapely.points(hits))
    whole = shapely.length(steps[step])
    new = (along > 0) & (along < whole)
    hits, step, along = hits[new], step[new], along[new]
    order = np.lexsort([along, step])
    return np.insert(ring, step[order] + 1, hits[order], axis=0)
