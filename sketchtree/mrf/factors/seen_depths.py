"""Depths that were seen: points in space, or strokes on a second view, say how deep a drawn branch lies. One model for all evidence; ours.

At places i all along the drawn segments, `_APART` of the height from one another, where z_i lies on the straight line between the segment's ends:

    log P(z_i) = log [ ε + (1 − ε) Σ_k w_k q(z_i − d_k) ] − log ε'        q: one third each of N(0, σ²), N(0, (4σ)²), N(0, (16σ)²)

    d_k   depths where something was seen behind or before place i on the page; w_k their shares, which sum to 1
    ε     chance that what is drawn there was not seen; ε' makes the potential 0 where nothing was seen at all

    points        d_k: their z, of those within `reach` of the place on the page; w_k falls off with the distance there
    second view   turned by ω about the upright axis over the first base: a stroke at height y_i and at x' says z = (x' − x_i cos ω) / sin ω

The wide tails lead a search in; where no point is, the prior says what it always says. A factor for `infer(graph, prior, Elevation(factors={"seen": SeenPoints(points)}), key=key)`.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float, Int
from scipy.ndimage import gaussian_filter1d
from scipy.spatial import cKDTree

from sketchtree.errors import InferenceError
from sketchtree.mrf.factor_graph import FactorGraph

SD, REACH = 0.01, 0.015  # H
UNSEEN = 0.1  # ε, before the depth's range divides it
_WIDTHS = (1.0, 4.0, 16.0)  # σ
_CELLS = 512  # of depth, between the least that was seen and the most
_MOST = 256  # depths a place, the nearest on the page
_BUCKET = 256  # places, or four times, sixteen times … as many
_APART = 0.04  # H, about, from place to place


class SeenDepths(eqx.Module):
    """One factor a place; those near which nothing was seen, or that only fill a bucket, say nothing."""

    row: Int[Array, " place"]  # the segment it lies on
    above: Int[Array, " place"]  # its parent
    share: Float[Array, " place"]  # how far along, 0-1
    table: Float[Array, "place depth"]  # log potential on an even grid of z
    low: Float[Array, ""]  # z of its first column, H
    cell: Float[Array, ""]  # H

    def log_potential(self, assignment, theta) -> Float[Array, " place"]:
        """The table between its columns; as far beyond them as at its ends."""
        start, end = assignment.tip.z[self.above], assignment.tip.z[self.row]
        at = jnp.clip((start + self.share * (end - start) - self.low) / self.cell, 0.0, self.table.shape[1] - 1.000001)
        left = jax.lax.stop_gradient(jnp.floor(at)).astype(int)
        rows = jnp.arange(len(self.row))
        return self.table[rows, left] + (at - left) * (self.table[rows, left + 1] - self.table[rows, left])


@dataclass(frozen=True, eq=False)
class SeenPoints:
    """Points of a scan, or of photos, over which strokes were drawn. Called with the factor graph."""

    points: Float[np.ndarray, "point 3"]  # sketch units from the first base: x and y as on the page (y up), z towards the viewer
    sd: float = SD  # H: how far a point may lie from the axis of the wood
    reach: float = REACH  # H on the page
    needed: bool = True  # an error where they say nothing of any branch; else the prior alone speaks there

    def __call__(self, graph: FactorGraph) -> SeenDepths:
        """The factors of a drawing. Raises InferenceError where no point lies near any branch, and some should."""
        places = _places(graph)
        points = np.asarray(self.points, float) / graph.scale
        tree = cKDTree(points[:, :2])
        near = tree.query(places.xy, k=min(_MOST, len(points)), distance_upper_bound=self.reach)
        distance, index = (np.reshape(column, (len(places.row), -1)) for column in near)
        there = np.isfinite(distance)
        weight = np.where(there, np.exp(-0.5 * (distance / (0.5 * self.reach)) ** 2), 0.0)
        return _factors(places, np.where(there, points[np.minimum(index, len(points) - 1), 2], 0.0), weight, self.sd, "No point of the cloud lies near any drawn branch." if self.needed else None)


@dataclass(frozen=True, eq=False)
class SecondView:
    """Strokes drawn of the same tree as it looks from another side. Called with the factor graph."""

    strokes: Sequence[Float[np.ndarray, "point 2"]]  # sketch units; x from the axis over the first base, y up from it
    degrees: float  # ω: how far the viewer went round, seen from above counter-clockwise; x' = x cos ω − z sin ω
    sd: float = 2 * SD  # H: hands are less sure than scanners

    def __call__(self, graph: FactorGraph) -> SeenDepths:
        """The factors of a drawing. Raises InferenceError for a view that is no other one, and where no stroke is as high as any branch."""
        turn = np.radians(self.degrees)
        if abs(np.sin(turn)) < 0.2:
            raise InferenceError(f"A view turned by {self.degrees:g} degrees tells no depth.", remedy="Turn it by 12 to 168 degrees to either side.")
        places = _places(graph)
        found = [self._across(y, graph.scale) for y in places.xy[:, 1]]
        most = max(map(len, found), default=0)
        weight = np.array([np.r_[np.ones(len(one)), np.zeros(most - len(one))] for one in found]).reshape(len(found), most)
        x = np.array([np.r_[one, np.zeros(most - len(one))] for one in found]).reshape(len(found), most)
        depth = (places.xy[:, :1] * np.cos(turn) - x) / np.sin(turn)
        return _factors(places, depth, weight, self.sd / abs(np.sin(turn)), "No stroke of the second view is as high as any drawn branch.")

    def _across(self, y: float, scale: float) -> Float[np.ndarray, " crossing"]:
        """Where strokes cross a height, H."""
        found = []
        for stroke in self.strokes:
            line = np.asarray(stroke, float) / scale
            a, b = line[:-1], line[1:]
            crosses = (a[:, 1] <= y) != (b[:, 1] <= y)
            share = (y - a[crosses, 1]) / (b[crosses, 1] - a[crosses, 1])
            found.append(a[crosses, 0] + share * (b[crosses, 0] - a[crosses, 0]))
        return np.concatenate(found) if found else np.zeros(0)


@dataclass(frozen=True, eq=False)
class _Places:
    row: Int[np.ndarray, " place"]
    above: Int[np.ndarray, " place"]
    share: Float[np.ndarray, " place"]
    xy: Float[np.ndarray, "place 2"]  # H


def _places(graph: FactorGraph) -> _Places:
    """Places all along the segments, their tips among them."""
    rows = np.flatnonzero(~graph.is_base)
    number = np.maximum(np.round(graph.length[rows] / _APART), 1).astype(int)
    row = np.repeat(rows, number)
    share = (np.arange(len(row)) - np.repeat(np.cumsum(number) - number, number) + 1) / np.repeat(number, number)
    start = graph.xy[graph.parent[row]]
    return _Places(row, graph.parent[row], share, start + share[:, None] * (graph.xy[row] - start))


def _factors(places: _Places, depth, weight, sd: float, nothing: str | None) -> SeenDepths:
    """The tables of places at which something was seen. `nothing`: what is wrong where there is none; None: nothing is."""
    total = weight.sum(axis=1)
    told = total > 1e-9
    if not told.any() and nothing is None:
        return _silent(places)
    if not told.any():
        raise InferenceError(nothing, remedy="Check that both have the same foot and scale, and that the points' z runs towards the viewer.")
    share = weight[told] / total[told, None]
    seen = depth[told]
    margin = 3 * _WIDTHS[-1] * sd
    low, high = seen[share > 0].min() - margin, seen[share > 0].max() + margin
    cell = (high - low) / (_CELLS - 1)
    held = np.zeros((told.sum(), _CELLS))
    np.add.at(held, (np.arange(len(seen))[:, None], np.round((seen - low) / cell).clip(0, _CELLS - 1).astype(int)), share)
    density = sum(gaussian_filter1d(held, width * sd / cell, axis=1, mode="constant") for width in _WIDTHS) / (len(_WIDTHS) * cell)
    floor = UNSEEN / (high - low)
    table = np.log(floor + (1 - UNSEEN) * density) - np.log(floor)
    size = _size(int(told.sum()))
    whole = np.zeros((size, _CELLS))
    whole[np.flatnonzero(told)] = table
    row, above, along = (np.pad(column, (0, size - len(told))) for column in (places.row, places.above, places.share))
    return SeenDepths(jnp.asarray(row), jnp.asarray(above), jnp.asarray(along, jnp.float32), jnp.asarray(whole, jnp.float32), jnp.float32(low), jnp.float32(cell))


def _silent(places: _Places) -> SeenDepths:
    """Factors that say nothing, as many as the least drawing has."""
    rows, none = jnp.full(_BUCKET, places.row[0]), jnp.zeros(_BUCKET, jnp.float32)
    return SeenDepths(rows, jnp.full(_BUCKET, places.above[0]), none, jnp.zeros((_BUCKET, _CELLS), jnp.float32), jnp.float32(0.0), jnp.float32(1.0))


def _size(count: int) -> int:
    """So many places or more: few sizes, so that other points, or other strokes, need no new program."""
    return _BUCKET * 4 ** max(int(np.ceil(np.log2(count / _BUCKET) / 2)), 0)
