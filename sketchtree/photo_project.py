"""How does a project keep a tree that was made of a photo, and how is that tree made of it again?

A project (`export/skeletons/hdf5.py`) of a photo holds the picture as its underlay, `photo` set, the strokes that mark the tree in it, in the photo's pixels (y up, so negative), the
options of a photo too, and the grown skeleton. The studio opens it as the photo with its strokes on it; `sketchtree build` makes the tree of the same pixels and strokes once more. What
was traced is not kept: it is found again.
"""

import dataclasses
import io
import json
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from scipy.spatial import cKDTree

from sketchtree.axes import NULL
from sketchtree.editing.document import Underlay
from sketchtree.editing.settled import Settled
from sketchtree.errors import SketchError
from sketchtree.options import DrawingOptions
from sketchtree.photo.marked import Marked
from sketchtree.photo.photo import Photo, turned_over
from sketchtree.photo.read_photo import photo_in
from sketchtree.photo.read_strokes import marked_trees
from sketchtree.photo.wanted import PhotoOptions
from sketchtree.photo_tree import PhotoTree
from sketchtree.pipeline import TreeModel
from sketchtree.sketch.files.project import column, holds_photo
from sketchtree.sketch.formats import read_sketch
from sketchtree.sketch.strokes import Sketch, Stroke, StrokeKind

_SHOWN = ((b"\x89PNG\r\n\x1a\n", 0), (b"\xff\xd8\xff", 0), (b"WEBP", 8))  # what the studio's page can show: what files begin with, and where
_TRUNK = "trunk"  # a layer's name, which says so whatever the stroke is called


@dataclass(frozen=True, eq=False)
class PhotoProject:
    """A photo, the trees that are marked in it, and how they are wanted."""

    photo: Photo
    marked: tuple[Marked, ...]
    wanted: PhotoOptions


def as_project(tree: PhotoTree, picture: bytes) -> tuple[TreeModel, Underlay, tuple[str, ...]]:
    """(the model with the strokes that mark it as its drawing, its photo as underlay, what can't be kept). `picture`: the bytes of the photo's file."""
    photo, marked = tree.seen.photo, tree.marked
    page = (0.0, -float(photo.height), float(photo.width), 0.0)
    sketch = Sketch(_strokes(marked), name=photo.name, units="px", page=page)
    crown = next(k for k, stroke in enumerate(sketch.strokes) if stroke.kind == StrokeKind.CROWN)
    drawn = dataclasses.replace(tree.drawn, sketch=sketch, settled=Settled(template=tree.drawn.settled.template))
    model = dataclasses.replace(tree.model, drawn=drawn, skeleton=_by_marks(tree, crown))
    kept, told = _shown(picture, photo)
    return model, Underlay(kept, 0.0, 0.0, float(photo.width), float(photo.height), opacity=1.0, photo=True), told


def read_photo_project(path: str | Path, limits: DrawingOptions = DrawingOptions()) -> PhotoProject | None:
    """The photo of a project, with all that was marked in it; None for any other file. Raises SketchError."""
    path = Path(path)
    if not holds_photo(path):
        return None
    underlay, wanted = _underlay(path)
    photo = photo_in(underlay.picture, path.name, max_megapixels=limits.max_megapixels)
    sketch = read_sketch(path, max_strokes=limits.max_strokes, max_mb=limits.max_mb)
    front = [stroke for stroke in sketch.strokes if stroke.view_deg % 360.0 == 0.0 and stroke.kind in (StrokeKind.BRANCH, StrokeKind.CROWN)]
    laid = (photo.width / underlay.width, photo.height / underlay.height)
    strokes = tuple(dataclasses.replace(stroke, points=(stroke.points - (underlay.x, underlay.y)) * laid) for stroke in front)
    return PhotoProject(photo, marked_trees(dataclasses.replace(sketch, strokes=strokes, page=None), photo), wanted)


def picture_in(path: str | Path) -> bytes:
    """The bytes of the picture in a project that holds a photo. Raises SketchError."""
    return _underlay(Path(path))[0].picture


def _strokes(marked: Marked) -> tuple[Stroke, ...]:
    """The strokes of one tree as a drawing: its limbs, the trunk's first, then its crown."""
    names = marked.names or tuple(f"limb{k + 1}" for k in range(len(marked.branches)))
    limbs = [
        Stroke(id=name, points=turned_over(line), labelled=True, layer=_TRUNK if k == 0 else None) for k, (name, line) in enumerate(zip(names, marked.branches, strict=True))
    ]
    crown = marked.crown_name if marked.crown_name not in names else f"{marked.crown_name} "
    return (*limbs, Stroke(id=crown, points=turned_over(marked.crown), kind=StrokeKind.CROWN, labelled=True, closed=True))


def _by_marks(tree: PhotoTree, crown: int):
    """The grown skeleton, its column `stroke` numbering the marks instead of the limbs that were traced."""
    skeleton, graph = tree.model.skeleton, tree.drawn.graph
    joint = cKDTree(turned_over(tree.traced.xy)).query(graph.xy)[1]
    mark = np.full(max(len(graph.stroke_ids), int(skeleton.stroke.max(initial=0)) + 1), NULL)
    mark[graph.stroke] = np.minimum(tree.traced.stroke[joint], crown - 1)
    return skeleton.replace(stroke=np.where(skeleton.stroke == NULL, NULL, mark[skeleton.stroke]))


def _shown(picture: bytes, photo: Photo) -> tuple[bytes, tuple[str, ...]]:
    """(a file that the studio's page can show, what is lost by that)."""
    if any(picture[at:].startswith(start) for start, at in _SHOWN):
        return picture, ()
    from PIL import Image

    whole = io.BytesIO()
    Image.fromarray(photo.rgb if photo.alpha is None else np.dstack([photo.rgb, photo.alpha])).save(whole, "PNG")
    return whole.getvalue(), (f"The project keeps {photo.name} as PNG, in 8 bits.",)


def _underlay(path: Path) -> tuple[Underlay, PhotoOptions]:
    """The photo and the options of a project."""
    import h5py

    try:
        with h5py.File(path, "r") as file:
            at = file["underlay"].attrs
            laid = Underlay(column(file, "underlay").astype(np.uint8).tobytes(), *(float(at[one]) for one in ("x", "y", "width", "height")), photo=True)
            said = json.loads(column(file, "options").tobytes()) if "options" in file else {}
        if not (np.isfinite([laid.x, laid.y, laid.width, laid.height]).all() and laid.width > 0 and laid.height > 0):
            raise ValueError("its photo has no size")
        known = {field.name for field in dataclasses.fields(PhotoOptions)}
        return laid, PhotoOptions(**{name: value for name, value in said.items() if name in known})
    except (OSError, RuntimeError, ValueError, TypeError, KeyError, AttributeError, RecursionError) as error:
        raise SketchError(f"The photo in {path.name} can't be read ({error}).", remedy="Open an older copy of it.") from error
