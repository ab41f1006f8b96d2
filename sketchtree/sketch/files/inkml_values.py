"""Which numbers does one InkML trace hold? Its text, point by point, in any of the encodings of the standard.

InkML (W3C Recommendation 2011, §3.2): points are separated by commas, values by spaces or by nothing at all where
no two could run together. A prefix says how a value counts, and holds for its channel until another one:

    !  v                  the value itself (the default)
    '  x ← x + v          difference: v is the velocity
    "  v ← v + a          second difference: a is the acceleration

    *  as before (value, velocity or acceleration)        ?  not known        #  hexadecimal        T F  true, false
"""

import re

import numpy as np
from jaxtyping import Float

from sketchtree.sketch.files.limits import MAX_OUTLINE

_PLAIN = re.compile(r"[-+0-9.eE,\s]*")
_VALUE = re.compile(r"([!'\"]?)\s*+([-+]?\s*+(?:#[0-9A-Fa-f]+|(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)|[TF*?])\s*+")  # possessive: looked at once
_KEPT = 60  # characters of a wrong value that a message repeats


def trace_values(text: str, regular: int, intermittent: int = 0) -> Float[np.ndarray, "point channel"]:
    """The values of every point, (point, regular + intermittent channels); NaN where one is not known or not given.

    Raises ValueError, with words that fit after "in FILE, ", for text that is no such list.
    """
    if len(text) > MAX_OUTLINE:
        raise ValueError(f"its trace takes {len(text) / 1e6:.3g} MB of text, more than {MAX_OUTLINE / 1e6:g}")
    if _PLAIN.fullmatch(text):
        table = _plain(text, regular)
        if table is not None:
            return np.hstack([table, np.full((len(table), intermittent), np.nan)])
    return _decoded([_values(point) for point in _points(text)], regular, intermittent)


def _plain(text: str, regular: int) -> Float[np.ndarray, "point channel"] | None:
    """Points of plain numbers, one of each channel: almost every trace. None for any other."""
    points = _points(text)
    numbers = text.replace(",", " ").split()
    if len(numbers) != regular * len(points) or any(len(point.split()) != regular for point in points):
        return _comma_in_point(text, regular)
    try:
        return np.array(numbers, float).reshape(-1, regular)
    except ValueError:
        return None


def _points(text: str) -> list[str]:
    text = text.strip().removesuffix(",")
    return text.split(",") if text.strip() else []


def _comma_in_point(text: str, regular: int) -> Float[np.ndarray, "point channel"] | None:
    """Points that some programs write the other way round: "x,y x,y"."""
    points = [point.split(",") for point in text.split()]
    if regular < 2 or any(len(point) != regular for point in points):
        return None
    try:
        return np.array(points, float).reshape(-1, regular)
    except ValueError:
        return None


def _values(point: str) -> list[tuple[str, str]]:
    """(prefix, number) of every value of one point."""
    found, at, point = [], 0, point.strip()
    while at < len(point):
        match = _VALUE.match(point, at)
        if match is None:
            raise ValueError(f"its trace has {point[at : at + _KEPT]!r}, which is no value of InkML")
        found.append((match[1], "".join(match[2].split())))
        at = match.end()
    return found


def _decoded(points: list[list[tuple[str, str]]], regular: int, intermittent: int) -> Float[np.ndarray, "point channel"]:
    table = np.full((len(points), regular + intermittent), np.nan)
    mode, value, speed, change = (["!"] * table.shape[1], *([0.0] * table.shape[1] for _ in range(3)))
    for row, point in enumerate(points):
        if not regular <= len(point) <= table.shape[1]:
            raise ValueError(f"point {row + 1} of its trace has {len(point)} values for {regular} channels")
        for k, (prefix, word) in enumerate(point):
            mode[k] = prefix or mode[k]
            if word == "?":
                continue
            number = None if word == "*" else _number(word)
            if mode[k] == "!":
                value[k] = value[k] if number is None else number
                speed[k] = 0.0
            else:
                if mode[k] == '"':
                    change[k] = change[k] if number is None else number
                    speed[k] += change[k]
                else:
                    speed[k] = speed[k] if number is None else number
                value[k] += speed[k]
            table[row, k] = value[k]
    return table


def _number(word: str) -> float:
    if word in "TF":
        return float(word == "T")
    sign, digits = (-1.0, word[1:]) if word[0] == "-" else (1.0, word.lstrip("+"))
    try:
        return sign * float(int(digits[1:], 16) if digits[0] == "#" else float(digits))
    except OverflowError:
        return sign * float("inf")
