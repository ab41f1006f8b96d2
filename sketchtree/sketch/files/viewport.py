"""How large is the page, and what do lengths on it mean? Viewboxes, nested viewports, percentages."""

import numpy as np
from cssselect2 import ElementWrapper

from sketchtree.errors import SketchError
from sketchtree.sketch.files.transforms import Matrix, length

REDRAW = "Draw that shape again, or export the drawing as plain SVG."


def page(root: ElementWrapper, name: str) -> tuple[float, float]:
    """(width, height) of the root's viewBox, else of the page."""
    box = _view_box(root, name)
    if box is not None:
        return box[2], box[3]
    size = [root.etree_element.get(side, "100%") for side in ("width", "height")]
    try:
        page = length(size[0], 300.0), length(size[1], 150.0)
    except ValueError:
        page = (300.0, 150.0)
    if min(page) <= 0:
        raise SketchError(
            f"{name} has a page of no size ({size[0]} × {size[1]}).",
            remedy="Set the page's width and height, and export it again.",
        )
    return page


def _view_box(element: ElementWrapper, name: str) -> tuple[float, float, float, float] | None:
    text = element.etree_element.get("viewBox")
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


def nested(element: ElementWrapper, view: tuple[float, float], name: str) -> Matrix:
    """A nested `svg` or `symbol`: its viewBox, centred in its own rectangle (xMidYMid meet, or none)."""
    attributes = element.etree_element.attrib
    x, y = (user_length(attributes.get(a, "0"), i, element, view, name) for i, a in enumerate("xy"))
    box = _view_box(element, name)
    if box is None:
        return np.array([[1, 0, x], [0, 1, y], [0, 0, 1.0]])
    size = [user_length(attributes.get(a, "100%"), i, element, view, name) for i, a in enumerate(("width", "height"))]
    scale = np.array([size[0] / box[2], size[1] / box[3]])
    if attributes.get("preserveAspectRatio", "xMidYMid").split()[0] != "none":
        scale[:] = scale.max() if "slice" in attributes.get("preserveAspectRatio", "") else scale.min()
    shift = np.array([x, y]) + (np.array(size) - scale * box[2:]) / 2 - scale * box[:2]
    return np.array([[scale[0], 0, shift[0]], [0, scale[1], shift[1]], [0, 0, 1.0]])


def user_length(text: str, axis: int, element: ElementWrapper, view: tuple[float, float], name: str) -> float:
    """`axis` 0: percentages are of the width, 1: of the height, 2: of the diagonal / √2."""
    whole = (*view, float(np.hypot(*view) / np.sqrt(2.0)))[axis]
    try:
        return length(text, whole)
    except ValueError as error:
        raise SketchError(f"in {name}, {error}.", stroke=element.id or f"<{element.local_name}>", remedy=REDRAW) from None
