"""What kind of file is this? By what it holds; its name is not asked.

Formats we know but can't read are named, with the way to a format we can.
"""

import io
import re
import zipfile
from dataclasses import dataclass

PICTURES = {
    b"\x89PNG": "PNG picture",
    b"\xff\xd8\xff": "JPEG picture",
    b"GIF8": "GIF picture",
    b"BM": "BMP picture",
    b"II*\x00": "TIFF picture",
    b"MM\x00*": "TIFF picture",
    b"II+\x00": "TIFF picture",
    b"MM\x00+": "TIFF picture",
}
SVG, SKETCH, EXCALIDRAW, INKML, QUICKDRAW, WEBP = (
    "SVG drawing",
    "sketch in JSON",
    "Excalidraw drawing",
    "drawing in digital ink (InkML)",
    "Quick, Draw! drawing",
    "WebP picture",
)
_AS_SVG = "Open it in a drawing program and save it as SVG."
_AS_PICTURE = "Export the drawing as PNG (or, if its lines are vectors, as SVG)."
_FRAME = "Save one picture of it as PNG."
_OTHERS = {
    b"%PDF": ("a PDF", _AS_SVG),
    b"%!PS": ("a PostScript (EPS) drawing", _AS_SVG),
    b"\xc5\xd0\xd3\xc6": ("a PostScript (EPS) drawing", _AS_SVG),
    b"8BPS": ("a Photoshop file", _AS_PICTURE),
    b"gimp xcf": ("a GIMP file", _AS_PICTURE),
    b"CSFCHUNK": ("a Clip Studio file", _AS_PICTURE),
    b"\x00\xffKA": ("an Affinity file", _AS_PICTURE),
    b"fig-": ("a Figma file", "Export the frame as SVG."),
    b"\x89HDF\r\n\x1a\n": ("a SketchTree project or exemplar database", "Give the drawing it was made from."),
    b"glTF": ("a finished 3D model", "Give the drawing it was made from."),
    b"SQLite format 3": ("a database, as some drawing apps keep their documents in", _AS_PICTURE),
    b"\x1a\x45\xdf\xa3": ("a video", _FRAME),
    b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1": ("an Office document", _AS_PICTURE),
    b"7z\xbc\xaf'\x1c": ("an archive", "Unpack it, and give the drawing inside."),
    b"Rar!": ("an archive", "Unpack it, and give the drawing inside."),
    b"AutoCAD Binary DXF": ("a CAD drawing (DXF)", _AS_SVG),
}
_PACKED = (
    (b"application/x-krita", "a Krita file", _AS_PICTURE),
    (b"image/openraster", "an OpenRaster file", _AS_PICTURE),
    (b"opendocument", "an OpenDocument file", _AS_SVG),
)
_INSIDE = (  # a file in a zip archive that tells whose it is
    ("Document.archive", "a Procreate file", _AS_PICTURE),
    ("[Content_Types].xml", "an Office document", _AS_PICTURE),
    ("document.json", "a Sketch file", "Export the page as SVG."),
    ("index.notes.pb", "a GoodNotes file", _AS_PICTURE),
)
_MARKS = b"\xef\xbb\xbf\xff\xfe\x00 \t\r\n"  # byte order marks, spaces, and the zeros of UTF-16
_ASIDE = {b"<!--": b"-->", b"<?": b"?>", b"<!DOCTYPE": b">"}  # what may stand before the root element, and its end
_ELEMENT = re.compile(rb"<(?:[\w.-]+:)?([A-Za-z][\w.-]*)")
_STILL = (b"avif", b"avis", b"heic", b"heix", b"heim", b"heis", b"hevc", b"hevx", b"mif1", b"msf1")
HEAD = 65_536  # bytes that are looked at


@dataclass(frozen=True)
class Unreadable:
    """A format that is known, but not read."""

    what: str  # with its article
    remedy: str


def recognise(data: bytes) -> str | Unreadable | None:
    """What a file holds: SVG, SKETCH …, or the name of a kind of picture; what it is if it can't be read; None for the unknown."""
    for magic, what in PICTURES.items():
        if data.startswith(magic):
            return what
    for magic, other in _OTHERS.items():
        if data.startswith(magic):
            return Unreadable(*other)
    if data[:4] == b"RIFF":
        return WEBP if data[8:12] == b"WEBP" else Unreadable("a video or sound", _FRAME)
    if data[4:8] == b"ftyp":
        return Unreadable("a HEIC or AVIF picture", _AS_PICTURE) if data[8:12] in _STILL else Unreadable("a video", _FRAME)
    if data[:4] in (b"PK\x03\x04", b"PK\x05\x06"):
        return _packed(data)
    head = data[:HEAD].lstrip(_MARKS).replace(b"\0", b"")
    if head[:1] == b"<":
        return INKML if _root(head) == b"ink" else SVG
    if head[:1] in (b"{", b"["):
        return Unreadable("a tldraw drawing", "Export it as SVG.") if b'"tldraw' in head else _json(head)
    return Unreadable("an Excalidraw note of Obsidian", "Export it as .excalidraw or SVG.") if b"excalidraw-plugin" in head else None


def _root(head: bytes) -> bytes:
    """Name of the root element of an XML file; empty if there is none in its head."""
    at = head.find(b"<")
    while at >= 0:
        aside = next((start for start in _ASIDE if head.startswith(start, at)), None)
        if aside is None:
            found = _ELEMENT.match(head, at)
            return found[1] if found else b""
        if aside == b"<!DOCTYPE" and 0 <= head.find(b"[", at) < head.find(b">", at):
            at = head.find(b"]", at)  # the declarations inside
        end = head.find(_ASIDE[aside], at) if at >= 0 else -1
        at = head.find(b"<", end) if end >= 0 else -1
    return b""


def _json(head: bytes) -> str:
    """Which JSON it is, from the keys near its start: sketches say so themselves, and what is left is one that is damaged."""
    if b'"sketchtree"' in head:
        return SKETCH
    if any(key in head for key in (b'"excalidraw', b'"elements"', b'"libraryItems"')):
        return EXCALIDRAW
    return QUICKDRAW if b'"drawing"' in head else SKETCH


def _packed(data: bytes) -> Unreadable:
    for mark, what, remedy in _PACKED:
        if mark in data[:200]:
            return Unreadable(what, remedy)
    try:
        with zipfile.ZipFile(io.BytesIO(data)) as archive:
            names = {name.rpartition("/")[2] for name in archive.namelist()[:10_000]}
    except (zipfile.BadZipFile, OSError, ValueError, NotImplementedError, RuntimeError, UnicodeDecodeError):
        names = set()
    for inside, what, remedy in _INSIDE:
        if inside in names:
            return Unreadable(what, remedy)
    return Unreadable("a packed archive (zip)", "Unpack it, and give the drawing inside.")
