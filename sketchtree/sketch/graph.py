"""The rooted segment tree that the strokes make: what inference works on.

One row per segment, parents first, as in `TreeSkeleton`, but flat: depths are what is to be found.
A *limb* is one chain of segments that a person would call one branch: usually one stroke, or
several that were drawn end to end.
"""

import dataclasses
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from jaxtyping import Bool, Float, Int

from sketchtree.axes import NULL

DOUBT = 1.0  # an attachment whose next best parent costs less than this more might be another


@dataclass(frozen=True)
class Attachment:
    """How one stroke came to hang where it hangs; one line of the report."""

    stroke: str  # id of the stroke
    parent: str | None  # id of the stroke it grows from; None for a stem that stands on the ground
    point: tuple[float, float]  # the junction, sketch units, y up
    gap: float  # how far its end was moved, sketch units
    cost: float  # attachment cost, lower is surer
    alternatives: tuple[tuple[str, float], ...]  # (stroke id, cost) of the next best parents
    reason: str  # what decided, in words

    @property
    def doubtful(self) -> bool:
        """Whether the next best parent costs less than DOUBT more."""
        return any(cost - self.cost < DOUBT for _, cost in self.alternatives)


@dataclass(frozen=True)
class Role:
    """What a stroke was taken for that is no branch; one line of the report."""

    stroke: str  # id of the stroke
    role: str  # crown | obstacle | ground | shadow | leaves | hatching | speckle | paper | dot
    reason: str  # what decided, in words
    alternatives: tuple[tuple[str, float], ...] = ()  # (role or "branch", cost) of what else it may be


@dataclass(frozen=True)
class Cut:
    """Where the page's edge cuts the tree."""

    stroke: str  # id of the stroke
    point: tuple[float, float]  # where it leaves the page, sketch units, y up
    edge: str  # left | right | top | bottom


@dataclass(frozen=True, eq=False)
class SketchGraph:
    """One or several rooted trees of drawn segments. Sketch units, y up.

    Requirements, checked at construction: parents precede children; a base (parent NULL) is a point
    on the ground; positions are finite; the rows of a limb are a chain; rows of drawn roots come last.
    """

    parent: Int[np.ndarray, " segment"]  # row; NULL at a base
    xy: Float[np.ndarray, "segment 2"]  # tip
    limb: Int[np.ndarray, " segment"]  # 0 … limb_count − 1; a base belongs to its trunk's limb
    stroke: Int[np.ndarray, " segment"]  # row of the stroke in the sketch
    tree: Int[np.ndarray, " segment"]
    width: Float[np.ndarray, " segment"]  # line width at the tip, sketch units; NaN where it says nothing
    joined: Bool[np.ndarray, " segment"]  # continues its limb only because the reader joined two strokes there
    curve_points: Float[np.ndarray, "point 2"]  # drawn points strictly between parent's tip and tip
    curve_start: Int[np.ndarray, " segment+1"]
    limb_id: Int[np.ndarray, " limb"]  # stable 63-bit id, from the first stroke's id
    stroke_ids: tuple[str, ...]  # id of every stroke of the sketch
    width_is_wood: bool = False  # the widths are those of painted limbs or of a trunk's two edges, not a pen's
    crown: tuple[np.ndarray, ...] = ()  # closed outlines (point 2), first point not repeated
    obstacles: tuple[np.ndarray, ...] = ()
    attachments: tuple[Attachment, ...] = ()
    roles: tuple[Role, ...] = ()  # strokes that are no branch, or only in part
    root: Bool[np.ndarray, " segment"] | None = None  # rows of drawn roots, below the ground; made all False if None
    ground: tuple[np.ndarray, ...] = ()  # drawn ground lines (point 2)
    cuts: tuple[Cut, ...] = ()  # where the page's edge cuts the tree
    warnings: tuple[str, ...] = ()

    def __post_init__(self):
        if self.root is None:
            object.__setattr__(self, "root", np.zeros(len(self.parent), bool))
        for name, dtype in _DTYPE.items():
            column = np.array(getattr(self, name), dtype)
            column.flags.writeable = False
            object.__setattr__(self, name, column)
        n = len(self.parent)
        assert all(len(getattr(self, name)) == n for name in _ROW_COLUMNS), "every column has one entry a row"
        assert n == 0 or (self.limb.min() >= 0 and self.limb.max() < len(self.limb_id)), "every limb has an id"
        assert (self.parent < np.arange(n)).all(), "parents must precede children"
        assert np.isfinite(self.xy).all() and self.xy.shape == (n, 2)
        assert not (self.root[:-1] & ~self.root[1:]).any(), "roots stand after all other rows"
        assert self.curve_start.shape == (n + 1,) and self.curve_start[-1] == len(self.curve_points)

    def __len__(self) -> int:
        return len(self.parent)

    def replace(self, **columns) -> "SketchGraph":
        """The same graph with some columns exchanged; checked anew."""
        return dataclasses.replace(self, **columns)

    def above_ground(self) -> "SketchGraph":
        """The same graph without the rows and limbs of drawn roots; all other rows keep their numbers."""
        if not self.root.any():
            return self
        count = int(np.sum(~self.root))
        limbs, limb = np.unique(self.limb[:count], return_inverse=True)
        rows = {name: getattr(self, name)[:count] for name in _ROW_COLUMNS}
        points = int(self.curve_start[count])
        return self.replace(
            **(rows | {"limb": limb.reshape(-1)}),
            limb_id=self.limb_id[limbs],
            curve_points=self.curve_points[:points],
            curve_start=self.curve_start[: count + 1],
        )

    @cached_property
    def is_base(self) -> Bool[np.ndarray, " segment"]:
        """Rows that are points on the ground."""
        return self.parent == NULL

    @cached_property
    def start(self) -> Float[np.ndarray, "segment 2"]:
        """Where each segment starts."""
        return np.where(self.is_base[:, None], self.xy, self.xy[self.parent])

    @property
    def segment_count(self) -> int:
        """How many rows are segments, bases left out."""
        return int(np.sum(~self.is_base))

    @cached_property
    def limb_first(self) -> Int[np.ndarray, " limb"]:
        """The first segment of every limb (never a base)."""
        first = np.full(len(self.limb_id), NULL)
        rows = np.flatnonzero(~self.is_base)[::-1]
        first[self.limb[rows]] = rows
        return first

    @cached_property
    def limb_tip(self) -> Int[np.ndarray, " limb"]:
        """The last segment of every limb."""
        tip = np.full(len(self.limb_id), NULL)
        rows = np.flatnonzero(~self.is_base)
        tip[self.limb[rows]] = rows
        return tip

    @cached_property
    def limb_parent(self) -> Int[np.ndarray, " limb"]:
        """The limb that every limb grows from; NULL for a trunk."""
        at = self.parent[self.limb_first]
        return np.where(self.is_base[at] & (self.limb[at] == np.arange(len(at))), NULL, self.limb[at])

    @cached_property
    def limb_order(self) -> Int[np.ndarray, " limb"]:
        """Branching order of every limb, 0 for a trunk."""
        order = np.zeros(len(self.limb_id), np.int64)
        for limb in np.argsort(self.limb_first):
            if self.limb_parent[limb] != NULL:
                order[limb] = order[self.limb_parent[limb]] + 1
        return order

    @cached_property
    def order(self) -> Int[np.ndarray, " segment"]:
        """Branching order of every segment."""
        return self.limb_order[self.limb]

    @cached_property
    def height(self) -> float:
        """H: the drawn branches' height, or their width where that is larger, roots left out; sketch units."""
        count = int(np.sum(~self.root))
        points = np.concatenate([self.xy[:count], self.curve_points[: self.curve_start[count]]])
        return float(np.ptp(points, axis=0).max())

    def curve(self, row: int) -> Float[np.ndarray, "point 2"]:
        """The whole drawn polyline of one segment: start, points between, tip."""
        inner = self.curve_points[self.curve_start[row] : self.curve_start[row + 1]]
        return np.concatenate([self.start[row][None], inner, self.xy[row][None]])


_DTYPE = {
    "parent": np.int64,
    "xy": np.float64,
    "limb": np.int64,
    "stroke": np.int64,
    "tree": np.int64,
    "width": np.float64,
    "joined": np.bool_,
    "root": np.bool_,
    "curve_points": np.float64,
    "curve_start": np.int64,
    "limb_id": np.int64,
}
_ROW_COLUMNS = ("parent", "xy", "limb", "stroke", "tree", "width", "joined", "root")
