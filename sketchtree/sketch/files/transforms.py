"""Where does an element's coordinate system lie? Transforms of SVG attributes and of CSS, as 3 × 3 matrices.

CSS Transforms 1 and 2 for two dimensions. A matrix acts on column vectors (x, y, 1) with y down, as in the
file; nested elements multiply from the left. CSS properties apply in the order

    translate(origin) · translate · rotate · scale · transform · translate(−origin)

The `transform` attribute is the same list with bare numbers (user units, degrees), and a `transform` in a style
sheet replaces it.
"""

import math
import re
from functools import lru_cache

import numpy as np
from jaxtyping import Float

from sketchtree.sketch.files.css import Style

Matrix = Float[np.ndarray, "3 3"]
IDENTITY: Matrix = np.eye(3)
IDENTITY.flags.writeable = False

_FUNCTION = re.compile(r"(?<![a-zA-Z0-9])([a-zA-Z0-9]++)\s*+\(([^()]*+)\)")  # possessive: long texts are looked at once
_NUMBER = re.compile(r"([-+]?(?:[0-9]++\.?+[0-9]*+|\.[0-9]++)(?:[eE][-+]?[0-9]++)?)([a-zA-Z%]*+)")
_LENGTH = {"": 1.0, "px": 1.0, "in": 96.0, "cm": 96 / 2.54, "mm": 96 / 25.4, "q": 96 / 101.6, "pt": 96 / 72, "pc": 16.0, "rem": 16.0}
_LETTER = {"em": 1.0, "ex": 0.5}
EM = 16.0  # size of letters where nothing says otherwise, px
_ANGLE = {"": 1.0, "deg": 1.0, "grad": 0.9, "rad": 180 / math.pi, "turn": 360.0}
_LONGEST = 100_000  # characters of one list of transforms
_MOVES = frozenset({"translate", "rotate", "scale", "transform-origin"})
_KEYWORD = {"left": "0%", "top": "0%", "center": "50%", "right": "100%", "bottom": "100%"}


@lru_cache(maxsize=4096)
def length(text: str, percent_of: float = 0.0, em: float = EM) -> float:
    """A CSS or SVG length in user units (96 px an inch; `em` a letter). Raises ValueError if it is none."""
    match = _NUMBER.fullmatch(text.strip())
    value, unit = (float(match[1]), match[2].lower()) if match else (math.inf, "")
    if not math.isfinite(value):
        raise ValueError(f"'{text[:40]}' is not a length")
    if unit == "%":
        return value / 100 * percent_of
    if unit in _LETTER:
        return value * _LETTER[unit] * em
    if unit not in _LENGTH:
        raise ValueError(f"'{text[:40]}' has a unit that is not a length")
    return value * _LENGTH[unit]


def matrix_of(attribute: str | None, style: Style, box: tuple[float, float, float, float]) -> Matrix:
    """The matrix of one element. `box` (x, y, width, height) is what percentages and the origin refer to."""
    listed = style.get("transform", attribute)
    if not _MOVES & style.keys():
        return IDENTITY if listed is None else transform_list(listed, box)
    moves = [_one("translate", style.get("translate"), box), _one("rotate", style.get("rotate"), box)]
    moves += [_one("scale", style.get("scale"), box), transform_list(listed, box)]
    whole = moves[0] @ moves[1] @ moves[2] @ moves[3]
    if "transform-origin" not in style:
        return whole
    x, y = _origin(style["transform-origin"], box)
    return translation(x, y) @ whole @ translation(-x, -y)


@lru_cache(maxsize=4096)
def transform_list(text: str | None, box: tuple[float, float, float, float] = (0.0, 0.0, 0.0, 0.0)) -> Matrix:
    """A list of transform functions as one matrix, leftmost outermost. Raises ValueError for an unknown one."""
    whole = IDENTITY
    if text and text.strip().lower() != "none":
        if len(text) > _LONGEST:
            raise ValueError(f"its transform takes {len(text)} characters, more than {_LONGEST}")
        for name, arguments in _FUNCTION.findall(text):
            whole = whole @ _function(name.lower(), _NUMBER.findall(arguments), box)
        whole.flags.writeable = False
    return whole


def _one(name: str, value: str | None, box) -> Matrix:
    if value is None or value.strip().lower() == "none":
        return IDENTITY
    return _function(name, _NUMBER.findall(value), box)


def _function(name: str, arguments: list[tuple[str, str]], box) -> Matrix:
    try:
        if name.startswith("translate"):
            return _translation(name, arguments, box)
        if name in ("rotate", "rotatez"):
            return _rotation(arguments)
        if name.startswith("scale"):
            return _scaling(name, arguments)
        if name.startswith("skew"):
            return _skew(name, arguments)
        if name == "matrix":
            a, b, c, d, e, f = (float(number) for number, _ in arguments)
            return np.array([[a, c, e], [b, d, f], [0, 0, 1]])
    except (IndexError, KeyError, ValueError):
        pass
    raise ValueError(f"'{name}({', '.join(n + u for n, u in arguments):.60})' is not a transform in the plane")


def _translation(name: str, arguments, box) -> Matrix:
    x, y = ((length("".join(part), box[2 + axis]) for axis, part in enumerate((arguments * 2)[:2])))
    if name == "translatex":
        return translation(x, 0.0)
    if name == "translatey":
        return translation(0.0, length("".join(arguments[0]), box[3]))
    return translation(x, y if len(arguments) > 1 else 0.0)


def _rotation(arguments) -> Matrix:
    angle = math.radians(float(arguments[0][0]) * _ANGLE[arguments[0][1].lower()])
    turn = np.array([[math.cos(angle), -math.sin(angle), 0], [math.sin(angle), math.cos(angle), 0], [0, 0, 1]])
    if len(arguments) < 3:
        return turn
    x, y = float(arguments[1][0]), float(arguments[2][0])
    return translation(x, y) @ turn @ translation(-x, -y)


def _scaling(name: str, arguments) -> Matrix:
    factors = [float(number) / (100.0 if unit == "%" else 1.0) for number, unit in arguments]
    x, y = factors[0], factors[1] if len(factors) > 1 else factors[0]
    if name == "scalex":
        y = 1.0
    elif name == "scaley":
        x, y = 1.0, factors[0]
    return np.diag([x, y, 1.0])


def _skew(name: str, arguments) -> Matrix:
    angles = [math.tan(math.radians(float(number) * _ANGLE[unit.lower()])) for number, unit in arguments]
    x, y = (0.0, angles[0]) if name == "skewy" else (angles[0], angles[1] if len(angles) > 1 else 0.0)
    return np.array([[1, x, 0], [y, 1, 0], [0, 0, 1]])


def scale_of(matrix: Matrix) -> float:
    """How much larger a matrix makes things: the square root of what it does to an area."""
    return math.sqrt(abs(matrix[0, 0] * matrix[1, 1] - matrix[0, 1] * matrix[1, 0]))


def translation(x: float, y: float) -> Matrix:
    """A shift."""
    return np.array([[1, 0, x], [0, 1, y], [0, 0, 1.0]])


def _origin(text: str, box: tuple[float, float, float, float]) -> tuple[float, float]:
    words = text.lower().split()
    if words[0] in ("top", "bottom") or (len(words) > 1 and words[1] in ("left", "right")):
        words = [*words[1:2], words[0]] if len(words) > 1 else ["center", words[0]]
    words = [_KEYWORD.get(word, word) for word in words[:2]] + ["50%"] * (2 - len(words))
    return box[0] + length(words[0], box[2]), box[1] + length(words[1], box[3])
