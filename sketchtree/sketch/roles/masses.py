"""What does a scribble cover, and which part of an area is crown, which trunk?

The area of a scribble is its line widened by r and narrowed again (a morphological closing). The bulky part of an area is what is
left once it is narrowed by R and widened again (an opening): a crown. What that takes away below is trunk, as long
as it reaches well out of the crown; all the rest of the area is the crown then, points and lobes too.
"""

import numpy as np
import shapely
from jaxtyping import Float

CLOSES = 0.05  # r, of the scribble's size
OPENS = 0.11  # R, of the area's size: what is thinner than twice that is no crown
LARGEST = 0.45  # least share of the area that is crown
HIGH = 0.35  # of the area's height: a crown's middle is above
REACHES = 0.12  # of the area's height: how far the trunk comes out of the crown at the foot
SIMPLE = 0.004  # of its size: how finely an outline is kept


def mass(points: Float[np.ndarray, "point 2"]) -> shapely.Polygon:
    """The area that a scribble covers, without holes; empty if it has none."""
    size = float(np.ptp(points, axis=0).max())
    reach = CLOSES * size
    return _largest(shapely.LineString(points).buffer(reach).buffer(-0.9 * reach))


def bulk_and_trunk(area: shapely.Polygon) -> tuple[shapely.Polygon | None, list[shapely.Polygon]]:
    """(the crown of a painted tree, the pieces below and in it that are wood); (None, []) if it is no crown on a trunk."""
    left, bottom, right, top = area.bounds
    size = max(right - left, top - bottom)
    crown = _largest(area.buffer(-OPENS * size).buffer(OPENS * size * 1.02))
    if crown.is_empty or crown.area < LARGEST * area.area or crown.centroid.y < bottom + HIGH * (top - bottom):
        return None, []
    pieces = [piece for piece in shapely.get_parts(area.difference(crown.buffer(0.01 * size))) if piece.geom_type == "Polygon"]
    reach = REACHES * (top - bottom)
    wood = [p for p in pieces if p.bounds[1] <= bottom + 0.3 * reach and crown.bounds[1] - p.bounds[1] >= reach]
    if not wood:
        return None, []
    return _largest(area.difference(shapely.union_all(wood).buffer(0.012 * size))), wood


def border(area: shapely.Polygon) -> Float[np.ndarray, "point 2"]:
    """The outline of an area, first point not repeated, without points that do not bend it."""
    size = max(area.bounds[2] - area.bounds[0], area.bounds[3] - area.bounds[1])
    return shapely.get_coordinates(shapely.simplify(area.exterior, SIMPLE * size))[:-1]


def _largest(area) -> shapely.Polygon:
    pieces = [piece for piece in shapely.get_parts(area) if piece.geom_type == "Polygon" and not piece.is_empty]
    best = max(pieces, key=lambda piece: piece.area, default=shapely.Polygon())
    return shapely.Polygon(best.exterior) if not best.is_empty else best
