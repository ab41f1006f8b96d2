"""Which points are neighbours on the same wood? One graph that joins all of them.

Every point is joined with the nearest others, as far as its own surroundings are sparse:

    |p_i − p_j| ≤ reach · min(s_i, s_j),      s_i  the median distance to the six nearest

What is left in pieces (a scan has holes, and twigs hide one another) is joined over the narrowest gaps, pieces with pieces, each by several bridges, so that the way to the foot
may choose the one that lies on its way.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int
from scipy.sparse import csr_matrix
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

NEIGHBOURS = 10
REACH = 4.0  # spacings
_WIDER = 1.5  # bridges so many times as long as a piece's narrowest are built too
_BRIDGES = 12  # the most that a piece begins in one round


@dataclass(frozen=True, eq=False)
class Joined:
    """A graph of points; each pair once, in one direction or in both."""

    one: Int[np.ndarray, " pair"]
    other: Int[np.ndarray, " pair"]
    length: Float[np.ndarray, " pair"]  # metres
    spacing: Float[np.ndarray, " point"]  # s_i, metres
    pieces: int  # before bridges were built

    def matrix(self, value: Float[np.ndarray, " pair"], size: int) -> csr_matrix:
        """The graph as a symmetric matrix of a positive value."""
        there = csr_matrix((value, (self.one, self.other)), shape=(size, size))
        return there.maximum(there.T)


def joined(xyz: Float[np.ndarray, "point 3"], neighbours: int = NEIGHBOURS, reach: float = REACH) -> Joined:
    """The graph of two points or more; those at the same place count as neighbours too."""
    tree, count = cKDTree(xyz), min(neighbours, len(xyz) - 1)
    distance, near = tree.query(xyz, k=count + 1)
    distance, near = distance[:, 1:], near[:, 1:]
    spacing = np.maximum(np.median(distance[:, :6], axis=1), 1e-9)
    one, other, length = np.repeat(np.arange(len(xyz)), count), near.ravel(), distance.ravel()
    kept = (length <= reach * np.minimum(spacing[one], spacing[other])) & (one != other)
    one, other, length = one[kept], other[kept], length[kept]
    pieces, piece = _pieces(one, other, len(xyz))
    found = pieces
    while found > 1:
        begun, ended, across = _bridges(tree, xyz, piece, found)
        one, other, length = np.r_[one, begun], np.r_[other, ended], np.r_[length, across]
        found, piece = _pieces(one, other, len(xyz))
    return Joined(one, other, np.maximum(length, 1e-9), spacing, pieces)


def _pieces(one, other, size: int) -> tuple[int, np.ndarray]:
    return connected_components(csr_matrix((np.ones(len(one), np.int8), (one, other)), shape=(size, size)), directed=False)


def _bridges(tree: cKDTree, xyz, piece, pieces: int):
    """From every piece but the largest to the nearest points of others: (from, to, metres)."""
    biggest = np.argmax(np.bincount(piece))
    begun, ended, across = [], [], []
    best = np.full(pieces, np.inf)
    rest, looked = np.flatnonzero(piece != biggest), 16
    while len(rest):
        distance, near = tree.query(xyz[rest], k=min(looked, len(xyz)))
        other = piece[near] != piece[rest][:, None]
        has, first = other.any(axis=1), other.argmax(axis=1)
        begun.append(rest[has])
        ended.append(near[has, first[has]])
        across.append(distance[has, first[has]])
        np.minimum.at(best, piece[rest[has]], across[-1])
        beyond = distance[~has, -1] < _WIDER * best[piece[rest[~has]]]
        rest, looked = rest[~has][beyond], 4 * looked
    begun, ended, across = np.concatenate(begun), np.concatenate(ended), np.concatenate(across)
    order = np.lexsort((across, piece[begun]))
    begun, ended, across = begun[order], ended[order], across[order]
    first = np.r_[0, np.flatnonzero(np.diff(piece[begun])) + 1]
    rank = np.arange(len(begun)) - np.repeat(first, np.diff(np.r_[first, len(begun)]))
    kept = (across <= _WIDER * best[piece[begun]]) & (rank < _BRIDGES)
    return begun[kept], ended[kept], across[kept]
