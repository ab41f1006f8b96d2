"""A sketch as an SVG drawing: layers for Inkscape, lines for a browser, and nothing lost on the way back.

Every stroke is one path `M x,y x,y … [Z]` in the sketch's units with y down, its numbers written so that they read back
to the last bit. Strokes lie in layers: their own, else `branches`, `crown` or `obstacles` where the drawing named the
kind, else `strokes`. What SVG has no place for rides along (`svg_record`).
"""

import re
from xml.sax.saxutils import escape, quoteattr

import numpy as np

from sketchtree.sketch.files.document import INKSCAPE, SVG
from sketchtree.sketch.files.ids import unique
from sketchtree.sketch.files.svg_record import NAMESPACE, sketch_text, stroke_text
from sketchtree.sketch.strokes import Sketch, Stroke, StrokeKind

MARGIN = 0.05  # around a drawing without a page, of its size
PEN = 0.004  # width of a line that has none, of the drawing's size
_INK = {
    StrokeKind.BRANCH: "#4a3a2c", StrokeKind.CROWN: "#4f8a3a", StrokeKind.OBSTACLE: "#8a8a92",
    StrokeKind.FOREGROUND: "#2f9e63", StrokeKind.BACKGROUND: "#c8452f", StrokeKind.MATTE_ADD: "#2f9e63", StrokeKind.MATTE_ERASE: "#c8452f",
}  # fmt: skip
_LAYER = {
    StrokeKind.BRANCH: "branches", StrokeKind.CROWN: "crown", StrokeKind.OBSTACLE: "obstacles",
    StrokeKind.FOREGROUND: "foreground", StrokeKind.BACKGROUND: "background", StrokeKind.MATTE_ADD: "add", StrokeKind.MATTE_ERASE: "erase",  # as `matting` and `trunk` name them
}  # fmt: skip
_NAME = re.compile(r"[A-Za-z_][A-Za-z0-9_.-]*")
_UNPRINTABLE = re.compile("[\x00-\x1f\x7f-\x9f\ud800-\udfff\ufffe\uffff]")


def sketch_svg(sketch: Sketch) -> str:
    """The text of an SVG file; `read_svg` gives the same sketch back, bit for bit (but its name and warnings)."""
    view_box, pen = _view_box(sketch)
    layers: dict[str, list[int]] = {}
    for row, stroke in enumerate(sketch.strokes):
        layers.setdefault(_layer(stroke), []).append(row)
    used = dict.fromkeys((stroke.id for stroke in sketch.strokes), 1)
    head = [
        f'<svg xmlns="{SVG}" xmlns:inkscape="{INKSCAPE}" xmlns:sketchtree="{NAMESPACE}" viewBox="{view_box}"',
        f" sketchtree:sketch={quoteattr(sketch_text(sketch, view_box))}>",
        f"<title>{escape(_UNPRINTABLE.sub(' ', sketch.name))}</title>",
    ]
    body = []
    for number, (name, rows) in enumerate(layers.items(), 1):
        group = f"id={quoteattr(unique(f'layer{number}', used))} inkscape:groupmode=\"layer\" inkscape:label={quoteattr(name)}"
        body.append(f'<g {group} fill="none" stroke-linecap="round" stroke-linejoin="round">')
        body += [_path(sketch.strokes[row], row, name, pen, used) for row in rows]
        body.append("</g>")
    return "\n".join([*head, *body, "</svg>"]) + "\n"


def _layer(stroke: Stroke) -> str:
    """The name of the layer a stroke is put in."""
    if stroke.layer and stroke.layer.strip() and not _UNPRINTABLE.search(stroke.layer):
        return stroke.layer
    return _LAYER[stroke.kind] if stroke.labelled or stroke.kind != StrokeKind.BRANCH else "strokes"


def _path(stroke: Stroke, row: int, group: str, pen: float, used: dict[str, int]) -> str:
    own = stroke.id if _NAME.fullmatch(stroke.id) else unique(f"stroke-{row + 1}", used)
    width = repr(float(stroke.width if stroke.width else pen))
    ink = _INK[stroke.kind]
    paint = f'fill="{ink}"' if stroke.filled else f'stroke="{ink}"'
    record = stroke_text(stroke, row, as_id=own, as_group=group, as_pen=width)
    return f'<path id="{own}" {paint} stroke-width="{width}" d="{_data(stroke)}" sketchtree:stroke={quoteattr(record)}/>'


def _data(stroke: Stroke) -> str:
    points = " ".join(f"{x!r},{-y!r}" for x, y in stroke.points.tolist())
    return f"M{points}{'Z' if stroke.closed else ''}"


def _view_box(sketch: Sketch) -> tuple[str, float]:
    """(the viewBox, a fine pen's width): the page, else the drawing with a margin."""
    with np.errstate(all="ignore"):
        points = np.concatenate([np.zeros((0, 2)), *(stroke.points for stroke in sketch.strokes)])
        low, high = (points.min(0), points.max(0)) if len(points) else (np.zeros(2), np.ones(2))
        size = float((high - low).max())
        if sketch.page is not None:
            left, bottom, right, top = sketch.page
        else:
            (left, bottom), (right, top) = low - MARGIN * size, high + MARGIN * size
        box = [float(left), float(-top), float(right - left), float(top - bottom)]
    fits = bool(np.isfinite(box).all()) and min(box[2:]) > 0
    pen = PEN * size if 0 < PEN * size < np.inf else 1.0
    return " ".join(map(repr, box)) if fits else "0 0 100 100", pen
