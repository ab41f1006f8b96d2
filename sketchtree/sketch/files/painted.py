"""Which shapes does an SVG document paint, in which order, and where?

Styles cascade (`css`), transforms nest (`transforms`), `use` and nested `svg` are followed; what is hidden, transparent
or unpainted is left out, and so are the contents of definitions.
"""

from collections.abc import Iterator
from dataclasses import dataclass, field

import numpy as np
from cssselect2 import ElementWrapper

from sketchtree.errors import SketchError
from sketchtree.sketch.files.css import Cascade, Style
from sketchtree.sketch.files.labels import kind_named
from sketchtree.sketch.files.outlines import Subpath, flatten, subpaths
from sketchtree.sketch.files.paint import fraction, is_paint
from sketchtree.sketch.strokes import StrokeKind
from sketchtree.sketch.files.transforms import IDENTITY, Matrix, matrix_of
from sketchtree.sketch.files.viewport import REDRAW, nested, page, user_length

DEEPEST = 256  # nested elements
_SHAPES = frozenset({"path", "line", "polyline", "polygon", "rect", "circle", "ellipse"})
_GROUPS = frozenset({"svg", "g", "a", "switch"})
_LABELS = ("{http://www.inkscape.org/namespaces/inkscape}label", "id", "class", "data-name")
_HREF = ("href", "{http://www.w3.org/1999/xlink}href")


@dataclass(frozen=True, eq=False)
class Shape:
    """One painted shape, its geometry in user units of the root (y down)."""

    id: str | None
    paths: list[Subpath]
    kind: StrokeKind | None
    width: float | None
    filled: bool


@dataclass(frozen=True)
class _Scope:
    """What an element inherits."""

    matrix: Matrix = field(default_factory=lambda: IDENTITY)
    style: Style = field(default_factory=dict)
    kind: StrokeKind | None = None
    depth: int = 0
    uses: tuple[str, ...] = ()


class Walk:
    """One pass over a document, in the order of painting."""

    def __init__(self, root: ElementWrapper, name: str, max_strokes: int):
        self.name, self.max_strokes = name, max_strokes
        self.root, self.cascade = root, Cascade(root)
        self.view = page(root, name)
        self.by_id = {e.id: e for e in reversed(list(root.iter_subtree())) if e.id}
        self.warnings: list[str] = []
        self.seen = 0

    def shapes(self) -> list[Shape]:
        """Every painted shape. Raises SketchError when there are more than `max_strokes` strokes."""
        found: list[Shape] = []
        count = 0
        for shape in self._element(self.root, _Scope()):
            found.append(shape)
            count += len(shape.paths)
            if count > self.max_strokes:
                raise SketchError(
                    f"{self.name} holds more than {self.max_strokes} strokes.",
                    remedy="Draw fewer strokes, or raise the limit with --max-strokes.",
                )
        return found

    def _element(self, element: ElementWrapper, scope: _Scope) -> Iterator[Shape]:
        tag, attributes = element.local_name, element.etree_element.attrib
        self._guard(scope)
        if tag not in _SHAPES | _GROUPS | {"use", "symbol"} or (tag == "symbol" and not scope.uses):
            return
        style = self.cascade.style(element, scope.style)
        if style.get("display") == "none" or fraction(style.get("opacity", "1")) == 0.0:
            return
        matrix = scope.matrix @ self._matrix(element, style)
        kind = kind_named(*(attributes.get(label) for label in _LABELS)) or scope.kind
        inner = _Scope(matrix, style, kind, scope.depth + 1, scope.uses)
        if tag in _SHAPES:
            yield from self._shape(element, inner)
        elif tag == "use":
            yield from self._use(element, inner)
        else:
            yield from self._children(element, inner)

    def _children(self, element: ElementWrapper, scope: _Scope) -> Iterator[Shape]:
        if scope.depth > 1 and element.local_name in ("svg", "symbol"):
            scope = _Scope(scope.matrix @ nested(element, self.view, self.name), scope.style, scope.kind, scope.depth, scope.uses)
        for child in element.iter_children():
            yield from self._element(child, scope)

    def _use(self, element: ElementWrapper, scope: _Scope) -> Iterator[Shape]:
        attributes = element.etree_element.attrib
        target = next((attributes[h] for h in _HREF if h in attributes), "")
        if not target.startswith("#"):
            self.warnings.append(f"A <use> of '{target[:60]}' was left out: other files are not read.")
        elif target[1:] in self.by_id and target not in scope.uses:
            x, y = (user_length(attributes.get(a, "0"), i, element, self.view, self.name) for i, a in enumerate("xy"))
            shift = np.array([[1, 0, x], [0, 1, y], [0, 0, 1.0]])
            inner = _Scope(scope.matrix @ shift, scope.style, scope.kind, scope.depth, (*scope.uses, target))
            yield from self._element(self.by_id[target[1:]], inner)

    def _shape(self, element: ElementWrapper, scope: _Scope) -> Iterator[Shape]:
        style = scope.style
        stroke = is_paint(style.get("stroke", "none"), style.get("stroke-opacity", "1"), style)
        fill = is_paint(style.get("fill", "black"), style.get("fill-opacity", "1"), style) and element.local_name != "line"
        width = user_length(style.get("stroke-width", "1"), 2, element, self.view, self.name) if stroke else 0.0
        if style.get("visibility", "visible") != "visible" or not (fill or width > 0):
            return
        if style.get("vector-effect") != "non-scaling-stroke":
            width *= float(np.sqrt(abs(np.linalg.det(scope.matrix[:2, :2]))))
        paths = [transformed(path, scope.matrix) for path in self._geometry(element)]
        filled = width <= 0
        yield Shape(element.id, paths, scope.kind, None if filled else width, filled)

    def _geometry(self, element: ElementWrapper) -> list[Subpath]:
        try:
            return subpaths(element.local_name, element.etree_element.attrib, self.view)
        except ValueError as error:
            raise SketchError(f"in {self.name}, {error}.", stroke=element.id or f"<{element.local_name}>", remedy=REDRAW) from None

    def _matrix(self, element: ElementWrapper, style: Style) -> Matrix:
        if style.get("transform-box") in ("fill-box", "content-box", "stroke-box", "border-box"):
            box = self._fill_box(element)
        else:
            box = (0.0, 0.0, *self.view)
        attribute = None if element is self.root else element.etree_element.get("transform")
        style = {} if element is self.root else style
        try:
            return matrix_of(attribute, style, box)
        except ValueError as error:
            raise SketchError(f"in {self.name}, {error}.", stroke=element.id or f"<{element.local_name}>", remedy=REDRAW) from None

    def _fill_box(self, element: ElementWrapper) -> tuple[float, float, float, float]:
        """Bounding box of an element in its own coordinates."""
        scope = _Scope(depth=2)
        if element.local_name in _SHAPES:
            paths = self._geometry(element)
        else:
            paths = [path for child in element.iter_children() for shape in self._element(child, scope) for path in shape.paths]
        if not paths:
            return 0.0, 0.0, 0.0, 0.0
        corners = np.concatenate([np.concatenate([p.start[None], flatten(p.cubics, 1e-3 * extent_of(paths))[0]]) for p in paths])
        low, high = corners.min(0), corners.max(0)
        return float(low[0]), float(low[1]), float(high[0] - low[0]), float(high[1] - low[1])

    def _guard(self, scope: _Scope) -> None:
        self.seen += 1
        if scope.depth > DEEPEST or self.seen > 10 * self.max_strokes + 100_000:
            raise SketchError(
                f"{self.name} nests its groups more than {DEEPEST} deep, or repeats them too often.",
                remedy="Ungroup the drawing, unlink its clones, and export it again.",
            )


def transformed(path: Subpath, matrix: Matrix) -> Subpath:
    """The same geometry after a transform."""
    linear, shift = matrix[:2, :2].T, matrix[:2, 2]
    return Subpath(path.start @ linear + shift, path.cubics @ linear + shift, path.closed)


def extent_of(paths: list[Subpath]) -> float:
    """The larger side of the bounding box of all control points."""
    points = np.concatenate([p.start[None] for p in paths] + [p.cubics.reshape(-1, 2) for p in paths])
    finite = points[np.isfinite(points).all(1)]
    return float(np.ptp(finite, axis=0).max()) if len(finite) else 0.0
