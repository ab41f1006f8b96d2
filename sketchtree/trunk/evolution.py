"""Which vertices of the contour tell its shape? Discrete curve evolution: the one that matters least goes, again and again.

§II.2 and Algorithm 1, after Latecki & Lakämper 1999: two consecutive segments s₁, s₂ become one when their relevance is the least,

    R(s₁, s₂) = β(s₁, s₂) l(s₁) l(s₂) / (l(s₁) + l(s₂))

    β    turn angle at their common vertex, 0 … π
    l    length over the whole contour's

until m vertices of the first ring are left (holes evolve along with it), or until the least relevance exceeds a noise level. Lengths are kept in pixels while it runs, and divided once at the end: the order is the same. A bump of height h
has R ≈ h pixels however wide it is, a twig of length h has R ≈ πh / 2: the level parts noise from twigs by their height alone.

No ring ever crosses itself or another: a vertex stays while any other lies in the triangle that its going would sweep; it is asked again when that one has gone. Every ring keeps three.
"""

import heapq
import math
from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Float, Int

_CELL = 6.0  # pixels
_MANY = 48  # cells of a triangle from which all vertices are asked instead


@dataclass(frozen=True, eq=False)
class Evolved:
    """What is left of the contour."""

    kept: tuple[Int[np.ndarray, " vertex"], ...]  # of each ring: numbers of its points that stay
    went: Float[np.ndarray, " removal"]  # relevance of every vertex that went, in their order; pixels
    length: float  # of the whole contour, pixels: relevance over it is the paper's

    @property
    def count(self) -> int:
        """m: vertices of the first ring."""
        return len(self.kept[0])


def relevance(before: tuple[float, float], at: tuple[float, float], after: tuple[float, float]) -> float:
    """R of the vertex `at` between its neighbours, in the unit of the points."""
    ax, ay, bx, by = at[0] - before[0], at[1] - before[1], after[0] - at[0], after[1] - at[1]
    one, two = math.hypot(ax, ay), math.hypot(bx, by)
    if one + two == 0.0:
        return 0.0
    return abs(math.atan2(ax * by - ay * bx, ax * bx + ay * by)) * one * two / (one + two)


def evolve(rings: Sequence[Float[np.ndarray, "point 2"]], *, vertices: int | None = None, noise: float = 0.0) -> Evolved:
    """Evolve all rings together, the first down to `vertices`; None: until the least relevance exceeds `noise` pixels."""
    ring = _Rings(rings)
    least = 3 if vertices is None else max(vertices, 3)
    limit = noise if vertices is None else math.inf
    went = []
    heap = [(ring.relevance(k), k, 0) for k in range(len(ring.xy))]
    heapq.heapify(heap)
    while heap and (vertices is None or ring.size[0] > least):
        value, k, version = heapq.heappop(heap)
        if not ring.alive[k] or version != ring.version[k]:
            continue
        if value > limit:
            break
        if ring.size[ring.of[k]] <= 3:
            continue
        blocker = ring.in_the_way(k)
        if blocker is not None:
            ring.waiting[blocker].append(k)
            continue
        went.append(value)
        for other in ring.remove(k):
            ring.version[other] += 1
            heapq.heappush(heap, (ring.relevance(other), other, ring.version[other]))
    length = sum(float(np.hypot(*(np.roll(points, -1, axis=0) - points).T).sum()) for points in rings)
    return Evolved(ring.kept(rings), np.array(went), length)


class _Rings:
    """All rings as one linked list, and which vertices lie where. Changed in place, by `evolve` alone."""

    def __init__(self, rings):
        sizes = [len(points) for points in rings]
        first = np.concatenate([[0], np.cumsum(sizes)]).tolist()
        self.array = np.concatenate([np.asarray(points, np.float64) for points in rings])
        self.xy = [tuple(point) for point in self.array.tolist()]
        self.of = [number for number, size in enumerate(sizes) for _ in range(size)]
        self.size, self.left = sizes, sum(sizes)
        self.before = [first[n] + (k - 1) % size for n, size in enumerate(sizes) for k in range(size)]
        self.after = [first[n] + (k + 1) % size for n, size in enumerate(sizes) for k in range(size)]
        self.alive, self.version = [True] * self.left, [0] * self.left
        self.waiting: dict[int, list[int]] = defaultdict(list)
        self.cells: dict[tuple[int, int], set[int]] = defaultdict(set)
        self.cell = [(int(x // _CELL), int(y // _CELL)) for x, y in self.xy]
        for k, cell in enumerate(self.cell):
            self.cells[cell].add(k)
        self.few = np.arange(self.left)  # all that are alive, and some that went since

    def relevance(self, k: int) -> float:
        return relevance(self.xy[self.before[k]], self.xy[k], self.xy[self.after[k]])

    def in_the_way(self, k: int) -> int | None:
        """A vertex in the triangle of k and its neighbours; None if there is none."""
        u, w = self.before[k], self.after[k]
        (ax, ay), (bx, by), (cx, cy) = self.xy[u], self.xy[k], self.xy[w]
        turn = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
        if turn == 0.0:
            return None
        left, right, low, high = min(ax, bx, cx), max(ax, bx, cx), min(ay, by, cy), max(ay, by, cy)
        columns, rows = range(int(left // _CELL), int(right // _CELL) + 1), range(int(low // _CELL), int(high // _CELL) + 1)
        if len(columns) * len(rows) > _MANY:
            near = self._in_box(left, right, low, high)
        else:
            near = [j for column in columns for row in rows if (column, row) in self.cells for j in self.cells[column, row]]
        sign = 1.0 if turn > 0 else -1.0
        for j in near:
            if j == u or j == k or j == w:
                continue
            x, y = self.xy[j]
            if (
                sign * ((bx - ax) * (y - ay) - (by - ay) * (x - ax)) >= 0.0
                and sign * ((cx - bx) * (y - by) - (cy - by) * (x - bx)) >= 0.0
                and sign * ((ax - cx) * (y - cy) - (ay - cy) * (x - cx)) >= 0.0
            ):
                return j
        return None

    def _in_box(self, left, right, low, high) -> list[int]:
        if len(self.few) > 2 * self.left:
            self.few = np.flatnonzero(self.alive)
        x, y = self.array[self.few].T
        near = self.few[(x >= left) & (x <= right) & (y >= low) & (y <= high)].tolist()
        return [j for j in near if self.alive[j]]

    def remove(self, k: int) -> list[int]:
        """Take k out; returns the vertices whose relevance is another now, or that may go now."""
        u, w = self.before[k], self.after[k]
        self.after[u], self.before[w] = w, u
        self.alive[k] = False
        self.cells[self.cell[k]].discard(k)
        self.size[self.of[k]] -= 1
        self.left -= 1
        return list({u, w, *(j for j in self.waiting.pop(k, ()) if self.alive[j])})

    def kept(self, rings) -> tuple[Int[np.ndarray, " vertex"], ...]:
        parts: list[Bool[np.ndarray, " point"]] = np.split(np.array(self.alive), np.cumsum([len(points) for points in rings])[:-1])
        return tuple(np.flatnonzero(part) for part in parts)
