"""What strokes does an SVG file hold? The drawing as one sees it, in the user units of its viewBox, y up.

The document is walked as a browser paints it: styles cascade (`css`), transforms nest (`transforms`), `use` and
nested `svg` are followed, and what is not painted is left out: hidden, transparent and unpainted shapes, and
the contents of definitions. Clips, masks and filters are ignored: a stroke counts as it was drawn.
The viewBox is not mapped to the viewport, so that a point of the file keeps its numbers (y negated).
"""

from collections.abc import Iterator
from dataclasses import dataclass, field

import numpy as np
from cssselect2 import ElementWrapper

from sketchtree.errors import SketchError
from sketchtree.sketch.css import Cascade, Style
from sketchtree.sketch.document import parse_xml
from sketchtree.sketch.labels import kind_named
from sketchtree.sketch.outlines import Subpath, flatten, subpaths
from sketchtree.sketch.paint import fraction, is_paint
from sketchtree.sketch.strokes import Sketch, Stroke, StrokeKind
from sketchtree.sketch.transforms import IDENTITY, Matrix, length, matrix_of

FLATNESS = 5e-4  # how far a flattened curve may lie from the true one, of the drawing's size
DEEPEST = 256  # nested elements
_SHAPES = frozenset({"path", "line", "polyline", "polygon", "rect", "circle", "ellipse"})
_GROUPS = frozenset({"svg", "g", "a", "switch"})
_LABELS = ("{http://www.inkscape.org/namespaces/inkscape}label", "id", "class", "data-name")
_HREF = ("href", "{http://www.w3.org/1999/xlink}href")
_REDRAW = "Draw that shape again, or export the drawing as plain SVG."


@dataclass(frozen=True, eq=False)
class _Shape:
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


def read_svg(data: bytes, name: str, *, max_strokes: int = 20_000) -> Sketch:
    """The strokes of an SVG file, in document order. Raises SketchError."""
    root = parse_xml(data, name)
    if root.tag.rpartition("}")[2] != "svg":
        tag = root.tag.rpartition("}")[2]
        raise SketchError(f"{name} is XML, but its root is <{tag}>, not <svg>.", remedy="Export the drawing as SVG.")
    walk = _Walk(ElementWrapper.from_xml_root(root), name, max_strokes)
    shapes = walk.shapes()
    strokes, warnings = _strokes(shapes, name, walk.view)
    return Sketch(strokes, name=name, units="px", warnings=tuple(walk.warnings) + warnings)


class _Walk:
    """One pass over a document, in the order of painting."""

    def __init__(self, root: ElementWrapper, name: str, max_strokes: int):
        self.name, self.max_strokes = name, max_strokes
        self.root, self.cascade = root, Cascade(root)
        self.view = self._view(root)
        self.by_id = {e.id: e for e in reversed(list(root.iter_subtree())) if e.id}
        self.warnings: list[str] = []
        self.seen = 0

    def shapes(self) -> list[_Shape]:
        """Every painted shape. Raises SketchError when there are more than `max_strokes` strokes."""
        found: list[_Shape] = []
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

    def _element(self, element: ElementWrapper, scope: _Scope) -> Iterator[_Shape]:
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

    def _children(self, element: ElementWrapper, scope: _Scope) -> Iterator[_Shape]:
        if scope.depth > 1 and element.local_name in ("svg", "symbol"):
            scope = _Scope(scope.matrix @ self._nested(element), scope.style, scope.kind, scope.depth, scope.uses)
        for child in element.iter_children():
            yield from self._element(child, scope)

    def _use(self, element: ElementWrapper, scope: _Scope) -> Iterator[_Shape]:
        attributes = element.etree_element.attrib
        target = next((attributes[h] for h in _HREF if h in attributes), "")
        if not target.startswith("#"):
            self.warnings.append(f"A <use> of '{target[:60]}' was left out: other files are not read.")
        elif target[1:] in self.by_id and target not in scope.uses:
            x, y = (self._length(attributes.get(a, "0"), i, element) for i, a in enumerate("xy"))
            shift = np.array([[1, 0, x], [0, 1, y], [0, 0, 1.0]])
            inner = _Scope(scope.matrix @ shift, scope.style, scope.kind, scope.depth, (*scope.uses, target))
            yield from self._element(self.by_id[target[1:]], inner)

    def _shape(self, element: ElementWrapper, scope: _Scope) -> Iterator[_Shape]:
        style = scope.style
        stroke = is_paint(style.get("stroke", "none"), style.get("stroke-opacity", "1"), style)
        fill = is_paint(style.get("fill", "black"), style.get("fill-opacity", "1"), style) and element.local_name != "line"
        width = self._length(style.get("stroke-width", "1"), 2, element) if stroke else 0.0
        if style.get("visibility", "visible") != "visible" or not (fill or width > 0):
            return
        if style.get("vector-effect") != "non-scaling-stroke":
            width *= float(np.sqrt(abs(np.linalg.det(scope.matrix[:2, :2]))))
        paths = [_transformed(path, scope.matrix) for path in self._geometry(element)]
        filled = width <= 0
        yield _Shape(element.id, paths, scope.kind, None if filled else width, filled)

    def _geometry(self, element: ElementWrapper) -> list[Subpath]:
        try:
            return subpaths(element.local_name, element.etree_element.attrib, self.view)
        except ValueError as error:
            raise SketchError(f"in {self.name}, {error}.", stroke=element.id or f"<{element.local_name}>", remedy=_REDRAW) from None

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
            raise SketchError(f"in {self.name}, {error}.", stroke=element.id or f"<{element.local_name}>", remedy=_REDRAW) from None

    def _fill_box(self, element: ElementWrapper) -> tuple[float, float, float, float]:
        """Bounding box of an element in its own coordinates."""
        scope = _Scope(depth=2)
        if element.local_name in _SHAPES:
            paths = self._geometry(element)
        else:
            paths = [path for child in element.iter_children() for shape in self._element(child, scope) for path in shape.paths]
        if not paths:
            return 0.0, 0.0, 0.0, 0.0
        corners = np.concatenate([np.concatenate([p.start[None], flatten(p.cubics, 1e-3 * _size(paths))[0]]) for p in paths])
        low, high = corners.min(0), corners.max(0)
        return float(low[0]), float(low[1]), float(high[0] - low[0]), float(high[1] - low[1])

    def _view(self, root: ElementWrapper) -> tuple[float, float]:
        """(width, height) of the root's viewBox, else of the page."""
        box = self._view_box(root)
        if box is not None:
            return box[2], box[3]
        size = [root.etree_element.get(side, "100%") for side in ("width", "height")]
        try:
            page = length(size[0], 300.0), length(size[1], 150.0)
        except ValueError:
            page = (300.0, 150.0)
        if min(page) <= 0:
            raise SketchError(
                f"{self.name} has a page of no size ({size[0]} × {size[1]}).",
                remedy="Set the page's width and height, and export it again.",
            )
        return page

    def _view_box(self, element: ElementWrapper) -> tuple[float, float, float, float] | None:
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
                f'{self.name} has viewBox="{text[:60]}": four finite numbers are expected, width and height above 0.',
                remedy="Set the page size in the drawing program, and export it again.",
            )
        return x, y, width, height

    def _nested(self, element: ElementWrapper) -> Matrix:
        """A nested `svg` or `symbol`: its viewBox, centred in its own rectangle (xMidYMid meet, or none)."""
        attributes = element.etree_element.attrib
        x, y = (self._length(attributes.get(a, "0"), i, element) for i, a in enumerate("xy"))
        box = self._view_box(element)
        if box is None:
            return np.array([[1, 0, x], [0, 1, y], [0, 0, 1.0]])
        size = [self._length(attributes.get(a, "100%"), i, element) for i, a in enumerate(("width", "height"))]
        scale = np.array([size[0] / box[2], size[1] / box[3]])
        if attributes.get("preserveAspectRatio", "xMidYMid").split()[0] != "none":
            scale[:] = scale.max() if "slice" in attributes.get("preserveAspectRatio", "") else scale.min()
        shift = np.array([x, y]) + (np.array(size) - scale * box[2:]) / 2 - scale * box[:2]
        return np.array([[scale[0], 0, shift[0]], [0, scale[1], shift[1]], [0, 0, 1.0]])

    def _length(self, text: str, axis: int, element: ElementWrapper) -> float:
        """`axis` 0: percentages are of the width, 1: of the height, 2: of the diagonal / √2."""
        whole = (*self.view, float(np.hypot(*self.view) / np.sqrt(2.0)))[axis]
        try:
            return length(text, whole)
        except ValueError as error:
            raise SketchError(f"in {self.name}, {error}.", stroke=element.id or f"<{element.local_name}>", remedy=_REDRAW) from None

    def _guard(self, scope: _Scope) -> None:
        self.seen += 1
        if scope.depth > DEEPEST or self.seen > 10 * self.max_strokes + 100_000:
            raise SketchError(
                f"{self.name} nests its groups more than {DEEPEST} deep, or repeats them too often.",
                remedy="Ungroup the drawing, unlink its clones, and export it again.",
            )


def _strokes(shapes: list[_Shape], name: str, view: tuple[float, float]) -> tuple[tuple[Stroke, ...], tuple[str, ...]]:
    """Flatten every shape in one go and name the strokes."""
    entries = [(shape, k, path) for shape in shapes for k, path in enumerate(shape.paths)]
    if not entries:
        return (), ()
    tolerance = FLATNESS * _size([path for *_, path in entries])
    pieces = np.concatenate([path.cubics for *_, path in entries])
    points, steps = flatten(pieces, tolerance)
    ends = np.r_[0, np.cumsum(steps)][np.r_[0, np.cumsum([len(path.cubics) for *_, path in entries])]]
    strokes, warnings, used = [], [], set()
    order = {id(shape): number for number, shape in enumerate(shapes, 1)}
    for number, (shape, k, path) in enumerate(entries):
        line = np.concatenate([path.start[None], points[ends[number] : ends[number + 1]]]) * (1.0, -1.0)
        if path.closed and len(line) > 1 and (line[0] == line[-1]).all():
            line = line[:-1]
        if shape.filled and shape.kind is None and _is_page(line, view):
            warnings.append(f"A filled shape over the whole page ({shape.id or 'no id'}) was taken for the paper and left out.")
            continue
        stroke_id = _unique((shape.id or f"stroke-{order[id(shape)]}") + (f"-{k + 1}" if k else ""), used)
        try:
            strokes.append(
                Stroke(
                    stroke_id,
                    line,
                    shape.kind or StrokeKind.BRANCH,
                    labelled=shape.kind is not None,
                    closed=path.closed or shape.filled,
                    width=shape.width,
                    filled=shape.filled,
                )
            )
        except SketchError as error:
            raise SketchError(f"in {name}, {error.message}", stroke=stroke_id, remedy=error.remedy) from None
    return tuple(strokes), tuple(warnings)


def _unique(name: str, used: set[str]) -> str:
    free, k = name, 1
    while free in used:
        k += 1
        free = f"{name}-{k}"
    used.add(free)
    return free


def _transformed(path: Subpath, matrix: Matrix) -> Subpath:
    linear, shift = matrix[:2, :2].T, matrix[:2, 2]
    return Subpath(path.start @ linear + shift, path.cubics @ linear + shift, path.closed)


def _size(paths: list[Subpath]) -> float:
    """The larger side of the bounding box of all control points."""
    points = np.concatenate([p.start[None] for p in paths] + [p.cubics.reshape(-1, 2) for p in paths])
    finite = points[np.isfinite(points).all(1)]
    return float(np.ptp(finite, axis=0).max()) if len(finite) else 0.0


def _is_page(line, view: tuple[float, float]) -> bool:
    low, high = line.min(0), line.max(0)
    corners = np.array([[x, y] for x in (low[0], high[0]) for y in (low[1], high[1])])
    gaps = np.abs(line[:, None] - corners).max(-1).min(1)
    return bool(len(line) == 4 and gaps.max() < 1e-6 * max(view) and (high - low >= 0.9 * np.array(view)).all())
