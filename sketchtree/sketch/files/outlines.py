"""What is the geometry of an SVG element? Paths and basic shapes as cubic Béziers, and those as polylines.

Every piece, straight ones too, is one cubic with four control points (x, y), y down as in the file, so that a
whole drawing is flattened in one array operation. A cubic B on n equal steps differs from its chords by at most

    max |B''| / (8 n²) ≤ (6 / 8) max(|p0 − 2 p1 + p2|, |p1 − 2 p2 + p3|) / n²
"""

import re
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int
from svgelements import Arc, Close, CubicBezier, Line, Move, Path, QuadraticBezier

from sketchtree.sketch.files.transforms import length

CIRCLE = 0.5522847498307936  # control arm of a quarter circle, by its radius
_NUMBER = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?|[a-zA-Z]+")
_CURVED = re.compile(r"[^MmLlZz0-9eE+\-., \t\r\n]")
_RUN = re.compile(r"[MmLlZz]|[^MmLlZz]+")
_MISSING = "its path data can't be understood (a number is missing)"
_NOT_FINITE = re.compile(r"nan|inf", re.IGNORECASE)


@dataclass(frozen=True, eq=False)
class Subpath:
    """One pen-down run: cubics end to end, `(piece, 4, 2)`; a lone point has no piece but `start`."""

    start: Float[np.ndarray, " 2"]
    cubics: Float[np.ndarray, "piece 4 2"]
    closed: bool = False


def subpaths(tag: str, attributes, view: tuple[float, float]) -> list[Subpath]:
    """The geometry of one element in its own coordinates; [] for an element that draws nothing.

    `view` is (width, height) of the viewBox, for percentages. Raises ValueError for data that make no sense.
    """
    found = _shape(tag, attributes, view)
    if not all(np.isfinite(path.start).all() and np.isfinite(path.cubics).all() for path in found):
        raise ValueError("a coordinate is not a finite number")
    return found


def _shape(tag: str, attributes, view: tuple[float, float]) -> list[Subpath]:
    if tag == "path":
        return _path(attributes.get("d", ""))
    if tag in ("polyline", "polygon"):
        return _poly(attributes.get("points", ""), tag == "polygon")
    diagonal = float(np.hypot(*view) / np.sqrt(2.0))

    def number(name: str, default: str = "0") -> float:
        whole = view[0] if name in ("x", "x1", "x2", "cx", "width", "rx") else view[1]
        return length(attributes.get(name, default), diagonal if name == "r" else whole)

    if tag == "line":
        return [_lines(np.array([[number("x1"), number("y1")], [number("x2"), number("y2")]]), False)]
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
    steps = np.clip(np.ceil(np.sqrt(0.75 * bend / max(tolerance, 1e-300)) - 1e-9), 1, 500).astype(np.int64)
    piece = np.repeat(np.arange(len(cubics)), steps)
    first = np.repeat(np.cumsum(steps) - steps, steps)
    t = ((np.arange(len(piece)) - first + 1) / steps[piece])[:, None]
    p0, p1, p2, p3 = np.moveaxis(cubics[piece], 1, 0)
    points = (1 - t) ** 3 * p0 + 3 * t * (1 - t) ** 2 * p1 + 3 * t**2 * (1 - t) * p2 + t**3 * p3
    points[np.cumsum(steps) - 1] = cubics[:, 3]
    return points, steps


def _path(data: str) -> list[Subpath]:
    if _NOT_FINITE.search(data):
        raise ValueError("a coordinate is not a finite number")
    if data and not _CURVED.search(data):
        return _straight_runs(data)
    found: list[Subpath] = []
    start, pieces = None, []

    def finish(closed: bool) -> None:
        if start is not None:
            found.append(Subpath(np.array(start, float), np.array(pieces, float).reshape(-1, 4, 2), closed))

    try:
        segments = list(Path(data))
    except (ValueError, IndexError, TypeError, ZeroDivisionError) as error:
        raise ValueError(f"its path data can't be understood ({error or 'a number is missing'})") from None
    for segment in segments:
        if isinstance(segment, Move):
            if pieces or (start is not None and not found):
                finish(False)
            start, pieces = tuple(segment.end), []
        elif start is None:
            raise ValueError("its path data do not begin with a move")
        else:
            pieces += _cubics(segment)
            if isinstance(segment, Close):
                finish(True)
                start, pieces = tuple(segment.end), []
    if pieces or not found:
        finish(False)
    return found


def _straight_runs(data: str) -> list[Subpath]:
    """A path of moves, straight lines and closings alone, run by run: what most drawn strokes are."""
    found: list[Subpath] = []
    here, run, command, waiting = np.zeros(2), None, "", False
    for token in _RUN.findall(data):
        if waiting and token.isalpha():
            raise ValueError(_MISSING)
        if token in "Zz":
            if run is None:
                raise ValueError("its path data do not begin with a move")
            found.append(_lines(np.concatenate(run), True))
            here, run, command = run[0][0], [run[0][:1]], token
        elif token in "MmLl":
            command, waiting = token, True
        elif token.strip(" \t\r\n,"):
            points = _pairs_of(token, command)
            if command.islower():
                points = here + np.cumsum(points, axis=0)
            if command in "Mm":
                if run is not None and (len(run) > 1 or len(run[0]) > 1 or not found):
                    found.append(_lines(np.concatenate(run), False))
                run = []
            elif run is None:
                raise ValueError("its path data do not begin with a move")
            run.append(points)
            here, waiting = points[-1], False
    if waiting:
        raise ValueError(_MISSING)
    if run and (len(run) > 1 or len(run[0]) > 1 or not found):
        found.append(_lines(np.concatenate(run), False))
    return found


def _pairs_of(text: str, command: str) -> Float[np.ndarray, "point 2"]:
    numbers = np.array(_NUMBER.findall(text), float)
    if command not in ("M", "m", "L", "l") or len(numbers) % 2:
        raise ValueError(_MISSING)
    return numbers.reshape(-1, 2)


def _cubics(segment) -> list:
    if isinstance(segment, (Line, Close)):
        ends = tuple(segment.start), tuple(segment.end)
        return [_straight(*ends)] if ends[0] != ends[1] else []
    if isinstance(segment, CubicBezier):
        return [[tuple(p) for p in (segment.start, segment.control1, segment.control2, segment.end)]]
    if isinstance(segment, QuadraticBezier):
        a, b, c = (np.array(tuple(p)) for p in (segment.start, segment.control, segment.end))
        return [[a, a + (b - a) * (2 / 3), c + (b - c) * (2 / 3), c]]
    if isinstance(segment, Arc):
        return [[tuple(p) for p in (c.start, c.control1, c.control2, c.end)] for c in segment.as_cubic_curves()]
    raise ValueError(f"its path data hold a {type(segment).__name__}")


def _straight(a, b) -> list:
    a, b = np.array(a, float), np.array(b, float)
    return [a, a + (b - a) / 3, a + (b - a) * (2 / 3), b]


def _lines(points: Float[np.ndarray, "point 2"], closed: bool) -> Subpath:
    ring = np.concatenate([points, points[:1]]) if closed else points
    a, b = ring[:-1], ring[1:]
    kept = (a != b).any(1)
    a, b = a[kept], b[kept]
    return Subpath(points[0], np.stack([a, a + (b - a) / 3, a + (b - a) * (2 / 3), b], 1), closed)


def _poly(text: str, closed: bool) -> list[Subpath]:
    tokens = _NUMBER.findall(text)
    if any(token[0].isalpha() for token in tokens):
        raise ValueError("a coordinate is not a finite number")
    numbers = np.array(tokens, float)
    points = numbers[: len(numbers) // 2 * 2].reshape(-1, 2)
    return [_lines(points, closed)] if len(points) else []


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
        return [_lines(corners, True)]
    corner = _quarters(0.0, 0.0, rx, ry)
    inner = np.array([[x + width - rx, y + height - ry], [x + rx, y + height - ry], [x + rx, y + ry], [x + width - rx, y + ry]])
    arcs = corner + inner[:, None]
    cubics: list = []
    for arc, following in zip(arcs, np.roll(arcs, -1, 0), strict=True):
        cubics.append(arc)
        if (arc[3] != following[0]).any():
            cubics.append(np.array(_straight(arc[3], following[0])))
    return [Subpath(arcs[0, 0], np.array(cubics), True)]
