"""A branching drawing seen under one or more views: the flat form that exemplars (under many views) and sketches
(one view) share.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int

from sketchtree.skeleton import TreeSkeleton
from sketchtree.sketch.graph import SketchGraph
from sketchtree.templates.seen.footprint import project


@dataclass(frozen=True, eq=False)
class Drawing:
    """A branching drawing seen under one or more views. Rows as in a skeleton: parents first."""

    parent: Int[np.ndarray, " segment"]
    limb: Int[np.ndarray, " segment"]
    order: Int[np.ndarray, " segment"]
    start: Float[np.ndarray, "view segment 2"]
    tip: Float[np.ndarray, "view segment 2"]

    @classmethod
    def of_graph(cls, graph: SketchGraph) -> "Drawing":
        """A sketch: one view, in sketch units."""
        return cls(graph.parent, graph.limb, graph.order, graph.start[None], graph.xy[None])

    @classmethod
    def of_skeleton(cls, tree: TreeSkeleton, azimuth_deg: Float[np.ndarray, " view"]) -> "Drawing":
        """Orthographic views of a skeleton from these azimuths, metres."""
        start = np.stack([project(tree.start, v) for v in azimuth_deg])
        tip = np.stack([project(tree.tip, v) for v in azimuth_deg])
        return cls(tree.parent, tree.limb, tree.order, start, tip)

    @property
    def size(self) -> Float[np.ndarray, " view"]:
        """H of every view: the larger of height and width."""
        return np.ptp(self.tip, axis=1).max(axis=1)
