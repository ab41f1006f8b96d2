"""How does a tree come of the points behind a drawing? One chain for the studio and for a project of it (`sketchtree build PROJECT`), the one of `sketchtree cloud`.

The points were prepared when they were laid there (`clouds.prepared`), so they are taken as they are. What is found may become strokes: the stoutest limbs, each where it lies on the
front page, as wide as the wood, its depths those of the points.
"""

import json
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from jaxtyping import Array, Float, Key

from sketchtree.cloud_tree import CloudTree, cloud_to_tree
from sketchtree.clouds.cloud import PointCloud
from sketchtree.clouds.files.placed import Placement
from sketchtree.clouds.files.read_cloud import read_placed
from sketchtree.clouds.prepared.prepare import Prepared, prepare
from sketchtree.editing.laid_cloud import LaidCloud
from sketchtree.editing.laid_cloud import laid as laid_behind
from sketchtree.editing.project import laid_cloud
from sketchtree.editing.settled import MEASURED, Depths, Settled, course_of
from sketchtree.limb_ids import stroke_limb_id
from sketchtree.options import DrawingOptions, ReadingOptions, TreeOptions
from sketchtree.sketch.files.project import column, holds_traced
from sketchtree.sketch.formats import read_sketch
from sketchtree.sketch.strokes import Stroke
from sketchtree.skeleton import TreeSkeleton
from sketchtree.templates.store.database import Database
from sketchtree.watch import Watch

_LIMBS = 60  # that become strokes, at most
_SHORT = 0.04  # of the height: shorter limbs become none
_NONE = ("auto", "none")  # templates that name no leaves
_LEAST = 1e-3  # of the height: points of a stroke are no nearer to one another


@dataclass(frozen=True, eq=False)
class Laid:
    """Points behind a drawing, and how the tree in them is wanted."""

    cloud: LaidCloud
    reading: ReadingOptions = ReadingOptions()  # its template and height
    tree: TreeOptions = TreeOptions()

    @property
    def stretch(self) -> float:
        """Metres of the tree to a metre of the points: 1, unless another height is asked for."""
        return 1.0 if self.reading.height is None else self.reading.height / self.cloud.height

    @property
    def scale(self) -> float:
        """Metres of the tree to a unit of the page."""
        return self.stretch / self.cloud.unit


def tree_of(wanted: Laid, templates: Database | None, *, key: Key[Array, ""], watch: Watch | None = None) -> CloudTree:
    """The tree that stands in them, as `cloud_to_tree` traces it; it wears what the template says, if one is named. Raises SketchError, OptionError."""
    cloud = wanted.cloud.cloud
    cloud = PointCloud(cloud.xyz * wanted.stretch, cloud.colour)
    prepared = Prepared(cloud, np.maximum(cloud.xyz[:, 1], 0.0), Placement(), 1.0, False, 1, wanted.cloud.remarks)
    template = None if wanted.reading.template in _NONE else wanted.reading.template
    return cloud_to_tree(prepared, templates, key=key, tree=wanted.tree, template=template, watch=watch)


def read_behind(points: str | Path, sketch: str | Path, tree: int | None = None, limits: DrawingOptions = DrawingOptions()) -> LaidCloud:
    """The points of a file behind the drawing of another: their foot at its foot, and as high. `tree`: which of several, 1 the largest. Raises SketchError, OptionError."""
    cloud = prepare(read_placed(points), tree=tree)
    return laid_behind(cloud, read_sketch(sketch, max_strokes=limits.max_strokes, max_mb=limits.max_mb, max_megapixels=limits.max_megapixels).strokes)


def read_laid(path: str | Path, reading: ReadingOptions = ReadingOptions(), tree: TreeOptions = TreeOptions()) -> Laid | None:
    """The points of a project whose tree is traced in them; None for any other file. `reading` says otherwise than the project where it says anything. Raises SketchError."""
    if not holds_traced(path):
        return None
    import h5py

    with h5py.File(path, "r") as file:
        said = json.loads(column(file, "options").tobytes())
    template = said.get("template", "auto") if reading.template == "auto" else reading.template
    return Laid(laid_cloud(path), replace(reading, template=template, height=reading.height or said.get("height")), tree)


def as_strokes(found: CloudTree, laid: Laid) -> tuple[dict[str, Stroke], Settled]:
    """(the stoutest of the limbs that were seen, as strokes by name, the trunk first; where their depths lie)."""
    tree = found.skeleton.select(np.arange(len(found.skeleton)) < found.seen)
    strokes, settled, name_of = {}, {}, {}
    for number, (limb, rows) in enumerate(_stoutest(tree)):
        line, radius = _course(tree, rows, laid)
        name = name_of[limb] = "trunk" if number == 0 else f"limb {number}"
        width = 2 * float(radius.max())
        strokes[name] = Stroke(name, line[:, :2], labelled=True, width=width, pressure=np.clip(2 * radius / width, 0.0, 1.0), wood=True)
        along = np.r_[0.0, np.cumsum(np.linalg.norm(np.diff(line[:, :2], axis=0), axis=1))]
        above = tree.parent[rows[0]]
        parent = None if tree.is_base[above] else stroke_limb_id(name_of[int(tree.limb[above])])
        settled[stroke_limb_id(name)] = Depths(along / along[-1], line[:, 2], np.zeros(len(line)), course_of(line[:, :2]), parent, (name,))
    return strokes, Settled(settled, asked=MEASURED, axis=laid.cloud.x)


def _stoutest(tree: TreeSkeleton) -> list[tuple[int, np.ndarray]]:
    """(id, rows) of the limbs with most wood, each after the one it grows on."""
    rows = np.flatnonzero(~tree.is_base)
    ids, first, of = np.unique(tree.limb[rows], return_index=True, return_inverse=True)
    wood, long = (np.bincount(of, tree.length[rows] * weight) for weight in (tree.radius[rows] ** 2, 1.0))
    above = [int(tree.limb[tree.parent[rows[k]]]) if not tree.is_base[tree.parent[rows[k]]] else None for k in first]
    number, kept = {int(name): k for k, name in enumerate(ids)}, set()
    for k in np.argsort(-wood, kind="stable"):
        if long[k] < _SHORT * tree.height and kept:
            continue
        way = [int(k)]
        while (on := above[way[-1]]) is not None:
            way.append(number[on])
        if len(kept | set(way)) <= _LIMBS:
            kept |= set(way)
    return [(int(ids[k]), rows[of == k]) for k in sorted(kept, key=lambda k: (first[k], k))]


def _course(tree: TreeSkeleton, rows, laid: Laid) -> tuple[Float[np.ndarray, "point 3"], Float[np.ndarray, " point"]]:
    """(a limb's course on the front page, sketch units; half its width at each point)."""
    above = tree.parent[rows[0]]
    own = tree.radius[rows[0]] if tree.is_base[above] or tree.limb[above] != tree.limb[rows[0]] else tree.radius[above]
    parts, radius = [tree.curve(rows[0])[:1]], [own]
    for row in rows:
        curve = tree.curve(row)[1:]
        parts.append(curve)
        radius += np.linspace(radius[-1], tree.radius[row], len(curve) + 1)[1:].tolist()
    line, radius = np.concatenate(parts), np.array(radius)
    page = line / laid.scale + (laid.cloud.x, laid.cloud.y, 0.0)
    apart = np.linalg.norm(np.diff(page[:, :2], axis=0), axis=1) > _LEAST * laid.cloud.height * laid.cloud.unit
    keep = np.r_[True, apart]
    keep[-1] = True
    return page[keep], radius[keep] / laid.scale
