"""How does a point of one page look on another?

The pages are vertical planes through the axis x = a of the front page, each turned by its azimuth φ. A point (x, y, z) of the front page is on the turned one

    X = a + (x − a) cos φ − z sin φ      Y = y      Z = (x − a) sin φ + z cos φ

with X to the right, Y up and Z towards the viewer. All in sketch units.
"""

import numpy as np
from jaxtyping import Float


def on_page(point: Float[np.ndarray, "*point 3"], view_deg: float, axis: float) -> Float[np.ndarray, "*point 3"]:
    """Points of the front page as the page at azimuth `view_deg` has them."""
    return _turned(point, np.radians(view_deg), axis)


def in_front(point: Float[np.ndarray, "*point 3"], view_deg: float, axis: float) -> Float[np.ndarray, "*point 3"]:
    """Points of the page at azimuth `view_deg` as the front page has them."""
    return _turned(point, -np.radians(view_deg), axis)


def _turned(point, angle: float, axis: float):
    point = np.asarray(point, float)
    if angle == 0.0:
        return point
    x, y, z = np.moveaxis(point, -1, 0)
    cos, sin = np.cos(angle), np.sin(angle)
    return np.stack([axis + (x - axis) * cos - z * sin, y, (x - axis) * sin + z * cos], axis=-1)
