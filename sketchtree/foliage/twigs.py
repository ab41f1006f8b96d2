"""Which stretches of wood carry leaves, and which way do they look?

Leaves grow on the young, thin, outer wood: where the radius is at most `thickest` and the way along the
limb to its tip at most `reach`. The wood is cut into straight *pieces* of the centre lines that are rendered,
so that no leaf floats beside its twig.

Frames are carried along each limb by the smallest rotation from one tangent to the next (parallel
transport, so leaves do not spin about a bending twig):

    R u = u − (u·t')/(1 + t·t') (t + t')        u ⟂ t, the tangent before; t' the one after
"""

from dataclasses import dataclass, replace

import numpy as np
from jaxtyping import Bool, Float, Int
from scipy.spatial import cKDTree

from sketchtree.axes import NULL
from sketchtree.geometry.chains import chains
from sketchtree.geometry.limbs import CentreLines, centre_lines
from sketchtree.skeleton import TreeSkeleton
from sketchtree.traverse import generations, sum_to_root
from sketchtree.watch import Pulse, no_pulse

_UP = np.array([0.0, 1.0, 0.0])
THICKEST = 8.0  # leafy wood has at most this many twig radii
_SLIM = 1.5  # of the thickest frond's radius: a thicker end of a palm's trunk is no frond


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


def wood_pieces(tree: TreeSkeleton, pulse: Pulse = no_pulse) -> Twigs:
    """All wood of the tree as straight pieces of its rendered centre lines, with their frames and their
    place on their limb; the pieces of a limb stand in order."""
    lines = centre_lines(tree) if tree.segment_count else None
    if lines is None or len(lines) == 0:
        return _no_wood()
    pulse()
    first = np.flatnonzero(np.diff(lines.of_point) == 0)
    row = _row_of_point(tree, lines, pulse)[first + 1]
    first, row = first[row != NULL], row[row != NULL]
    limb = lines.of_point[first]
    span = lines.point[first + 1] - lines.point[first]
    pulse()
    tangent_row, side_row = _frames(tree)
    pulse()
    tangent = _unit(span)
    stands = lines.parent != NULL
    foot_radius = np.zeros(len(lines))
    foot_radius[stands] = lines.at(lines.parent[stands], lines.parent_s[stands])[1]
    return Twigs(
        row=row,
        start=lines.point[first],
        end=lines.point[first + 1],
        start_radius=lines.radius[first],
        end_radius=lines.radius[first + 1],
        tangent=tangent,
        side=transport(side_row[row], tangent_row[row], tangent),
        to_tip=lines.length[limb] - lines.s[first + 1],
        from_foot=lines.s[first],
        foot_radius=foot_radius[limb],
        limb_length=lines.length[limb],
    )


def _no_wood() -> Twigs:
    vectors, numbers = np.zeros((0, 3)), np.zeros(0)
    return Twigs(np.zeros(0, np.int64), vectors, vectors, numbers, numbers, vectors, vectors, numbers, numbers, numbers, numbers)


def leafy(pieces: Twigs, order: Int[np.ndarray, " segment"], *, thickest: float, reach: float, share: float) -> Twigs:
    """The pieces that carry leaves: no thicker than `thickest` metres at their end, and ending within
    `reach` metres of the limb's tip or in its outer `share`. A trunk carries them at its very tip only."""
    outer = np.maximum(reach, share * pieces.limb_length)
    outer = np.where(order[pieces.row] == 0, np.minimum(outer, reach), outer)
    return pieces.select((pieces.end_radius <= thickest) & (pieces.to_tip < outer) & (pieces.length > 1e-9))


def fronds(pieces: Twigs, tree: TreeSkeleton) -> Twigs:
    """The pieces of a palm that bear leaflets: its limbs, and of a trunk what goes on beyond its last frond, which is
    a frond drawn in one stroke with the trunk. That one's foot is where it leaves the last frond."""
    limbs = sum_to_root(tree.parent, (tree.order > 0).astype(float))
    beyond = (tree.order == 0) & (limbs == 0) & (_of_tree(tree, limbs) > 0)
    slim = _SLIM * tree.radius[tree.order > 0].max(initial=0.0)
    bears = (tree.order > 0)[pieces.row] | (beyond[pieces.row] & (pieces.start_radius <= slim))
    found = pieces.select(bears & (pieces.length > 1e-9))
    on_trunk = tree.order[found.row] == 0
    _, limb = np.unique(tree.limb[found.row], return_inverse=True)
    foot = np.full(limb.max(initial=-1) + 1, np.inf)
    np.minimum.at(foot, limb.ravel(), found.from_foot)
    foot = np.where(on_trunk, foot[limb.ravel()], 0.0)
    return replace(found, from_foot=found.from_foot - foot, limb_length=found.limb_length - foot)


def _of_tree(tree: TreeSkeleton, value) -> Float[np.ndarray, " segment"]:
    """The greatest value among the rows of each row's tree."""
    _, name = np.unique(tree.tree, return_inverse=True)
    most = np.full(name.max(initial=-1) + 1, -np.inf)
    np.maximum.at(most, name.ravel(), value)
    return most[name.ravel()]


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


def _row_of_point(tree: TreeSkeleton, lines: CentreLines, pulse: Pulse) -> Int[np.ndarray, " point"]:
    """The row whose wood ends at or after each point of the centre lines: a row's tip is a point of its limb's
    line, never the first one."""
    apart = 10.0 * (1.0 + np.abs(lines.point).max())
    of_point = lines.of_point
    inner = np.setdiff1d(np.arange(len(of_point)), lines.start[:-1])
    place = np.column_stack([lines.point, apart * lines.first_row[of_point]])
    rows = np.flatnonzero(~tree.is_base)
    cut = chains(tree)  # one line may hold limbs that were drawn end to end
    tips = np.column_stack([tree.tip[rows], apart * cut.row[cut.start[cut.of_row[rows]]]])
    pulse()
    known = cKDTree(place[inner])
    pulse()
    gap, near = known.query(tips)
    found = gap < 1e-6 * apart
    row = np.full(len(of_point), NULL)
    row[inner[near[found]]] = rows[found]
    after = np.minimum.accumulate(np.where(row != NULL, np.arange(len(row)), len(row))[::-1])[::-1]
    held = np.append(row, NULL)[after]
    ends = np.append(of_point, NULL)[after]
    return np.where(ends == of_point, held, NULL)


def _frames(tree: TreeSkeleton):
    """Tangent and side of every row, carried along each limb."""
    tangent = _unit(tree.vector)
    tangent[np.linalg.norm(tangent, axis=1) < 0.5] = _UP
    side = level_side(tangent)
    follows = _follows(tree)
    for rows in generations(tree.parent):
        rows = rows[follows[rows]]
        above = tree.parent[rows]
        side[rows] = transport(side[above], tangent[above], tangent[rows])
    return tangent, side


def _unit(vector):
    return vector / np.maximum(np.linalg.norm(vector, axis=-1, keepdims=True), 1e-12)
