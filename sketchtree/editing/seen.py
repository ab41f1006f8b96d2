"""Which points of the cloud behind a drawing say how deep its branches lie?

The cloud stands on the drawing's front page (`laid_cloud`); a factor of the drawing's graph wants its points from the graph's first base (`mrf.factors.seen_depths`), and one of a turned page
wants them turned about the axis through the first root.
"""

import dataclasses

import numpy as np
from jaxtyping import Float

from sketchtree.editing.laid_cloud import LaidCloud
from sketchtree.editing.turning import on_page
from sketchtree.mrf.factors.seen_depths import SeenPoints
from sketchtree.mrf.solver import AbstractSolver
from sketchtree.sketch.graph import SketchGraph

FACTOR = "seen"


def with_seen(solver: AbstractSolver, cloud: LaidCloud | None, graph: SketchGraph) -> AbstractSolver:
    """The solver, told of the points that are seen of the drawing's front page. Only `elevation` hears of them."""
    return solver if cloud is None or solver.name != "elevation" else _told(solver, cloud.on_page, graph, 0.0)


def with_seen_from(solver: AbstractSolver, cloud: LaidCloud | None, graph: SketchGraph, view_deg: float, axis: float, depth: float) -> AbstractSolver:
    """The same of a page at azimuth `view_deg`, on which the graph's first base lies at that depth."""
    return solver if cloud is None or solver.name != "elevation" else _told(solver, on_page(cloud.on_page, view_deg, axis), graph, depth)


def _told(solver: AbstractSolver, points: Float[np.ndarray, "point 3"], graph: SketchGraph, depth: float) -> AbstractSolver:
    base = graph.xy[np.flatnonzero(graph.is_base)[0]]
    seen = SeenPoints(points - (*base, depth), needed=False)
    return dataclasses.replace(solver, factors={**solver.factors, FACTOR: seen})
