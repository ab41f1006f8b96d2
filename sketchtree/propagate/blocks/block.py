"""Which pieces of a tree can be replicated?

Chen et al. 2008, §6: a *replication block* is a parent segment and its child segments. It is stored
in the parent's frame by the parameters of §4, so that it can be scaled, oriented and attached anywhere:

    v_c = s R_y(ϕ) R_x(φ) v_p

    s   scale         |v_c| / |v_p|                                   `scale`
    φ   divergence    angle between child and parent, radians         `divergence`
    ϕ   orientation   azimuth about the parent from its z to its x    `orientation`

Beyond the paper, a block remembers where it sat: the order of its parent, its `position` along the limb and
along the `zone` of that limb that bears laterals. A lateral child remembers its `reach`, the length of its
whole limb over that of the limb it sits on: segment lengths alone say little, they are where laterals happened to
be drawn. An apical child remembers its `droop`, how far it turned towards the ground per metre: plants bend by
the vertical, whichever way they are attached.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Float, Int

from sketchtree.axes import NULL
from sketchtree.limb_ids import child_limb_id
from sketchtree.parameters import Habit, TreeParameters
from sketchtree.propagate.blocks.open_branch import frames, levelled, limb_positions, polar
from sketchtree.skeleton import TreeSkeleton
from sketchtree.traverse import children

POSITIONS = (np.arange(10) + 0.5) / 10  # where along a limb the synthetic blocks sit
_HANGS = np.radians(-65.0)  # elevation of a segment that hangs: it is held there, turning or not
_PLUMB = np.radians(90.0)  # a metre towards the ground, at least, for what hangs
_GRAVITY = np.array([0.0, 0.2, 1.0])  # share of a habit's gravitropism on limbs of order 0, 1 and 2+


@dataclass(frozen=True, eq=False)
class Blocks:
    """Replication blocks, each with one child or more; children ragged, the apical one first."""

    id: Int[np.ndarray, " block"]  # 63 bits, from the limbs that make it: stable when strokes are added
    order: Int[np.ndarray, " block"]  # branching order of the parent segment
    position: Float[np.ndarray, " block"]  # 0-1, where the node lies along the parent's limb
    zone: Float[np.ndarray, " block"]  # 0-1, where it lies between that limb's first lateral and its tip
    start: Int[np.ndarray, " block+1"]  # block i owns children start[i]:start[i + 1]
    apical: Bool[np.ndarray, " child"]
    scale: Float[np.ndarray, " child"]
    divergence: Float[np.ndarray, " child"]  # radians
    orientation: Float[np.ndarray, " child"]  # radians
    reach: Float[np.ndarray, " child"]  # limb length / parent limb length; NaN for an apical child
    length: Float[np.ndarray, " child"]  # of the segment, metres; what `droop` was measured over
    droop: Float[np.ndarray, " child"]  # radians a metre towards the ground; NaN for a lateral one

    def __len__(self) -> int:
        return len(self.id)

    @property
    def owner(self) -> Int[np.ndarray, " child"]:
        """The block of every child."""
        return np.repeat(np.arange(len(self)), np.diff(self.start))

    @property
    def lateral_count(self) -> Int[np.ndarray, " block"]:
        """Laterals of every block."""
        return np.bincount(self.owner[~self.apical], minlength=len(self))

    @property
    def has_apical(self) -> Bool[np.ndarray, " block"]:
        """Blocks whose limb goes on."""
        return np.bincount(self.owner[self.apical], minlength=len(self)) > 0

    def select(self, keep: Bool[np.ndarray, " block"]) -> "Blocks":
        """Only the blocks where `keep` is true."""
        child = keep[self.owner]
        count = np.diff(self.start)[keep]
        columns = {name: getattr(self, name)[keep] for name in ("id", "order", "position", "zone")}
        columns |= {name: getattr(self, name)[child] for name in _CHILD}
        return Blocks(**columns, start=np.r_[0, np.cumsum(count)])


_CHILD = ("apical", "scale", "divergence", "orientation", "reach", "length", "droop")


def blocks_of(tree: TreeSkeleton) -> Blocks:
    """Every replication block of a tree: each segment with children, and those children (Chen §6)."""
    frame = levelled(frames(tree), tree.order)
    position, limb_length = limb_positions(tree)
    child, _ = children(tree.parent)
    parent, length, vector = tree.parent[child], tree.length, tree.vector
    usable = (tree.parent[parent] != NULL) & (length[child] > 0) & (length[parent] > 0)
    child, parent = child[usable], parent[usable]
    apical = tree.limb[child] == tree.limb[parent]
    first = np.argsort(2 * parent + ~apical, kind="stable")
    child, parent, apical = child[first], parent[first], apical[first]

    at = np.unique(parent)
    owner = np.searchsorted(at, parent)
    divergence, orientation = polar(np.einsum("cji,cj->ci", frame[parent], vector[child]))
    sinks = _elevation(vector[parent]) - _elevation(vector[child])
    sinks = np.where(_elevation(vector[child]) < _HANGS, np.maximum(sinks, _PLUMB * length[child]), sinks)
    return Blocks(
        id=_block_id(owner, np.where(apical, 0, tree.limb[child]), tree.limb[at]),
        order=tree.order[at],
        position=position[at],
        zone=_zone(tree, position, parent[~apical])[at],
        start=np.r_[0, np.cumsum(np.bincount(owner, minlength=len(at)))].astype(np.int64),
        apical=apical,
        scale=length[child] / length[parent],
        divergence=divergence,
        orientation=orientation,
        reach=np.where(apical, np.nan, limb_length[child] / limb_length[parent]),
        length=length[child],
        droop=np.where(apical, sinks / length[child], np.nan),
    )


def _elevation(vector):
    return np.arctan2(vector[:, 1], np.hypot(vector[:, 0], vector[:, 2]))


def _zone(tree, position, bearing):
    """Place between the first lateral of each row's limb and its tip, 0-1; 0 on limbs without laterals."""
    _, limb = np.unique(tree.limb, return_inverse=True)
    first = np.ones(limb.max(initial=-1) + 1)
    np.minimum.at(first, limb[bearing], position[bearing])
    begin = first[limb]
    return np.clip((position - begin) / np.maximum(1.0 - begin, 1e-9), 0.0, 1.0)


def blocks_of_parameters(theta: TreeParameters, habit: Habit) -> Blocks:
    """Blocks made from Θ and the habit alone, for a tree that has none of its own and no exemplar.

    Each holds an apical child and a node's laterals, at the mean angles of Chen §4 (cases 1-3); the
    arrangement decides how many laterals a node bears. Their reach follows the habit: the longest near
    the limb's tip (apical control 0) to the longest near its base (1), never past the limb's own tip.
    """
    count = {"opposite": 2, "whorled": max(habit.whorl, 3)}.get(habit.arrangement, max(habit.whorl, 1))
    order, position, turn = (
        axis.ravel() for axis in np.meshgrid(np.arange(habit.max_order + 1), POSITIONS, np.arange(4), indexing="ij")
    )
    labels = np.arange(1, count + 2)
    angle = np.array([theta.child(int(label), count + 1) for label in labels])
    swing = (turn[:, None] - 1.5) * np.r_[0.0, np.full(count, 0.4)] * min(theta.sigma_gamma, 1.0)
    lean = np.where(order[:, None] > 0, np.radians(habit.lateral_angle), angle[:, 0])
    divergence = np.where(labels == 1, angle[:, 0], lean + (turn[:, None] % 2 - 0.5) * theta.sigma_beta)
    apical = np.broadcast_to(labels == 1, divergence.shape)
    reach = np.where(apical, np.nan, habit_reach(habit, position)[:, None])
    weight = _GRAVITY[np.minimum(np.arange(habit.max_order + 1), 2)]
    return Blocks(
        id=child_limb_id(order * 100 + turn, (position * 1000).astype(np.int64)),
        order=order,
        position=position,
        zone=position,
        start=np.arange(len(order) + 1) * (count + 1),
        apical=apical.ravel(),
        scale=np.full(divergence.size, float(np.clip(theta.mu_s, 0.6, 1.0))),
        divergence=np.clip(divergence, 0.02, 2.4).ravel(),
        orientation=(angle[:, 2] + swing).ravel(),
        reach=reach.ravel(),
        length=np.zeros(divergence.size),
        droop=np.where(apical, np.radians(habit.gravitropism) * weight[order][:, None], np.nan).ravel(),
    )


def habit_reach(habit: Habit, position: Float[np.ndarray, " node"]) -> Float[np.ndarray, " node"]:
    """Limb length over parent limb length at a position along the parent limb, by the habit."""
    tilt = 1.0 + (2.0 * habit.apical_control - 1.0) * (1.0 - 2.0 * position) * 0.8
    return np.minimum(habit.lateral_ratio * tilt, 1.1 * (1.0 - position) + 0.12)


def log_likelihood(blocks: Blocks, theta: TreeParameters) -> Float[np.ndarray, " block"]:
    """Mean log density of a block's angles under Θ, relative to the mode (≤ 0).

    Chen §4: φ ~ N(μ_α, σ_α) for the apical child, N(μ_β, σ_β) for laterals. A block whose angles
    are the tree's own scores 0.
    """
    mean = np.where(blocks.apical, theta.mu_alpha, theta.mu_beta)
    sd = np.where(blocks.apical, theta.sigma_alpha, theta.sigma_beta)
    z = (blocks.divergence - mean) / np.maximum(sd, 0.05)
    total = np.bincount(blocks.owner, -0.5 * z**2, minlength=len(blocks))
    return total / np.maximum(np.diff(blocks.start), 1)


def _block_id(owner, child_limb, parent_limb):
    """One id per block out of its limbs' ids, whatever their order."""
    with np.errstate(over="ignore"):
        mixed = child_limb_id(parent_limb[owner], child_limb)
        total = np.zeros(len(parent_limb), np.uint64)
        np.add.at(total, owner, mixed.astype(np.uint64))
    return (total >> np.uint64(1)).astype(np.int64)
