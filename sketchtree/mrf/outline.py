"""How wide is the crown at each height, and where is the trunk below it?

    x_trunk(y)   the trunk's own line, held at its ends beyond them; the mean of a tree's stems
    R(y)         half the width, at height y, of the drawn crown or else of the hull of the laterals
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int
from scipy.spatial import ConvexHull, QhullError


@dataclass(frozen=True, eq=False)
class Outline:
    """Trunk lines and crown outlines of every tree of a drawing; H = 1, y up."""

    stems: tuple[tuple[Float[np.ndarray, "node 2"], ...], ...]  # of each tree, nodes in the order of y
    crowns: tuple[tuple[Float[np.ndarray, "point 2"], ...], ...]  # of each tree, closed

    def trunk_x(self, y: Float[np.ndarray, " query"], tree: Int[np.ndarray, " query"]) -> Float[np.ndarray, " query"]:
        """x_trunk at height `y` of tree number `tree`."""
        x = np.zeros(len(y))
        for k, stems in enumerate(self.stems):
            at = np.flatnonzero(tree == k)
            if len(at) and stems:
                x[at] = np.mean([np.interp(y[at], stem[:, 1], stem[:, 0]) for stem in stems], axis=0)
        return x

    def half_width(self, y: Float[np.ndarray, " query"], tree: Int[np.ndarray, " query"]) -> Float[np.ndarray, " query"]:
        """R at height `y` of tree number `tree`; 0 above and below its crown."""
        half = np.zeros(len(y))
        for k, crowns in enumerate(self.crowns):
            at = np.flatnonzero(tree == k)
            if len(at) and crowns:
                low, high = zip(*(_span(crown, y[at]) for crown in crowns), strict=True)
                half[at] = np.maximum(np.max(high, axis=0) - np.min(low, axis=0), 0.0) / 2
        return half


def outline_of(
    trunk_nodes: list[list[Float[np.ndarray, "node 2"]]],
    lateral_nodes: list[Float[np.ndarray, "node 2"]],
    drawn_crowns: tuple[Float[np.ndarray, "point 2"], ...],
) -> Outline:
    """The outline of each tree from its stems' nodes, its laterals' nodes and the drawn crown curves.

    A drawn curve goes to the tree whose laterals it covers best; a tree without one gets the convex hull
    of its laterals.
    """
    stems = tuple(tuple(stem[np.argsort(stem[:, 1], kind="stable")] for stem in tree) for tree in trunk_nodes)
    crowns: list[list] = [[] for _ in trunk_nodes]
    centre = np.array([nodes.mean(axis=0) if len(nodes) else [np.inf, np.inf] for nodes in lateral_nodes])
    for curve in drawn_crowns:
        if len(curve) >= 3 and np.isfinite(centre).any():
            crowns[int(np.argmin(np.linalg.norm(centre - curve.mean(axis=0), axis=1)))].append(curve)
    for tree, nodes in enumerate(lateral_nodes):
        if not crowns[tree] and len(nodes):
            crowns[tree].append(_hull(nodes))
    return Outline(stems, tuple(tuple(tree) for tree in crowns))


def _hull(nodes):
    """Convex hull, counter-clockwise; the nodes themselves where they span no area."""
    try:
        return nodes[ConvexHull(nodes).vertices] if len(nodes) > 2 else nodes
    except QhullError:
        return nodes[[nodes[:, 0].argmin(), nodes[:, 0].argmax(), nodes[:, 1].argmin(), nodes[:, 1].argmax()]]


def _span(curve, y):
    """Least and greatest x of a closed curve at each height; (inf, −inf) where it does not reach."""
    here, ahead = curve, np.roll(curve, -1, axis=0)
    falls = (here[:, 1] > ahead[:, 1])[:, None]
    a, b = np.where(falls, ahead, here), np.where(falls, here, ahead)
    crosses = (a[:, 1, None] <= y) & (y <= b[:, 1, None])
    t = np.clip((y - a[:, 1, None]) / np.where(b[:, 1] == a[:, 1], 1.0, b[:, 1] - a[:, 1])[:, None], 0.0, 1.0)
    x = a[:, 0, None] + t * (b[:, 0] - a[:, 0])[:, None]
    return np.where(crosses, x, np.inf).min(axis=0), np.where(crosses, x, -np.inf).max(axis=0)
