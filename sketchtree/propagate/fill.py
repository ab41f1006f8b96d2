"""Where is the crown still empty, and what grows there?

Growth by blocks leaves gaps where nothing drawn is near. To fill a crown evenly, points are spread over its
volume (one in every cell of a grid, in a place of its own that is the same in every run); those farther than

    gap = GAP · spacing of laterals

from every node are empty. A near node that may still bear a lateral grows one towards each, as long as the
way there; its laterals and theirs follow by blocks as everywhere. Rounds of this go on until no point is empty.

The lateral leaves its limb at an angle the species has, μ_β ± `SPREADS` σ_β: of the near nodes one is chosen from which the way lies so,
and where there is none the angle is brought to the nearer end, the side kept. A poplar fills its crown from below, an oak from beside.

Where drawn limbs stand out of a crown that nobody drew, the room around them, `HALO` of their length wide, is filled with it.

A crown of which more than `HOLLOW` is farther than `HOLLOW_GAP` spacings from all wood is *hollow*: a sketch of a trunk in an
outline, or of limbs that lie far apart in depth. It is filled unasked, less densely, unless the user drew both the
crown and the limbs in it.
"""

import numpy as np
from jaxtyping import Array, Float, Int, Key
from scipy.spatial import cKDTree

from sketchtree import keys, limb_ids
from sketchtree.parameters import Habit, TreeParameters
from sketchtree.propagate.blocks.attach_block import RANKS, Nodes
from sketchtree.propagate.space.envelope import Envelope
from sketchtree.propagate.space.space import Space
from sketchtree.propagate.blocks.open_branch import OpenBranches, polar, turn

ROUNDS = 6  # at most
GAP = 1.6  # spacings of laterals
HOLLOW, HOLLOW_GAP = 0.15, 2.5
HOLLOW_ROUNDS, COARSE_GAP = 4, 2.0  # rounds in a hollow crown, and its gap in spacings of laterals
LED_GAP = 1.3  # the same where leaders alone make the crown
HALO = (0.2, 5.0)  # of a drawn limb's length, and spacings of laterals, at most
_POINTS = 30_000  # at most, over the crown's bounding box
_NEAR = 16  # nodes of which one grows towards a point
SPREADS = 1.5  # σ_β to either side of μ_β that a filling lateral may diverge
_WIDEST = np.radians(110.0)  # from a limb: towards points behind it nothing grows


def empty_points(
    envelope: Envelope, tips: Float[np.ndarray, "node 3"], gap: float
) -> Float[np.ndarray, "point 3"]:
    """Points inside the envelope that are farther than `gap` metres from every tip."""
    point = _spread(envelope, gap)
    return point[_empty(point, tips, gap)]


def empty_around(
    nodes: Nodes, reach: Float[np.ndarray, " node"], tips: Float[np.ndarray, "tip 3"], gap: float
) -> Float[np.ndarray, "point 3"]:
    """Points within `reach` metres of each node that are farther than `gap` metres from every tip: where a drawn limb
    stands out of an implied crown, that is the room it fills."""
    if len(nodes) == 0:
        return np.zeros((0, 3))
    count = int(np.clip(np.median(4.0 * (2.0 * reach / gap) ** 3), 8, max(_POINTS // len(nodes), 8)))
    ball = 2.0 * halton(count) - 1.0
    ball = ball[np.linalg.norm(ball, axis=1) <= 1.0]
    point = (nodes.tip[:, None] + reach[:, None, None] * ball).reshape(-1, 3)
    return point[_empty(point, tips, gap)]


def emptiness(envelope: Envelope, tips: Float[np.ndarray, "node 3"], gap: float, space: Space = Space()) -> float:
    """The share of the envelope's volume, as far as the space is free, that is farther than `gap` metres from every tip."""
    point = _spread(envelope, gap)
    point = point[space.inside(point)]
    return float(np.mean(_empty(point, tips, gap))) if len(point) else 0.0


def halton(count: int) -> Float[np.ndarray, "point 3"]:
    """The first points of Halton's sequence in bases 2, 3 and 5: digits of k mirrored at the point, Σ_i d_i b^(−i−1)."""
    cube = np.zeros((count, 3))
    for axis, base in enumerate((2, 3, 5)):
        left, scale = np.arange(count), 1.0
        while left.any():
            scale /= base
            cube[:, axis] += scale * (left % base)
            left = left // base
    return cube


def _spread(envelope, gap):
    """Points all over the envelope, four to a cube of side `gap`: one somewhere in every cell of a grid that is fixed in the
    world, so that a crown that grows on one side keeps its points on the other."""
    low, high = envelope.bounds
    cell = gap / 4.0 ** (1.0 / 3.0)
    while np.prod(np.ceil((high - low) / cell) + 1.0) > _POINTS:
        cell *= 2.0
    first, last = np.floor(low / cell).astype(np.int64), np.floor(high / cell).astype(np.int64)
    i, j, k = (axis.ravel() for axis in np.meshgrid(*(np.arange(a, b + 1) for a, b in zip(first, last, strict=True)), indexing="ij"))
    name = limb_ids.child_limb_id(limb_ids.child_limb_id(i, j), k)
    inner = np.stack([limb_ids.child_limb_id(name, np.full(len(name), axis)) / 2.0**63 for axis in range(3)], axis=1)
    point = (np.stack([i, j, k], axis=1) + inner) * cell
    return point[envelope.inside(point)]


def _empty(point, tips, gap):
    distance, _ = cKDTree(tips).query(point, distance_upper_bound=gap)
    return np.isinf(distance)


def towards(
    points: Float[np.ndarray, "point 3"],
    nodes: Nodes,
    habit: Habit,
    theta: TreeParameters,
    round_: int,
    key: Key[Array, ""] | np.uint64,
) -> OpenBranches:
    """One open branch from each node that is near an empty point, towards it. `nodes` may not be of
    the deepest order; `round_` keeps the limb ids of the rounds apart."""
    angles = np.clip(theta.mu_beta + SPREADS * theta.sigma_beta * np.array([-1.0, 1.0]), 0.0, _WIDEST)
    at, point = _nearest(points, nodes, angles)
    way = point - nodes.tip[at]
    length = np.linalg.norm(way, axis=1)
    divergence, orientation = polar(np.einsum("bji,bj->bi", nodes.frame[at], way))
    keep = (divergence < _WIDEST) & (length > habit.twig_length)
    at, length, divergence, orientation = at[keep], length[keep], divergence[keep], orientation[keep]
    length = np.minimum(length, 0.8 * nodes.whole[at])
    limb = limb_ids.child_limb_id(nodes.limb[at], nodes.number[at] * RANKS + RANKS - 1 - round_)
    return OpenBranches(
        row=nodes.row[at],
        origin=nodes.tip[at],
        frame=turn(nodes.frame[at], np.clip(divergence, *angles), orientation, np.zeros(len(at), bool)),
        limb=limb,
        order=nodes.order[at] + 1,
        tree=nodes.tree[at],
        length=length * (0.85 + 0.15 * keys.uniform(key, limb, 13)),
        grown=np.zeros(len(at)),
        node=np.zeros(len(at), np.int64),
        radius=np.minimum(nodes.radius[at], 0.02 * length),
        bends=np.zeros(len(at), bool),
    )


def _nearest(points, nodes, angles) -> tuple[Int[np.ndarray, " branch"], Float[np.ndarray, "branch 3"]]:
    """(node, point) pairs: for every point, of its nearest nodes one from which the way there diverges by one of the `angles`
    between (least, most), of these one of the lowest order (its limb reaches farthest); and of a node's points the nearest."""
    if len(points) == 0 or len(nodes) == 0:
        return np.zeros(0, np.int64), np.zeros((0, 3))
    near = min(_NEAR, len(nodes))
    distances, found = (x.reshape(len(points), near) for x in cKDTree(nodes.tip).query(points, near))
    along = np.einsum("pna,pna->pn", nodes.frame[found][:, :, :, 1], points[:, None] - nodes.tip[found])
    turn_ = np.arccos(np.clip(along / np.maximum(distances, 1e-12), -1.0, 1.0))
    unlike = (turn_ < angles[0]) | (turn_ > angles[1])
    best = np.lexsort((distances, nodes.order[found], unlike), axis=1)[:, 0]
    each = np.arange(len(points))
    distance, node = distances[each, best], found[each, best]
    order = np.lexsort((distance, node))
    _, first = np.unique(node[order], return_index=True)
    chosen = order[first]
    return node[chosen], points[chosen]
