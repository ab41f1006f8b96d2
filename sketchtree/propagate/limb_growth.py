"""How does an open branch grow to its length?

Node by node, all open branches at once. At every node a replication block is chosen (Chen et al. 2008, §6); its apical
child turns the limb and its laterals will open new branches in the next generation. One step:

    d ← gravity(R_y(ϕ) R_x(φ) d)          then   p ← p + min(ℓ, exit) d

    d, p      direction and end of the limb
    φ, ϕ      the block's apical angles, φ + κ σ_α ε
    gravity   turns d towards the ground by `gravitropism` · ℓ (or towards the sky, if negative), never
              past it; in full from order 2 on, little on the limbs that carry the crown
    exit      where the crown's surface is met: the branch is scaled back to touch it and stops there
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Array, Float, Int, Key

from sketchtree import keys
from sketchtree.parameters import Habit, TreeParameters
from sketchtree.propagate.attach_block import RANKS, Nodes
from sketchtree.propagate.envelope import Envelope
from sketchtree.propagate.library import Library
from sketchtree.propagate.open_branch import OpenBranches, direction, polar, turn

NODES = 24  # of one limb, at most
_GRAVITY = np.array([0.0, 0.2, 1.0])  # share of the gravitropism by order 0, 1, 2+
_TAPER = 0.85  # share of a limb's radius that is lost towards its tip
_SHORTEST = 0.05  # of a step: a step cut shorter than this at the crown is not made
_TOUCH = 1.0 - 1e-9  # of the way to the surface, so that rounding never leaves a tip outside


@dataclass(frozen=True, eq=False)
class Plan:
    """The nodes of all limbs before they are placed: limb after limb, node after node."""

    count: Int[np.ndarray, " branch"]  # nodes of each branch
    owner: Int[np.ndarray, " node"]
    number: Int[np.ndarray, " node"]  # along the limb
    step: Float[np.ndarray, " node"]  # metres from the node before
    arc: Float[np.ndarray, " node"]  # metres from the limb's insertion
    block: Int[np.ndarray, " node"]


def plan(
    open_: OpenBranches, library: Library, spacing: Float[np.ndarray, " branch"], key: Key[Array, ""]
) -> Plan:
    """Where the nodes of each branch will lie: about `spacing` apart, closing up a little towards the
    tip, at least two and at most `NODES`; and the block of each."""
    count = np.clip(np.ceil(open_.length / spacing - 0.25).astype(np.int64), 2, NODES)
    owner = np.repeat(np.arange(len(open_)), count)
    along = np.arange(len(owner)) - np.repeat(np.cumsum(count) - count, count)
    number = open_.node[owner] + along
    node_id = keys.child_limb_id(open_.limb[owner], number * RANKS)
    weight = (1.15 - 0.3 * along / count[owner]) * (0.85 + 0.3 * keys.uniform(key, node_id, 5))
    total = np.bincount(owner, weight, minlength=len(open_))
    step = weight / total[owner] * open_.length[owner]
    run = np.cumsum(step)
    before = np.r_[0.0, run][np.cumsum(count) - count]
    arc = open_.grown[owner] + run - before[owner]
    whole = (open_.grown + open_.length)[owner]
    block = library.choose(open_.order[owner], arc / whole, keys.uniform(key, node_id, 6))
    return Plan(count, owner, number, step, arc, block)


def grow(
    open_: OpenBranches,
    nodes: Plan,
    library: Library,
    habit: Habit,
    theta: TreeParameters,
    envelope: Envelope | None,
    key: Key[Array, ""],
    *,
    first_row: int,
    spread: float = 0.35,
) -> Nodes:
    """The rows of the grown limbs, as nodes numbered from `first_row`, and `parent` rows with them.

    Returns (nodes, parent, block): parents precede children; limbs that met the crown are shorter than planned.
    """
    total = len(nodes.owner)
    offset = np.cumsum(nodes.count) - nodes.count
    divergence, orientation = _bends(open_, nodes, library, theta, key, spread)
    weight = _GRAVITY[np.minimum(open_.order, 2)]
    pull = np.radians(habit.gravitropism) * weight
    tip, frame, made = np.empty((total, 3)), np.empty((total, 3, 3)), np.zeros(total, bool)
    at, axes = open_.origin.copy(), open_.frame.copy()
    alive = np.arange(len(open_))
    for k in range(int(nodes.count.max(initial=0))):
        alive = alive[nodes.count[alive] > k]
        flat = offset[alive] + k
        step = nodes.step[flat]
        bent = _turned(axes[alive], divergence[flat], orientation[flat], pull[alive] * step)
        end = at[alive] + step[:, None] * bent[:, :, 1]
        keep = np.ones(len(alive), bool)
        if envelope is not None:
            fraction = envelope.exit_fraction(at[alive], end)
            keep = fraction > _SHORTEST
            cut = fraction < 1.0
            end = np.where(cut[:, None], at[alive] + (fraction * _TOUCH * step)[:, None] * bent[:, :, 1], end)
            keep_on = keep & ~cut
        else:
            keep_on = keep
        flat, rows = flat[keep], alive[keep]
        tip[flat], frame[flat], made[flat] = end[keep], bent[keep], True
        at[rows], axes[rows] = end[keep], bent[keep]
        alive = alive[keep_on]
    return _as_nodes(open_, nodes, tip, frame, made, habit, first_row)


def _bends(open_, nodes, library, theta, key, spread):
    """Apical (divergence, orientation) with which every step starts, from the block of the node before it."""
    blocks, owner = library.blocks, nodes.owner
    first = nodes.number == open_.node[owner]
    before = nodes.block[np.maximum(np.arange(len(owner)) - 1, 0)]
    child = blocks.start[before]
    has = blocks.apical[child] & ~(first & ~open_.bends[owner])
    noise = keys.normal(key, keys.child_limb_id(open_.limb[owner], nodes.number * RANKS), 7)
    divergence = np.where(has, blocks.divergence[child] + spread * theta.sigma_alpha * noise, 0.0)
    return np.clip(divergence, -0.8, 0.8), np.where(has, blocks.orientation[child], 0.0)


def _turned(frame, divergence, orientation, pull):
    """Frames after the block's bend and gravity, both as transport along the limb."""
    heading = np.einsum("bij,bj->bi", frame, direction(divergence, orientation))
    if np.any(pull):
        heading = gravity(heading, pull)
    local = np.einsum("bji,bj->bi", frame, heading)
    return turn(frame, *polar(local), np.ones(len(frame), bool))


def gravity(
    heading: Float[np.ndarray, "branch 3"], angle: Float[np.ndarray, " branch"]
) -> Float[np.ndarray, "branch 3"]:
    """Unit headings turned towards the ground by `angle` (radians; < 0 towards the sky), never past it."""
    level = np.hypot(heading[:, 0], heading[:, 2])
    down = np.arctan2(level, -heading[:, 1])
    turned = np.clip(down - angle, np.minimum(down, 0.03), np.maximum(down, np.pi - 0.03))
    out = np.sin(turned) / np.where(level > 1e-9, level, 1.0)
    bent = np.stack([heading[:, 0] * out, -np.cos(turned), heading[:, 2] * out], axis=1)
    return np.where((level > 1e-9)[:, None], bent, heading)


def _as_nodes(open_, nodes, tip, frame, made, habit, first_row):
    """Nodes of the rows that were made, their parents and their blocks."""
    row = first_row + np.cumsum(made) - 1
    first = nodes.number == open_.node[nodes.owner]
    parent = np.where(first, open_.row[nodes.owner], np.r_[0, row[:-1]] if len(row) else row)
    whole = (open_.grown + open_.length)[nodes.owner]
    taper = 1.0 - _TAPER * (nodes.arc - open_.grown[nodes.owner]) / np.maximum(open_.length[nodes.owner], 1e-12)
    owner = nodes.owner
    grown = Nodes(
        row=row,
        tip=tip,
        frame=frame,
        limb=open_.limb[owner],
        order=open_.order[owner],
        tree=open_.tree[owner],
        number=nodes.number,
        position=nodes.arc / whole,
        whole=whole,
        radius=np.maximum(open_.radius[owner] * taper, habit.twig_radius),
    )
    return grown.select(made), parent[made], nodes.block[made]
