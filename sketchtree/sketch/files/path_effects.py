"""Which line did the user draw, where Inkscape painted an outline around it? Strokes of varying width.

Its power stroke and taper stroke replace a line by the filled outline of its swelling stroke and keep the line itself in
`inkscape:original-d`. Power stroke points are `t,w | t,w …`: w is half the width where t pieces of the line are done.
"""

import re
from collections.abc import Mapping
from typing import NamedTuple
from xml.etree.ElementTree import Element

import numpy as np
from jaxtyping import Float

from sketchtree.sketch.files.document import INKSCAPE
from sketchtree.sketch.files.transforms import length

_EFFECT = f"{{{INKSCAPE}}}path-effect"
_ORIGINAL = f"{{{INKSCAPE}}}original-d"
_POINT = re.compile(r"\s*([-+\d.eE]+)\s*,\s*([-+\d.eE]+)\s*")


class Spine(NamedTuple):
    """The drawn line, and how wide it was painted."""

    data: str  # path data
    knots: Float[np.ndarray, "knot 2"] | None  # (pieces done, width there), user units; None: one width
    width: float | None  # the greatest width, user units

    def scaled(self, scale: float) -> "Spine":
        """The same with widths in other units."""
        knots = None if self.knots is None else self.knots * (1.0, scale)
        return Spine(self.data, knots, None if self.width is None else self.width * scale)


def spine(element: Element, by_id: Mapping[str, Element]) -> Spine | None:
    """The line under a path that a stroke effect has thickened; None for any other path."""
    original = element.get(_ORIGINAL)
    if original is None:
        return None
    for reference in element.get(_EFFECT, "").split(";"):
        effect = by_id.get(reference.strip().removeprefix("#"))
        if effect is None or effect.get("is_visible", "true") == "false":
            continue
        if effect.get("effect") == "powerstroke":
            knots = _knots(effect.get("offset_points", ""))
            return Spine(original, knots, None if knots is None else float(knots[:, 1].max()))
        if effect.get("effect") == "taper_stroke":
            return Spine(original, None, _width(effect.get("stroke_width", "")))
    return None


def _knots(text: str) -> Float[np.ndarray, "knot 2"] | None:
    try:
        pairs = [_POINT.fullmatch(part).groups() for part in text.split("|") if part.strip()]
        knots = np.array(pairs, float).reshape(-1, 2)
    except (ValueError, AttributeError):
        return None
    knots = knots[np.argsort(knots[:, 0], kind="stable")]
    knots[:, 1] = 2 * np.abs(knots[:, 1])
    return knots if len(knots) and np.isfinite(knots).all() and knots[:, 1].max() > 0 else None


def _width(text: str) -> float | None:
    try:
        width = length(text)
    except ValueError:
        return None
    return width if width > 0 else None
