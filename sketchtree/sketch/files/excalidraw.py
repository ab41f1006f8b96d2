"""What strokes does an Excalidraw drawing hold? Scenes (`.excalidraw`), libraries (`.excalidrawlib`) and what its clipboard holds.

Lines, arrows and freedraw are strokes; rectangles, diamonds and ellipses are closed ones. Pictures, texts, what is
invisible, and arrows to or from a text are none; what is deleted is not there. Freedraw is painted

    wide = FREEDRAW · strokeWidth · f(pressure),   f = 1 − THINNING (1 − sin(π pressure / 2))

so `Stroke.width` is its width at full pressure, or, drawn with a mouse, at MOUSE.
"""

import math
from collections import Counter
from collections.abc import Iterator
from typing import Any

import numpy as np

from sketchtree.errors import SketchError
from sketchtree.sketch.files.excalidraw_labels import FRAMES, Labels, text_of
from sketchtree.sketch.files.excalidraw_shapes import BOXED, POINTED, drawn
from sketchtree.sketch.files.ids import unique
from sketchtree.sketch.files.json_text import AGAIN, is_number, parse_json
from sketchtree.sketch.files.limits import MAX_STROKES, check_number, check_strokes
from sketchtree.sketch.strokes import Sketch, Stroke, StrokeKind

FREEDRAW = 4.25  # painted width of a freedraw at full pressure, of its strokeWidth
THINNING = 0.6  # what no pressure takes from it
MOUSE = 0.5  # the pressure of a pen that reports none
FLATNESS = 5e-4  # how far a flattened curve may lie from the true one, of the drawing's size
_UNKNOWN = "unknown element"
_OTHERS = {"image": "picture", "text": "text", "embeddable": "web page", "iframe": "web page"}


def read_excalidraw(data: bytes, name: str, *, max_strokes: int = MAX_STROKES, number: int | None = None) -> Sketch:
    """The strokes of an Excalidraw file, in the order they are painted, px, y up. Raises SketchError naming the element.

    `number` is the drawing wanted of a library, from 1; None: the first, with a warning if there are others.
    """
    return excalidraw_sketch(parse_json(data, name), name, max_strokes=max_strokes, number=number)


def is_excalidraw(document: Any) -> bool:
    """Whether a JSON document is an Excalidraw scene, library or clipboard."""
    keys = ("elements", "libraryItems", "library")
    return isinstance(document, dict) and (text_of(document.get("type")).startswith("excalidraw") or any(key in document for key in keys))


def excalidraw_sketch(document: Any, name: str, *, max_strokes: int = MAX_STROKES, number: int | None = None) -> Sketch:
    """The strokes of a parsed Excalidraw document; as `read_excalidraw`."""
    if not is_excalidraw(document):
        raise SketchError(f"{name} is JSON, but no Excalidraw drawing.", remedy=AGAIN)
    elements, warnings = _elements(document, name, number)
    labels = Labels.of(elements)
    left_out: Counter[str] = Counter()
    shown = [(k, element) for k, element in enumerate(elements, 1) if _is_shown(element, labels, left_out)]
    check_strokes(len(shown), name, max_strokes)
    tolerance = FLATNESS * _size(element for _, element in shown)
    used: dict[str, int] = {}
    strokes = []
    for k, element in shown:
        stroke_id = unique(text_of(element.get("id")) or f"stroke-{k}", used)
        try:
            strokes.append(_stroke(element, stroke_id, labels, tolerance))
        except ValueError as error:
            raise SketchError(f"in {name}, {error}.", stroke=stroke_id, remedy="Draw it again, or delete it.") from None
    return Sketch(tuple(strokes), name=name, units="px", warnings=(*warnings, *_said(left_out, elements)))


def _said(left_out: Counter[str], elements: list[dict[str, Any]]) -> Iterator[str]:
    """A line for every kind of thing that was left out."""
    unknown = sorted({element["type"] for element in elements} - POINTED - BOXED - FRAMES - _OTHERS.keys())
    for what, count in sorted(left_out.items()):
        named = f" ({', '.join(unknown)[:60]})" if what == _UNKNOWN else ""
        yield f"{count} {what}{'s' if count > 1 else ''}{named} {'were' if count > 1 else 'was'} left out."


def _elements(document: dict[str, Any], name: str, number: int | None) -> tuple[list[dict[str, Any]], list[str]]:
    """The elements of a scene or of one drawing of a library, and what to say about the choice."""
    items = document.get("libraryItems", document.get("library"))
    elements, warnings = document.get("elements"), []
    if isinstance(items, list) and "elements" not in document:
        item = items[check_number(number or 1, len(items), name) - 1]
        elements = item.get("elements") if isinstance(item, dict) else item
        if number is None and len(items) > 1:
            title = f" ('{text_of(item.get('name'))}')" if isinstance(item, dict) and text_of(item.get("name")) else ""
            warnings.append(f"{name} is a library of {len(items)} drawings; the first{title} was read. {name}#2 is the next.")
    else:
        check_number(number or 1, 1, name)
    if not isinstance(elements, list) or not all(isinstance(e, dict) and isinstance(e.get("type"), str) for e in elements):
        raise SketchError(f"{name} has no list 'elements' of objects with a 'type'.", remedy=AGAIN)
    return [element for element in elements if element.get("isDeleted") is not True], warnings


def _is_shown(element: dict[str, Any], labels: Labels, left_out: Counter[str]) -> bool:
    """Whether an element is a stroke that shows; what else the drawing holds is counted."""
    kind = element["type"]
    if kind in FRAMES or (kind == "text" and _labels_something(element, labels)):
        return False
    if kind not in POINTED | BOXED:
        left_out[_OTHERS.get(kind, _UNKNOWN)] += 1
    elif element.get("opacity") == 0 or not (_has_outline(element) or _has_fill(element)):
        left_out["invisible element"] += 1
    elif labels.is_note(element):
        left_out["arrow at a text"] += 1
    else:
        return True
    return False


def _labels_something(element: dict[str, Any], labels: Labels) -> bool:
    text = text_of(element.get("originalText")) or text_of(element.get("text"))
    return text in labels.words


def _has_outline(element: dict[str, Any]) -> bool:
    return _shows(element.get("strokeColor", "#000")) and element.get("strokeWidth", 2) != 0


def _has_fill(element: dict[str, Any]) -> bool:
    return _shows(element.get("backgroundColor")) and element["type"] != "arrow"


def _shows(colour: Any) -> bool:
    """Whether a colour, as CSS writes it, can be seen."""
    colour = text_of(colour).lower()
    clear = colour.startswith("#") and len(colour) in (5, 9) and set(colour[-(len(colour) // 4) :]) == {"0"}
    return not clear and colour not in ("", "none", "transparent")


def _stroke(element: dict[str, Any], stroke_id: str, labels: Labels, tolerance: float) -> Stroke:
    shape = drawn(element, tolerance)
    kind = labels.kind(element)
    filled = shape.loop and _has_fill(element)
    pressure = _pressure(element, len(shape.points))
    return Stroke(
        stroke_id,
        shape.points * (1.0, -1.0),
        kind or StrokeKind.BRANCH,
        labelled=kind is not None,
        closed=shape.closed or filled,
        width=_width(element, pressure is not None) if _has_outline(element) else None,
        pressure=pressure,
        filled=filled,
        layer=labels.layer(element),
    )


def _width(element: dict[str, Any], pressed: bool) -> float:
    """Line width as painted, px."""
    width = element.get("strokeWidth", 2)
    if not is_number(width) or width < 0:
        raise ValueError(f"its strokeWidth is {width!r:.40}; a number of at least 0 was expected")
    if element["type"] != "freedraw":
        return float(width)
    return FREEDRAW * float(width) * (1.0 if pressed else 1.0 - THINNING * (1.0 - math.sin(math.pi * MOUSE / 2)))


def _pressure(element: dict[str, Any], count: int) -> np.ndarray | None:
    """Pressure at every point, 0-1; None where the pen gave none."""
    pressures = element.get("pressures")
    if element["type"] != "freedraw" or element.get("simulatePressure") is True or not isinstance(pressures, list) or not pressures:
        return None
    if not all(map(is_number, pressures)):
        raise ValueError("its pressures are not all finite numbers")
    given = np.clip(np.array(pressures[:count], float), 0.0, 1.0)
    return np.r_[given, np.full(count - len(given), MOUSE)]


def _size(elements) -> float:
    """The larger side of what the elements cover, roughly: turning and curves left out."""
    corners = []
    for element in elements:
        x, y, w, h = (element.get(key, 0.0) for key in ("x", "y", "width", "height"))
        if all(map(is_number, (x, y, w, h))):
            corners += [(x, y), (x + w, y + h)]
    return float(np.ptp(np.array(corners, float), axis=0).max()) if corners else 0.0
