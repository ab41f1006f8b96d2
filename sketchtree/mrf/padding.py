"""Columns of a drawing, padded so that drawings of like size share one compiled program.

Segments are padded to a power of two, limbs to a quarter, a half or all of that, competing tips to two a limb.
"""

import numpy as np
from jaxtyping import Float, Int, Shaped

from sketchtree.mrf.factor_graph import FactorGraph

SMALLEST_BUCKET = 32


def bucket(graph: FactorGraph) -> tuple[int, int]:
    """(segments, limbs) that the columns are padded to."""
    segments = SMALLEST_BUCKET
    while segments < len(graph):
        segments *= 2
    limbs = segments // 4
    while limbs < graph.limb_count:
        limbs *= 2
    return segments, limbs


class Padding:
    """Makes columns of a given length; the tail of index columns is 0, that of others `fill`."""

    def __init__(self, graph: FactorGraph, dtype=np.float32):
        self.segments, self.limbs = bucket(graph)
        self.dtype = dtype

    def real(self, column, length: int, fill: float = 0.0) -> Float[np.ndarray, "padded *rest"]:
        """`column` as real numbers, `length` long."""
        return self._filled(np.asarray(column, float), length, fill).astype(self.dtype)

    def index(self, column, length: int) -> Int[np.ndarray, "padded *rest"]:
        """`column` as row numbers, `length` long."""
        return self._filled(np.asarray(column, int), length, 0).astype(np.int32)

    @staticmethod
    def _filled(column, length, fill) -> Shaped[np.ndarray, "padded *rest"]:
        return np.concatenate([column, np.full((length - len(column), *column.shape[1:]), fill, column.dtype)])
