"""Where does each limb of a drawing run, and how far along it is each node?"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from jaxtyping import Float, Int

from sketchtree.axes import NULL
from sketchtree.editing.settled import Depths, course_of
from sketchtree.mrf.lift import along_curves
from sketchtree.sketch.graph import SketchGraph
from sketchtree.traverse import limb_chains


@dataclass(frozen=True, eq=False)
class LimbLine:
    """One limb on its page. Its foot is a node of what it grows on, or a base."""

    limb: int  # id
    parent: int | None  # id of the limb it grows on
    foot: int  # row of the graph whose tip it starts at
    rows: Int[np.ndarray, " node"]  # its segments, from foot to tip
    share: Float[np.ndarray, " node"]  # of each one's tip, 0-1 of the limb's length on the page
    length: float  # sketch units

    def depths(self, graph: SketchGraph, depth, sd, stroke_ids: tuple[str, ...]) -> Depths:
        """What is settled, where `depth` and `sd` are those of the graph's rows (sketch units)."""
        nodes = np.r_[self.foot, self.rows]
        strokes = tuple(dict.fromkeys(stroke_ids[k] for k in graph.stroke[self.rows] if k != NULL))
        return Depths(np.r_[0.0, self.share], depth[nodes], sd[nodes], self.course(graph), self.parent, strokes)

    def course(self, graph: SketchGraph) -> Float[np.ndarray, "place 2"]:
        """Where it runs, at even shares."""
        points = np.concatenate([graph.curve(row)[1:] for row in self.rows])
        return course_of(np.concatenate([graph.xy[self.foot][None], points]))


@dataclass(frozen=True, eq=False)
class LimbLines:
    """All limbs of a drawing."""

    graph: SketchGraph
    lines: tuple[LimbLine, ...]  # parents first

    @classmethod
    def of(cls, graph: SketchGraph) -> "LimbLines":
        """Those of a graph; limbs without a segment are left out."""
        page_length = np.linalg.norm(graph.xy - graph.start, axis=1)
        if len(graph.curve_points):
            _, page_length = along_curves(graph, np.repeat(np.arange(len(graph)), np.diff(graph.curve_start)))
        lines = []
        for rows in limb_chains(graph.parent, graph.limb):
            rows = rows[~graph.is_base[rows]]
            if len(rows):
                lines.append(_line(graph, rows, page_length[rows]))
        return cls(graph, tuple(lines))

    @cached_property
    def of_limb(self) -> dict[int, LimbLine]:
        """id → limb."""
        return {line.limb: line for line in self.lines}


def _line(graph: SketchGraph, rows, length) -> LimbLine:
    limb, above = int(graph.limb[rows[0]]), int(graph.parent[rows[0]])
    on_ground = bool(graph.is_base[above]) and graph.limb[above] == limb
    total = max(float(length.sum()), 1e-300)
    share = np.minimum(np.cumsum(length) / total, 1.0)
    share[-1] = 1.0
    parent = None if on_ground else int(graph.limb_id[graph.limb[above]])
    return LimbLine(int(graph.limb_id[limb]), parent, above, rows, share, total)
