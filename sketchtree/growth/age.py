"""When did each piece of wood grow?

Single-image growth, §II.3, Eq. 5: the growth age of a node i, larger where it is older, and the size of the whole tree,

    T(i) = 1 / ‖x_r − x_i‖_geo + w_p · EDT(x_i)            M(j) = 1 / (r T(j)),  0 < M(j) ≤ 1

    ‖x_r − x_i‖_geo   way along the branches from the root to the node, pixels
    EDT(x_i)          radius there, pixels
    w_p               `THICKNESS_WEIGHT` = 0.001
    j                 the latest branching node

The equation is printed without its fraction bars; this is our reading. Pixels are those of a picture in which the tree is
`PICTURE` = 400 high or wide: in metres the two terms would weigh differently in every tree. r = 1 / T(last branching node), so that M ends at 1.

Time runs with 1 / T: 0 at the root, where T is infinite, and for thin wood just the way from the root, so that tips go at one
speed; thick wood comes earlier. A piece grows from the moment of its start to that of its tip,

    begin(i) = max(1 / T at its start, with its own radius there;  end(parent))
    end(i)   = max(1 / T(i);  begin(i) + ℓ_i / `FASTEST`)

so that age never rises towards a tip, even where wood swells; equal ages follow the way from the root; a thin side branch rests in its bud
until wood as thin as it comes; and nothing grows faster than `FASTEST` times as fast as the thinnest wood. All is then scaled so that
the last wood is there at `WHOLE` < 1: the rest of the time is for the last leaves to unfold. A few twigs that come much later than all others
don't make everybody wait: what comes after `MOST_WOOD` of all wood has at most `TAIL` of the time, and M goes with that time too.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float

from sketchtree.growth.straight import radius_at_start
from sketchtree.skeleton import TreeSkeleton
from sketchtree.traverse import child_count, generations, sum_from_root

THICKNESS_WEIGHT = 0.001  # w_p
PICTURE = 400.0  # pixels
FASTEST = 8.0
WHOLE = 0.95  # all wood is there
MOST_WOOD, TAIL = 0.99, 0.04
BUD_REST = 0.05  # of the longest 1 / T: how much later each further branching order starts, where order counts


@dataclass(frozen=True, eq=False)
class Timeline:
    """When each piece grows; 0 ≤ begin ≤ end ≤ `WHOLE`, and no piece begins before its parent ends."""

    begin: Float[np.ndarray, " segment"]
    end: Float[np.ndarray, " segment"]
    last_fork: float  # when the last branching node is there

    def grown(self, time: Float[np.ndarray, " time"]) -> Float[np.ndarray, "segment time"]:
        """The share of its length that each piece has at each time, 0-1."""
        span = np.maximum(self.end - self.begin, 1e-12)[:, None]
        return np.clip((time - self.begin[:, None]) / span, 0.0, 1.0)

    def size(self, time: Float[np.ndarray, " time"]) -> Float[np.ndarray, " time"]:
        """M: at the moment of each branching node as Eq. 5 says, in between linear; 0 only at time 0."""
        return np.minimum(time / self.last_fork, 1.0)


def growth_age(tree: TreeSkeleton, thickness_weight: float = THICKNESS_WEIGHT) -> Float[np.ndarray, " segment"]:
    """T of every row's tip (Eq. 5), made to fall towards the tips; infinite at a base. The tree has no curve points."""
    distance, radius = _in_pixels(tree, sum_from_root(tree.parent, tree.length)), _in_pixels(tree, tree.radius)
    age = np.where(distance > 0, 1.0 / np.maximum(distance, 1e-300) + thickness_weight * radius, np.inf)
    for rows in generations(tree.parent)[1:]:
        age[rows] = np.minimum(age[rows], age[tree.parent[rows]])
    return age


def timeline(tree: TreeSkeleton, thickness_weight: float = THICKNESS_WEIGHT, bud_rest: float = 0.0) -> Timeline:
    """When each row of a tree without curve points grows. `bud_rest`: how much later each further branching order comes, in longest 1 / T."""
    length = _in_pixels(tree, tree.length)
    way = sum_from_root(tree.parent, length)
    clock_start = _clock(way - length, _in_pixels(tree, radius_at_start(tree)), thickness_weight)
    clock_tip = _clock(way, _in_pixels(tree, tree.radius), thickness_weight)
    rest = bud_rest * clock_tip.max(initial=0.0) * tree.order
    begin, end = np.where(tree.is_base, 0.0, clock_start + rest), np.where(tree.is_base, 0.0, clock_tip + rest)
    for rows in generations(tree.parent)[1:]:
        begin[rows] = np.maximum(begin[rows], end[tree.parent[rows]])
        end[rows] = np.maximum(end[rows], begin[rows] + length[rows] / FASTEST)
    begin, end = _scaled(begin, end, tree.length)
    forks = end[(child_count(tree.parent) > 1) & (end > 0)]
    return Timeline(begin, end, float(forks.max()) if len(forks) else WHOLE)


def _clock(way, radius, thickness_weight: float):
    """1 / T = d / (1 + w r d), pixels; 0 at the root."""
    return way / (1.0 + thickness_weight * radius * way)


def _scaled(begin, end, length):
    """The times from 0 to `WHOLE`, the tail shortened."""
    last = float(end.max(initial=0.0))
    if last <= 0:
        return np.zeros_like(begin), np.zeros_like(end)
    order = np.argsort(end, kind="stable")
    wood = np.cumsum(length[order])
    most = float(end[order[np.searchsorted(wood, MOST_WOOD * wood[-1])]])
    knots, times = [0.0, most, last], [0.0, max(most / last, 1.0 - TAIL) * WHOLE, WHOLE]
    if most >= last:
        knots, times = [0.0, last], [0.0, WHOLE]
    return np.interp(begin, knots, times), np.interp(end, knots, times)


def _in_pixels(tree: TreeSkeleton, metres):
    extent = float(np.ptp(tree.tip, axis=0).max()) if len(tree) else 0.0
    return np.asarray(metres) * (PICTURE / extent if extent > 0 else 1.0)
