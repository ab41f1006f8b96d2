"""Is this text a safe XML document? Files as an element tree, nothing fetched, entities expanded only while small.

Files come from strangers. Illustrator and its like declare their namespaces as entities inside the DOCTYPE; those are put
in as long as all references together add no more than LARGEST_GROWTH characters, which stops every entity bomb
before it swells. External and parameter entities are refused, external DTDs are not read. Prefixes that a careless
export forgot to declare get the meaning everyone gives them.
"""

import codecs
import re
from collections import ChainMap, Counter
from functools import lru_cache
from xml.etree.ElementTree import Element
from xml.parsers import expat

from sketchtree.errors import SketchError
from sketchtree.sketch.files.limits import MAX_MB, inflate

DEEPEST = 256  # nested elements
MOST_SPACES = 100  # prefixes that are copied from element to element
MOST_ENTITIES = 500  # expat puts them in by recursion
LARGEST_GROWTH = 2**20  # characters that all entity references of a file may add
_TOGETHER = 2**20  # characters of text that come at once
SVG = "http://www.w3.org/2000/svg"
XLINK = "http://www.w3.org/1999/xlink"
INKSCAPE = "http://www.inkscape.org/namespaces/inkscape"
SERIF = "http://www.serif.com/"
_XML = "http://www.w3.org/XML/1998/namespace"
_USUAL = {"xml": _XML, "svg": SVG, "xlink": XLINK, "inkscape": INKSCAPE, "serif": SERIF}
_REFERENCE = re.compile(r"&([^#&;\s][^&;\s]{0,255});")
_DECLARED = re.compile(rb"""^\s*<\?xml[^>]*?encoding\s*=\s*["']([\w.:-]{1,40})["']""")
_NO_TEXT = frozenset({"punycode", "idna", "unicode_escape", "raw_unicode_escape", "undefined"})  # codecs, but no file's encoding
_MARKS = (
    (codecs.BOM_UTF8, "utf-8-sig"),
    (codecs.BOM_UTF32_LE, "utf-32"),
    (codecs.BOM_UTF32_BE, "utf-32"),
    (codecs.BOM_UTF16_LE, "utf-16"),
    (codecs.BOM_UTF16_BE, "utf-16"),
    (b"<\0", "utf-16-le"),
    (b"\0<", "utf-16-be"),
)
_EXPORT = "Export the drawing again."


def parse_xml(data: bytes, name: str, *, max_mb: float = MAX_MB) -> Element:
    """The root element of an XML file, gzipped or plain, in any encoding. Raises SketchError for damaged or hostile ones."""
    text = decoded(inflate(data, name, max_mb=max_mb), name).strip("\ufeff\0 \t\r\n")
    if not text:
        raise SketchError(f"{name} is empty.", remedy="Save the drawing again.")
    try:
        return _Builder(text, name).root
    except expat.ExpatError as error:
        cause = f"{expat.ErrorString(error.code)} in line {error.lineno}"
        raise SketchError(f"{name} is not well-formed XML ({cause}); it may be cut short.", remedy=_EXPORT) from None


def decoded(data: bytes, name: str) -> str:
    """The text of a file: by its byte order mark, else as its XML declaration says, else UTF-8, else Latin-1.

    Bytes that are no letter in that encoding become "\ufffd": names may suffer, coordinates can't.
    """
    marked = next((encoding for mark, encoding in _MARKS if data.startswith(mark)), None)
    if marked:
        return data.decode(marked, "replace")
    found = _DECLARED.match(data[:400])
    encoding = found[1].decode("ascii").lower() if found else "utf-8"
    encoding = "utf-8" if encoding.startswith(("utf-16", "utf16", "ucs")) else encoding  # it began as bytes of ASCII
    try:
        if codecs.lookup(encoding).name.replace("-", "_") in _NO_TEXT:
            raise LookupError
        return data.decode(encoding, "replace" if found else "strict")
    except LookupError:
        raise SketchError(f"{name} says that its text is in '{encoding}', which is no known encoding.", remedy="Save it as UTF-8.") from None
    except UnicodeDecodeError:
        return data.decode("latin-1")


@lru_cache(maxsize=1024)
def local_name(tag: str) -> str:
    """The bare name of an SVG element's tag; "" for an element of any other vocabulary."""
    space, _, local = tag.rpartition("}")
    return local if space in ("", "{" + SVG) else ""


class _Builder:
    """Feeds expat's events into an element tree."""

    def __init__(self, text: str, name: str):
        self.text, self.name = text, name
        self.root: Element | None = None
        self._open: list[Element] = []
        self._last: Element | None = None  # the element just closed: text goes to its tail
        self._spaces: list[dict[str, str]] = [_USUAL]
        self._known: list[dict[str, str]] = [{}]  # resolved names, for every scope of prefixes
        self._entities: dict[str, str] = {}
        parser = expat.ParserCreate()
        parser.buffer_text, parser.buffer_size, parser.specified_attributes = True, _TOGETHER, True
        parser.StartElementHandler, parser.EndElementHandler = self._start, self._end
        parser.CharacterDataHandler = self._characters
        parser.EntityDeclHandler, parser.EndDoctypeDeclHandler = self._entity, self._check_growth
        parser.Parse(text, True)

    def _start(self, tag: str, attributes: dict[str, str]) -> None:
        if len(self._open) >= DEEPEST:
            raise too_deep(self.name)
        spaces, known = self._spaces[-1], self._known[-1]
        declared = {key[6:]: value for key, value in attributes.items() if key[:5] == "xmlns" and key[5:6] in ("", ":")}
        if declared:
            many = isinstance(spaces, ChainMap) or len(spaces) > MOST_SPACES
            spaces, known = ChainMap(declared, *getattr(spaces, "maps", [spaces])) if many else {**spaces, **declared}, {}
        self._spaces.append(spaces)
        self._known.append(known)
        if tag not in known:
            known[tag] = _resolved(tag, spaces, spaces.get("", ""))
        plain = {}
        for key, value in attributes.items():
            if ":" in key:
                key = _resolved(key, spaces, "")
            plain[key] = value
        element = Element(known[tag], plain)
        if self._open:
            self._open[-1].append(element)
        else:
            self.root = element
        self._open.append(element)
        self._last = None

    def _end(self, _: str) -> None:
        self._last = self._open.pop()
        self._spaces.pop()
        self._known.pop()

    def _characters(self, text: str) -> None:
        if self._last is None:
            self._open[-1].text = (self._open[-1].text or "") + text
        else:
            self._last.tail = (self._last.tail or "") + text

    def _entity(self, entity, is_parameter, value, base, system, public, notation) -> None:
        if is_parameter or value is None:
            kind = "a parameter entity" if is_parameter else "an entity of another file"
            raise SketchError(
                f"{self.name} declares {kind} ({entity[:40]}), which could fetch files.",
                remedy="Save it as plain SVG, without a DOCTYPE that declares entities.",
            )
        self._entities.setdefault(entity, value)
        if len(self._entities) > MOST_ENTITIES:
            raise self._bomb(f"are more than {MOST_ENTITIES}")

    def _check_growth(self) -> None:
        """Refuse entities that refer to themselves, or that would swell the document."""
        lengths: dict[str, int] = {}
        used = Counter(match[1] for match in _REFERENCE.finditer(self.text)) if self._entities else {}
        growth = sum(self._length(entity, lengths, ()) * used.get(entity, 0) for entity in self._entities)
        if growth > LARGEST_GROWTH:
            raise self._bomb("would swell the document")

    def _length(self, entity: str, lengths: dict[str, int], above: tuple[str, ...]) -> int:
        """How many characters an entity stands for once all inside it is put in."""
        if entity in above:
            raise self._bomb("refer to themselves")
        if entity not in lengths:
            value = self._entities[entity]
            inner = [name for name in _REFERENCE.findall(value) if name in self._entities]
            lengths[entity] = len(value) + sum(self._length(name, lengths, (*above, entity)) for name in inner)
        return lengths[entity]

    def _bomb(self, what: str) -> SketchError:
        return SketchError(
            f"{self.name} declares XML entities that {what}.",
            remedy="Save it as plain SVG, without a DOCTYPE that declares entities.",
        )


def too_deep(name: str) -> SketchError:
    """The error for elements inside elements without end."""
    return SketchError(
        f"{name} nests its groups more than {DEEPEST} deep, or repeats them too often.",
        remedy="Ungroup the drawing, unlink its clones, and export it again.",
    )


def _resolved(name: str, spaces: dict[str, str], default: str) -> str:
    """A name with its namespace in braces, as element trees have it; an unknown prefix is a namespace of its own."""
    prefix, colon, local = name.rpartition(":")
    space = spaces.get(prefix, prefix) if colon else default
    return f"{{{space}}}{local}" if space else local
