"""Which reader fits this file? By what it holds first; a name that says otherwise is remarked on."""

import contextlib
import dataclasses
import os
import secrets
from collections.abc import Callable
from pathlib import Path

import numpy as np

from sketchtree.errors import SketchError
from sketchtree.sketch.files.excalidraw import excalidraw_sketch, is_excalidraw, read_excalidraw
from sketchtree.sketch.files.excalidraw_embed import embedded_scene
from sketchtree.sketch.files.inkml import read_inkml
from sketchtree.sketch.files.limits import MAX_MB, MAX_MEGAPIXELS, MAX_STROKES, check_number, inflate, read_bytes
from sketchtree.sketch.files.project import drawing_in_project
from sketchtree.sketch.files.quickdraw import read_quickdraw
from sketchtree.sketch.files.recognise import EXCALIDRAW, INKML, PICTURES, QUICKDRAW, SKETCH, SVG, WEBP, Unreadable, recognise
from sketchtree.sketch.files.sketch_json import read_sketch_json, sketch_json
from sketchtree.sketch.files.svg import read_svg
from sketchtree.sketch.strokes import SCRIBBLES, Sketch, StrokeKind

READABLE = {  # extension → what such a file holds
    ".svg": SVG,
    ".svgz": SVG,
    ".json": SKETCH,
    ".excalidraw": EXCALIDRAW,
    ".excalidrawlib": EXCALIDRAW,
    ".inkml": INKML,
    ".ndjson": QUICKDRAW,
    ".png": "PNG picture",
    ".jpg": "JPEG picture",
    ".jpeg": "JPEG picture",
    ".webp": WEBP,
    ".tif": "TIFF picture",
    ".tiff": "TIFF picture",
    ".gif": "GIF picture",
    ".bmp": "BMP picture",
}
WRITABLE = (".json", ".svg")
FARTHEST = 1e12  # user units from the origin
FINEST = 1e-9  # of that distance: a smaller drawing drowns in rounding
Progress = Callable[[float], None]  # told the part done, 0 to 1
_WHOLE = "Set it again, or leave it out."
_ANY_JSON = frozenset({SKETCH, EXCALIDRAW, QUICKDRAW})


def read_sketch(
    path: str | os.PathLike,
    *,
    max_strokes: int = MAX_STROKES,
    max_mb: float = MAX_MB,
    max_megapixels: float = MAX_MEGAPIXELS,
    progress: Progress | None = None,
) -> Sketch:
    """Read a drawing: SVG (also gzipped), sketch JSON, Excalidraw, InkML, Quick, Draw!, a picture of a line drawing, or a project of ours.

    Points come in the file's user units, y up (INTERFACES §2); of a picture, in pixels. `progress` is told the part done,
    0 to 1. Raises SketchError, naming file and stroke, for anything that is no such drawing, is larger than
    `max_strokes`, `max_mb` (10⁶ bytes) or `max_megapixels` allow, or holds no stroke that could be a branch.
    `FILE#N` is the N-th drawing of a file that holds several (a library, or one drawing a line).
    """
    path, number = _numbered(Path(path))
    data = inflate(read_bytes(path, max_mb=max_mb), path.name, max_mb=max_mb)
    if not data.strip(b"\xef\xbb\xbf\xff\xfe\x00 \t\r\n"):
        raise SketchError(f"{path.name} is empty.", remedy="Save the drawing again.")
    data = drawing_in_project(data, path.name) or data
    what = recognise(data)
    if what is None or isinstance(what, Unreadable):
        raise _no_reader(path, what)
    scene = embedded_scene(data, max_mb=max_mb) if what in (SVG, "PNG picture") else None
    if is_excalidraw(scene):
        sketch = excalidraw_sketch(scene, path.name, max_strokes=max_strokes, number=number)
        remark = f"{path.name} carries the Excalidraw drawing it was exported from; that was read."
    else:
        if what in (EXCALIDRAW, QUICKDRAW):
            reader = read_excalidraw if what == EXCALIDRAW else read_quickdraw
            sketch = reader(data, path.name, max_strokes=max_strokes, number=number)
        else:
            check_number(number or 1, 1, path.name)
            sketch = _read(data, what, path.name, max_strokes, max_megapixels, progress)
        remark = _mislabelled(path, what)
    check_sketch(sketch)
    if progress is not None:
        progress(1.0)
    return _with_warning(sketch, remark) if remark else sketch


def write_sketch(sketch: Sketch, path: str | os.PathLike) -> None:
    """Write a sketch as sketch JSON (`.json`) or SVG (`.svg`), without loss; the file appears whole or not at all.

    Raises SketchError for another extension, a place that can't be written, or a sketch that could not be read back.
    """
    path = Path(path)
    check_writable(sketch)
    suffix = path.suffix.lower()
    if suffix == ".json":
        text = sketch_json(sketch)
    elif suffix == ".svg":
        from sketchtree.sketch.files.svg_writer import sketch_svg

        text = sketch_svg(sketch)
    else:
        raise SketchError(f"Sketches are not written as '{suffix or path.name}' files.", remedy=f"Name the file {' or '.join(WRITABLE)}.")
    _write_whole(path, text)


def write_sketch_json(sketch: Sketch, path: str | os.PathLike) -> None:
    """Write a sketch as sketch JSON; `read_sketch` gives the same sketch back. The file appears whole or not at all."""
    check_writable(sketch)
    _write_whole(Path(path), sketch_json(sketch))


def check_writable(sketch: Sketch) -> None:
    """Raise SketchError for a sketch that a file could not give back: two strokes of one id, numbers that are none."""
    seen: set[str] = set()
    for stroke in sketch.strokes:
        if stroke.id.encode("utf-8", "replace").decode() != stroke.id:
            raise SketchError("its id holds half a surrogate pair.", stroke=repr(stroke.id), remedy="Give it another id.")
        if stroke.id in seen:
            raise SketchError("its id is used twice.", stroke=stroke.id, remedy="Give every stroke an id of its own.")
        seen.add(stroke.id)
        for what, values in (("pressure", stroke.pressure), ("time", stroke.time)):
            if values is not None and np.shape(values) != (len(stroke.points),):
                raise SketchError(f"its {what} is not one number for each of its {len(stroke.points)} points.", stroke=stroke.id, remedy=_WHOLE)
            if values is not None and not np.isfinite(values).all():
                raise SketchError(f"its {what} is not finite everywhere.", stroke=stroke.id, remedy=_WHOLE)
        if stroke.width is not None and not 0 <= stroke.width < np.inf:
            raise SketchError(f"its width is {stroke.width}; a number of at least 0 was expected.", stroke=stroke.id, remedy=_WHOLE)
    if not np.isfinite([sketch.view_deg, *(sketch.page or ())]).all():
        raise SketchError(f"{sketch.name} has a view or page that is not finite.", remedy=_WHOLE)


def check_sketch(sketch: Sketch) -> None:
    """Raise SketchError for a sketch that no tree could be made of: neither branch strokes nor scribbles over a photo, or coordinates beyond what can be told apart."""
    if not sketch.strokes:
        raise SketchError(
            f"{sketch.name} holds no strokes.",
            remedy="Draw the branches as lines (paths); text, pictures and hidden layers are not read.",
        )
    if all(stroke.kind != StrokeKind.BRANCH and stroke.kind not in SCRIBBLES for stroke in sketch.strokes):
        raise SketchError(
            f"{sketch.name} has no branch strokes: all it holds is labelled crown or obstacle.",
            remedy="Draw at least a trunk, outside the crown's layer.",
        )
    low = np.min([stroke.points.min(0) for stroke in sketch.strokes], axis=0)
    high = np.max([stroke.points.max(0) for stroke in sketch.strokes], axis=0)
    reach, size = float(np.abs([low, high]).max()), float((high - low).max())
    if reach > FARTHEST:
        raise SketchError(
            f"{sketch.name} reaches {reach:.3g} {sketch.units} from the origin; {FARTHEST:g} is the limit.",
            remedy="A number in it is probably wrong: move the drawing to its page and export it again.",
        )
    if 0 < size < FINEST * max(reach, FINEST):
        raise SketchError(
            f"{sketch.name} is only {size:.3g} {sketch.units} large, too small to be told from rounding.",
            remedy="Scale the drawing up, and move it near the origin.",
        )


def _read(data: bytes, what: str, name: str, max_strokes: int, max_megapixels: float, progress: Progress | None) -> Sketch:
    """The sketch in a file of one drawing, of a known kind."""
    if what in PICTURES.values() or what == WEBP:
        from sketchtree.sketch.raster.reader import read_raster

        return read_raster(data, name, max_strokes=max_strokes, max_megapixels=max_megapixels, progress=progress)
    reader = {SVG: read_svg, SKETCH: read_sketch_json, INKML: read_inkml}[what]
    try:
        return reader(data, name, max_strokes=max_strokes)
    except RecursionError:  # brackets without end in a style, say
        raise SketchError(f"{name} nests its parts too deep to be read.", remedy="Ungroup the drawing, and export it again.") from None


def _numbered(path: Path) -> tuple[Path, int | None]:
    """(file, number of the drawing in it) of a path that may end in "#N"."""
    stem, mark, number = path.name.rpartition("#")
    if not mark or not stem or not number.isdecimal() or len(number) > 9 or os.path.exists(path):
        return path, None
    return path.with_name(stem), int(number)


def _no_reader(path: Path, what: Unreadable | None) -> SketchError:
    if what is not None:
        return SketchError(f"{path.name} is {what.what}, which can't be read.", remedy=what.remedy)
    kinds = ", ".join(dict.fromkeys(READABLE.values()))
    return SketchError(f"{path.name} is none of the files that can be read: {kinds}.", remedy="Save the drawing as SVG, or as a PNG picture.")


def _mislabelled(path: Path, what: str) -> str | None:
    """A remark on a name that says something else than the file holds."""
    said = READABLE.get(path.suffix.lower())
    if said is None or said == what or (path.suffix.lower() == ".json" and what in _ANY_JSON):
        return None
    return f"{path.name} is named like {_a(said)}, but it holds {_a(what)}; it was read as that."


def _a(what: str) -> str:
    return ("an " if what.startswith(("SVG", "Excalidraw")) else "a ") + what


def _with_warning(sketch: Sketch, warning: str) -> Sketch:
    return dataclasses.replace(sketch, warnings=(warning, *sketch.warnings))


def _write_whole(path: Path, text: str) -> None:
    """Write UTF-8 text under a name beside `path`, then move it there."""
    part = path.with_name(f".{path.name}.{secrets.token_hex(4)}.part")
    try:
        part.write_text(text, encoding="utf-8", newline="\n")
        part.replace(path)
    except (OSError, ValueError) as error:
        raise SketchError(f"{path} can't be written ({getattr(error, 'strerror', None) or error}).", remedy="Choose a folder you may write to.") from None
    finally:
        with contextlib.suppress(OSError, ValueError):
            part.unlink(missing_ok=True)
