"""Where every path meets: one table of branch segments.

A source (a sketch, a photo, a cloud, a file) makes a `TreeSkeleton`; a stage takes one and returns
one; a sink reads one. One row is one branch segment, from its parent's tip to its own.
"""

import dataclasses
from dataclasses import dataclass
from enum import IntEnum

import numpy as np
from jaxtyping import Float, Int

from sketchtree.axes import NULL
from sketchtree.errors import SkeletonError


class Kind(IntEnum):
    """Where a segment comes from."""

    DRAWN = 0
    PROPAGATED = 1
    GROWN = 2
    OBSERVED = 3
    ROOT = 4  # drawn, below the ground


@dataclass(frozen=True, eq=False)
class TreeSkeleton:
    """A branching structure: one row per branch segment, parents before children.

    Requirements, checked at construction:
      - every parent precedes its children; a row whose parent is NULL is a *base*: a point on the
        ground of zero length (one a stem, several allowed);
      - positions and curve points are finite, radii finite and positive;
      - `order` is 0 or more; `kind` is one of `Kind`;
      - `curve_start` has one entry more than there are rows, starts at 0, never falls and ends at
        the number of curve points.

    A *segment* in reports and limits is a row that is not a base. Columns are read-only.
    """

    parent: Int[np.ndarray, " segment"]  # row of the parent; NULL at a base
    tip: Float[np.ndarray, "segment 3"]  # end point, metres, y up, z towards the viewer
    radius: Float[np.ndarray, " segment"]  # at the tip, metres
    order: Int[np.ndarray, " segment"]  # 0 on a trunk, +1 at each lateral branching
    limb: Int[np.ndarray, " segment"]  # id (63 bits) of the apical chain the row belongs to
    stroke: Int[np.ndarray, " segment"]  # stroke that drew it; NULL if none did
    tree: Int[np.ndarray, " segment"]  # which tree of a sketch with several
    kind: Int[np.ndarray, " segment"]  # a `Kind`
    depth_sd: Float[np.ndarray, " segment"]  # posterior sd of the tip's z, metres; NaN unknown
    age: Float[np.ndarray, " segment"]  # growth age; NaN unknown
    curve_points: Float[np.ndarray, "point 3"]  # drawn points strictly between parent's tip and tip
    curve_start: Int[np.ndarray, " segment+1"]  # row i owns curve_points[curve_start[i]:curve_start[i + 1]]

    def __post_init__(self):
        for field in dataclasses.fields(self):
            column = np.array(getattr(self, field.name), _DTYPE[field.name])
            column.flags.writeable = False
            object.__setattr__(self, field.name, column)
        _check(self)

    @classmethod
    def from_columns(cls, parent, tip, radius, **columns) -> "TreeSkeleton":
        """A skeleton from its three needed columns; any other column may be given by name.

        Defaults: order, limb and tree 0; stroke NULL; kind
        PROPAGATED; depth_sd and age NaN; no curve points.
        """
        n = len(parent)
        full = {
            "order": np.zeros(n, int),
            "limb": np.zeros(n, int),
            "stroke": np.full(n, NULL),
            "tree": np.zeros(n, int),
            "kind": np.full(n, int(Kind.PROPAGATED)),
            "depth_sd": np.full(n, np.nan),
            "age": np.full(n, np.nan),
            "curve_points": np.zeros((0, 3)),
            "curve_start": np.zeros(n + 1, int),
        } | columns
        return cls(parent=parent, tip=tip, radius=radius, **full)

    def __len__(self) -> int:
        return len(self.parent)

    @property
    def node_id(self) -> Int[np.ndarray, " segment"]:
        """The number of every row's tip, from 1, when the drawn points between tips are numbered too, each row's just
        before its tip: the ids of an SWC file."""
        return np.cumsum(np.diff(self.curve_start) + 1)

    @property
    def is_base(self):
        """Bool[segment]: rows that are points on the ground."""
        return self.parent == NULL

    @property
    def start(self):
        """Float[segment 3]: where each segment starts, metres (a base starts at itself)."""
        return np.where(self.is_base[:, None], self.tip, self.tip[self.parent])

    @property
    def vector(self):
        """Float[segment 3]: from start to tip, metres."""
        return self.tip - self.start

    @property
    def length(self):
        """Float[segment]: straight length, metres; 0 at a base."""
        return np.linalg.norm(self.vector, axis=1)

    @property
    def segment_count(self) -> int:
        """How many rows are segments, bases left out."""
        return int(np.sum(~self.is_base))

    @property
    def height(self) -> float:
        """Height of the highest tip above the lowest base, metres."""
        if len(self) == 0:
            return 0.0
        return float(self.tip[:, 1].max() - self.tip[self.is_base, 1].min())

    def curve(self, row: int) -> Float[np.ndarray, "point 3"]:
        """The whole polyline of one segment: its start, the drawn points between, its tip."""
        inner = self.curve_points[self.curve_start[row] : self.curve_start[row + 1]]
        start = self.tip[row if self.parent[row] == NULL else self.parent[row]]
        return np.concatenate([start[None], inner, self.tip[row][None]])

    def replace(self, **columns) -> "TreeSkeleton":
        """The same skeleton with some columns exchanged; checked anew."""
        return dataclasses.replace(self, **columns)

    def append(self, other_rows: dict) -> "TreeSkeleton":
        """More rows after the present ones. `other_rows` holds parent, tip, radius and any other
        column; its `parent` numbers rows of the result. The appended rows have no curve points."""
        extra = len(other_rows["parent"])
        filler = TreeSkeleton.from_columns(np.full(extra, NULL), np.zeros((extra, 3)), np.ones(extra))
        merged = {}
        for name in _ROW_COLUMNS:
            rows = other_rows.get(name, getattr(filler, name))
            merged[name] = np.concatenate([getattr(self, name), rows])
        tail = np.full(extra, len(self.curve_points))
        return self.replace(**merged, curve_start=np.concatenate([self.curve_start, tail]))

    def select(self, keep) -> "TreeSkeleton":
        """Only the rows where `keep` (Bool[segment]) is true. A kept row's parent must be kept."""
        rows = np.flatnonzero(keep)
        renumber = np.full(len(self) + 1, NULL)
        renumber[rows] = np.arange(len(rows))
        orphan = rows[(self.parent[rows] != NULL) & ~np.asarray(keep)[self.parent[rows]]]
        if len(orphan):
            raise SkeletonError(
                "it is kept but its parent is not.",
                row=int(orphan[0]),
                remedy="Keep every ancestor of a kept row.",
            )
        count = np.diff(self.curve_start)
        kept = np.zeros(len(self), bool)
        kept[rows] = True
        points, count = self.curve_points[np.repeat(kept, count)], count[rows]
        columns = {name: getattr(self, name)[rows] for name in _ROW_COLUMNS}
        columns["parent"] = renumber[columns["parent"]]
        return self.replace(**columns, curve_points=points, curve_start=np.r_[0, np.cumsum(count)])


_DTYPE = {
    "parent": np.int64,
    "tip": np.float64,
    "radius": np.float64,
    "order": np.int64,
    "limb": np.int64,
    "stroke": np.int64,
    "tree": np.int64,
    "kind": np.int8,
    "depth_sd": np.float64,
    "age": np.float64,
    "curve_points": np.float64,
    "curve_start": np.int64,
}
_ROW_COLUMNS = tuple(name for name in _DTYPE if not name.startswith("curve_"))


def _check(tree: TreeSkeleton) -> None:
    n = len(tree.parent)
    for name in _ROW_COLUMNS:
        column = getattr(tree, name)
        if column.shape != ((n, 3) if name == "tip" else (n,)):
            raise SkeletonError(
                f"Column `{name}` has shape {column.shape}, but there are {n} rows.",
                remedy="Give every column one entry per row.",
            )
    _refuse(
        (tree.parent >= np.arange(n)) | (tree.parent < NULL),
        "its parent does not stand before it.",
        "Sort the rows so that every parent precedes its children.",
    )
    _refuse(~np.isfinite(tree.tip).all(axis=1), "its tip is not finite.", "Drop or repair the row.")
    _refuse(
        ~(np.isfinite(tree.radius) & (tree.radius > 0)),
        "its radius is not a positive number.",
        "Give every row a radius above zero, in metres.",
    )
    _refuse(tree.order < 0, "its order is negative.", "Number the trunk 0 and each lateral one more.")
    _refuse(~np.isin(tree.kind, [int(kind) for kind in Kind]), "its kind is unknown.", "Use a value of `Kind`.")
    start = tree.curve_start
    if start.shape != (n + 1,) or start[0] != 0 or (np.diff(start) < 0).any() or start[-1] != len(tree.curve_points):
        raise SkeletonError(
            "`curve_start` does not cut `curve_points` into one piece per row.",
            remedy="Start at 0, never fall, and end at the number of points.",
        )
    if not np.isfinite(tree.curve_points).all():
        raise SkeletonError("A curve point is not finite.", remedy="Drop or repair the curve.")


def _refuse(bad, message: str, remedy: str) -> None:
    if bad.any():
        raise SkeletonError(message, row=int(np.flatnonzero(bad)[0]), remedy=remedy)
