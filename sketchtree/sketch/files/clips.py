"""Which part of an element shows? Clip paths and plain masks as areas in the user units of the root.

CSS Masking 1. A clip shows what lies inside the union of its shapes. A mask of plain shapes shows what lies under its
bright ones (luminance × opacity ≥ DARK) and not under a dark one painted later; soft edges and gradients count as
showing. What can't be worked out (text, pictures) shows all, with a warning.
"""

import re
from collections.abc import Callable
from xml.etree.ElementTree import Element

import numpy as np
import shapely

from sketchtree.sketch.files.areas import NOTHING, Area, area, both
from sketchtree.sketch.files.css import Style
from sketchtree.sketch.files.document import local_name
from sketchtree.sketch.files.outlines import flatten
from sketchtree.sketch.files.paint import brightness
from sketchtree.sketch.files.path_data import Subpath
from sketchtree.sketch.files.transforms import Matrix
from sketchtree.sketch.files.viewport import Box, user_length

DARK = 0.05  # luminance × opacity below which a mask hides
MOST_REGIONS = 10_000  # worked out for one document
_FLAT = 1e-3  # how far a flattened border may lie from the true one, of its size
_URL = re.compile(r"""url\(\s*+["']?#([^"')]++)["']?\s*+\)""", re.IGNORECASE)  # possessive: looked at once
_NOT_PLAIN = frozenset({"text", "image", "foreignObject", "flowRoot"})


class Clips:
    """The clips and masks of one document. `walk` knows how to paint an element."""

    def __init__(self, walk):
        self.walk = walk
        self.warnings: dict[str, None] = {}  # an ordered set
        self._following: list[str] = []
        self._known: dict[tuple[str, str, bytes], Area | None] = {}
        self._alone = False  # whether what is worked out holds for one element only
        self._built = 0

    def region(self, element: Element, style: Style, matrix: Matrix) -> Area | None:
        """Where an element of this style shows, in root units (y down); None: everywhere. `matrix` is that of its content."""
        found = None
        for name, build in (("clip-path", self._clip), ("mask", self._mask)):
            value = style.get(name, "none")
            if value == "none":
                continue
            part = self._followed(value, build, element, matrix)
            found = both(found, part)
        return found

    def _followed(self, value: str, build: Callable, element: Element, matrix: Matrix) -> Area | None:
        match = _URL.match(value.strip())
        if match is None:
            self._ignore(value, "is of a kind that is not read")
            return None
        node = self.walk.by_id.get(match[1])
        if node is None:  # CSS: a clip that is not there clips nothing
            return None
        if match[1] in self._following:  # … nor does one inside itself; elsewhere it may
            self._alone = True
            return None
        key = match[1], build.__name__, matrix.tobytes()
        if key not in self._known:
            outer, self._alone = self._alone, False
            region = self._worked_out(match[1], node, build, element, matrix)
            alone, self._alone = self._alone, self._alone or outer
            if alone:
                return region
            self._known[key] = region
        return self._known[key]

    def _worked_out(self, name: str, node: Element, build: Callable, element: Element, matrix: Matrix) -> Area | None:
        self._built += 1
        if self._built > MOST_REGIONS:
            self._ignore(name, "is one of too many")
            return None
        if any(local_name(part.tag) in _NOT_PLAIN for part in node.iter()):
            self._ignore(name, "holds text or a picture")
            return None
        self._following.append(name)
        try:
            return build(node, element, matrix)
        except (ValueError, shapely.errors.GEOSException) as error:
            self._ignore(name, f"can't be worked out ({error})")
            return None
        finally:
            self._following.pop()

    def _ignore(self, name: str, why: str) -> None:
        self.warnings[f"The clip or mask '{name[:40]}' {why}; what it hides was read too."] = None

    def _clip(self, node: Element, element: Element, matrix: Matrix) -> Area | None:
        if local_name(node.tag) != "clipPath":
            return None
        inner = self._units(node.get("clipPathUnits", "userSpaceOnUse"), element, matrix)
        style = self.walk.cascade.style(node, {})
        inner = inner @ self.walk.matrix(node, style)
        parts = [self._visible(shape, _rings(shape.paths), shape.rule) for shape in self.walk.ghosts(node, inner)]
        whole = shapely.union_all(parts) if parts else NOTHING
        own = self.region(node, {"clip-path": style.get("clip-path", "none")}, matrix)
        return both(whole, own)

    def _mask(self, node: Element, element: Element, matrix: Matrix) -> Area | None:
        if local_name(node.tag) != "mask":
            return None
        inner = self._units(node.get("maskContentUnits", "userSpaceOnUse"), element, matrix)
        style = self.walk.cascade.style(node, {})
        by_alpha = style.get("mask-type") == "alpha"
        shown = NOTHING
        for shape in self.walk.painted(node, inner, style):
            for part, light, alpha in self._layers(shape):
                bright = alpha if by_alpha else light * alpha
                shown = shown | part if bright >= DARK else shown if by_alpha or alpha < 0.5 else shown - part
        if node.get("maskUnits") == "userSpaceOnUse":
            sides = [user_length(node.get(a, d), i % 2, node, self.walk.view, self.walk.name) for i, (a, d) in enumerate(_SIDES)]
            shown = both(shown, rectangle(tuple(sides), matrix))
        return shown

    def _layers(self, shape):
        """(area, luminance, opacity) of a shape's fill and of its line."""
        if shape.fill is not None:
            yield self._visible(shape, _rings(shape.paths), shape.rule), *brightness(shape.fill)
        if shape.line is not None:
            lines = [shapely.LineString(ring) for ring in _rings(shape.paths, closing=True) if len(ring) > 1]
            yield self._visible(shape, None, "", shapely.union_all(lines).buffer((shape.width or 0.0) / 2)), *brightness(shape.line)

    @staticmethod
    def _visible(shape, rings, rule: str, whole: Area | None = None) -> Area:
        whole = area(rings, rule) if whole is None else whole
        return both(whole, shape.clip)

    def _units(self, units: str, element: Element, matrix: Matrix) -> Matrix:
        if units != "objectBoundingBox":
            return matrix
        self._alone = True
        x, y, width, height = self.walk.fill_box(element)
        return matrix @ np.array([[width, 0, x], [0, height, y], [0, 0, 1.0]])


_SIDES = (("x", "-10%"), ("y", "-10%"), ("width", "120%"), ("height", "120%"))


def _rings(paths: list[Subpath], closing: bool = False) -> list[np.ndarray]:
    """Outlines as polylines; `closing` repeats the first point of those that are closed."""
    found = []
    for path in paths:
        corners = np.concatenate([path.start[None], path.cubics.reshape(-1, 2)])
        size = float(np.ptp(corners, axis=0).max())
        ring = np.concatenate([path.start[None], flatten(path.cubics, _FLAT * size)[0]])
        ring = ring[:-1] if len(ring) > 1 and (ring[0] == ring[-1]).all() else ring
        found.append(np.concatenate([ring, ring[:1]]) if closing and path.closed else ring)
    return found


def rectangle(box: Box, matrix: Matrix) -> Area | None:
    """A rectangle (x, y, width, height) after a transform; None, everywhere, where numbers are too large."""
    x, y, width, height = box
    corners = np.array([[x, y], [x + width, y], [x + width, y + height], [x, y + height]])
    corners = corners @ matrix[:2, :2].T + matrix[:2, 2]
    return shapely.Polygon(corners) if np.isfinite(corners).all() else None
