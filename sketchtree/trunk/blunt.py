"""Which branches are only the corners of a blunt end, or what noise has left? Those that hardly stand out of the circle at their fork.

Evolution keeps both corners of a limb that is cut straight across, and the axis forks into them. Ours, beside the paper: a branch from a fork f to its tip t stays if it protrudes,

    |t − f| + r_t − r_f  ≥  max(least, share · r_f, `SPUR` · r_own)

r the radius of the largest circle, r_own the median of those along the branch outside the fork's: a spur shorter than it is thick is no limb. Where that at the fork reaches the ground, so do the corners of the foot and the roots, and `FEET` is the share. The one that protrudes least goes first, and its fork is none any more. Tips that a person asked for stay in any case.
"""

import heapq
import math

import numpy as np
from jaxtyping import Bool

from sketchtree.axes import NULL
from sketchtree.trunk.rooted import Rooted

SHARE = 0.5
SPUR = 2.0
FEET = 4.0  # at a fork whose circle reaches the ground: length of a corner of the foot, or of a root that spreads, in radii of the circle
_GROUND = 2.0  # pixels above the root


def without_blunt(tree: Rooted, asked: Bool[np.ndarray, " node"], least: float, share: float = SHARE) -> Rooted:
    """The tree without such branches; `asked`: tips that stay."""
    alive = _Alive(tree, asked, least, share)
    heap = [entry for tip in alive.tips() if (entry := alive.lacking(tip)) is not None]
    heapq.heapify(heap)
    while heap:
        value, tip, fork = heapq.heappop(heap)
        if value >= 0.0:
            break
        if not alive.here[tip] or alive.fork_of(tip) != fork:
            continue
        onward = alive.remove(tip, fork)
        entry = alive.lacking(onward) if onward is not None else None
        if entry is not None:
            heapq.heappush(heap, entry)
    return tree.select(alive.here)


class _Alive:
    """What still stands while branches go. Changed in place, by `without_blunt` alone."""

    def __init__(self, tree: Rooted, asked, least: float, share: float):
        self.parent, self.radius, self.xy = tree.parent.tolist(), tree.radius.tolist(), tree.xy.tolist()
        self.asked, self.least, self.share = asked, least, share
        self.children: list[set[int]] = [set() for _ in self.parent]
        for row, up in enumerate(self.parent):
            if up != NULL:
                self.children[up].add(row)
        self.here = np.ones(len(self.parent), bool)

    def tips(self) -> list[int]:
        return [row for row, own in enumerate(self.children) if not own]

    def fork_of(self, tip: int) -> int | None:
        """The first fork below a tip; None where there is none."""
        at = self.parent[tip]
        while at != NULL and len(self.children[at]) < 2:
            at = self.parent[at]
        return None if at == NULL else at

    def lacking(self, tip: int) -> tuple[float, int, int] | None:
        """(how far it protrudes beyond what it must, tip, fork)."""
        fork = self.fork_of(tip)
        if fork is None or self.asked[tip]:
            return None
        (x, y), (fx, fy), wide = self.xy[tip], self.xy[fork], self.radius[fork]
        foot = fy + wide >= self.xy[0][1] - _GROUND and y > fy
        must = max(self.least, (FEET if foot else self.share) * wide, SPUR * self.thickness(tip, fork))
        return math.hypot(x - fx, y - fy) + self.radius[tip] - wide - must, tip, fork

    def thickness(self, tip: int, fork: int) -> float:
        """The median radius of a branch outside the circle of its fork."""
        (fx, fy), found, at = self.xy[fork], [], tip
        while at != fork:
            x, y = self.xy[at]
            if math.hypot(x - fx, y - fy) > self.radius[fork]:
                found.append(self.radius[at])
            at = self.parent[at]
        return float(np.median(found)) if found else 0.0

    def remove(self, tip: int, fork: int) -> int | None:
        """Take a branch away; returns the tip that its fork's other child leads to without another fork, if one does."""
        at = tip
        while at != fork:
            self.here[at] = False
            below, at = at, self.parent[at]
        self.children[fork].discard(below)
        at = fork
        while len(self.children[at]) == 1:
            (at,) = self.children[at]
        return None if self.children[at] else at
