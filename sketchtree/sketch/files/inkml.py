"""What strokes does a file of digital ink hold? W3C InkML: traces in order, with force and time where the pen gave them.

Traces of `definitions` are drawn only where a `traceView` shows them; a view of a trace that is drawn anyway names it.
Trace and group names, and annotations of few words, say what a stroke is. Traces in the air (`penUp`), erasers and
empty traces are left out; pieces of one trace (`continuation`) are joined. Coordinates are the file's, y up.
"""

import dataclasses
import re
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from xml.etree.ElementTree import Element

import numpy as np
from jaxtyping import Float

from sketchtree.errors import SketchError
from sketchtree.sketch.files.document import parse_xml
from sketchtree.sketch.files.ids import unique
from sketchtree.sketch.files.inkml_channels import Channel, TraceFormat, forces, local, number, positions, times
from sketchtree.sketch.files.inkml_context import Contexts, Setting, id_of
from sketchtree.sketch.files.inkml_values import trace_values
from sketchtree.sketch.files.labels import is_automatic, kind_named, meaning
from sketchtree.sketch.files.limits import MAX_STROKES, check_points, check_strokes
from sketchtree.sketch.strokes import Sketch, Stroke, StrokeKind

DEEPEST = 256  # nested groups and views
FEW_WORDS = 3  # an annotation of more is a note, not a label
_REDRAW = "Draw that stroke again, or export the ink again."


@dataclass(eq=False)
class Ink:
    """One trace as it was found."""

    id: str
    table: list[Float[np.ndarray, "point channel"]]  # one for each piece
    setting: Setting
    form: TraceFormat
    names: list[str]  # the closest first
    begin: float | None  # ms, relative to the setting's clock
    lasts: float | None  # ms


def read_inkml(data: bytes, name: str, *, max_strokes: int = MAX_STROKES) -> Sketch:
    """The strokes of an InkML file, in document order. Raises SketchError naming the trace at fault."""
    root = parse_xml(data, name)
    if local(root) != "ink":
        raise SketchError(f"{name} is XML, but its root is <{local(root)}>, not <ink>.", remedy="Export the drawing as InkML or SVG.")
    try:
        walk = Walk(root, name, max_strokes)
        walk.children(root, walk.contexts.start, 0)
        walk.name_views()
    except ValueError as error:
        raise SketchError(f"in {name}, {error}.", remedy="Export the ink again.") from None
    largest = max((float(np.nanmax(force)) for ink in walk.found if len(force := _column(ink, "F"))), default=1.0)
    used: dict[str, int] = {}
    strokes = tuple(_stroke(ink, unique(ink.id or f"stroke-{k}", used), walk, largest) for k, ink in enumerate(walk.found, 1))
    along = next((ink.form.channel("X") for ink in walk.found), Channel("X"))
    units = along.units if along.units not in (None, "dev") and not along.resolution else "px"
    return Sketch(_from_zero(strokes), name=name, units=units, warnings=walk.warnings())


class Walk:
    """One pass over a file, in its order."""

    def __init__(self, root: Element, name: str, max_strokes: int):
        self.name, self.max_strokes = name, max_strokes
        self.contexts = Contexts(root)
        self.found: list[Ink] = []
        self._defined = {id(e) for part in root.iter() if local(part) == "definitions" for e in part.iter()}
        self._drawn: dict[int, Ink] = {}  # trace element → its ink
        self._views: list[tuple[Element, tuple[str, ...]]] = []  # what a view shows, and its names
        self._left_out: Counter[str] = Counter()
        self._turned = any(local(e) == "canvasTransform" and len(e) for e in root.iter())
        self._tables: dict[tuple[int, TraceFormat], np.ndarray] = {}
        self._seen = self._points = 0

    def children(self, element: Element, setting: Setting, depth: int) -> None:
        """Every trace in an element, in the setting that holds there."""
        for child in element:
            tag = local(child)
            if tag == "context":
                setting = self.contexts.under(child, setting)
            elif tag in ("traceFormat", "inkSource"):
                setting = self.contexts.part(child, setting)
            elif tag in ("trace", "traceGroup", "traceView"):
                self._one(child, setting, depth + 1)

    def _one(self, element: Element, setting: Setting, depth: int) -> None:
        self._count(depth)
        setting = self.contexts.entered(element, setting)
        if local(element) == "trace":
            self._trace(element, setting)
            return
        names = _names(element)
        layer = next((name for name in names if not is_automatic(name)), setting.layer)
        setting = dataclasses.replace(setting, names=(*names, *setting.names), layer=layer)
        target = self.contexts.find(element.get("traceDataRef")) if local(element) == "traceView" else None
        if target is not None and id(target) in self._defined:
            for part, span in _shown(element, target):
                if local(part) == "trace":
                    self._trace(part, self.contexts.entered(part, setting), span)
                elif local(part) in ("traceGroup", "traceView"):
                    self._one(part, setting, depth + 1)
        elif target is not None and not (element.get("from") or element.get("to")):
            self._views.append((target, setting.names))
        self.children(element, setting, depth)

    def _count(self, depth: int = 0) -> None:
        """One more element looked at. Raises ValueError for a file that would never end."""
        self._seen += 1
        if depth > DEEPEST or self._seen > 10 * self.max_strokes + 100_000:
            raise ValueError(f"groups and views are nested more than {DEEPEST} deep, or repeated too often")

    def _trace(self, element: Element, setting: Setting, span: slice = slice(None)) -> None:
        self._count()
        names = [*_names(element), *setting.names]
        brush = () if setting.brush is None else _names(setting.brush)
        if (element.get("type") or "").strip() == "penUp":
            self._left_out["trace of a lifted pen"] += 1
        elif any("eraser" in name.lower() for name in (*names, *brush)):
            self._left_out["eraser trace"] += 1
        elif len(table := self._table(element, setting)[span]):
            self._enter(element, setting, names, table)
        else:
            self._left_out["empty trace"] += 1

    def _table(self, element: Element, setting: Setting) -> Float[np.ndarray, "point channel"]:
        """The values of a trace; points without a place left out."""
        text = (element.text or "") + "".join(child.tail or "" for child in element)
        form = setting.form or _unnamed(text)
        if (id(element), form) in self._tables:
            return self._tables[id(element), form]
        self._left_out["unnamed channel"] = max(self._left_out["unnamed channel"], 0 if setting.form else len(form.regular) - 2)
        try:
            table = trace_values(text, len(form.regular), len(form.intermittent))
        except ValueError as error:
            raise SketchError(f"in {self.name}, {error}.", stroke=id_of(element) or len(self.found) + 1, remedy=_REDRAW) from None
        table = table[~np.isnan(positions(table, form)).any(1)]
        return self._tables.setdefault((id(element), form), table)

    def _enter(self, element: Element, setting: Setting, names: list[str], table: Float[np.ndarray, "point channel"]) -> None:
        """A trace as a stroke of its own, or as the next piece of an earlier one."""
        prior = self.contexts.find(element.get("priorTrace")) if element.get("continuation") in ("middle", "end") else None
        ink = None if prior is None else self._drawn.get(id(prior))
        if ink is not None and ink.table[0].shape[1] == table.shape[1]:
            ink.table.append(table)
        else:
            form = setting.form or TraceFormat((*TraceFormat().regular, *[Channel("")] * (table.shape[1] - 2)))
            ink = Ink(id_of(element), [table], setting, form, names, number(element.get("timeOffset")), number(element.get("duration")))
            self.found.append(ink)
            check_strokes(len(self.found), self.name, self.max_strokes)
        self._points += len(table)
        check_points(self._points, self.name)
        self._drawn[id(element)] = ink

    def name_views(self) -> None:
        """Give what is drawn the names of the views that show it; they lie closer than those of its groups."""
        for target, names in self._views:
            for trace in target.iter():
                self._count()
                if id(trace) in self._drawn:
                    self._drawn[id(trace)].names[0:0] = names

    def warnings(self) -> tuple[str, ...]:
        """What was left out, a line each."""
        lines = [f"{n} {what}{'s were' if n > 1 else ' was'} left out." for what, n in sorted((+self._left_out).items())]
        lines += ["Its canvas transforms are not applied: the ink is read as the pen drew it."] if self._turned else []
        return tuple(lines)


def _names(element: Element) -> list[str]:
    """What names an element: its annotations of few words, then its id."""
    texts = ["".join(e.itertext()).strip() for e in element if local(e) in ("annotation", "annotationXML")]
    return [text for text in (*texts, id_of(element)) if 0 < len(text.split()) <= FEW_WORDS]


def _shown(view: Element, target: Element) -> Iterator[tuple[Element, slice]]:
    """(trace or group, its points) that a view shows of what it refers to: `from` and `to` count from 1, a group's parts before points."""
    first, last = ([int(k) for k in re.findall(r"\d{1,9}", view.get(key) or "")] for key in ("from", "to"))
    depth = 0
    while local(target) != "trace" and first[depth : depth + 1] == last[depth : depth + 1] and depth < len(first):
        parts = [e for e in target if local(e) in ("trace", "traceGroup", "traceView")]
        if not 1 <= first[depth] <= len(parts):
            return
        target, depth = parts[first[depth] - 1], depth + 1
    span = slice(max(first[depth] - 1, 0) if depth < len(first) else None, last[depth] if depth < len(last) else None)
    if local(target) == "trace" or span == slice(None):
        yield target, span
    else:
        yield from ((part, slice(None)) for part in [e for e in target if local(e) in ("trace", "traceGroup", "traceView")][span])


def _unnamed(text: str) -> TraceFormat:
    """X, Y and as many channels without a name as the first point has further values."""
    extra = len(text.strip().partition(",")[0].split()) - 2
    return TraceFormat((*TraceFormat().regular, *[Channel("")] * extra)) if extra > 0 else TraceFormat()


def _column(ink: Ink, channel: str) -> Float[np.ndarray, " point"]:
    """The known values of one channel."""
    column = ink.form.column(channel)
    values = np.zeros(0) if column is None else np.concatenate([table[:, column] for table in ink.table])
    return values[~np.isnan(values)]


def _stroke(ink: Ink, stroke_id: str, walk: Walk, largest: float) -> Stroke:
    table = np.concatenate(ink.table)
    points = positions(table, ink.form)
    kind = kind_named(*ink.names)
    time = times(table, ink.form, ink.begin, ink.lasts)
    try:
        return Stroke(
            stroke_id,
            points,
            kind or StrokeKind.BRANCH,
            labelled=kind is not None,
            width=walk.contexts.width(ink.setting),
            pressure=None if walk.contexts.ignores_force(ink.setting) else forces(table, ink.form, largest),
            time=None if time is None else time + ink.setting.clock,
            layer=next((name for name in ink.names if meaning(name) is not None), ink.setting.layer),
        )
    except SketchError as error:
        raise SketchError(f"in {walk.name}, {error.message.split(': ', 1)[-1]}", stroke=stroke_id, remedy=error.remedy) from None


def _from_zero(strokes: tuple[Stroke, ...]) -> tuple[Stroke, ...]:
    """The same strokes, their times counted from the first."""
    first = min((float(s.time.min()) for s in strokes if s.time is not None), default=0.0)
    return tuple(s if s.time is None else dataclasses.replace(s, time=s.time - first) for s in strokes)
