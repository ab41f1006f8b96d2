"""Which other trees may the drawing show? Every reading with where its depths would be, held ones kept."""

import dataclasses

import numpy as np

from sketchtree.drawn_tree import draw_out
from sketchtree.editing.attached import is_turned
from sketchtree.editing.document import Document
from sketchtree.editing.edits import Edits
from sketchtree.editing.limbs import LimbLines
from sketchtree.editing.settled import Settled
from sketchtree.keys import root_key
from sketchtree.mrf.lift import curve_depth
from sketchtree.sketch.graph import SketchGraph
from sketchtree.studio import messages
from sketchtree.watch import Watch

_WANTED = 8


def alternatives(templates, revision: int, document: Document, watch: Watch) -> tuple[messages.Alternatives, list[Settled]]:
    """Readings of the front page, the present one first; limbs of turned pages, and adopted ones, follow what they grow on."""
    front = dataclasses.replace(document.sketch, strokes=tuple(stroke for stroke in document.sketch.strokes if not is_turned(stroke)))
    options = dataclasses.replace(document.reading, alternatives=_WANTED)
    held = Edits(held=document.edits.held)
    drawn = draw_out(front, templates, key=root_key(document.seed), options=options, edits=held, settled=document.settled, cloud=document.cloud, watch=watch)
    graph = drawn.graph.above_ground()
    lines = LimbLines.of(graph)
    attached = {limb: one for limb, one in document.settled.limbs.items() if limb not in lines.of_limb}
    found, settled = [], []
    for reading in drawn.fit.alternatives:
        depth = reading.depth[: len(graph)]
        limbs = {line.limb: line.depths(graph, depth, drawn.fit.depth_sd, graph.stroke_ids) for line in lines.lines}
        settled.append(dataclasses.replace(drawn.settled, limbs=limbs | attached))
        found.append(messages.Reading(odds=float(reading.odds), log_posterior=float(reading.log_posterior), paths=_paths(graph, lines, depth)))
    return messages.Alternatives(revision=revision, readings=found), settled


def _paths(graph: SketchGraph, lines: LimbLines, depth) -> list[list[float]]:
    """Every limb's course, y down."""
    z = curve_depth(graph, depth)
    points = np.column_stack([graph.curve_points, z]) if len(z) else np.zeros((0, 3))
    paths = []
    for line in lines.lines:
        parts = [np.r_[graph.xy[line.foot], depth[line.foot]][None]]
        for row in line.rows:
            parts += [points[graph.curve_start[row] : graph.curve_start[row + 1]], np.r_[graph.xy[row], depth[row]][None]]
        paths.append((np.concatenate(parts) * (1.0, -1.0, 1.0)).round(3).ravel().tolist())
    return paths
