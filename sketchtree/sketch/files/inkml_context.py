"""Under which context was an InkML trace drawn? Its trace format, brush and clock, by reference or in place.

Elements name one another by `#id`. What a context does not say it takes from the one it refers to, else from the one
that held before (the streaming style); a file with a single trace format means that one throughout.
"""

import dataclasses
from collections.abc import Iterator
from dataclasses import dataclass
from datetime import UTC, datetime
from xml.etree.ElementTree import Element

from sketchtree.sketch.files.inkml_channels import METRES, TraceFormat, local, number, per_metre, trace_format

DEEPEST = 64  # references one after another
_ID = "{http://www.w3.org/XML/1998/namespace}id"


@dataclass(frozen=True)
class Setting:
    """What holds for a trace unless it says otherwise."""

    form: TraceFormat | None = None  # None: the file names no channels
    brush: Element | None = None
    clock: float = 0.0  # ms, what its times count from
    names: tuple[str, ...] = ()  # of the groups it lies in, innermost first
    layer: str | None = None  # of the innermost group that has one


class Contexts:
    """The contexts, brushes, formats and time stamps of one file."""

    def __init__(self, root: Element):
        self._forms: dict[int, TraceFormat | None] = {}  # by the element
        self._formats: dict[int, Element | None] = {}  # of an ink source
        self._by_id = {id_of(e): e for e in reversed(list(root.iter())) if id_of(e)}
        canvas = {id(f) for c in root.iter() if local(c) == "canvas" for f in c.iter()}
        forms = [e for e in root.iter() if local(e) == "traceFormat" and id(e) not in canvas]
        self._sources = {id(f): source for source in root.iter() if local(source) == "inkSource" for f in source}
        self.start = Setting(self._form(forms[0]) if len(forms) == 1 else None)

    def find(self, reference: str | None) -> Element | None:
        """The element that `#id` (or `id`) names in this file."""
        return self._by_id.get(reference.strip().removeprefix("#")) if reference else None

    def entered(self, element: Element, setting: Setting) -> Setting:
        """The setting inside a trace, group or view, after its `contextRef` and `brushRef`."""
        context = self.find(element.get("contextRef"))
        if context is not None:
            setting = self.under(context, setting)
        brush = self.find(element.get("brushRef"))
        return setting if brush is None else dataclasses.replace(setting, brush=brush)

    def under(self, context: Element, setting: Setting, depth: int = 0) -> Setting:
        """The setting after a context."""
        before = self.find(context.get("contextRef"))
        if before is not None and depth < DEEPEST:
            setting = self.under(before, setting, depth + 1)
        for element in self._parts(context):
            setting = self.part(element, setting)
        return setting

    def part(self, element: Element, setting: Setting) -> Setting:
        """The setting after a trace format, source, brush or time stamp."""
        tag = local(element)
        if tag == "traceFormat":
            return dataclasses.replace(setting, form=self._form(element))
        if tag == "inkSource":
            if id(element) not in self._formats:
                self._formats[id(element)] = next((e for e in element if local(e) == "traceFormat"), None)
            form = self._formats[id(element)]
            return setting if form is None else dataclasses.replace(setting, form=self._form(form))
        if tag == "brush":
            return dataclasses.replace(setting, brush=element)
        if tag == "timestamp":
            return dataclasses.replace(setting, clock=self._stamp(element))
        return setting

    def _parts(self, context: Element) -> Iterator[Element]:
        """What a context refers to, then what it holds; the trace format last, for it says more than the source."""
        for name in ("inkSourceRef", "brushRef", "timestampRef"):
            found = self.find(context.get(name))
            if found is not None:
                yield found
        yield from (child for child in context if local(child) != "traceFormat")
        form = self.find(context.get("traceFormatRef"))
        yield from () if form is None else (form,)
        yield from (child for child in context if local(child) == "traceFormat")

    def _form(self, element: Element) -> TraceFormat | None:
        if id(element) not in self._forms:
            self._forms[id(element)] = self._read_form(element)
        return self._forms[id(element)]

    def _read_form(self, element: Element) -> TraceFormat | None:
        if not any(local(e) == "channel" for e in element.iter()):
            return None
        source = self._sources.get(id(element))
        properties = {}
        for child in () if source is None else source.iter():
            if local(child) == "channelProperty":
                value = number(child.get("value"))
                if value is not None:
                    key = (child.get("channel") or "").strip(), (child.get("name") or "").strip()
                    properties[key] = value, (child.get("units") or "").strip()
        return trace_format(element, properties)

    def _stamp(self, element: Element, depth: int = 0) -> float:
        """Milliseconds of a time stamp; 0 where it says nothing that can be read."""
        before = self.find(element.get("timestampRef"))
        base = self._stamp(before, depth + 1) if before is not None and depth < DEEPEST else 0.0
        own = number(element.get("time"))
        if own is None and element.get("timeString"):
            try:
                moment = datetime.fromisoformat(element.get("timeString").strip())
                own = (moment if moment.tzinfo else moment.replace(tzinfo=UTC)).timestamp() * 1e3
            except (ValueError, OverflowError):
                own = None
        return base + (own or 0.0) + (number(element.get("timeOffset")) or 0.0)

    def width(self, setting: Setting) -> float | None:
        """Width of the brush in the units of X; None where there is none."""
        value, units = self._property(setting.brush, "width")
        if value is None or value < 0:
            return None
        along = None if setting.form is None else setting.form.channel("X")
        per = None if along is None else per_metre(along)
        return value * METRES[units] * per if units in METRES and per else value

    def ignores_force(self, setting: Setting) -> bool:
        """Whether the brush draws as wide however hard the pen is pressed."""
        value, _ = self._property(setting.brush, "ignorePressure")
        return bool(value)

    def _property(self, brush: Element | None, name: str, depth: int = 0) -> tuple[float | None, str]:
        if brush is None or depth > DEEPEST:
            return None, ""
        for child in brush:
            if local(child) == "brushProperty" and (child.get("name") or "").strip() == name:
                value = (child.get("value") or "").strip().lower()
                return number({"true": "1", "false": "0"}.get(value, value)), (child.get("units") or "").strip()
        return self._property(self.find(brush.get("brushRef")), name, depth + 1)


def id_of(element: Element) -> str:
    """The id of an element, "" for none."""
    return (element.get(_ID) or element.get("id") or "").strip()
