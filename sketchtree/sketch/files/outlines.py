"""What is the geometry of an SVG element? Paths and basic shapes as cubic Béziers, and those as polylines.

Every piece, straight ones too, is one cubic with four control points (x, y), y down as in the file, so that a
whole drawing is flattened in one array operation. A cubic B on n equal steps differs from its chords by at most

    max |B''| / (8 n²) ≤ (6 / 8) max(|p0 − 2 p1 + p2|, |p1 − 2 p2 + p3|) / n²
"""

import numpy as np
from jaxtyping import Float, Int

from sketchtree.sketch.files.limits import MAX_OUTLINE
from sketchtree.sketch.files.path_data import Subpath, lines, numbers_of, path_data, straight
from sketchtree.sketch.files.viewport import View

CIRCLE = 0.5522847498307936  # control arm of a quarter circle, by its radius
_ACROSS = frozenset({"x", "x1", "x2", "cx", "width", "rx"})
SHAPES = frozenset({"path", "line", "polyline", "polygon", "rect", "circle", "ellipse"})


def subpaths(tag: str, attributes, view: View) -> list[Subpath]:
    """The geometry of one element in its own coordinates; [] for an element that draws nothing.

    Lengths refer to `view`. Raises ValueError for data that make no sense.
    """
    data = attributes.get("d" if tag == "path" else "points", "")
    if len(data) > MAX_OUTLINE:
        raise ValueError(f"its outline takes {len(data) / 1e6:.3g} MB of text, more than {MAX_OUTLINE / 1e6:g}")
    found = _shape(tag, attributes, view)
    if not all(np.isfinite(path.cubics if len(path.cubics) else path.start).all() for path in found):
        raise ValueError("a coordinate is not a finite number")
    return found


def _shape(tag: str, attributes, view: View) -> list[Subpath]:
    if tag == "path":
        return path_data(attributes.get("d", ""))
    if tag in ("polyline", "polygon"):
        return _poly(attributes.get("points", ""), tag == "polygon")

    def number(name: str) -> float:
        return view.length(attributes.get(name, "0"), 0 if name in _ACROSS else 2 if name == "r" else 1)

    if tag == "line":
        return [lines(np.array([[number("x1"), number("y1")], [number("x2"), number("y2")]]), False)]
    if tag in ("circle", "ellipse"):
        radii = (number("r"),) * 2 if tag == "circle" else _radii(attributes, number)
        return _ellipse(number("cx"), number("cy"), *radii) if min(radii) > 0 else []
    if tag == "rect" and min(number("width"), number("height")) > 0:
        return _rect(number("x"), number("y"), number("width"), number("height"), *_radii(attributes, number))
    return []


def flatten(cubics: Float[np.ndarray, "piece 4 2"], tolerance: float) -> tuple[Float[np.ndarray, "point 2"], Int[np.ndarray, " piece"]]:
    """Points along every cubic (its start left out), and how many each gave; within `tolerance` of the curve."""
    bend = np.maximum(
        np.hypot(*(cubics[:, 0] - 2 * cubics[:, 1] + cubics[:, 2]).T),
        np.hypot(*(cubics[:, 1] - 2 * cubics[:, 2] + cubics[:, 3]).T),
    )
    wanted = np.nan_to_num(np.sqrt(0.75 * bend / max(tolerance, 1e-300)), nan=1.0)  # NaN: larger than a number can be
    steps = np.clip(np.ceil(wanted - 1e-9), 1, 500).astype(np.int64)
    piece = np.repeat(np.arange(len(cubics)), steps)
    first = np.repeat(np.cumsum(steps) - steps, steps)
    t = ((np.arange(len(piece)) - first + 1) / steps[piece])[:, None]
    p0, p1, p2, p3 = np.moveaxis(cubics[piece], 1, 0)
    points = (1 - t) ** 3 * p0 + 3 * t * (1 - t) ** 2 * p1 + 3 * t**2 * (1 - t) * p2 + t**3 * p3
    points[np.cumsum(steps) - 1] = cubics[:, 3]
    return points, steps


def _poly(text: str, closed: bool) -> list[Subpath]:
    numbers = numbers_of(text)
    points = numbers[: len(numbers) // 2 * 2].reshape(-1, 2)
    return [lines(points, closed)] if len(points) else []


def _radii(attributes, number) -> tuple[float, float]:
    given = [number(name) if attributes.get(name, "auto") != "auto" else None for name in ("rx", "ry")]
    x, y = (given[0] if given[0] is not None else given[1]), (given[1] if given[1] is not None else given[0])
    return max(x or 0.0, 0.0), max(y or 0.0, 0.0)


def _ellipse(cx: float, cy: float, rx: float, ry: float) -> list[Subpath]:
    return [Subpath(np.array([cx + rx, cy]), _quarters(cx, cy, rx, ry), True)]


def _quarters(cx: float, cy: float, rx: float, ry: float) -> Float[np.ndarray, "4 4 2"]:
    """A whole ellipse from its rightmost point, in the direction of growing angle."""
    quarter = np.array([[1, 0], [1, CIRCLE], [CIRCLE, 1], [0, 1.0]])
    turn = np.array([[0, 1], [-1, 0.0]])  # row vectors: a quarter turn
    return np.stack([quarter @ np.linalg.matrix_power(turn, k) for k in range(4)]) * (rx, ry) + (cx, cy)


def _rect(x: float, y: float, width: float, height: float, rx: float, ry: float) -> list[Subpath]:
    rx, ry = min(rx, width / 2), min(ry, height / 2)
    if rx <= 0 or ry <= 0:
        corners = np.array([[x, y], [x + width, y], [x + width, y + height], [x, y + height]])
        return [lines(corners, True)]
    corner = _quarters(0.0, 0.0, rx, ry)
    inner = np.array([[x + width - rx, y + height - ry], [x + rx, y + height - ry], [x + rx, y + ry], [x + width - rx, y + ry]])
    arcs = corner + inner[:, None]
    cubics: list = []
    for arc, following in zip(arcs, np.roll(arcs, -1, 0), strict=True):
        cubics.append(arc)
        if (arc[3] != following[0]).any():
            cubics.append(straight(np.stack([arc[3], following[0]]))[0])
    return [Subpath(arcs[0, 0], np.array(cubics), True)]
