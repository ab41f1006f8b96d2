"""How does a file become a document, and a document a project file?"""

import dataclasses
import io
import json
import tempfile
from pathlib import Path

import numpy as np

from sketchtree.editing.document import Document, Underlay
from sketchtree.editing.laid_cloud import CloudChoices
from sketchtree.errors import SketchError, SketchTreeError
from sketchtree.options import ReadingOptions, TreeOptions
from sketchtree.photo.wanted import PhotoOptions
from sketchtree.propagate.after.shears import plane
from sketchtree.sketch.files.project import POINTS, SIGNATURE, TRUNK, column, drawing_in_project, holds_cloud
from sketchtree.sketch.files.sketch_json import read_sketch_json
from sketchtree.sketch.formats import read_sketch
from sketchtree.sketch.strokes import Sketch
from sketchtree.studio.cloud_files import is_cloud
from sketchtree.studio.messages import CloudReading
from sketchtree.trunk.wanted import TrunkChoices

_NOT_KEPT = ("max_strokes", "max_mb", "max_megapixels", "samples", "alternatives")  # limits of a reading, and questions that were answered then


def document_of(data: bytes, name: str, cloud: CloudReading = CloudReading()) -> Document:
    """The document of a file's bytes: any drawing, a project with all that it keeps, or a point cloud, read so, behind an empty page. Raises SketchTreeError, which names the file."""
    if is_cloud(data, name):
        return _of_points(data, name, cloud)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / (Path(name).name or "drawing")
        path.write_bytes(data)
        try:
            drawn = _over_points(data, path)
            sketch = read_sketch(path) if drawn is None else drawn
            by_hand = _by_hand(path) if data.startswith(SIGNATURE) else {}
        except SketchTreeError as error:
            raise type(error)(error.message.replace(f"{folder}/", ""), remedy=error.remedy) from error
    strokes = {stroke.id: stroke for stroke in sketch.strokes}
    document = Document(strokes, name=Path(name).stem, units=sketch.units, page=sketch.page, warnings=sketch.warnings)
    if not data.startswith(SIGNATURE):
        return document
    try:
        return _with_choices(document.replace(**by_hand), data, name)
    except (OSError, RuntimeError, ValueError, TypeError, KeyError, AttributeError, RecursionError) as error:
        raise SketchError(f"{name} is damaged ({error}).", remedy="Open an older copy of it.") from error


def _over_points(data: bytes, path: Path) -> Sketch | None:
    """The drawing of a project with points behind it, which may have no stroke yet; None of any other file."""
    drawing = drawing_in_project(data, path.name) if holds_cloud(path) else None
    return None if drawing is None else read_sketch_json(drawing, path.name)


def _of_points(data: bytes, name: str, cloud: CloudReading) -> Document:
    """A page with the points of a file behind it."""
    from sketchtree.studio.making.points_of_file import points_of

    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / Path(name).name
        path.write_bytes(data)
        return Document.blank(name=Path(name).stem, cloud=points_of(path, cloud))


def _by_hand(path: Path) -> dict:
    """What was done to a project's tree by hand, by the fields of a document. Imported here: the server reads small drawings of lines before it has anything else to do."""
    from sketchtree.drawing import read_hand_work

    found = read_hand_work(path)
    return {"edits": found.edits, "settled": found.settled, "cloud": found.cloud}


def _with_choices(document: Document, data: bytes, name: str) -> Document:
    """The document with a project's options, seed and picture. What this version does not know is as by default; mesh files are left out, and said."""
    import h5py

    with h5py.File(io.BytesIO(data), "r") as file:
        said = json.loads(column(file, "options").tobytes()) if "options" in file else {}
        seed = int(file.attrs.get("seed", 0))
        underlay = None
        if "underlay" in file:
            at = file["underlay"].attrs
            underlay = Underlay(column(file, "underlay").astype(np.uint8).tobytes(), *(float(at[one]) for one in ("x", "y", "width", "height", "opacity")), photo=bool(at.get("photo", False)))
    said, meshes = _without_meshes(said)
    told = tuple(f"The studio opens no file that a project names: the tree is made without {name}. `sketchtree build` takes it." for name in meshes)
    return document.replace(
        reading=_options(ReadingOptions, said), tree=_options(TreeOptions, said), photo=_options(PhotoOptions, said), points=_options(CloudChoices, said.get(POINTS) or {}), trunk=_options(TrunkChoices, said.get(TRUNK) or {}), seed=seed, underlay=underlay, warnings=(*document.warnings, *told)
    )


def _without_meshes(said: dict) -> tuple[dict, list[str]]:
    """(the options without mesh files, their names): a project may come from anywhere, and a path in it lead anywhere."""
    cuts, obstacles = ([str(one) for one in said.get(option) or ()] for option in ("prune", "obstacle"))
    planes = [one for one in cuts if _is_plane(one)]
    return said | {"prune": tuple(planes), "obstacle": ()}, [*obstacles, *(one for one in cuts if one not in planes)]


def _is_plane(text: str) -> bool:
    try:
        return plane(text) is not None
    except SketchTreeError:
        return False


def _options(kind: type, said: dict):
    """One record of options, of what a project says."""
    names = [field.name for field in dataclasses.fields(kind) if field.name in said and field.name not in _NOT_KEPT]
    try:
        return kind(**{name: said[name] for name in names})
    except (SketchTreeError, TypeError, ValueError):
        return kind()
