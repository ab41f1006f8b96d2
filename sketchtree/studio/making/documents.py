"""How does a file become a document, and a document a project file?"""

import dataclasses
import io
import json
import tempfile
from pathlib import Path

import numpy as np

from sketchtree.drawing import read_hand_work
from sketchtree.editing.document import Document, Underlay
from sketchtree.errors import SketchTreeError
from sketchtree.options import FileOptions, ReadingOptions, TreeOptions
from sketchtree.sketch.formats import read_sketch

_SIGNATURE = b"\x89HDF\r\n\x1a\n"
_NOT_OURS = {FileOptions: (), ReadingOptions: ("max_strokes", "max_mb", "max_megapixels", "samples", "alternatives"), TreeOptions: ("prune", "obstacle", "wood", "solid")}


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
    reading, tree, seed, underlay = _kept(data) if data.startswith(_SIGNATURE) else (ReadingOptions(), TreeOptions(), 0, None)
    return Document(
        {stroke.id: stroke for stroke in sketch.strokes}, by_hand.edits, by_hand.settled, reading, tree, seed, underlay, Path(name).stem, sketch.units, sketch.page
    )


def _kept(data: bytes) -> tuple[ReadingOptions, TreeOptions, int, Underlay | None]:
    """Options, seed and picture of a project; what this version does not know, or can't be so, is as by default."""
    import h5py

    with h5py.File(io.BytesIO(data), "r") as file:
        said = json.loads(file["options"][()].tobytes()) if "options" in file else {}
        seed = int(file.attrs.get("seed", 0))
        underlay = None
        if "underlay" in file:
            at = file["underlay"].attrs
            underlay = Underlay(file["underlay"][()].astype(np.uint8).tobytes(), *(float(at[name]) for name in ("x", "y", "width", "height", "opacity")))
    return _options(ReadingOptions, said), _options(TreeOptions, said), seed, underlay


def _options(kind: type, said: dict):
    """One record of options, of what a project says; files that it named may lie elsewhere, so they are left out."""
    names = [field.name for field in dataclasses.fields(kind) if field.name in said and field.name not in _NOT_OURS[kind]]
    try:
        return kind(**{name: said[name] for name in names})
    except (SketchTreeError, TypeError):
        return kind()
