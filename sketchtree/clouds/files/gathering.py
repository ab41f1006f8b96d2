"""How does a file of any size become a cloud of bounded size? Pieces are gathered; whenever too many points are held, one real point is kept for each voxel, and voxels grow as they must.

Memory is bounded by `max_points`, whatever the file holds. Points far from the origin (map coordinates) are moved near it first, so that no precision is lost later on.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float

from sketchtree.clouds.files.pieces import Piece
from sketchtree.clouds.voxels import voxel_rows, voxel_size

_HELD = 2.0  # times `max_points`: when thinning begins
_FAR = 1000.0  # a cloud whose middle is farther from the origin is moved
_NOWHERE = 1e9  # a coordinate beyond this is no place
_GROWS = 1.15  # voxels, whenever they are too many


@dataclass(frozen=True, eq=False)
class Columns:
    """Points in order, moved by `offset`."""

    xyz: Float[np.ndarray, "point 3"]
    colour: Float[np.ndarray, "point 3"] | None
    normal: Float[np.ndarray, "point 3"] | None
    offset: tuple[float, float, float]  # was subtracted
    voxel: float  # of which one point was kept, in the file's units; 0 where all were
    read: int
    nowhere: int  # points that were left out: not finite, or beyond any place


class Gathering:
    """Takes pieces, gives columns."""

    def __init__(self, max_points: int):
        self._most = max_points
        self._held: list[tuple] = []
        self._count = 0
        self._offset = None
        self._voxel = 0.0
        self._read = self._nowhere = 0

    def add(self, piece: Piece) -> None:
        """Gather a piece."""
        self._read += len(piece.xyz)
        kept = (np.isfinite(piece.xyz) & (np.abs(piece.xyz) < _NOWHERE)).all(axis=1)
        self._nowhere += int((~kept).sum())
        if not kept.any():
            return
        xyz = piece.xyz[kept]
        if self._offset is None:
            middle = np.median(xyz, axis=0)
            self._offset = np.round(middle) if np.linalg.norm(middle) > _FAR else np.zeros(3)
        with np.errstate(over="ignore", invalid="ignore"):
            others = [None if column is None else column[kept].astype(np.float32) for column in (piece.colour, piece.normal)]
        self._hold(xyz - self._offset, *others)
        if self._count > _HELD * self._most:
            self._thin()

    def columns(self) -> Columns | None:
        """All that was gathered; None where that is nothing."""
        if not self._count:
            return None
        if self._count > self._most:
            self._thin()
        xyz, colour, normal = self._joined()
        return Columns(xyz, colour, normal, tuple(map(float, self._offset)), self._voxel, self._read, self._nowhere)

    def _hold(self, *columns) -> None:
        columns = _kept(columns, self._voxel) if self._voxel else columns
        self._held.append(columns)
        self._count += len(columns[0])

    def _thin(self) -> None:
        columns = self._joined()
        self._voxel = self._voxel or voxel_size(columns[0], self._most)
        columns = _kept(columns, self._voxel)
        while len(columns[0]) > self._most:
            self._voxel *= _GROWS
            columns = _kept(columns, self._voxel)
        self._held, self._count = [columns], len(columns[0])

    def _joined(self) -> tuple:
        return tuple(None if any(part[k] is None for part in self._held) else np.concatenate([part[k] for part in self._held]) for k in range(3))


def _kept(columns: tuple, voxel: float) -> tuple:
    """One point of each voxel."""
    rows = voxel_rows(columns[0], voxel)
    return tuple(None if column is None else column[rows] for column in columns)
