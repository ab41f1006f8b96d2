"""Which leaf is each vertex of a leaf mesh part of, and how far from its petiole?

Leaf meshes hold block after block of vertices, one a leaf in the order of the leaves, then six a short shoot. Where a mesh
is cut otherwise (cards that stand for several leaves, leaves that a level of detail left out), its pieces are what hangs
together by triangles, and a piece belongs to the leaf whose foot one of its vertices is nearest to.
"""

from typing import NamedTuple

import numpy as np
from jaxtyping import Bool, Float, Int

from sketchtree.foliage.leaves import Leaves
from sketchtree.geometry.mesh import Mesh

_SHOOT = 6  # vertices of a short shoot
_AT_FOOT = 0.25  # a leaf's foot is in its block's box, or as near to it as this, leaf sizes
_AT_MIDDLE = 0.1  # a short shoot's piece has its middle as near to the shoot's as this, shoot lengths


class LeafRows(NamedTuple):
    """One row a vertex."""

    leaf: Int[np.ndarray, " vertex"]  # row of the leaves
    reach: Float[np.ndarray, " vertex"]  # 0 at the petiole's foot, 1 where its leaf ends; 0 on a short shoot


class _Cut(NamedTuple):
    """A mesh cut into pieces; the first is 0."""

    piece: Int[np.ndarray, " vertex"]
    leaf: Int[np.ndarray, " piece"]
    is_shoot: Bool[np.ndarray, " piece"]


def leaf_rows(mesh: Mesh, leaves: Leaves) -> LeafRows:
    """The leaf of every vertex of a mesh of these leaves; there is at least one leaf."""
    cut = _by_block(mesh, leaves)
    cut = _by_triangles(mesh, leaves) if cut is None else cut
    away = np.linalg.norm(mesh.position - leaves.position[cut.leaf[cut.piece]], axis=1)
    order = np.argsort(cut.piece, kind="stable")
    first = np.searchsorted(cut.piece[order], np.arange(len(cut.leaf)))
    nearest, farthest = np.minimum.reduceat(away[order], first), np.maximum.reduceat(away[order], first)
    long = np.where(cut.is_shoot | (farthest <= nearest), np.inf, farthest - nearest)
    return LeafRows(cut.leaf[cut.piece], np.where(cut.is_shoot[cut.piece], 0.0, (away - nearest[cut.piece]) / long[cut.piece]))


def _by_block(mesh: Mesh, leaves: Leaves) -> _Cut | None:
    """The pieces of a mesh that is made of equal blocks."""
    count, shoots = len(leaves), len(leaves.shoot)
    size, rest = divmod(len(mesh.position) - _SHOOT * shoots, count)
    if rest or size < 3:
        return None
    block = mesh.position[: size * count].reshape(count, size, 3)
    room = _AT_FOOT * leaves.size[:, None] + 1e-9
    if not ((block.min(axis=1) - room <= leaves.position) & (leaves.position <= block.max(axis=1) + room)).all():
        return None
    piece = np.concatenate([np.repeat(np.arange(count), size), count + np.repeat(np.arange(shoots), _SHOOT)])
    return _Cut(piece, np.concatenate([np.arange(count), _leaf_on(leaves)]), np.arange(count + shoots) >= count)


def _leaf_on(leaves: Leaves) -> Int[np.ndarray, " shoot"]:
    """A leaf that stands on each short shoot: the nearest to its end."""
    from scipy.spatial import cKDTree

    return cKDTree(leaves.position).query(leaves.shoot[:, 1])[1] if len(leaves.shoot) else np.zeros(0, np.int64)


def _by_triangles(mesh: Mesh, leaves: Leaves) -> _Cut:
    """The pieces that hang together by triangles."""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components
    from scipy.spatial import cKDTree

    a, b = mesh.triangle[:, [0, 1]].ravel(), mesh.triangle[:, [1, 2]].ravel()
    vertices = len(mesh.position)
    count, piece = connected_components(coo_array((np.ones(len(a), np.int8), (a, b)), shape=(vertices, vertices)), directed=False)
    away, leaf = cKDTree(leaves.position).query(mesh.position, workers=-1)
    order = np.lexsort((away, piece))
    first = order[np.searchsorted(piece[order], np.arange(count))]
    return _Cut(piece.astype(np.int64), leaf[first], _are_shoots(mesh, leaves, piece, count))


def _are_shoots(mesh: Mesh, leaves: Leaves, piece, count: int) -> Bool[np.ndarray, " piece"]:
    """The pieces that have a short shoot's number of vertices, and their middle where one has it."""
    from scipy.spatial import cKDTree

    if not len(leaves.shoot):
        return np.zeros(count, bool)
    size = np.bincount(piece, minlength=count)
    middle = np.stack([np.bincount(piece, mesh.position[:, axis], minlength=count) for axis in range(3)], axis=1) / size[:, None]
    away, shoot = cKDTree(leaves.shoot.mean(axis=1)).query(middle)
    long = np.linalg.norm(leaves.shoot[:, 1] - leaves.shoot[:, 0], axis=1)
    return (size == _SHOOT) & (away <= _AT_MIDDLE * long[shoot])
