"""What is known of a trunk in the picture: its axis as a rooted graph, its thickness, and the polygon that it follows."""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Float, Int

from sketchtree.axes import NULL
from sketchtree.errors import SkeletonError
from sketchtree.trunk.outline import Outline


@dataclass(frozen=True, eq=False)
class TrunkSkeleton:
    """The undirected acyclic graph G(V, E) of §II.3. Pixels, x right, y DOWN.

    Requirements, checked at construction: every edge leads from a node nearer to the root to one farther away; every node but the root is the second of exactly one edge, so that there is no cycle and one piece;
    positions are finite, radii positive."""

    xy: Float[np.ndarray, "node 2"]
    edges: Int[np.ndarray, "edge 2"]  # (nearer to the root, farther away)
    radius: Float[np.ndarray, " node"]  # Euclidean distance to the contour (EDT); at a tip that of the last circle within it
    root: int
    vertices: tuple[Float[np.ndarray, "vertex 2"], ...] = ()  # of the evolved polygon: the outer ring's, then each hole's
    parting: tuple[Bool[np.ndarray, " vertex"], ...] = ()  # those that part the contour into segments
    outline: Outline | None = None
    warnings: tuple[str, ...] = ()

    def __post_init__(self):
        count, edges = len(self.xy), np.asarray(self.edges, np.int64).reshape(-1, 2)
        object.__setattr__(self, "edges", edges)
        if not (np.isfinite(self.xy).all() and np.isfinite(self.radius).all() and (np.asarray(self.radius) > 0).all()):
            raise SkeletonError("A trunk's node is not finite, or its radius is not positive.", remedy="Drop or repair the node.")
        if len(edges) and not (0 <= edges.min() and edges.max() < count) or not 0 <= self.root < count:
            raise SkeletonError("An edge of the trunk, or its root, names a node that does not exist.", remedy="Number nodes from 0.")
        self._check_tree(count, edges)

    def _check_tree(self, count: int, edges) -> None:
        reached = np.zeros(count, bool)
        parent = np.full(count, NULL)
        parent[edges[:, 1]] = edges[:, 0]
        reached[self.root] = True
        for _ in range(count):
            more = ~reached & (parent != NULL) & reached[parent]
            if not more.any():
                break
            reached |= more
        if len(edges) >= count:
            raise SkeletonError(f"The trunk's graph has a cycle: {len(edges)} edges join {count} nodes.", remedy="Cut every loop; `trunk_skeleton` does so where two ways from the root meet.")
        if not reached.all() or len(edges) != count - 1:
            raise SkeletonError("The trunk's graph has a cycle, or is in pieces.", row=int(np.argmin(reached)), remedy="Direct every edge away from the root, one to each node.")

    def __len__(self) -> int:
        return len(self.xy)

    @property
    def parent(self) -> Int[np.ndarray, " node"]:
        """The node before each; NULL at the root."""
        parent = np.full(len(self), NULL)
        parent[self.edges[:, 1]] = self.edges[:, 0]
        return parent

    @property
    def tips(self) -> Int[np.ndarray, " tip"]:
        """Nodes where a branch ends."""
        ends = np.bincount(self.edges[:, 0], minlength=len(self)) == 0
        ends[self.root] = False
        return np.flatnonzero(ends)

    @property
    def vertex_count(self) -> int:
        """m of Algorithm 1: vertices of the outer ring."""
        return len(self.vertices[0]) if self.vertices else 0
