"""Which point stands for each voxel? The one nearest to the voxel's middle: a real point, so thin wood stays where it is and nothing lies between two twigs."""

import numpy as np
from jaxtyping import Float, Int

_BITS = 21  # of each coordinate in a voxel's number
FINEST = 2.0 ** (1 - _BITS)  # of the distance from the origin: finer voxels have no number


def voxel_rows(xyz: Float[np.ndarray, "point 3"], size: float) -> Int[np.ndarray, " kept"]:
    """Rows of the points that stand for the voxels of that size (metres), in the order of the points. Of two that are as near, the earlier."""
    cell = np.floor(xyz / size)
    away = (((xyz / size - cell) - 0.5) ** 2).sum(axis=1)
    key = _number(cell.astype(np.int64))
    order = np.argsort(key, kind="stable")
    begins = np.r_[True, np.diff(key[order]) > 0]
    voxel, away = np.cumsum(begins) - 1, away[order]
    hit = np.flatnonzero(away == np.minimum.reduceat(away, np.flatnonzero(begins))[voxel])
    return np.sort(order[hit[np.r_[True, np.diff(voxel[hit]) > 0]]])


def voxel_count(xyz: Float[np.ndarray, "point 3"], size: float) -> int:
    """How many voxels of that size have points."""
    key = np.sort(_number(np.floor(xyz / size).astype(np.int64)))
    return 1 + int((np.diff(key) > 0).sum())


def voxel_size(xyz: Float[np.ndarray, "point 3"], points: int) -> float:
    """The size of voxels, metres, of which about as many have points as are asked for, and no more."""
    widest = float(np.abs(xyz).max()) + 1e-12
    low = high = max(widest / 4096, FINEST * widest * 2)
    while voxel_count(xyz, high) > points:
        low, high = high, 1.6 * high
    while low == high or voxel_count(xyz, low) <= points:
        if low < 2 * FINEST * widest:
            return high
        low, high = low / 1.6, low
    for _ in range(5):
        middle = float(np.sqrt(low * high))
        low, high = (middle, high) if voxel_count(xyz, middle) > points else (low, middle)
    return high


def _number(cell):
    half = 1 << (_BITS - 1)
    x, y, z = (np.clip(cell[:, k] + half, 0, 2 * half - 1) for k in range(3))
    return (x << (2 * _BITS)) | (y << _BITS) | z
