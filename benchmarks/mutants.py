"""Files that almost make sense: mutants of valid ones, and nonsense in the grammar of each format. Same generator, same file.

    bytes      flips, cuts, copies, splices, numbers that no one writes, brackets without end
    JSON       one value of the parsed document replaced, removed, repeated or wrapped, anywhere
    XML        one element repeated, moved, removed or wrapped; one attribute or text replaced
    pictures   a field of a PNG chunk changed, its checksum made right again; else bytes
"""

import collections
import copy
import gzip
import json
import re
import struct
import zlib
from collections.abc import Callable, Iterator
from xml.etree import ElementTree

import numpy as np

from benchmarks import little_tree

READERS = ("svg", "json", "excalidraw", "inkml", "ndjson", "picture", "svgz")
_NUMBERS = b"0 -0 1e400 -1e308 1e-320 NaN Infinity 1e9 0x10 1.5.2 --1 1e".split() + [b"9" * 400, b""]
_WORDS = (*b"null true [] {} &amp; &x; <g> </g> ]]> <!-- # ' *?!".split(), b'""', b'"', b"\0", b"\xff\xfe", b"\xf0\x9f")
_VALUES = (
    *(None, True, 0, -1, 1, 1e308, -1e-320, 10**400, float("nan"), float("inf")),
    *("", "crown", "\ud800", "1", [], {}, [[]], [None], [0, 0], [[0, 0]] * 3),
)
_TEXTS = (
    *("", "0", "-1", "1e999", "nan", "10%", "none", "M0 0", "M0 0L1 1Z", "m1 1c0 0 0 0 9e9 9e9", "0 0 9 9", "0 0 0 0", "crown", "#a", "#half", "2em"),
    *("url(#a)", "url(#page)", "url(#all) red", "url(#fade)", "var(--ink)", "objectBoundingBox", "display:none", "*", "1 2,3 4", "'1 1,\"2 2"),
    *("matrix(0 0 0 0 0 0)", "rotate(1e300)", "scale(0)", "0 0 1e400 1"),
)
_TAGS = tuple(
    "g path use svg symbol polyline circle ellipse rect line clipPath mask style defs a switch marker trace traceGroup traceView traceFormat "
    "channel context brush brushProperty definitions annotation inkSource".split()
)
_ATTRIBUTES = tuple(
    "id d points transform style class href viewBox width height x y r rx cx x1 y2 stroke fill stroke-width opacity display clip-path "
    "traceDataRef contextRef brushRef name value units type min max from to continuation priorTrace timeOffset duration orientation "
    "preserveAspectRatio mask clipPathUnits maskUnits font-size visibility overflow transform-origin".split()
)
_KEYS = tuple(
    "sketchtree strokes points id kind width closed y units type elements angle x pressures roundness groupIds customData frameId isDeleted "
    "opacity libraryItems drawing polygon strokeWidth backgroundColor text".split()
)


def seeds(reader: str) -> list[bytes]:
    """Valid files of one kind."""
    if reader == "picture":
        plain = [little_tree.picture(kind, 0.4) for kind in ("PNG", "JPEG", "TIFF", "GIF", "BMP", "WEBP")]
        return [*plain, little_tree.picture("PNG", 0.4, scene=True)]
    return [data for name, data in little_tree.files().items() if name.endswith("." + reader)]


def mutant(reader: str, rng: np.random.Generator) -> bytes:
    """One file of a kind that a program would not write."""
    data = seeds(reader)[int(rng.integers(len(seeds(reader))))]
    if rng.random() < 0.04:
        return rng.bytes(int(rng.integers(0, 300)))
    ways: list[Callable[[bytes, np.random.Generator], bytes]] = [_by_bytes]
    ways += {"svg": [_by_xml] * 5, "inkml": [_by_xml] * 5, "picture": [_by_chunk], "svgz": [_packed] * 5}.get(reader, [_by_json] * 5)
    for _ in range(int(rng.integers(1, 4))):
        try:
            data = ways[int(rng.integers(len(ways)))](data, rng)
        except RecursionError:  # nested deeper than it can be written out
            break
    if reader in ("svg", "inkml", "json", "excalidraw", "ndjson") and rng.random() < 0.05:
        return data.decode("utf-8", "replace").encode(("utf-16", "utf-8-sig", "utf-16-le", "utf-32")[int(rng.integers(4))])
    return data


def _by_bytes(data: bytes, rng: np.random.Generator) -> bytes:
    size = max(len(data), 1)
    a, b = sorted(int(k) for k in rng.integers(0, size, 2))
    b = min(b, a + int(rng.integers(1, 400)))
    way = int(rng.integers(8))
    if way == 0:
        found = bytearray(data)
        for at in rng.integers(0, size, int(rng.integers(1, 9))) if found else ():
            found[at] ^= 1 << int(rng.integers(8))
        return bytes(found)
    if way == 1:
        return data[:a] if rng.random() < 0.8 else data[a:]
    if way == 2:
        return data[:a] + data[b:]
    if way == 3:
        return data[:b] + data[a:b] * int(rng.integers(1, 50)) + data[b:]
    if way == 4:
        other = seeds(READERS[int(rng.integers(5))])[0]
        start = int(rng.integers(len(other)))
        return data[:a] + other[start : start + int(rng.integers(1, 400))] + data[b:]
    if way == 5:
        return data[:a] + _WORDS[int(rng.integers(len(_WORDS)))] + data[a:]
    if way == 6:
        return data[:a] + (b"[", b"{", b"<g>", b'{"a":[', b"(", b"<traceGroup>")[int(rng.integers(6))] * int(rng.integers(1, 5000)) + data[a:]
    numbers = list(re.finditer(rb"-?\d+(?:\.\d+)?", data))
    if not numbers:
        return data
    hit = numbers[int(rng.integers(len(numbers)))]
    return data[: hit.start()] + _NUMBERS[int(rng.integers(len(_NUMBERS)))] + data[hit.end() :]


def _by_json(data: bytes, rng: np.random.Generator) -> bytes:
    try:
        document = json.loads(data)
    except (ValueError, RecursionError):
        return _by_bytes(data, rng)
    places = list(_places({"": document}))
    holder, key = places[int(rng.integers(len(places)))] if rng.random() < 0.5 else places[int(rng.integers(min(len(places), 12)))]
    root = {"": document}
    if key == "":
        holder = root
    way = int(rng.integers(6))
    if way == 0 and key != "":
        del holder[key]
    elif way == 1 and isinstance(holder, list):
        holder[key:key] = [copy.deepcopy(holder[key]) for _ in range(int(rng.integers(1, 30)))]
    elif way == 2:
        for _ in range(int(rng.integers(1, 200))):
            holder[key] = [holder[key]]
    elif way == 3 and isinstance(holder, dict):
        holder[_KEYS[int(rng.integers(len(_KEYS)))]] = holder.get(key) if rng.random() < 0.5 else nonsense(rng)
    elif type(holder[key]) in (int, float) and rng.random() < 0.7:
        holder[key] = round(float(rng.normal(0, 10.0 ** rng.integers(-2, 5))), 2)
    else:
        holder[key] = nonsense(rng)
    return json.dumps(root[""]).encode()


def _places(holder: list | dict) -> Iterator[tuple[list | dict, int | str]]:
    """(list or object, index or key) of every value inside, the outer ones first."""
    waiting = collections.deque([holder])
    while waiting:
        holder = waiting.popleft()
        for key in range(len(holder)) if isinstance(holder, list) else list(holder):
            yield holder, key
            if isinstance(holder[key], (list, dict)):
                waiting.append(holder[key])


def nonsense(rng: np.random.Generator, depth: int = 3) -> object:
    """A JSON value of any shape, with keys that mean something to some reader."""
    way = int(rng.integers(8))
    if depth and way == 0:
        return [nonsense(rng, depth - 1) for _ in range(int(rng.integers(0, 6)))]
    if depth and way == 1:
        return {_KEYS[int(rng.integers(len(_KEYS)))]: nonsense(rng, depth - 1) for _ in range(int(rng.integers(0, 6)))}
    if way == 2:
        return (rng.normal(0, 10.0 ** rng.integers(-3, 6), (int(rng.integers(0, 20)), int(rng.integers(1, 5)))) // 1).tolist()
    if way == 3:
        return float(rng.normal(0, 10.0 ** rng.integers(-12, 15)))
    return copy.deepcopy(_VALUES[int(rng.integers(len(_VALUES)))])


def _by_xml(data: bytes, rng: np.random.Generator) -> bytes:
    try:
        root = ElementTree.fromstring(data)
    except (ElementTree.ParseError, ValueError, LookupError, RecursionError):
        return _by_bytes(data, rng)
    elements = list(root.iter())
    element = elements[int(rng.integers(len(elements)))]
    space = root.tag.rpartition("}")[0] + "}" if "}" in str(root.tag) else ""
    way = int(rng.integers(6))
    if way == 0 and len(element):
        del element[int(rng.integers(len(element)))]
    elif way == 1 and len(element):
        child = element[int(rng.integers(len(element)))]
        for _ in range(int(rng.integers(1, 30))):
            element.append(copy.deepcopy(child))
    elif way == 2:
        inner = element
        for _ in range(int(rng.integers(1, 300))):
            inner = ElementTree.SubElement(inner, space + _TAGS[int(rng.integers(len(_TAGS)))])
        inner.extend([copy.deepcopy(e) for e in list(root)[:2]])
    elif way == 3:
        element.text = _TEXTS[int(rng.integers(len(_TEXTS)))]
    elif way == 4:
        element.tag = space + _TAGS[int(rng.integers(len(_TAGS)))]
    else:
        for _ in range(int(rng.integers(1, 4))):
            keys = [*element.keys(), *_ATTRIBUTES]
            element.set(keys[int(rng.integers(len(keys)))], _TEXTS[int(rng.integers(len(_TEXTS)))])
    return ElementTree.tostring(root)


def _by_chunk(data: bytes, rng: np.random.Generator) -> bytes:
    """A byte of one PNG chunk changed and its checksum put right; other pictures by bytes."""
    if not data.startswith(b"\x89PNG"):
        return _by_bytes(data, rng)
    chunks, at = [], 8
    while at + 8 <= len(data):
        (size,) = struct.unpack_from(">I", data, at)
        chunks.append((data[at + 4 : at + 8], bytearray(data[at + 8 : at + 8 + size])))
        at += 12 + size
    if not chunks:
        return _by_bytes(data, rng)
    kind, body = chunks[int(rng.integers(len(chunks)))] if rng.random() < 0.5 else chunks[0]
    if body:
        body[int(rng.integers(len(body)))] = int(rng.integers(256))
    return data[:8] + b"".join(struct.pack(">I", len(b)) + k + bytes(b) + struct.pack(">I", zlib.crc32(k + bytes(b))) for k, b in chunks)


def _packed(data: bytes, rng: np.random.Generator) -> bytes:
    """A gzipped mutant of the drawing inside."""
    try:
        return gzip.compress(_by_xml(gzip.decompress(data), rng), mtime=0)
    except (OSError, EOFError, zlib.error):
        return _by_bytes(data, rng)
