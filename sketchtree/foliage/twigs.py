"""Which stretches of wood carry leaves, and which way do they look?

Leaves grow on the young, thin, outer wood: where the radius is at most `thickest` and the way along the
limb to its tip at most `reach`. The wood is cut into straight *pieces* (drawn curves keep their points).

Frames are carried along each limb by the smallest rotation from one tangent to the next (parallel
transport, so leaves do not spin about a bending twig):

    R u = u − (u·t')/(1 + t·t') (t + t')        u ⟂ t, the tangent before; t' the one after
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Float, Int

from sketchtree.axes import NULL
from sketchtree.skeleton import TreeSkeleton
from sketchtree.traverse import generations

_UP = np.array([0.0, 1.0, 0.0])


@dataclass(frozen=True, eq=False)
class Twigs:
    """Straight pieces of wood, metres. `to_tip` is measured along the limb from a piece's *end*."""

    row: Int[np.ndarray, " piece"]  # of the skeleton
    start: Float[np.ndarray, "piece 3"]
    end: Float[np.ndarray, "piece 3"]
    start_radius: Float[np.ndarray, " piece"]
    end_radius: Float[np.ndarray, " piece"]
    tangent: Float[np.ndarray, "piece 3"]
    side: Float[np.ndarray, "piece 3"]  # unit, ⟂ tangent; level where the limb starts level
    to_tip: Float[np.ndarray, " piece"]
    from_foot: Float[np.ndarray, " piece"]  # from the limb's insertion to the piece's start
    foot_radius: Float[np.ndarray, " piece"]  # of the wood that the limb stands on; 0 on a trunk
    limb_length: Float[np.ndarray, " piece"]

    def __len__(self) -> int:
        return len(self.row)

    @property
    def length(self) -> Float[np.ndarray, " piece"]:
        """Length of each piece, metres."""
        return np.linalg.norm(self.end - self.start, axis=1)

    def select(self, keep: Bool[np.ndarray, " piece"]) -> "Twigs":
        """Only the pieces where `keep` is true."""
        return Twigs(**{name: getattr(self, name)[keep] for name in self.__dataclass_fields__})


def wood_pieces(tree: TreeSkeleton) -> Twigs:
    """All wood of the tree as straight pieces with their frames and their place on their limb."""
    follows = _follows(tree)
    start, end, row = _cut(tree)
    length = np.linalg.norm(end - start, axis=1)
    row_length = np.bincount(row, length, minlength=len(tree))
    to_tip, from_foot, foot_radius = _places(tree, follows, row_length)
    tangent_row, side_row = _frames(tree, follows)
    tangent = (end - start) / np.maximum(length, 1e-12)[:, None]
    tangent = np.where((length > 1e-12)[:, None], tangent, tangent_row[row])
    before = np.cumsum(length) - length
    first = np.searchsorted(row, row)
    within = before - before[first]
    start_row_radius = np.where(follows, tree.radius[tree.parent], tree.radius)
    along = lambda at: start_row_radius[row] + (tree.radius - start_row_radius)[row] * at / np.maximum(row_length[row], 1e-12)  # noqa: E731
    return Twigs(
        row=row,
        start=start,
        end=end,
        start_radius=along(within),
        end_radius=along(within + length),
        tangent=tangent,
        side=transport(side_row[row], tangent_row[row], tangent),
        to_tip=to_tip[row] + row_length[row] - within - length,
        from_foot=from_foot[row] + within,
        foot_radius=foot_radius[row],
        limb_length=(from_foot + row_length + to_tip)[row],
    )


def leafy(pieces: Twigs, order: Int[np.ndarray, " segment"], *, thickest: float, reach: float, share: float) -> Twigs:
    """The pieces that carry leaves: no thicker than `thickest` metres at their end, and ending within
    `reach` metres of the limb's tip or in its outer `share`. A trunk carries them at its very tip only."""
    outer = np.maximum(reach, share * pieces.limb_length)
    outer = np.where(order[pieces.row] == 0, np.minimum(outer, reach), outer)
    return pieces.select((pieces.end_radius <= thickest) & (pieces.to_tip < outer) & (pieces.length > 1e-9))


def transport(
    side: Float[np.ndarray, "row 3"], before: Float[np.ndarray, "row 3"], after: Float[np.ndarray, "row 3"]
) -> Float[np.ndarray, "row 3"]:
    """`side` (⟂ `before`) turned by the smallest rotation that takes unit `before` to unit `after`."""
    cosine = np.einsum("ij,ij->i", before, after)
    gain = np.einsum("ij,ij->i", side, after) / np.maximum(1 + cosine, 1e-9)
    turned = side - np.where(cosine > -1 + 1e-9, gain, 0.0)[:, None] * (before + after)
    return _unit(turned - np.einsum("ij,ij->i", turned, after)[:, None] * after)


def level_side(tangent: Float[np.ndarray, "row 3"]) -> Float[np.ndarray, "row 3"]:
    """A unit vector ⟂ each tangent, level; along x (made ⟂) where the tangent is upright."""
    side = np.cross(tangent, _UP)
    upright = np.linalg.norm(side, axis=1) < 1e-3
    across = np.array([1.0, 0.0, 0.0]) - tangent[:, :1] * tangent
    return _unit(np.where(upright[:, None], across, side))


def _follows(tree: TreeSkeleton) -> Bool[np.ndarray, " segment"]:
    """Rows that continue their parent's limb: same limb id, parent no base, first child to do so."""
    inner = (tree.parent != NULL) & ~tree.is_base[tree.parent]
    same = inner & (tree.limb == tree.limb[tree.parent])
    rows = np.flatnonzero(same)
    first = np.zeros(len(tree), bool)
    first[rows[np.unique(tree.parent[rows], return_index=True)[1]]] = True
    return first


def _cut(tree: TreeSkeleton):
    """Start, end and row of every straight piece, rows in order."""
    rows = np.flatnonzero(~tree.is_base)
    inner = np.diff(tree.curve_start)[rows]
    row = np.repeat(rows, inner + 1)
    rank = np.arange(len(row)) - np.repeat(np.cumsum(inner + 1) - inner - 1, inner + 1)
    points = np.vstack([tree.curve_points, np.zeros((1, 3))])
    at = tree.curve_start[row] + rank
    last = len(points) - 1
    start = np.where((rank == 0)[:, None], tree.start[row], points[np.clip(at - 1, 0, last)])
    end = np.where((rank == np.repeat(inner, inner + 1))[:, None], tree.tip[row], points[np.clip(at, 0, last)])
    return start, end, row


def _places(tree: TreeSkeleton, follows, length):
    """Way from each row's tip to its limb's tip, from the limb's foot to its start, and the radius of the
    wood that the limb stands on."""
    to_tip, from_foot = np.zeros(len(tree)), np.zeros(len(tree))
    on_wood = (tree.parent != NULL) & ~tree.is_base[tree.parent]
    foot_radius = np.where(on_wood, tree.radius[tree.parent], 0.0)
    passes = [rows[follows[rows]] for rows in generations(tree.parent)]
    for rows in passes:
        above = tree.parent[rows]
        from_foot[rows] = from_foot[above] + length[above]
        foot_radius[rows] = foot_radius[above]
    for rows in reversed(passes):
        to_tip[tree.parent[rows]] = to_tip[rows] + length[rows]
    return to_tip, from_foot, foot_radius


def _frames(tree: TreeSkeleton, follows):
    """Tangent and side of every row, carried along each limb."""
    tangent = _unit(tree.vector)
    tangent[np.linalg.norm(tangent, axis=1) < 0.5] = _UP
    side = level_side(tangent)
    for rows in generations(tree.parent):
        rows = rows[follows[rows]]
        above = tree.parent[rows]
        side[rows] = transport(side[above], tangent[above], tangent[rows])
    return tangent, side


def _unit(vector):
    return vector / np.maximum(np.linalg.norm(vector, axis=-1, keepdims=True), 1e-12)
