"""How is a system over all pixels solved exactly, and fast? By a factorisation in the order of nested dissection.

Pixels couple over two rows and columns (windows of 3 × 3), so a strip two pixels wide parts a picture into halves that don't touch. Halves first, strip last, each half in
the same way: of 420 × 400 pixels the factor has 52 million entries, and 65 million in the order of least degree.
"""

import numpy as np
from jaxtyping import Float, Int
from scipy.sparse import csr_array
from scipy.sparse.linalg import splu

_STRIP = 2  # pixels: how far the matting Laplacian reaches
_SMALL = 64  # pixels of a block that is not parted further


class Factor:
    """The factors of a symmetric positive definite matrix over the pixels of a picture."""

    def __init__(self, matrix, shape: tuple[int, int]):
        self._order = dissected(*shape)
        inner = csr_array(matrix)[self._order][:, self._order].tocsc()
        self._factor = splu(inner, permc_spec="NATURAL", options={"SymmetricMode": True, "DiagPivotThresh": 0.0})

    def solve(self, right: Float[np.ndarray, " pixel"]) -> Float[np.ndarray, " pixel"]:
        """x with A x = right."""
        found = np.empty_like(right)
        found[self._order] = self._factor.solve(right[self._order])
        return found


def dissected(rows: int, columns: int) -> Int[np.ndarray, " pixel"]:
    """The pixels (row × columns + column) in the order of nested dissection."""
    blocks: list[np.ndarray] = []
    _part(blocks, 0, rows, 0, columns, columns)
    return np.concatenate(blocks)


def _part(blocks: list, top: int, bottom: int, left: int, right: int, columns: int) -> None:
    high, wide = bottom - top, right - left
    if high * wide <= _SMALL or min(high, wide) <= 2 * _STRIP:
        blocks.append((np.arange(top, bottom)[:, None] * columns + np.arange(left, right)).ravel())
    elif high >= wide:
        cut = (top + bottom - _STRIP) // 2
        _part(blocks, top, cut, left, right, columns)
        _part(blocks, cut + _STRIP, bottom, left, right, columns)
        blocks.append((np.arange(cut, cut + _STRIP)[:, None] * columns + np.arange(left, right)).ravel())
    else:
        cut = (left + right - _STRIP) // 2
        _part(blocks, top, bottom, left, cut, columns)
        _part(blocks, top, bottom, cut + _STRIP, right, columns)
        blocks.append((np.arange(top, bottom)[:, None] * columns + np.arange(cut, cut + _STRIP)).ravel())
