"""Which reader fits this file? By what it holds first, then by its extension."""

import os
from pathlib import Path

from sketchtree.errors import SketchError
from sketchtree.sketch.files.document import LARGEST_FILE, inflate
from sketchtree.sketch.files.sketch_json import read_sketch_json, sketch_json
from sketchtree.sketch.strokes import Sketch, StrokeKind
from sketchtree.sketch.files.svg import read_svg

_SAVE_AS_SVG = "Save the drawing as SVG (or as sketch JSON); docs/formats.md says how for each program."
_RASTERS = {
    b"\x89PNG": "a PNG picture",
    b"\xff\xd8\xff": "a JPEG picture",
    b"GIF8": "a GIF picture",
    b"BM": "a bitmap picture",
    b"II*\x00": "a TIFF picture",
    b"MM\x00*": "a TIFF picture",
    b"RIFF": "a WebP picture",
    b"%PDF": "a PDF",
    b"%!PS": "a PostScript drawing",
    b"PK\x03\x04": "a packed document",
}


def read_sketch(path: str | os.PathLike, *, max_strokes: int = 20_000) -> Sketch:
    """Read a drawing: SVG (also gzipped) or sketch JSON.

    Points come in the file's user units, y up (INTERFACES §2). Raises SketchError, naming file and stroke, for
    anything that is no such drawing or holds no stroke that could be a branch.
    """
    path = Path(path)
    data = inflate(_bytes(path), path.name)
    text = data.lstrip(b"\xef\xbb\xbf \t\r\n")
    if not text:
        raise SketchError(f"{path.name} is empty.", remedy="Save the drawing again.")
    _refuse_others(path, data, text)
    if text[:1] in (b"{", b"["):
        sketch = read_sketch_json(text, path.name, max_strokes=max_strokes)
    elif text[:1] == b"<" or data[:2] in (b"\xff\xfe", b"\xfe\xff"):
        sketch = read_svg(data, path.name, max_strokes=max_strokes)
    else:
        raise SketchError(f"{path.name} is neither SVG nor sketch JSON.", remedy=_SAVE_AS_SVG)
    _check_strokes(sketch)
    return sketch


def write_sketch_json(sketch: Sketch, path: str | os.PathLike) -> None:
    """Write a sketch as sketch JSON; `read_sketch` gives the same sketch back. The file appears whole or not at all."""
    path = Path(path)
    part = path.with_name(path.name + ".part")
    try:
        part.write_text(sketch_json(sketch), encoding="utf-8")
        part.replace(path)
    except OSError as error:
        part.unlink(missing_ok=True)
        raise SketchError(f"{path} can't be written ({error.strerror}).", remedy="Choose a folder you may write to.") from None


def _bytes(path: Path) -> bytes:
    if path.is_dir():
        raise SketchError(f"{path} is a folder, not a drawing.", remedy="Give the drawing inside it.")
    try:
        if path.stat().st_size > LARGEST_FILE:
            raise SketchError(
                f"{path.name} holds more than {LARGEST_FILE // 2**20} MiB.",
                remedy="Simplify the drawing, or split it into several files.",
            )
        return path.read_bytes()
    except FileNotFoundError:
        raise SketchError(f"There is no file {path}.", remedy="Check the path.") from None
    except OSError as error:
        raise SketchError(f"{path} can't be read ({error.strerror}).", remedy="Check the file's permissions.") from None


def _refuse_others(path: Path, data: bytes, text: bytes) -> None:
    """Name the formats we know but do not read."""
    known = next((what for magic, what in _RASTERS.items() if data.startswith(magic)), None)
    start = text[:4000]
    if start.startswith(b"{") and (b'"excalidraw' in start or path.suffix.lower() in (".excalidraw", ".excalidrawlib")):
        known = "an Excalidraw drawing"
    elif start.startswith(b"<") and (b"<ink" in start.lower() or path.suffix.lower() == ".inkml"):
        known = "digital ink (InkML)"
    if known:
        raise SketchError(f"{path.name} is {known}; this version reads SVG and sketch JSON.", remedy=_SAVE_AS_SVG)


def _check_strokes(sketch: Sketch) -> None:
    if not sketch.strokes:
        raise SketchError(
            f"{sketch.name} holds no strokes.",
            remedy="Draw the branches as lines (paths); text, pictures and hidden layers are not read.",
        )
    if all(stroke.kind != StrokeKind.BRANCH for stroke in sketch.strokes):
        raise SketchError(
            f"{sketch.name} has no branch strokes: all {len(sketch)} are labelled crown or obstacle.",
            remedy="Draw at least a trunk, outside the crown's layer.",
        )
