"""What is the example of a photo with scribbles on it, as a drawing? The photo under a page, and each scribble a stroke; its tree is taken from them."""

import io
import json

import numpy as np

from sketchtree.editing.document import Document, Underlay
from sketchtree.sketch.strokes import Stroke, StrokeKind
from sketchtree.studio import examples
from sketchtree.studio.underlays import placed
from sketchtree.trunk.wanted import TrunkChoices

_SIDE = 320  # pixels of its picture in the gallery
_PAINT = {"foreground": (247, 103, 7), "background": (28, 126, 214)}


def scribbled_example(name: str) -> Document:
    """The drawing of one of `examples.SCRIBBLED`."""
    picture, said = examples.data(name), json.loads(examples.scribbles(name))
    page = Document.blank(name=name.rpartition(".")[0])
    under = placed(picture, name, page)
    unit = under.width / said["width"]
    strokes = {}
    for side in _PAINT:
        for k, line in enumerate(said[side], start=1):
            points = np.array(line, float) * (unit, -unit) + (under.x, under.y)
            strokes[f"{side}-{k}"] = Stroke(f"{side}-{k}", points, StrokeKind(side), labelled=True, width=said["brush"] * unit)
    under = Underlay(under.picture, under.x, under.y, under.width, under.height, 1.0, photo=True)
    return page.replace(strokes=strokes, underlay=under, trunk=TrunkChoices(on=True))


def scribbled_picture(name: str) -> bytes:
    """It, small, as PNG."""
    from PIL import Image, ImageDraw

    said = json.loads(examples.scribbles(name))
    with Image.open(io.BytesIO(examples.data(name))) as photo:
        shown = photo.convert("RGB")
    pen = ImageDraw.Draw(shown)
    for side, colour in _PAINT.items():
        for line in said[side]:
            pen.line([tuple(point) for point in line], fill=colour, width=round(2 * said["brush"]), joint="curve")
    shown.thumbnail((_SIDE, _SIDE))
    out = io.BytesIO()
    shown.save(out, "PNG")
    return out.getvalue()
