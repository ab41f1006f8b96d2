"""Where is the middle of the trunk? The medial axis, without what one contour segment alone gives rise to.

Points of the medial axis lie on edges of the Voronoi diagram of the contour's points: the two points that an edge parts are those where the largest circle round any point of it touches the contour. §II.2 removes
"all skeleton points whose boundary points tangential to their maximal circle lie on the same contour segment" (Bai, Latecki & Liu 2007): an edge stays if its two points lie on different segments. What
is left hangs together, and has one loop for each hole.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Float, Int
from scipy.ndimage import map_coordinates
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components
from scipy.spatial import Voronoi

from sketchtree.errors import SketchError
from sketchtree.trunk.binary import HALF, Binary

_APART = 1e-3  # pixels: contour points of a grid stand on common circles, and are moved by so much


@dataclass(frozen=True, eq=False)
class Axis:
    """The medial axis as a graph; pixels, y down."""

    xy: Float[np.ndarray, "node 2"]
    edges: Int[np.ndarray, "edge 2"]
    lost: float = 0.0  # length of what does not hang together with it, pixels


def medial_axis(binary: Binary, rings: Sequence[Float[np.ndarray, "point 2"]], segment: Int[np.ndarray, " point"]) -> Axis:
    """The axis within the trunk; `segment` of every contour point, rings one after the other (None parts every point from every other)."""
    sites = np.concatenate(rings)
    diagram = Voronoi(sites + _scattered(len(sites)))
    ends = np.array(diagram.ridge_vertices)
    own = segment[diagram.ridge_points]
    inside = np.zeros(len(diagram.vertices) + 1, bool)  # the last: at infinity
    inside[:-1] = within(binary, diagram.vertices)
    parted = own[:, 0] != own[:, 1]
    whole, half = parted & inside[ends].all(axis=1), parted & (inside[ends].sum(axis=1) == 1) & _neighbours(diagram.ridge_points, rings)
    on_contour = sites[diagram.ridge_points[half]].mean(axis=1)  # an edge between two neighbours of the contour leaves the trunk between them
    reaching = np.column_stack([ends[half][inside[ends[half]]], len(diagram.vertices) + np.arange(len(on_contour))])
    ends = np.concatenate([ends[whole], reaching])
    if len(ends) == 0:
        raise SketchError("The trunk has no skeleton: it is too small, or its contour has too few vertices.", remedy="Ask for more vertices, or give a larger picture.")
    return _largest(np.concatenate([diagram.vertices, on_contour]), ends)


def _neighbours(pairs, rings) -> Bool[np.ndarray, " pair"]:
    """Which pairs of contour points follow each other on their ring?"""
    after, first = [], 0
    for ring in rings:
        after.append(first + (np.arange(len(ring)) + 1) % len(ring))
        first += len(ring)
    after = np.concatenate(after)
    return (after[pairs[:, 0]] == pairs[:, 1]) | (after[pairs[:, 1]] == pairs[:, 0])


def within(binary: Binary, points: Float[np.ndarray, "point 2"]) -> Bool[np.ndarray, " point"]:
    """Which points lie inside the contour."""
    return map_coordinates(binary.level, points[:, ::-1].T + 0.5, order=1, cval=0.0) > HALF


def _scattered(count: int) -> Float[np.ndarray, "point 2"]:
    """Little steps that never repeat: fractional parts of multiples of two irrational numbers."""
    k = np.arange(1, count + 1)[:, None]
    return _APART * ((k * np.array([0.7548776662466927, 0.5698402909980532])) % 1.0 - 0.5)


def _largest(xy, ends) -> Axis:
    """The longest connected part, nodes numbered anew."""
    used, edges = np.unique(ends, return_inverse=True)
    edges, xy = edges.reshape(-1, 2), xy[used]
    graph = coo_array((np.ones(len(edges)), (edges[:, 0], edges[:, 1])), shape=(len(xy), len(xy)))
    count, part = connected_components(graph, directed=False)
    lost = 0.0
    if count > 1:
        length = np.bincount(part[edges[:, 0]], np.hypot(*(xy[edges[:, 0]] - xy[edges[:, 1]]).T), minlength=count)
        keep, lost = part == np.argmax(length), float(length.sum() - length.max())
        number = np.cumsum(keep) - 1
        edges, xy = number[edges[keep[edges[:, 0]]]], xy[keep]
    return Axis(xy, edges, lost)
