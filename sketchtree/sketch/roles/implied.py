"""What trunk does a drawing imply that shows none? A bush is a crown on the ground; a fir's trunk runs up through its outline.

Under a crown with no branch at all a stem stands on the ground, below the middle of the crown, and ends in it. In a
pointed crown with nothing drawn inside it (tiers that overlap are one), the trunk below is carried on to near the top.
"""

import numpy as np
import shapely
from jaxtyping import Float

from sketchtree.sketch.joining.lines import Line
from sketchtree.sketch.roles.ground import level_at

TOP, SLENDER = 0.15, 0.4  # of its height the top part of a pointed crown, and how wide that is, of its width
BELOW = 0.45  # of its height: it is widest below
BROAD = 0.8  # of its width: it is at least as high
EMPTY = 0.35  # of its height: nothing is drawn above
REACHES = 0.92  # of the way to the top that a trunk is carried on
STEM = 0.6  # of the way from the ground to the crown's top that an implied stem rises


def implied_stems(
    outlines: list[Float[np.ndarray, "point 2"]], ground: list[Float[np.ndarray, "point 2"]], row: int, stroke_id: str
) -> tuple[list[Line], list[str]]:
    """(one stem under every crown, the warning that says so). `row` and `stroke_id`: the stroke they are put down to."""
    lines = []
    for points in sorted(outlines, key=lambda points: tuple(points.min(0))):
        x = float(shapely.make_valid(shapely.Polygon(points)).centroid.x)
        bottom, top = float(points[:, 1].min()), float(points[:, 1].max())
        foot = float(level_at(ground, x)) if ground else bottom
        stem = np.array([[x, foot], [x, foot + STEM * (top - foot)]])
        lines.append(Line(row, stroke_id, stem, np.full(2, np.nan)))
    many = "stems were put" if len(lines) > 1 else "one stem was put"
    return lines, [f"The drawing shows a crown and no branch: {many} from the ground into it. Draw a trunk to say otherwise."]


def carried_on(
    lines: list[Line], outlines: list[Float[np.ndarray, "point 2"]], row: int, stroke_id: str
) -> tuple[list[Line], list[str]]:
    """(the lines and what carries trunks on through pointed crowns, the warning that says so)."""
    more = [line for points in outlines if (line := _leader(lines, points, row, stroke_id)) is not None]
    if not more:
        return lines, []
    return [*lines, *more], ["Nothing is drawn inside the pointed crown: the trunk was carried on to near its top. Draw it inside the crown to say otherwise."]


def merged(outlines: list[Float[np.ndarray, "point 2"]]) -> list[Float[np.ndarray, "point 2"]]:
    """The outlines, those that overlap (the tiers of a fir) as one."""
    area = shapely.union_all([shapely.make_valid(shapely.Polygon(points)) for points in outlines])
    pieces = [piece for piece in shapely.get_parts(area) if piece.geom_type == "Polygon"]
    return [shapely.get_coordinates(piece.exterior)[:-1] for piece in pieces] if len(pieces) < len(outlines) else outlines


def _leader(lines: list[Line], points: Float[np.ndarray, "point 2"], row: int, stroke_id: str) -> Line | None:
    """The trunk from where it was drawn to near the top of one pointed, empty crown."""
    (left, low), (right, high) = points.min(0), points.max(0)
    width, height = right - left, high - low
    upper = points[points[:, 1] >= high - TOP * height]
    widest = points[np.argmax(points[:, 0]), 1], points[np.argmin(points[:, 0]), 1]
    pointed = np.ptp(upper[:, 0]) <= SLENDER * width and max(widest) <= low + BELOW * height and height >= BROAD * width
    tips = [(line.points[np.argmax(line.points[:, 1])], line) for line in lines]
    under = [tip for tip, _ in tips if left + 0.25 * width <= tip[0] <= right - 0.25 * width and tip[1] >= low - 0.2 * height]
    if not pointed or len(under) != 1 or under[0][1] > low + EMPTY * height:
        return None
    if any(line.points[:, 1].max() > low + EMPTY * height and left < line.points[:, 0].mean() < right for _, line in tips):
        return None
    apex = points[np.argmax(points[:, 1])]
    end = under[0] + REACHES * (apex - under[0])
    return Line(row, stroke_id, np.array([under[0], end]), np.full(2, np.nan))
