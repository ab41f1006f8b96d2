"""Where does an Excalidraw element lie on the page? Its points as they are painted, y down as in the file.

A line with roundness is the cubic spline that Excalidraw draws through its points p_i, the ends doubled (Catmull-Rom):

    c1 = p_i + (p_{i+1} − p_{i−1}) / 6        c2 = p_{i+1} − (p_{i+2} − p_i) / 6

`angle` turns an element, clockwise as seen, about the centre of the bounding box of what it draws. Hand-drawn
roughness is decoration: the ideal shape is read.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np
from jaxtyping import Float

from sketchtree.sketch.files.json_text import is_number, number_rows
from sketchtree.sketch.files.outlines import CIRCLE, flatten

POINTED = frozenset({"line", "arrow", "freedraw", "draw"})  # "draw": what a line was called before 2021
BOXED = frozenset({"rectangle", "diamond", "ellipse"})
LOOP = 8.0  # px between both ends, up to which Excalidraw fills a line as a loop
ADAPTIVE, ADAPTIVE_RADIUS, PROPORTION = 3, 32.0, 0.25  # roundness of corners: kind, px, share of the shorter side


@dataclass(frozen=True, eq=False)
class Drawn:
    """What one element draws."""

    points: Float[np.ndarray, "point 2"]  # px, y down; a closed shape does not repeat its first point
    closed: bool
    loop: bool  # closed, or nearly: Excalidraw paints its background


def drawn(element: dict[str, Any], tolerance: float) -> Drawn:
    """The geometry of a line, arrow, freedraw, rectangle, diamond or ellipse; curves within `tolerance` px.

    Raises ValueError, with words that fit after "in FILE, ", for numbers that are missing or make no sense.
    """
    x, y = (_number(element, key) for key in "xy")
    if element["type"] in POINTED:
        local = number_rows(element.get("points"), 2)
        if local is None:
            raise ValueError("its points are not a list of [x, y] rows of finite numbers")
        if not len(local):
            raise ValueError("it has no points")
        shape = _line(local, element, tolerance)
    else:
        shape = Drawn(_box(element, tolerance), True, True)
    angle = _number(element, "angle", 0.0)
    points = shape.points + (x, y)
    if angle:
        points = _turned(points, angle)
    return Drawn(points, shape.closed, shape.loop)


def _line(local: Float[np.ndarray, "point 2"], element: dict[str, Any], tolerance: float) -> Drawn:
    gap = float(np.hypot(*(local[-1] - local[0])))
    loop = len(local) > 2 and gap <= LOOP
    closed = len(local) > 2 and (gap == 0.0 or element.get("polygon") is True)
    if element["type"] != "freedraw" and is_round(element) and len(local) > 2 and not element.get("elbowed"):
        local = np.vstack([local[:1], flatten(_spline(local), tolerance)[0]])
    return Drawn(local[:-1] if closed and gap == 0.0 else local, closed, loop or closed)


def is_round(element: dict[str, Any]) -> bool:
    """Whether its corners are rounded; older files say `strokeSharpness`."""
    return element.get("roundness") is not None or element.get("strokeSharpness") == "round" or element["type"] == "draw"


def _spline(p: Float[np.ndarray, "point 2"]) -> Float[np.ndarray, "piece 4 2"]:
    before, after = np.vstack([p[:1], p[:-2]]), np.vstack([p[2:], p[-1:]])
    start, end = p[:-1], p[1:]
    return np.stack([start, start + (end - before) / 6, end - (after - start) / 6, end], axis=1)


def _box(element: dict[str, Any], tolerance: float) -> Float[np.ndarray, "point 2"]:
    """A rectangle, diamond or ellipse in its own coordinates."""
    w, h = (_number(element, key) for key in ("width", "height"))
    if element["type"] == "ellipse":
        return _ellipse(w, h, tolerance)
    if element["type"] == "diamond":
        corners = np.array([[w / 2, 0], [w, h / 2], [w / 2, h], [0, h / 2]])
        cut = np.full(4, PROPORTION)  # share of each side that a round corner takes
    else:
        corners = np.array([[0, 0], [w, 0], [w, h], [0, h]])
        cut = np.array([_radius(element, min(abs(w), abs(h))) / max(abs(side), 1e-300) for side in (w, h, w, h)])
    if not is_round(element) or w == 0 or h == 0:
        return corners
    return _rounded(corners, cut, tolerance)


def _radius(element: dict[str, Any], side: float) -> float:
    """Corner radius of a rectangle, px."""
    roundness = element.get("roundness")
    roundness = roundness if isinstance(roundness, dict) else {}
    fixed = roundness.get("value")
    fixed = float(fixed) if is_number(fixed) and fixed > 0 else ADAPTIVE_RADIUS
    return min(PROPORTION * side, fixed) if roundness.get("type") == ADAPTIVE else PROPORTION * side


def _rounded(corners: Float[np.ndarray, "4 2"], cut: Float[np.ndarray, " 4"], tolerance: float) -> Float[np.ndarray, "point 2"]:
    """Corners cut by `cut` of each side (side k leaves corner k) and replaced by quadratic curves about the corner."""
    side = np.roll(corners, -1, axis=0) - corners
    leave = corners + cut[:, None] * side
    reach = corners - np.roll(cut[:, None] * side, 1, axis=0)
    bends = np.stack([reach, reach + (corners - reach) * 2 / 3, leave + (corners - leave) * 2 / 3, leave], axis=1)
    begin, to = np.roll(leave, 1, axis=0), reach
    straight = np.stack([begin, begin + (to - begin) / 3, to - (to - begin) / 3, to], axis=1)
    return flatten(np.stack([straight, bends], axis=1).reshape(8, 4, 2), tolerance)[0]


def _ellipse(w: float, h: float, tolerance: float) -> Float[np.ndarray, "point 2"]:
    centre, radii = np.array([w, h]) / 2, np.array([w, h]) / 2
    turn = np.array([[1, 0], [0, 1], [-1, 0], [0, -1.0]])
    start, end = turn, np.roll(turn, -1, axis=0)
    quarters = np.stack([start, start + CIRCLE * end, end + CIRCLE * start, end], axis=1)
    return flatten(centre + radii * quarters, tolerance)[0]


def _turned(points: Float[np.ndarray, "point 2"], angle: float) -> Float[np.ndarray, "point 2"]:
    centre = (points.min(0) + points.max(0)) / 2
    cos, sin = np.cos(angle), np.sin(angle)
    return centre + (points - centre) @ np.array([[cos, sin], [-sin, cos]])


def _number(element: dict[str, Any], key: str, default: float | None = None) -> float:
    value = element.get(key, default)
    value = default if value is None else value
    if not is_number(value):
        raise ValueError(f"its {key} is {value!r:.40}; a finite number was expected")
    return float(value)
