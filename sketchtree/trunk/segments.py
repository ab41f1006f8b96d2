"""Into which segments do the vertices part the contour?

Bai, Latecki & Liu 2007, whose pruning §II.2 takes: only convex vertices of the evolved polygon (as the trunk sees them) part it, since a skeleton's branch ends in each of them and in no other; a vertex in the crotch
of two limbs parts nothing. A vertex that a person added parts it in any case. A ring without any, a smooth hole's, is one segment.
"""

from collections.abc import Sequence

import numpy as np
from jaxtyping import Bool, Float, Int

from sketchtree.trunk.edits import Vertices


def convex(ring: Float[np.ndarray, "vertex 2"]) -> Bool[np.ndarray, " vertex"]:
    """Which vertices of an evolved ring (trunk on its left) turn towards the trunk."""
    before, after = ring - np.roll(ring, 1, axis=0), np.roll(ring, -1, axis=0) - ring
    return before[:, 0] * after[:, 1] - before[:, 1] * after[:, 0] > 0


def segments(rings: Sequence[Float[np.ndarray, "point 2"]], vertices: Vertices) -> Int[np.ndarray, " point"]:
    """The segment of every point of every ring, rings one after the other; a vertex belongs to the segment that it begins."""
    labels, first = [], 0
    for ring, rows, parts in zip(rings, vertices.rows, vertices.parting, strict=True):
        parting = rows[parts]
        count = max(len(parting), 1)
        number = np.searchsorted(parting, np.arange(len(ring)), side="right") - 1
        labels.append(first + number % count)
        first += count
    return np.concatenate(labels)
