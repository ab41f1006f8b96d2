"""What is an element called, and what does that make of the strokes inside it?

Programs keep the name a person gave in different places: `inkscape:label`, `serif:id` (Affinity), `data-name`
(Illustrator), `vectornator:layerName`, a `<title>`, the `id`, a class. The nearest name that says something decides.
"""

from typing import NamedTuple
from xml.etree.ElementTree import Element

from sketchtree.sketch.files.document import INKSCAPE, SERIF, local_name
from sketchtree.sketch.files.labels import is_automatic, meaning, plain_name
from sketchtree.sketch.strokes import StrokeKind

LABEL, _SERIF, _LINEARITY = f"{{{INKSCAPE}}}label", f"{{{SERIF}}}id", "{http://vectornator.io}layerName"


class Naming(NamedTuple):
    """What the names around a place in the document say."""

    kind: StrokeKind | None = None
    layer: str | None = None  # the nearest name that says something, else that of the innermost group a person named
    telling: bool = False  # whether `layer` says something

    def within(self, element: Element, *, is_group: bool) -> "Naming":
        """The naming inside one more element."""
        given, code, classes = _names(element)
        said = meaning(*given, code, classes)
        if said is not None:
            speaker = next(name for name in (*given, code, classes) if name and meaning(name) is not None)
            kind = said if isinstance(said, StrokeKind) else None
            if is_group or kind is None:
                return Naming(kind, plain_name(speaker), True)
            return self._replace(kind=kind)
        if not is_group or self.telling:
            return self
        name = next((name for name in given if name), code if code and not is_automatic(plain_name(code)) else None)
        return self if name is None else self._replace(layer=plain_name(name))


def _names(element: Element) -> tuple[tuple[str | None, ...], str | None, str | None]:
    """(names a person gave, the id, the classes)."""
    attributes = element.attrib
    title = None
    if len(element) and local_name(element[0].tag) == "title":
        title = (element[0].text or "").strip() or None
    given = (attributes.get(LABEL), attributes.get(_SERIF), attributes.get(_LINEARITY), attributes.get("data-name"), title)
    return given, attributes.get("id"), attributes.get("class")
