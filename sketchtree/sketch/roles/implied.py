"""What trunk does a drawing imply that shows none? A bush is a crown on the ground; a fir's trunk runs up through its outline.

Under a crown with no branch at all a stem stands on the ground, below the middle of the crown, and ends in it.
"""

import numpy as np
import shapely
from jaxtyping import Float

from sketchtree.sketch.joining.lines import Line
from sketchtree.sketch.roles.ground import level_at

STEM = 0.6  # of the way from the ground to the crown's top that an implied stem rises


def implied_stems(
    outlines: list[Float[np.ndarray, "point 2"]], ground: list[Float[np.ndarray, "point 2"]], row: int, stroke_id: str
) -> tuple[list[Line], list[str]]:
    """(one stem under every crown, the warning that says so). `row` and `stroke_id`: the stroke they are put down to."""
    lines = []
    for points in sorted(outlines, key=lambda points: tuple(points.min(0))):
        x = float(shapely.make_valid(shapely.Polygon(points)).centroid.x)
        bottom, top = float(points[:, 1].min()), float(points[:, 1].max())
        foot = min(bottom, float(level_at(ground, x))) if ground else bottom
        stem = np.array([[x, foot], [x, foot + STEM * (top - foot)]])
        lines.append(Line(row, stroke_id, stem, np.full(2, np.nan)))
    many = "stems were put" if len(lines) > 1 else "one stem was put"
    return lines, [f"The drawing shows a crown and no branch: {many} from the ground into it. Draw a trunk to say otherwise."]
