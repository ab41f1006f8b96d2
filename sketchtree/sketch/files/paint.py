"""Does a fill or a stroke show at all? Colours are not read beyond that."""

from sketchtree.sketch.files.css import Style


def is_paint(paint: str, opacity: str, style: Style) -> bool:
    """Whether a fill or stroke shows at all."""
    paint = paint.strip().lower()
    if paint == "currentcolor":
        paint = style.get("color", "black").strip().lower()
    clear = paint.startswith(("rgba(", "hsla(", "rgb(", "hsl(")) and _alpha(paint) == 0.0
    clear |= paint.startswith("#") and len(paint) in (5, 9) and set(paint[(len(paint) - 1) // 4 * 3 + 1 :]) == {"0"}
    return paint not in ("none", "transparent") and not clear and fraction(opacity) > 0.0


def _alpha(paint: str) -> float:
    parts = paint[paint.index("(") + 1 :].rstrip(")").replace("/", " / ").replace(",", " ").split()
    return fraction(parts[-1]) if "/" in parts or len(parts) == 4 else 1.0


def fraction(text: str) -> float:
    """An opacity: a number or a percentage; 1 when it can't be read, as CSS has it."""
    try:
        return float(text.rstrip("%")) / (100.0 if text.endswith("%") else 1.0)
    except ValueError:
        return 1.0
