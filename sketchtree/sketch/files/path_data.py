r"""What curve does path data draw? The `d` of an SVG path as runs of cubic Béziers.

SVG 2, §9.3. Every piece becomes one cubic (p0, p1, p2, p3), y down as in the file:

    line a → b            (a, (2a + b)/3, (a + 2b)/3, b)
    quadratic (a, q, b)   (a, a + 2(q − a)/3, b + 2(q − b)/3, b)
    arc of angle δ        pieces of at most a quarter turn, control arm 4/3 · tan(δ/4) of the radius (SVG 2, §B.2.4 for the centre)
"""

import re
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float

_RUN = re.compile(r"([MmZzLlHhVvCcSsQqTtAa])([^MmZzLlHhVvCcSsQqTtAa]*)")
_DIGIT = re.compile(r"[0-9]")
_NUMBER = re.compile(r"[-+]?(?:[0-9]++\.?+[0-9]*+|\.[0-9]++)(?:[eE][-+]?[0-9]++)?+")  # possessive: long digits are looked at once
_ARC = re.compile(r"[\s,]*+".join(["", *[f"({_NUMBER.pattern})"] * 3, "([01])", "([01])", *[f"({_NUMBER.pattern})"] * 2]))
_SIZE = {"M": 2, "L": 2, "H": 1, "V": 1, "C": 6, "S": 4, "Q": 4, "T": 2}
_MISSING = "its path data can't be understood (a number is missing)"
_NO_MOVE = "its path data do not begin with a move"
_STRANGE = "its path data can't be understood ('{}' is no number)"

Cubics = Float[np.ndarray, "piece 4 2"]


@dataclass(frozen=True, eq=False)
class Subpath:
    """One pen-down run: cubics end to end; a lone point has no piece but `start`."""

    start: Float[np.ndarray, " 2"]
    cubics: Cubics
    closed: bool = False


def path_data(data: str) -> list[Subpath]:
    """The runs of a path ("none" has none, as SVG 2 says). Raises ValueError, in words, for data that make no sense."""
    if data.strip() == "none":
        return []
    if "n" in data or "N" in data:  # no command or number has an n
        raise ValueError("a coordinate is not a finite number")
    found: list[Subpath] = []
    pen = _Pen(found)
    for command, text in _merged(data):
        if command in "Zz":
            pen.close()
        elif command in "Aa":
            pen.arcs(_arc_numbers(text), command == "a")
        else:
            numbers, size = numbers_of(text), _SIZE[command.upper()]
            if len(numbers) % size:
                raise ValueError(_MISSING)
            pen.draw(command.upper(), numbers.reshape(-1, size), command.islower())
    pen.lift()
    return found


def lines(points: Float[np.ndarray, "point 2"], closed: bool) -> Subpath:
    """Points joined by straight lines; a point on top of the one before it is left out."""
    ring = np.concatenate([points, points[:1]]) if closed else points
    return Subpath(points[0], straight(ring), closed)


def straight(points: Float[np.ndarray, "point 2"]) -> Cubics:
    """The pieces of a polyline that have any length."""
    a, b = points[:-1], points[1:]
    step = b - a
    moved = (step[:, 0] != 0) | (step[:, 1] != 0)
    if not moved.all():
        a, b, step = a[moved], b[moved], step[moved]
    pieces = np.empty((len(a), 4, 2))
    third = step / 3
    pieces[:, 0], pieces[:, 1], pieces[:, 2], pieces[:, 3] = a, a + third, b - third, b
    return pieces


def numbers_of(text: str) -> Float[np.ndarray, " number"]:
    """All numbers of a list separated by spaces, commas or nothing. Raises ValueError at anything else."""
    try:
        if "_" in text:  # Python's own way of writing numbers
            raise ValueError
        return np.fromiter(map(float, text.replace(",", " ").split()), float)
    except ValueError:
        found = _NUMBER.findall(text)
        rest = _NUMBER.sub(" ", text).replace(",", " ").strip()
        if rest:
            raise ValueError(_STRANGE.format(rest[:20])) from None
        return np.fromiter(map(float, found), float)


def _merged(data: str):
    """(command, its arguments), a command repeated without need told once; L after M is M's own continuation."""
    runs = _RUN.findall(data)
    if data[: data.find(runs[0][0]) if runs else None].strip(" \t\r\n,"):
        raise ValueError(_NO_MOVE)
    if runs and runs[0][0] not in "Mm":
        raise ValueError(_NO_MOVE)
    k = 0
    while k < len(runs):
        command, text = runs[k]
        same = {"M": "L", "m": "l"}.get(command, command)
        last = k + 1
        if same not in "Zz":
            while last < len(runs) and runs[last][0] == same:
                last += 1
            parts = [arguments for _, arguments in runs[k:last]]
            if not all(map(_DIGIT.search, parts)):
                raise ValueError(_MISSING)
            text = " ".join(parts)
        elif text.strip(" \t\r\n,"):
            raise ValueError(_STRANGE.format(text.strip()[:20]))
        yield command, text
        k = last


def _arc_numbers(text: str) -> Float[np.ndarray, "arc 7"]:
    """Arcs, whose two flags may stand without a space between them."""
    text, found, at = text.strip(" \t\r\n,"), [], 0
    while at < len(text):  # not `findall`: it would try a long number that is no arc from each of its digits
        match = _ARC.match(text, at)
        if match is None:
            raise ValueError(_MISSING)
        found.append(match.groups())
        at = match.end()
    return np.array(found, float).reshape(-1, 7)


class _Pen:
    """Where the pen is, and what it has drawn since it was set down."""

    def __init__(self, found: list[Subpath]):
        self.found = found
        self.here, self.start = np.zeros(2), np.zeros(2)
        self.pieces: list[Cubics] = []
        self.down = False
        self.fresh = False  # a move that nothing has followed yet
        self.arm: tuple[str, Float[np.ndarray, " 2"]] = ("", self.here)  # the last control point and whose it is

    def draw(self, command: str, numbers: Float[np.ndarray, "step size"], relative: bool) -> None:
        """All steps of one command."""
        if command == "M":
            self.lift()
            self._land(numbers[0] + self.here if relative else numbers[0])
            numbers = numbers[1:]
            command = "L"
            if not len(numbers):
                return
        self._begin()
        if command in "HV":
            axis = "HV".index(command)
            points = np.tile(self.here, (len(numbers), 1))
            points[:, axis] = self.here[axis] + np.cumsum(numbers[:, 0]) if relative else numbers[:, 0]
            numbers, relative, command = points, False, "L"
        steps = numbers.reshape(len(numbers), -1, 2)
        if relative:
            ends = self.here + np.cumsum(steps[:, -1], axis=0)
            steps = steps + np.concatenate([self.here[None], ends[:-1]])[:, None]
        self._add(*_STEP[command](self, steps), command)

    def arcs(self, numbers: Float[np.ndarray, "arc 7"], relative: bool) -> None:
        """Elliptical arcs, one after the other."""
        self._begin()
        for rx, ry, turn, large, sweep, x, y in numbers:
            end = np.array([x, y]) + (self.here if relative else 0.0)
            self._add(_arc(self.here, end, abs(rx), abs(ry), np.radians(turn), large > 0, sweep > 0), end, end, "A")

    def close(self) -> None:
        """Draw back to where the pen was set down."""
        if self.down or self.fresh:
            self._begin()
            self._add(straight(np.stack([self.here, self.start])), self.start, self.start, "Z")
            self._put(True)
        self.here = self.start

    def lift(self) -> None:
        """End the run; a move that nothing followed is a dot, if it is the first."""
        if self.down or (self.fresh and not self.found):
            self._put(False)
        self.down = self.fresh = False

    def _land(self, point: Float[np.ndarray, " 2"]) -> None:
        self.here = self.start = point
        self.pieces, self.down, self.fresh = [], False, True

    def _begin(self) -> None:
        if not (self.down or self.fresh):
            self.pieces = []
            self.start = self.here
        self.down, self.fresh = True, False

    def _add(self, pieces: Cubics, end, arm, command: str) -> None:
        self.pieces.append(pieces)
        self.here, self.arm = end, (command, arm)

    def _put(self, closed: bool) -> None:
        cubics = self.pieces[0] if len(self.pieces) == 1 else np.concatenate([np.zeros((0, 4, 2)), *self.pieces])
        self.found.append(Subpath(self.start, cubics, closed))
        self.pieces, self.down = [], False

    def _mirrored(self, family: str) -> Float[np.ndarray, " 2"]:
        """The last control point on the other side of the pen; the pen itself after another kind of command."""
        return 2 * self.here - self.arm[1] if self.arm[0] and self.arm[0] in family else self.here


def _line_steps(pen: _Pen, steps):
    points = np.concatenate([pen.here[None], steps[:, 0]])
    return straight(points), points[-1], points[-1]


def _cubic_steps(pen: _Pen, steps):
    starts = np.concatenate([pen.here[None], steps[:-1, -1]])
    return np.concatenate([starts[:, None], steps], 1), steps[-1, 2], steps[-1, 1]


def _smooth_steps(pen: _Pen, steps):
    starts = np.concatenate([pen.here[None], steps[:-1, -1]])
    first = np.concatenate([pen._mirrored("CS")[None], 2 * starts[1:] - steps[:-1, 0]])
    return np.concatenate([starts[:, None], first[:, None], steps], 1), steps[-1, 1], steps[-1, 0]


def _quadratic_steps(pen: _Pen, steps):
    a, q, b = np.concatenate([pen.here[None], steps[:-1, -1]]), steps[:, 0], steps[:, 1]
    return np.stack([a, a + (q - a) * (2 / 3), b + (q - b) * (2 / 3), b], 1), b[-1], q[-1]


def _smooth_quadratic_steps(pen: _Pen, steps):
    arms, arm = [], pen._mirrored("QT")
    for end in steps[:, 0]:
        arms.append(arm)
        arm = 2 * end - arm
    return _quadratic_steps(pen, np.stack([np.array(arms), steps[:, 0]], 1))


_STEP = {"L": _line_steps, "C": _cubic_steps, "S": _smooth_steps, "Q": _quadratic_steps, "T": _smooth_quadratic_steps}


def _arc(a, b, rx: float, ry: float, turn: float, large: bool, sweep: bool) -> Cubics:
    """An elliptical arc from `a` to `b` as cubics; a straight line where a radius is 0, as SVG has it."""
    if rx == 0 or ry == 0 or (a == b).all():
        return straight(np.stack([a, b]))
    axes = np.array([[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]])
    half = axes.T @ (a - b) / 2 / (rx, ry)  # in the frame where the ellipse is a unit circle
    reach = float(np.hypot(*half))
    grow = max(reach, 1.0)  # radii too small for the chord are scaled up
    half, reach = half / grow, reach / grow
    aside = np.sqrt(max(1.0 / reach**2 - 1.0, 0.0)) * (1.0 if large != sweep else -1.0)
    centre = aside * np.array([half[1], -half[0]])
    first = np.arctan2(*(half - centre)[::-1])
    last = np.arctan2(*(-half - centre)[::-1])
    angle = (last - first) % (2 * np.pi) - (0.0 if sweep else 2 * np.pi)
    count = max(int(np.ceil(abs(angle) / (np.pi / 2) - 1e-9)), 1)
    theta = first + angle * np.arange(count + 1) / count
    on = np.stack([np.cos(theta), np.sin(theta)], 1)
    along = np.stack([-np.sin(theta), np.cos(theta)], 1) * (4 / 3 * np.tan(angle / count / 4))
    unit = np.stack([on[:-1], on[:-1] + along[:-1], on[1:] - along[1:], on[1:]], 1)
    pieces = (unit + centre) * (grow * rx, grow * ry) @ axes.T + (a + b) / 2
    pieces[0, 0], pieces[-1, 3] = a, b
    return pieces
