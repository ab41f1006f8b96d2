"""Which strokes are exact copies of others? A shape pasted over itself, once or thousands of times, is read once.

Copies run through the same points, from either end, and are alike in all else but their names and times. The one begun first
is kept, of those alike the first by name, so that the order of the file decides nothing. The report has a line for every copy.
"""

import dataclasses

import numpy as np

from sketchtree.axes import NULL
from sketchtree.sketch.graph import Attachment, SketchGraph
from sketchtree.sketch.joining.attachments import named
from sketchtree.sketch.joining.cleaning import AGAIN_OVER
from sketchtree.sketch.strokes import Sketch, Stroke


def without_copies(sketch: Sketch) -> tuple[Sketch, dict[int, int]]:
    """(the sketch without copies, row of every copy in the whole sketch → row of the stroke that it repeats)."""
    groups: dict[tuple, list[int]] = {}
    for row, stroke in enumerate(sketch.strokes):
        groups.setdefault(_looks(stroke), []).append(row)
    if len(groups) == len(sketch):
        return sketch, {}
    copies = {}
    for rows in groups.values():
        first = min(rows, key=lambda row: (_begun(sketch.strokes[row]), sketch.strokes[row].id))
        copies |= {row: first for row in rows if row != first}
    return dataclasses.replace(sketch, strokes=tuple(s for row, s in enumerate(sketch.strokes) if row not in copies)), copies


def _looks(stroke: Stroke) -> tuple:
    """What copies have in common."""
    points = stroke.points if stroke.pressure is None else np.column_stack([stroke.points, stroke.pressure])
    drawn = min(points.tobytes(), points[::-1].tobytes())
    return drawn, stroke.kind, stroke.labelled, stroke.closed, stroke.width, stroke.filled, stroke.wood, stroke.layer


def _begun(stroke: Stroke) -> float:
    return np.inf if stroke.time is None else float(stroke.time[0])


def with_copies(graph: SketchGraph, sketch: Sketch, copies: dict[int, int]) -> SketchGraph:
    """The graph of a sketch without its copies as that of the whole sketch; the report names every copy."""
    kept = np.array([row for row in range(len(sketch)) if row not in copies])
    ids = tuple(stroke.id for stroke in sketch.strokes)
    rank, roles = {name: k for k, name in enumerate(ids)}, {role.stroke: role for role in graph.roles}
    hanging = {a.stroke: a for a in reversed(graph.attachments)}
    again = [(sketch.strokes[row], ids[first]) for row, first in sorted(copies.items())]
    attachments = [*graph.attachments, *(_as_copy(stroke, hanging[first], first in roles) for stroke, first in again)]
    told = f"{len(again)} stroke(s) drawn exactly over others were merged with them (strokes {named([stroke.id for stroke, _ in again])})."
    return graph.replace(
        stroke=np.where(graph.stroke == NULL, NULL, kept[graph.stroke]),
        stroke_ids=ids,
        attachments=tuple(sorted(attachments, key=lambda a: rank[a.stroke])),
        roles=(*graph.roles, *(dataclasses.replace(roles[first], stroke=stroke.id) for stroke, first in again if first in roles)),
        warnings=(*graph.warnings, told),
    )


def _as_copy(stroke: Stroke, original: Attachment, apart: bool) -> Attachment:
    """The line of the report for a copy: part of the stroke it repeats, or apart from the tree as that is."""
    if apart and original.parent is None:
        return dataclasses.replace(original, stroke=stroke.id)
    owner = original.parent if original.reason == AGAIN_OVER else original.stroke
    x, y = min(stroke.points[[0, -1]].tolist(), key=lambda point: (point[1], point[0]))
    return Attachment(stroke.id, owner, (x, y), 0.0, 0.0, (), AGAIN_OVER)
