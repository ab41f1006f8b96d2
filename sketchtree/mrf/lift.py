"""From depths to a skeleton: every drawn point gets its z, and keeps its x and y.

At nodes z is the inferred depth. Between them it follows, along each limb, the monotone cubic of
Fritsch & Butland 1984 in the length on the page, so that limbs curve in depth as they do on the page and
never overshoot a node:

    m_i = 3 (h_{i-1} + h_i) / ((2h_i + h_{i-1}) / δ_{i-1} + (h_i + 2h_{i-1}) / δ_i)   if δ_{i-1} δ_i > 0, else 0

    h_i   length on the page of segment i        δ_i   its slope Δz / h_i        m_i   slope at a node
"""

import numpy as np
from jaxtyping import Float

from sketchtree.mrf.factor_graph import drawn_radius
from sketchtree.similarity import Similarity
from sketchtree.sketch.graph import SketchGraph
from sketchtree.skeleton import Kind, TreeSkeleton


def lift(
    graph: SketchGraph,
    depth: Float[np.ndarray, " segment"],
    similarity: Similarity,
    *,
    radius: Float[np.ndarray, " segment"] | None = None,
    depth_sd: Float[np.ndarray, " segment"] | None = None,
) -> TreeSkeleton:
    """The drawn skeleton in the world: rows are the graph's rows, in order.

    `depth` and `depth_sd` are in sketch units (z towards the viewer), `radius` in metres (None: from
    the drawn widths, or a taper). x and y are the drawn points' under the similarity, to the last bit.
    """
    depth = np.asarray(depth, float)
    curve_z = curve_depth(graph, depth)
    if radius is None:
        radius = drawn_radius(graph) * similarity.scale
    sd = np.full(len(graph), np.nan) if depth_sd is None else np.asarray(depth_sd) * similarity.scale
    return TreeSkeleton.from_columns(
        parent=graph.parent,
        tip=similarity.to_world(np.column_stack([graph.xy, depth])),
        radius=radius,
        order=graph.order,
        limb=graph.limb_id[graph.limb],
        stroke=graph.stroke,
        tree=graph.tree,
        kind=np.where(graph.root, int(Kind.ROOT), int(Kind.DRAWN)),
        depth_sd=sd,
        curve_points=similarity.to_world(np.column_stack([graph.curve_points, curve_z])),
        curve_start=graph.curve_start,
    )


def curve_depth(graph: SketchGraph, depth: Float[np.ndarray, " segment"]) -> Float[np.ndarray, " point"]:
    """z of every drawn point between nodes, sketch units."""
    if len(graph.curve_points) == 0:
        return np.zeros(0)
    row = np.repeat(np.arange(len(graph)), np.diff(graph.curve_start))
    along, page_length = along_curves(graph, row)
    above = np.maximum(graph.parent, 0)
    slope_in, slope_out = _node_slopes(graph, depth, page_length)
    h = np.maximum(page_length, 1e-300)[row]
    t = np.clip(along / h, 0.0, 1.0)
    z0, z1 = depth[above][row], depth[row]
    hermite = (2 * t**3 - 3 * t**2 + 1) * z0 + (3 * t**2 - 2 * t**3) * z1
    return hermite + h * ((t**3 - 2 * t**2 + t) * slope_in[row] + (t**3 - t**2) * slope_out[row])


def along_curves(graph: SketchGraph, row):
    """Length on the page from the start of its segment (`row`) to every curve point, and of every whole segment; sketch units."""
    count = np.diff(graph.curve_start)
    first = graph.curve_start[:-1]
    before = np.empty_like(graph.curve_points)
    before[1:] = graph.curve_points[:-1]
    has = count > 0
    before[first[has]] = graph.start[has]
    step = np.linalg.norm(graph.curve_points - before, axis=1)
    total = np.cumsum(step)
    opening = np.r_[0.0, total][first]
    along = total - opening[row]
    last = np.where(has[:, None], graph.curve_points[np.maximum(first + count - 1, 0)], graph.start)
    drawn = np.r_[0.0, total][graph.curve_start[1:]] - opening
    return along, drawn + np.linalg.norm(graph.xy - last, axis=1)


def _node_slopes(graph, depth, h):
    """dz/ds at the start and at the tip of every segment along its limb; one-sided at limb ends."""
    parent = np.maximum(graph.parent, 0)
    delta = np.where(graph.is_base, 0.0, (depth - depth[parent]) / np.maximum(h, 1e-300))
    delta = np.where(h > 0, delta, 0.0)
    continues = ~graph.is_base & (graph.limb[parent] == graph.limb) & ~graph.is_base[parent]
    slope_in, slope_out = delta.copy(), delta.copy()
    rows = np.flatnonzero(continues)
    above = parent[rows]
    d0, d1, h0, h1 = delta[above], delta[rows], h[above], h[rows]
    same = d0 * d1 > 0
    weight = (2 * h1 + h0) / np.where(same, d0, 1.0) + (h1 + 2 * h0) / np.where(same, d1, 1.0)
    slope_in[rows] = np.where(same, 3 * (h0 + h1) / np.where(same, weight, 1.0), 0.0)
    slope_out[above] = slope_in[rows]
    return slope_in, slope_out
