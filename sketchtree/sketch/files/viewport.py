"""How large is the page, and what do lengths on it mean? Viewboxes, nested viewports, percentages."""

import math
from collections.abc import Mapping
from typing import NamedTuple
from xml.etree.ElementTree import Element

import numpy as np

from sketchtree.errors import SketchError
from sketchtree.sketch.files.document import local_name
from sketchtree.sketch.files.transforms import EM, Matrix, length, translation

REDRAW = "Draw that shape again, or export the drawing as plain SVG."

Box = tuple[float, float, float, float]  # x, y, width, height; y down


class View(NamedTuple):
    """What lengths refer to: the size of the viewport around, and of its letters, user units."""

    width: float
    height: float
    em: float = EM

    def length(self, text: str, axis: int) -> float:
        """A length in user units. `axis` 0: percentages are of the width, 1: of the height, 2: of the diagonal / √2. Raises ValueError."""
        whole = 0.0
        if "%" in text:
            whole = (self.width, self.height, math.hypot(self.width, self.height) / math.sqrt(2.0))[axis]
        return length(text, whole, self.em)

    def with_letters(self, size: str) -> "View":
        """The same inside an element of this font size; words for sizes change nothing."""
        try:
            em = length(size, self.em, self.em)
        except ValueError:
            return self
        return self if em == self.em or em < 0 else self._replace(em=em)


def page(root: Element, name: str) -> tuple[Box, bool]:
    """The root's viewBox, else the page from 0, 0; and whether the file says so at all (or a browser's 300 × 150 stands in)."""
    box = _view_box(root, name)
    if box is not None:
        return box, True
    size = [root.get(side, "100%") for side in ("width", "height")]
    try:
        width, height = length(size[0], 300.0), length(size[1], 150.0)
    except ValueError:
        return (0.0, 0.0, 300.0, 150.0), False
    if min(width, height) <= 0:
        raise SketchError(
            f"{name} has a page of no size ({size[0][:20]} × {size[1][:20]}).",
            remedy="Set the page's width and height, and export it again.",
        )
    return (0.0, 0.0, width, height), not any(side.strip().endswith("%") for side in size)


def screen_scale(root: Element, box: Box) -> float:
    """Pixels that a user unit of the root's viewBox takes on a screen; 1 where the file does not say."""
    try:
        sides = [length(root.get(side, "100%"), math.nan) / whole for side, whole in zip(("width", "height"), box[2:], strict=True)]
    except ValueError:
        return 1.0
    known = [side for side in sides if math.isfinite(side) and side > 0]
    return min(known) if known else 1.0


def _view_box(element: Element, name: str) -> Box | None:
    text = element.get("viewBox")
    if text is None:
        return None
    try:
        x, y, width, height = (float(part) for part in text.replace(",", " ").split())
        finite = bool(np.isfinite([x, y, width, height]).all())
    except ValueError:
        finite = False
    if not finite or width <= 0 or height <= 0:
        raise SketchError(
            f'{name} has viewBox="{text[:60]}": four finite numbers are expected, width and height above 0.',
            remedy="Set the page size in the drawing program, and export it again.",
        )
    return x, y, width, height


def nested(element: Element, view: View, name: str, given: Mapping[str, str] | None = None) -> tuple[Matrix, Box | None, View]:
    """(matrix, the rectangle it shows in outer units, what lengths inside refer to) of a nested `svg` or `symbol`: its viewBox
    fitted into its own rectangle as `preserveAspectRatio` says. `given` replaces attributes: the width and height of a `use`.
    No rectangle: nothing is cut."""
    attributes = {**element.attrib, **(given or {})}
    x, y = (user_length(attributes.get(a, "0"), i, element, view, name) for i, a in enumerate("xy"))
    box = _view_box(element, name)
    if box is None and not {"width", "height"} & attributes.keys():
        return translation(x, y), None, view
    size = [user_length(attributes.get(a, "100%"), i, element, view, name) for i, a in enumerate(("width", "height"))]
    port = (x, y, max(size[0], 0.0), max(size[1], 0.0))
    if box is None:
        return translation(x, y), port, view._replace(width=port[2], height=port[3])
    aspect = attributes.get("preserveAspectRatio", "xMidYMid").split() or ["xMidYMid"]
    scale = np.array([size[0] / box[2], size[1] / box[3]])
    if aspect[0] != "none":
        scale[:] = scale.max() if "slice" in aspect else scale.min()
    spare = np.array(size) - scale * box[2:]
    part = np.array([_PART.get(aspect[0][1:4].lower(), 0.5), _PART.get(aspect[0][5:8].lower(), 0.5)])
    part = np.zeros(2) if aspect[0] == "none" else part
    shift = np.array([x, y]) + spare * part - scale * box[:2]
    matrix = np.array([[scale[0], 0, shift[0]], [0, scale[1], shift[1]], [0, 0, 1.0]])
    return matrix, port, view._replace(width=box[2], height=box[3])


_PART = {"min": 0.0, "mid": 0.5, "max": 1.0}


def user_length(text: str, axis: int, element: Element, view: View, name: str) -> float:
    """A length of one element, as `View.length` has it. Raises SketchError naming the element."""
    try:
        return view.length(text, axis)
    except ValueError as error:
        raise at(element, name, error) from None


def at(element: Element, name: str, error: Exception) -> SketchError:
    """The error for an attribute of one element that can't be read."""
    return SketchError(f"in {name}, {error}.", stroke=element.get("id") or f"<{local_name(element.tag)}>", remedy=REDRAW)
