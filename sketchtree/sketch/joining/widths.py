"""Do the drawn widths say how thick the branches are?

A pen that draws every line alike says nothing. Pressure does, and so do line widths that differ over the drawing.
"""

import numpy as np
from jaxtyping import Float

from sketchtree.sketch.strokes import Stroke

VARIES = 1.25  # the widest line over the narrowest, from which widths are believed
LIGHTEST = 0.05  # pressure below which a pen still leaves a line


def drawn_widths(strokes: list[Stroke]) -> list[Float[np.ndarray, " point"] | float]:
    """Width at every point of every stroke, sketch units; NaN throughout where it says nothing."""
    pressed = [s.pressure is not None and np.ptp(s.pressure) > 0.05 for s in strokes]
    given = [s.width for s in strokes if s.width]
    alike = len(given) < len(strokes) or max(given, default=0.0) < VARIES * min(given, default=1.0)
    if alike and not any(pressed):
        return [np.nan] * len(strokes)
    pen = float(np.median(given)) if given else 1.0
    return [_width(stroke, pen) for stroke in strokes]


def _width(stroke: Stroke, pen: float) -> Float[np.ndarray, " point"]:
    width = stroke.width if stroke.width else pen
    press = np.ones(len(stroke.points)) if stroke.pressure is None else np.clip(stroke.pressure, LIGHTEST, None)
    return width * press
