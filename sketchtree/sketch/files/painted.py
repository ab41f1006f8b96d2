"""Which shapes does an SVG document paint, in which order, and where?

Styles cascade (`css`), transforms nest (`transforms`), `use`, `switch` and nested `svg` are followed, clips and masks
(`clips`) are worked out; what is hidden, transparent or unpainted is left out and counted (`left_out`).
"""

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from types import MappingProxyType
from typing import NamedTuple
from xml.etree.ElementTree import Element

import numpy as np

from sketchtree.errors import SketchError
from sketchtree.sketch.files.areas import Area, both
from sketchtree.sketch.files.clips import Clips, rectangle
from sketchtree.sketch.files.css import GEOMETRY, Cascade, Style, geometry
from sketchtree.sketch.files.document import DEEPEST, XLINK, local_name, too_deep
from sketchtree.sketch.files.left_out import LeftOut
from sketchtree.sketch.files.limits import check_points
from sketchtree.sketch.files.names import LABEL, Naming
from sketchtree.sketch.files.outlines import SHAPES, subpaths
from sketchtree.sketch.files.paint import Paint, fraction, seen
from sketchtree.sketch.files.path_data import Subpath
from sketchtree.sketch.files.path_effects import Spine, spine
from sketchtree.sketch.files.shapes import Shape, bounds, transformed
from sketchtree.sketch.files.svg_record import STROKE, StrokeRecord, polyline, stroke_record
from sketchtree.sketch.files.transforms import IDENTITY, Matrix, matrix_of, scale_of, translation
from sketchtree.sketch.files.viewport import Box, View, at, nested, page, screen_scale, user_length

_GROUPS = frozenset({"svg", "g", "a", "switch"})
_PAINTED = SHAPES | _GROUPS | {"use", "symbol"}
_OTHER = {"text": "a text", "flowRoot": "a text", "image": "a picture", "foreignObject": "an embedded page"}
_HREF = ("href", f"{{{XLINK}}}href")
_MOST_CLONED = 100_000  # elements drawn through `use`, or looked at for a clip or a box, beyond two for every stroke allowed


class _Scope(NamedTuple):
    """What an element inherits."""

    view: View  # what lengths refer to
    matrix: Matrix = IDENTITY
    style: Style = MappingProxyType({})
    naming: Naming = Naming()
    depth: int = 0
    cloned: bool = False  # inside what a `use` draws
    clip: Area | None = None
    ghost: bool = False  # geometry counts, paint does not: the shapes of a clip path
    group: str | None = None  # the name of the group around
    given: Mapping[str, str] | None = None  # width and height of the `use` that draws this very element


class Walk:
    """One pass over a document, in the order of painting."""

    def __init__(self, root: Element, name: str, max_strokes: int):
        self.name, self.max_strokes, self.root = name, max_strokes, root
        self.cascade = Cascade(root)
        self.box, self.has_page = page(root, name)
        self.view = View(*self.box[2:])
        self.screen = screen_scale(root, self.box)
        self.by_id: dict[str, Element] = {}
        for element in root.iter():
            if (own := element.get("id")) is not None:
                self.by_id.setdefault(own, element)
        self.clips = Clips(self)
        self.left_out = LeftOut()
        self.elsewhere: dict[str, int] = {}  # `use` of other files
        self._found: list[Shape] = []
        self._cloned = 0
        self._open: set[Element] = set()  # the elements around the one that is looked at
        self._strokes = self._points = 0
        self._boxes: dict[Element, Box] = {}
        self._outlines: dict[tuple[Element, View], list[Subpath]] = {}

    def shapes(self) -> list[Shape]:
        """Every painted shape. Raises SketchError when there are more than `max_strokes` strokes."""
        self._element(self.root, _Scope(self.view))
        return self._found

    def warnings(self) -> tuple[str, ...]:
        """What was left out, or read in doubt."""
        others = [
            f"A <use> of '{target[:60]}'" + (f" (and {count - 1} more of it)" if count > 1 else "") + " was left out: other files are not read."
            for target, count in self.elsewhere.items()
        ]
        return (*self.left_out.sentence(), *others, *self.cascade.warnings, *self.clips.warnings)

    def ghosts(self, node: Element, matrix: Matrix) -> list[Shape]:
        """The shapes inside a clip path, whatever their paint."""
        return self._apart(node, _Scope(self.view, matrix, depth=2, ghost=True))

    def painted(self, node: Element, matrix: Matrix, style: Style) -> list[Shape]:
        """The shapes inside a mask."""
        return self._apart(node, _Scope(self.view, matrix, style, depth=2))

    def fill_box(self, element: Element) -> Box:
        """Bounding box of an element in its own coordinates (those of what it draws, for a `use`), line widths and clips left out."""
        if element not in self._boxes:
            self._boxes[element] = (0.0, 0.0, 0.0, 0.0)  # what it is to its own descendants, should they ask
            paths = [path for shape in self._apart(element, _Scope(self.view, depth=2, ghost=True), itself=True) for path in shape.paths]
            self._boxes[element] = bounds(paths)
        return self._boxes[element]

    def matrix(self, element: Element, style: Style) -> Matrix:
        """The transform of one element."""
        attribute = element.get("transform")
        if attribute is None and not style.keys() & _MOVES:
            return IDENTITY
        if style.get("transform-box") in ("fill-box", "content-box", "stroke-box", "border-box"):
            x, y, width, height = self.fill_box(element)
            shift = self._shift(element, self.view)
            box = (x + shift[0], y + shift[1], width, height)
        else:
            box = (0.0, 0.0, *self.view[:2])
        try:
            return matrix_of(attribute, style, box)
        except ValueError as error:
            raise at(element, self.name, error) from None

    def _apart(self, node: Element, scope: _Scope, *, itself: bool = False) -> list[Shape]:
        """The shapes of a part of the document by themselves; nothing of it is counted."""
        with self._aside() as found:
            if itself and local_name(node.tag) in SHAPES:
                self._shape(node, scope, {"visibility": "visible"})
            elif not itself or local_name(node.tag) in _GROUPS | {"symbol"}:
                for child in node:
                    self._element(child, scope)
            elif local_name(node.tag) == "use":
                self._use(node, scope)
        return found

    @contextmanager
    def _aside(self) -> Iterator[list[Shape]]:
        kept = self._found, self.left_out, self._strokes, self._open
        self._found, self.left_out, self._open = [], LeftOut(), set()
        try:
            yield self._found
        finally:
            self._found, self.left_out, self._strokes, self._open = kept

    def _element(self, element: Element, scope: _Scope) -> None:
        tag = local_name(element.tag)
        if tag not in _PAINTED or (tag == "symbol" and scope.given is None):
            if tag in _OTHER:
                self.left_out.add(_OTHER[tag])
            return
        if element in self._open:
            self.left_out.add("a clone of what it lies in")
            return
        self._guard(scope)
        style = self.cascade.style(element, scope.style)
        if style.get("display", "").lower() == "none" or fraction(style.get("opacity", "1")) <= 0.0 or not _fits(element):
            self._hide(element, scope)
            return
        view = scope.view
        if "font-size" in style:
            view = view.with_letters(style["font-size"])
            style["font-size"] = repr(view.em)
        is_root = element is self.root
        naming = scope.naming if is_root else scope.naming.within(element, is_group=tag not in SHAPES)
        own = IDENTITY if is_root else self.matrix(element, style)
        matrix = scope.matrix if own is IDENTITY else scope.matrix @ own
        if tag == "use" and (shift := self._shift(element, view)) != (0.0, 0.0):
            matrix = matrix @ translation(*shift)
        clip = scope.clip
        if "clip-path" in style or "mask" in style:
            clip = both(clip, self.clips.region(element, style, matrix))
        group = scope.group if tag in SHAPES or is_root else element.get(LABEL) or element.get("id")
        inner = _Scope(view, matrix, style, naming, scope.depth + 1, scope.cloned, clip, scope.ghost, group)
        if tag in SHAPES:
            self._shape(element, inner, style)
            return
        self._open.add(element)
        if tag == "use":
            self._use(element, inner)
        else:
            self._group(element, tag, inner, scope.given)
        self._open.remove(element)

    def _group(self, element: Element, tag: str, scope: _Scope, given: Mapping[str, str] | None) -> None:
        if tag == "symbol" or (tag == "svg" and element is not self.root):
            matrix, port, view = nested(element, scope.view, self.name, given)
            clip = scope.clip
            if port is not None and scope.style.get("overflow", "hidden") not in ("visible", "auto"):
                clip = both(clip, rectangle(port, scope.matrix))
            scope = scope._replace(matrix=scope.matrix @ matrix, clip=clip, view=view)
        if tag == "switch":
            first = next((child for child in element if local_name(child.tag) in _PAINTED | _OTHER.keys() and _fits(child)), None)
            if first is not None:
                self._element(first, scope)
            else:
                self._hide(element, scope)
            return
        for child in element:
            self._element(child, scope)

    def _use(self, element: Element, scope: _Scope) -> None:
        attributes = element.attrib
        target = next((attributes[h] for h in _HREF if h in attributes), "")
        if not target.startswith("#"):
            self.elsewhere[target] = self.elsewhere.get(target, 0) + 1
        elif target[1:] not in self.by_id:
            self.left_out.add("a clone of nothing")
        else:
            given = {side: attributes[side] for side in ("width", "height") if side in attributes}
            self._element(self.by_id[target[1:]], scope._replace(cloned=True, given=given))

    def _shift(self, element: Element, view: View) -> tuple[float, float]:
        """x and y of a `use`, which move what it draws, and its clip, after its own transform."""
        if local_name(element.tag) != "use":
            return 0.0, 0.0
        return tuple(user_length(element.get(a, "0"), i, element, view, self.name) for i, a in enumerate("xy"))

    def _shape(self, element: Element, scope: _Scope, style: Style) -> None:
        line = seen(style.get("stroke", "none"), style.get("stroke-opacity", "1"), style, self.by_id)
        fill = seen(style.get("fill", "black"), style.get("fill-opacity", "1"), style, self.by_id) if local_name(element.tag) != "line" else None
        width = user_length(style.get("stroke-width", "1"), 2, element, scope.view, self.name) if line else 0.0
        scale = scale_of(scope.matrix)
        if style.get("visibility", "visible") != "visible" or (scale == 0 and not scope.ghost):  # 0: squeezed flat
            self._hide(element, scope)
        elif scope.ghost or fill or width > 0:
            self._put(element, scope, style, fill, line, width)
        elif local_name(element.tag) != "rect":  # programs put unpainted rectangles around drawings
            self.left_out.add("a shape without fill or stroke")

    def _put(self, element: Element, scope: _Scope, style: Style, fill: Paint | None, line: Paint | None, width: float) -> None:
        """Enter a shape that shows; `width` is that of its line in its own units, 0 if it has none."""
        scale = scale_of(scope.matrix)
        if style.get("vector-effect") == "non-scaling-stroke":
            scale = 1.0 / self.screen
        under = None if scope.ghost else spine(element, self.by_id)
        record, drawn = self._own(element, style, scope)
        paths = [] if drawn else self._geometry(element, style, under, scope)
        self._count(1 if drawn else len(paths), len(drawn[0]) if drawn else sum(len(path.cubics) for path in paths))
        filled = width <= 0 and under is None
        if under is not None:
            under = under.scaled(scale)
        self._found.append(
            Shape(
                element,
                paths,
                scope.naming,
                width=None if filled else under.width if under is not None else width * scale,
                filled=filled,
                rule=style.get("clip-rule" if scope.ghost else "fill-rule", "nonzero"),
                fill=fill,
                line=line,
                clip=scope.clip,
                spine=under,
                matrix=scope.matrix,
                group=scope.group,
                pen=style.get("stroke-width", "1"),
                record=record,
                drawn=drawn,
            )
        )

    def _own(self, element: Element, style: Style, scope: _Scope) -> tuple[StrokeRecord | None, tuple[np.ndarray, bool] | None]:
        """(record, points) of a stroke that we wrote, as far as nobody has redrawn it."""
        if scope.ghost or STROKE not in element.attrib:
            return None, None
        try:
            record = stroke_record(element)
        except ValueError:
            self.left_out.add("a spoilt record")
            return None, None
        drawn = polyline(element.get("d", "")) if local_name(element.tag) == "path" and "d" not in style else None
        if drawn is not None and scope.matrix is not IDENTITY:
            drawn = drawn[0] @ scope.matrix[:2, :2].T + scope.matrix[:2, 2], drawn[1]
        if drawn is not None and not np.isfinite(drawn[0]).all():
            raise at(element, self.name, ValueError("a coordinate is not a finite number"))
        return record, drawn

    def _geometry(self, element: Element, style: Style, under: Spine | None, scope: _Scope) -> list[Subpath]:
        """The outline of a shape where it lies; that of a clone is worked out once."""
        attributes = element.attrib
        if under is not None:
            attributes = {"d": under.data}
        elif style.keys() & GEOMETRY:
            attributes = {**attributes, **geometry(style)}
        try:
            if not scope.cloned or attributes is not element.attrib:
                return transformed(subpaths(local_name(element.tag), attributes, scope.view), scope.matrix)
            if (element, scope.view) not in self._outlines:
                self._outlines[element, scope.view] = subpaths(local_name(element.tag), attributes, scope.view)
            return transformed(self._outlines[element, scope.view], scope.matrix)
        except ValueError as error:
            raise at(element, self.name, error) from None

    def _hide(self, element: Element, scope: _Scope) -> None:
        count = 1 if scope.cloned else sum(local_name(part.tag) in SHAPES or local_name(part.tag) == "use" for part in element.iter())
        self.left_out.add("a hidden shape", count)

    def _count(self, strokes: int, points: int) -> None:
        self._strokes += strokes
        self._points += points
        check_points(self._points, self.name)
        if self._strokes > self.max_strokes:
            raise SketchError(
                f"{self.name} holds more than {self.max_strokes} strokes.",
                remedy="Draw fewer strokes, or raise the limit with --max-strokes.",
            )

    def _guard(self, scope: _Scope) -> None:
        self._cloned += scope.cloned or scope.ghost
        if scope.depth > DEEPEST or self._cloned > 2 * self.max_strokes + _MOST_CLONED:
            raise too_deep(self.name)


_MOVES = frozenset({"transform", "translate", "rotate", "scale"})


def _fits(element: Element) -> bool:
    """Whether an element is for us: no extension of some program, and in English if in any language."""
    if element.get("requiredExtensions", "").strip():
        return False
    languages = element.get("systemLanguage")
    return languages is None or any(part.strip().lower().split("-")[0] == "en" for part in languages.split(","))
