"""A file, or a sketch, becomes the branches it shows: the first stage of every command.

Strokes of turned pages are no part of the front page's graph; they join the tree when it is in space (`editing.attached`). A project brings what was done to its tree by hand.
"""

import dataclasses
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from sketchtree.axes import NULL
from sketchtree.editing.edits import Edits
from sketchtree.editing.laid_cloud import LaidCloud
from sketchtree.editing.project import hand_work, laid_cloud
from sketchtree.editing.settled import Settled
from sketchtree.errors import SketchError
from sketchtree.options import DrawingOptions
from sketchtree.sketch.formats import read_sketch
from sketchtree.sketch.graph import SketchGraph
from sketchtree.sketch.reading import sketch_graph
from sketchtree.sketch.strokes import SCRIBBLES, Sketch, StrokeKind
from sketchtree.watch import Watch, shared

_FILE = 0.5  # of the work, about: the file's own part of reading a large drawing


@dataclass(frozen=True, eq=False)
class HandWork:
    """What is known of a drawing beside its strokes."""

    edits: Edits = Edits()
    settled: Settled = Settled()
    cloud: LaidCloud | None = None  # points that say how deep its branches lie


def read_drawing(source: Sketch | str | Path, options: DrawingOptions, watch: Watch) -> tuple[Sketch, SketchGraph]:
    """(the drawing, the segment tree of its front page). Raises SketchError."""
    if isinstance(source, Sketch):
        return source, front_graph(source, options.crown)
    sketch = read_sketch(
        source,
        max_strokes=options.max_strokes,
        max_mb=options.max_mb,
        max_megapixels=options.max_megapixels,
        progress=shared(watch.on_part, 0.0, _FILE),
    )
    return sketch, front_graph(sketch, options.crown)


def read_hand_work(source: Sketch | str | Path) -> HandWork:
    """What a project file knows beside its strokes; nothing of any other. Raises SketchError."""
    if isinstance(source, Sketch):
        return HandWork()
    found = hand_work(source)
    return HandWork() if found is None else HandWork(*found, laid_cloud(source))


def front_graph(sketch: Sketch, crown: str) -> SketchGraph:
    """The segment tree of the strokes of the front page; strokes are numbered as in the whole sketch. Raises SketchError."""
    front = [k for k, stroke in enumerate(sketch.strokes) if stroke.view_deg % 360.0 == 0.0 and stroke.kind not in SCRIBBLES]
    if len(front) == len(sketch.strokes):
        return sketch_graph(sketch, crown=crown)
    if all(stroke.kind in SCRIBBLES for stroke in sketch.strokes):
        raise SketchError(f"{sketch.name} has no branch strokes: all it holds is scribbles over a photo.", remedy="Draw at least a trunk.")
    graph = sketch_graph(dataclasses.replace(sketch, strokes=tuple(sketch.strokes[k] for k in front)), crown=crown)
    number = np.array(front, np.int64)
    aside = [stroke.id for stroke in sketch.strokes if stroke.view_deg % 360.0 != 0.0 and stroke.kind in (StrokeKind.CROWN, StrokeKind.OBSTACLE)]
    told = tuple(f"Stroke {name} is a crown or an obstacle on a turned page; only those of the front page count." for name in aside)
    return graph.replace(
        stroke=np.where(graph.stroke == NULL, NULL, number[graph.stroke]),
        stroke_ids=tuple(stroke.id for stroke in sketch.strokes),
        warnings=(*graph.warnings, *told),
    )
