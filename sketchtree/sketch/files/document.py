"""Is this text a safe XML document? SVG files as an element tree, nothing fetched, nothing expanded.

Files come from strangers: external entities are refused, entity bombs and gzip bombs are stopped before
they grow. Illustrator declares its namespaces as plain internal entities, so those alone are replaced.
"""

import gzip
import io
import re
from xml.etree.ElementTree import Element, ParseError

from defusedxml import DefusedXmlException, EntitiesForbidden
from defusedxml.ElementTree import fromstring

from sketchtree.errors import SketchError

LARGEST_FILE = 256 * 2**20  # bytes, after decompression
_ENTITY = re.compile(rb"<!ENTITY\s+([\w.:-]+)\s+(\"[^\"&%<]*\"|'[^'&%<]*')\s*>")
_SUBSET = re.compile(rb"<!DOCTYPE[^\[>]*\[.*?\]\s*>", re.DOTALL)
_EXPORT = "Export the drawing again as plain SVG."


def parse_xml(data: bytes, name: str) -> Element:
    """The root element of an XML file. Raises SketchError for damaged or hostile ones."""
    try:
        return _parse(inflate(data, name))
    except DefusedXmlException as error:
        raise SketchError(
            f"{name} declares XML entities, which could swell or fetch files ({type(error).__name__}).",
            remedy="Save it as plain SVG, without a DOCTYPE that declares entities.",
        ) from None
    except (ParseError, ValueError, LookupError) as error:
        raise SketchError(f"{name} is not well-formed XML ({error}); it may be cut short.", remedy=_EXPORT) from None


def inflate(data: bytes, name: str) -> bytes:
    """The bytes of a file, unpacked if they are gzipped (`.svgz`), and no more than we are willing to hold."""
    if data[:2] == b"\x1f\x8b":
        try:
            with gzip.open(io.BytesIO(data)) as packed:
                data = packed.read(LARGEST_FILE + 1)
        except (OSError, EOFError) as error:
            raise SketchError(f"{name} is a damaged gzip file ({error}).", remedy=_EXPORT) from None
    if len(data) > LARGEST_FILE:
        raise SketchError(
            f"{name} holds more than {LARGEST_FILE // 2**20} MiB.",
            remedy="Simplify the drawing, or split it into several files.",
        )
    return data


def _parse(data: bytes) -> Element:
    try:
        return fromstring(data)
    except EntitiesForbidden:
        plain = _without_namespace_entities(data)
        if plain is None:
            raise
        return fromstring(plain)


def _without_namespace_entities(data: bytes) -> bytes | None:
    """The text with plain entities (no references inside, as Illustrator writes) put in; None if there are others."""
    subset = _SUBSET.search(data)
    if subset is None or len(subset[0]) > 20_000 or len(_ENTITY.findall(subset[0])) != subset[0].count(b"<!ENTITY"):
        return None
    body = data[: subset.start()] + data[subset.end() :]
    for entity, value in _ENTITY.findall(subset[0]):
        reference = b"&" + entity + b";"
        if len(body) + body.count(reference) * len(value) > 2 * len(data) + 100_000:
            return None
        body = body.replace(reference, value[1:-1])
    return body
