"""Does a fill or a stroke show at all, and how bright is it? Colours are not read beyond that."""

import re
from collections.abc import Container
from functools import lru_cache
from typing import NamedTuple

from tinycss2.color3 import parse_color

from sketchtree.sketch.files.css import Style


_SERVER = re.compile(r"""url\(\s*+["']?([^"')]*+)["']?\s*+\)\s*+(.*)""", re.IGNORECASE | re.DOTALL)  # possessive: looked at once


class Paint(NamedTuple):
    """A paint that shows, as text."""

    colour: str
    opacity: str


def seen(paint: str, opacity: str, style: Style, by_id: Container[str]) -> Paint | None:
    """What a fill or stroke shows; None if nothing. A gradient that is not in the file shows what stands after it, else nothing;
    `currentColor` becomes the colour it stands for."""
    server = _SERVER.match(paint.strip()) if "(" in paint else None
    if server is not None and server[1].strip().removeprefix("#") not in by_id:
        paint = server[2].strip() or "none"
    if paint.lower() == "currentcolor":
        paint = style.get("color", "black")
    return None if _is_clear(paint, opacity) else Paint(paint, opacity)


@lru_cache(maxsize=1024)
def brightness(paint: Paint) -> tuple[float, float]:
    """(luminance, opacity), 0 to 1: the weights of linear sRGB, as masks have them; a pattern or gradient counts as white."""
    colour = parse_color(paint.colour.strip())
    opacity = min(max(fraction(paint.opacity), 0.0), 1.0)
    if not isinstance(colour, tuple):
        return 1.0, opacity
    return 0.2126 * colour[0] + 0.7152 * colour[1] + 0.0722 * colour[2], opacity * colour[3]


@lru_cache(maxsize=1024)
def fraction(text: str) -> float:
    """An opacity: a number or a percentage; 1 when it can't be read, as CSS has it."""
    try:
        return float(text.rstrip("%")) / (100.0 if text.endswith("%") else 1.0)
    except ValueError:
        return 1.0


@lru_cache(maxsize=1024)
def _is_clear(paint: str, opacity: str) -> bool:
    paint = paint.strip().lower()
    clear = "(" in paint and not paint.startswith("url(") and _alpha(paint) == 0.0
    clear |= paint.startswith("#") and len(paint) in (5, 9) and set(paint[(len(paint) - 1) // 4 * 3 + 1 :]) == {"0"}
    return clear or paint in ("none", "transparent") or fraction(opacity) <= 0.0


def _alpha(paint: str) -> float:
    """The opacity of a colour function: what stands after "/", or the fourth of the numbers of `rgba(r, g, b, a)`."""
    parts = paint[paint.index("(") + 1 :].rstrip(")").replace("/", " / ").replace(",", " ").split()
    fourth = paint.startswith(("rgb", "hsl")) and len(parts) == 4
    return fraction(parts[-1]) if "/" in parts or fourth else 1.0
