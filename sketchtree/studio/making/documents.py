"""How does a file become a document, and a document a project file?"""

import dataclasses
import io
import json
import tempfile
from pathlib import Path

import numpy as np

from sketchtree.drawing import read_hand_work
from sketchtree.editing.document import Document, Underlay
from sketchtree.errors import SketchError, SketchTreeError
from sketchtree.options import ReadingOptions, TreeOptions
from sketchtree.propagate.after.shears import HOLE, plane
from sketchtree.skeleton_hdf5 import SCHEMA
from sketchtree.sketch.files.project import SIGNATURE, column
from sketchtree.sketch.formats import read_sketch

_NOT_KEPT = ("max_strokes", "max_mb", "max_megapixels", "samples", "alternatives")  # limits of a reading, and questions that were answered then


def document_of(data: bytes, name: str) -> Document:
    """The document of a file's bytes: any drawing, or a project with all that it keeps. Raises SketchTreeError, which names the file."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / (Path(name).name or "drawing")
        path.write_bytes(data)
        try:
            sketch = read_sketch(path)
            by_hand = read_hand_work(path)
        except SketchTreeError as error:
            raise type(error)(error.message.replace(f"{folder}/", ""), remedy=error.remedy) from error
    strokes = {stroke.id: stroke for stroke in sketch.strokes}
    document = Document(strokes, by_hand.edits, by_hand.settled, name=Path(name).stem, units=sketch.units, page=sketch.page, warnings=sketch.warnings)
    if not data.startswith(SIGNATURE):
        return document
    try:
        return _with_choices(document, data, name)
    except (OSError, RuntimeError, ValueError, TypeError, KeyError, AttributeError, RecursionError) as error:
        raise SketchError(f"{name} is damaged ({error}).", remedy="Open an older copy of it.") from error


def _with_choices(document: Document, data: bytes, name: str) -> Document:
    """The document with a project's options, seed and picture. What this version does not know is as by default; meshes that are not there any more are said."""
    import h5py

    with h5py.File(io.BytesIO(data), "r") as file:
        schema = int(file.attrs.get("schema", SCHEMA))
        if schema > SCHEMA:
            raise SketchError(f"{name} has project schema {schema}; this version reads {SCHEMA}.", remedy="Update sketchtree.")
        said = json.loads(column(file, "options").tobytes()) if "options" in file else {}
        seed = int(file.attrs.get("seed", 0))
        underlay = None
        if "underlay" in file:
            at = file["underlay"].attrs
            underlay = Underlay(column(file, "underlay").astype(np.uint8).tobytes(), *(float(at[one]) for one in ("x", "y", "width", "height", "opacity")))
    said, gone = _without_meshes(said)
    told = tuple(f"{name} is not there any more; the tree is made without it." for name in gone)
    return document.replace(
        reading=_options(ReadingOptions, said), tree=_options(TreeOptions, said), seed=seed, underlay=underlay, warnings=(*document.warnings, *told)
    )


def _without_meshes(said: dict) -> tuple[dict, list[str]]:
    """(the options without the mesh files that are gone, their names)."""
    gone = []
    for option in ("obstacle", "prune"):
        named = [str(one) for one in said.get(option) or ()]
        missing = [one for one in named if not (option == "prune" and plane(one)) and not Path(one.removeprefix(HOLE)).is_file()]
        said = said | {option: tuple(one for one in named if one not in missing)}
        gone += missing
    return said, gone


def _options(kind: type, said: dict):
    """One record of options, of what a project says."""
    names = [field.name for field in dataclasses.fields(kind) if field.name in said and field.name not in _NOT_KEPT]
    try:
        return kind(**{name: said[name] for name in names})
    except (SketchTreeError, TypeError):
        return kind()
