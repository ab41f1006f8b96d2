"""What does the tree look like at any time of its life?

A plan is made once of any skeleton; `at(t)` is the tree at a time t, `poses(times)` the places of all segments at many times. Three ways
to grow (single-image growth, Figure 9):

    age     segments appear by age (Eq. 5), the growing ones lengthen, all thicken as they come to bear
    full    the same, each further branching order later, and the whole as large as M (Eq. 5): a young tree is a small tree. Its clock
            runs with √t, so that its height grows about evenly
    scale   the final tree, as large as M

At time 0 there is nothing but the points on the ground; at 1 the tree is the one that was given, to the last bit if it isn't bent. In
between segments never vanish, and lengths and radii never shrink.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int

from sketchtree.errors import OptionError
from sketchtree.growth import bending
from sketchtree.growth.age import BUD_REST, THICKNESS_WEIGHT, WHOLE, Timeline, timeline
from sketchtree.growth.layers import Layers
from sketchtree.growth.leafing import unfolded
from sketchtree.growth.straight import Straight
from sketchtree.growth.thickness import borne_share, radii
from sketchtree.skeleton import TreeSkeleton

MODES = ("age", "full", "scale")
_AT_ONCE = 800_000  # places that are worked out together


@dataclass(frozen=True, eq=False)
class Poses:
    """Where all segments of a tree are at many times. One that has not begun lies, without length, at the tip of what it will grow from."""

    time: Float[np.ndarray, " time"]
    tip: Float[np.ndarray, "time segment 3"]  # metres
    radius: Float[np.ndarray, "time segment"]  # at the tip, metres
    grown: Float[np.ndarray, "time segment"]  # share of its length, 0-1
    size: Float[np.ndarray, " time"]  # M; 1 where the whole does not grow
    parent: Int[np.ndarray, " segment"]

    @property
    def base(self) -> Float[np.ndarray, "time segment 3"]:
        """Where each segment starts, metres."""
        return self.tip[:, np.where(self.parent < 0, np.arange(len(self.parent)), self.parent)]

    @property
    def count(self) -> Int[np.ndarray, " time"]:
        """How many segments have begun."""
        return np.sum((self.grown > 0) & (self.parent >= 0), axis=1)

    @property
    def length(self) -> Float[np.ndarray, " time"]:
        """Straight length of all segments together, metres."""
        return np.linalg.norm(self.tip - self.base, axis=2).sum(axis=1)


@dataclass(frozen=True, eq=False)
class GrowthPlan:
    """When each part of a tree grows, and how."""

    tree: TreeSkeleton
    mode: str
    bend: float  # δ, degrees; above 0 branches rise, below 0 they hang
    straight: Straight
    times: Timeline  # of the straight pieces, on the growth's own clock
    layers: Layers
    yields: Float[np.ndarray, " piece"]  # share of δ that each piece takes

    @classmethod
    def of(cls, tree: TreeSkeleton, *, mode: str = "full", bend: float = 0.0, thickness_weight: float = THICKNESS_WEIGHT) -> "GrowthPlan":
        """The plan of a tree. Raises `OptionError` for an unknown mode, or a bend or weight out of range."""
        if mode not in MODES:
            raise OptionError(f"There is no mode of growth called {mode!r}.", remedy=f"Choose one of: {', '.join(MODES)}.")
        if not bending.LEAST <= bend <= bending.MOST:
            raise OptionError(
                f"bend is {bend:g}, but must lie between {bending.LEAST:g} and {bending.MOST:g} degrees.",
                remedy="Above 0 branches rise, below 0 they hang; the paper's pictures go from -25 to 20.",
            )
        if not 0 <= thickness_weight <= 1:
            raise OptionError(f"thickness_weight is {thickness_weight:g}, but must lie between 0 and 1.", remedy="The paper's is 0.001.")
        straight = Straight.of(tree)
        pieces = straight.pieces
        times = timeline(pieces, thickness_weight, BUD_REST if mode == "full" else 0.0)
        return cls(tree, mode, float(bend), straight, times, Layers.of(pieces.parent), bending.yielding(pieces))

    @property
    def birth(self) -> Float[np.ndarray, " segment"]:
        """When each segment begins, 0 ≤ b < 1; 0 at a base. In mode `scale` all begin at 0."""
        first = self.straight.last - np.diff(self.tree.curve_start)
        return self._time_of(self.times.begin[first])

    @property
    def end(self) -> Float[np.ndarray, " segment"]:
        """When each segment has its length, but for the growth of the whole."""
        return self._time_of(self.times.end[self.straight.last])

    def at(self, time: float) -> TreeSkeleton:
        """The tree at a time, 0-1: those rows that have begun, in order."""
        return self.with_rows_at(time)[0]

    def with_rows_at(self, time: float) -> tuple[TreeSkeleton, Int[np.ndarray, " kept"]]:
        """The same, and which rows of the final tree its rows are."""
        clock = checked_times([time])
        tip, radius, grown, _ = self._pieces(clock, np.float64)
        if grown.min(initial=1.0) >= 1 and self.bend == 0 and clock[0] == 1:
            return self.tree, np.arange(len(self.tree))
        return self.straight.back(tip[0], radius[0], grown[0]), self._begun(grown[0])

    def rows_at(self, time: float) -> Int[np.ndarray, " kept"]:
        """Which rows of the tree those of `at(time)` are."""
        return self._begun(self._grown(checked_times([time]))[:, 0])

    def _begun(self, grown):
        """The rows of which something has grown, by the shares of all pieces."""
        first = self.straight.last - np.diff(self.tree.curve_start)
        return np.flatnonzero((grown[first] > 0) | self.tree.is_base)

    def poses(self, times, *, pieces: bool = False, whole: bool = True, dtype=np.float32) -> Poses:
        """All segments at all times (each 0-1). `pieces`: those of `straight.pieces`, every drawn point a row of its own, instead of the tree's rows.
        Not `whole`: as they are before the whole is made as large as `size`."""
        times = checked_times(times)
        rows = np.arange(len(self.straight.row)) if pieces else self.straight.last
        parent = self.straight.pieces.parent if pieces else self.tree.parent
        tip, radius, grown = (np.empty((len(times), len(rows), *tail), dtype) for tail in ((3,), (), ()))
        size = np.empty(len(times))
        step = max(1, _AT_ONCE // max(len(self.straight.row), 1))
        for low in range(0, len(times), step):
            now = slice(low, low + step)
            places, thick, share, size[now] = self._pieces(times[now], dtype, whole)
            if not pieces and len(rows) < len(self.straight.row):
                places, thick, share = places[:, rows], thick[:, rows], self._of_rows(share)
            tip[now], radius[now], grown[now] = places, thick, share
        return Poses(times, tip, radius, grown, size, parent)

    def size_at(self, time: float) -> float:
        """M: how large the whole is at a time; 1 where it does not grow."""
        return 1.0 if self.mode == "age" else float(self.times.size(self._clock(checked_times([time])))[0])

    def leaf_scale(self, time: float, *, falling: bool = False) -> Float[np.ndarray, " segment"]:
        """How large the leaves on each row are at a time, 0-1: all at 1 in the end. `falling`: those of old inner wood are shed as it ages, as
        where leaves were put on all wood that once bore some."""
        return unfolded(float(checked_times([time])[0]), self.end, falling=falling)

    def _grown(self, times):
        return np.where(times > 0, np.ones((len(self.straight.row), 1)), 0.0) if self.mode == "scale" else self.times.grown(self._clock(times))

    def _pieces(self, times, dtype, whole=True):
        """(tip (time, piece, 3), radius (time, piece), grown (time, piece), size (time)) of the straight pieces."""
        pieces, layers, order = self.straight.pieces, self.layers, self.layers.order
        grown = self._grown(times).astype(dtype, copy=False)[order]
        share = grown if self.mode == "scale" else borne_share(layers, pieces.length[order].astype(dtype), grown)
        final = pieces.radius[order].astype(dtype)
        radius = np.repeat(final[:, None], len(times), 1) if self.mode == "scale" else radii(layers, final, share)
        size = np.ones(len(times)) if self.mode == "age" else self.times.size(self._clock(times))
        tip = self._tips(grown, share, dtype)
        base = self._ground()[order].astype(dtype)
        size = size.astype(dtype)
        if self.mode != "age" and whole:
            small = size < 1
            tip[:, :, small] = base.T[:, :, None] + size[small] * (tip[:, :, small] - base.T[:, :, None])
            radius = radius * np.where(size > 0, size, 1e-6)
        back = layers.place
        return tip[:, back].transpose(2, 1, 0), radius[back].T, grown[back].T, size

    def _tips(self, grown, share, dtype):
        """The tips of all pieces at their places, before the whole is scaled."""
        pieces, layers, order = self.straight.pieces, self.layers, self.layers.order
        base, vector, final = (of_all.astype(dtype) for of_all in (pieces.tip[order[: layers.ground]], pieces.vector[order], pieces.tip[order]))
        if self.bend != 0:
            turn = (np.radians(self.bend) * self.yields[order]).astype(dtype)[:, None] * share
            return bending.bent(layers, base, vector, grown, turn)
        tip = np.empty((3, *grown.shape), dtype)
        tip[:, : len(base)] = base.T[:, :, None]
        for layer in layers.downwards():
            reached = tip[:, layers.parent[layer]] + grown[layer] * vector[layer].T[:, :, None]
            tip[:, layer] = np.where(grown[layer] >= 1, final[layer].T[:, :, None], reached)
        return tip

    def _ground(self):
        """The base that each piece stands on."""
        pieces, layers = self.straight.pieces, self.layers
        ground = pieces.tip[layers.order]
        for layer in layers.downwards():
            ground[layer] = ground[layers.parent[layer]]
        return ground[layers.place]

    def _of_rows(self, share):
        """The share of each row's whole way that has grown, from those of its pieces."""
        if len(self.straight.row) == len(self.tree):
            return share
        length = self.straight.pieces.length
        count = np.diff(self.tree.curve_start) + 1
        first = self.straight.last - count + 1
        whole = np.add.reduceat(length, first)
        even = np.add.reduceat(share, first, axis=1) / count
        return np.where(whole > 0, np.add.reduceat(share * length, first, axis=1) / np.where(whole > 0, whole, 1.0), even)

    def _clock(self, times):
        """The growth's own clock at these times."""
        now = np.minimum(times, WHOLE)
        return np.sqrt(now * WHOLE) if self.mode == "full" else now

    def _time_of(self, clock):
        return np.zeros_like(clock) if self.mode == "scale" else clock**2 / WHOLE if self.mode == "full" else clock


def checked_times(times) -> Float[np.ndarray, " time"]:
    """The times as numbers. Raises OptionError where one is not from 0 to 1."""
    times = np.asarray(times, float)
    if times.ndim != 1 or not ((times >= 0) & (times <= 1)).all():
        raise OptionError("A time of growth is not a number from 0 to 1.", remedy="0 is before the seed, 1 the tree that was given.")
    return times
