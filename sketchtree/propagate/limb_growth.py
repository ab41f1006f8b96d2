"""How does an open branch grow to its length?

Node by node, all open branches at once. At every node a replication block is chosen (Chen et al. 2008, §6); its apical
child turns the limb and its laterals will open new branches in the next generation. One step:

    d ← guide(gravity(R_y(ϕ) R_x(φ) d))   then   p ← p + min(ℓ, exit) d

    d, p      direction and end of the limb;  ℓ  length of the step
    φ, ϕ      the block's apical angles: φ the bend that is not by the vertical, + κ σ_α ε
    gravity   turns d towards the ground by the block's `droop` · ℓ (towards the sky, if negative), never past it
    guide     turns d away from obstacles and neighbours, and towards the light (`space`)
    exit      where the crown's surface, another barrier or the ground is met: the branch is scaled back to touch it and stops
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Array, Float, Int, Key

from sketchtree import keys, limb_ids
from sketchtree.axes import NULL
from sketchtree.parameters import Habit, TreeParameters
from sketchtree.propagate.blocks.attach_block import RANKS, Nodes
from sketchtree.propagate.space.space import Space
from sketchtree.propagate.blocks.library import Library
from sketchtree.propagate.blocks.open_branch import OpenBranches, direction, polar, turn

NODES = 24  # of one limb, at most
_LARGEST_TURN = np.radians(60.0)  # of one step by gravity
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
    zone: Float[np.ndarray, " node"]  # 0-1 from where the limb bears laterals to its tip; < 0 before
    bend: Int[np.ndarray, " node"]  # block whose apical child the step to the node follows; NULL at an insertion


def plan(
    open_: OpenBranches, library: Library, spacing: Float[np.ndarray, " branch"], key: Key[Array, ""]
) -> Plan:
    """Where the nodes of each branch will lie: about `spacing` apart, closing up a little towards the
    tip, at least two and at most `NODES`; and the block that bends each step."""
    count = np.clip(np.ceil(open_.length / spacing - 0.25).astype(np.int64), 2, NODES)
    owner = np.repeat(np.arange(len(open_)), count)
    along = np.arange(len(owner)) - np.repeat(np.cumsum(count) - count, count)
    number = open_.node[owner] + along
    node_id = limb_ids.child_limb_id(open_.limb[owner], number * RANKS)
    weight = (1.15 - 0.3 * along / count[owner]) * (0.85 + 0.3 * keys.uniform(key, node_id, 5))
    total = np.bincount(owner, weight, minlength=len(open_))
    step = weight / total[owner] * open_.length[owner]
    run = np.cumsum(step)
    before = np.r_[0.0, run][np.cumsum(count) - count]
    arc = open_.grown[owner] + run - before[owner]
    position = arc / (open_.grown + open_.length)[owner]
    bare = library.bare[np.minimum(open_.order, len(library.bare) - 1)][owner]
    bend = library.choose(library.apical, open_.order[owner], position, keys.uniform(key, node_id, 6))
    bend = np.where((along == 0) & ~open_.bends[owner], NULL, bend)
    return Plan(count, owner, number, step, arc, (position - bare) / (1.0 - bare), bend)


def grow(
    open_: OpenBranches,
    nodes: Plan,
    library: Library,
    habit: Habit,
    theta: TreeParameters,
    space: Space,
    ground: Float[np.ndarray, " branch"],
    key: Key[Array, ""],
    *,
    first_row: int,
    spread: float = 0.35,
) -> tuple[Nodes, Int[np.ndarray, " node"]]:
    """The rows of the grown limbs, as nodes numbered from `first_row`, and the parent row of each.

    Parents precede children. Limbs that met the crown, or came as low as `ground` (metres), are shorter than planned.
    """
    total = len(nodes.owner)
    offset = np.cumsum(nodes.count) - nodes.count
    divergence, orientation, droop = _bends(open_, nodes, library, theta, key, spread)
    tip, frame, made = np.empty((total, 3)), np.empty((total, 3, 3)), np.zeros(total, bool)
    at, axes = open_.origin.copy(), open_.frame.copy()
    alive = np.arange(len(open_))
    for k in range(int(nodes.count.max(initial=0))):
        alive = alive[nodes.count[alive] > k]
        flat = offset[alive] + k
        guided = _guided(space, at[alive], nodes.step[flat], open_.limb[alive])
        turned = _turned(axes[alive], divergence[flat], orientation[flat], droop[flat], guided)
        fraction, end = _stopped(at[alive], turned[:, :, 1] * nodes.step[flat][:, None], space, ground[alive])
        keep = fraction > _SHORTEST
        tip[flat[keep]], frame[flat[keep]], made[flat[keep]] = end[keep], turned[keep], True
        at[alive[keep]], axes[alive[keep]] = end[keep], turned[keep]
        alive = alive[fraction == 1.0]
    return _as_nodes(open_, nodes, tip, frame, made, habit, first_row)


def _guided(space, start, step, limb):
    """What turns a heading at these places; None where nothing does."""
    return (lambda heading: space.turned(start, heading, step, limb)) if space.guides else None


def _stopped(start, step, space, ground):
    """(the fraction of each step that is free, where it ends): 1 and the whole step, or up to a barrier or the ground."""
    end = start + step
    fraction = space.exit_fraction(start, end)
    sinks = (end[:, 1] < ground) & (step[:, 1] < 0)
    above = np.maximum(start[sinks, 1] - ground[sinks], 0.0)
    fraction[sinks] = np.minimum(fraction[sinks], above / -step[sinks, 1])
    cut = fraction < 1.0
    end[cut] = start[cut] + (fraction[cut] * _TOUCH)[:, None] * step[cut]
    return fraction, end


def _bends(open_, nodes, library, theta, key, spread):
    """(divergence, orientation, droop) of every step: the block's bend, split by what the vertical explains."""
    blocks = library.blocks
    has = nodes.bend != NULL
    child = blocks.start[np.where(has, nodes.bend, 0)]
    noise = keys.normal(key, limb_ids.child_limb_id(open_.limb[nodes.owner], nodes.number * RANKS), 7)
    bend = blocks.divergence[child]
    turned = np.nan_to_num(blocks.droop[child] * blocks.length[child])
    bend = np.sqrt(np.maximum(bend**2 - turned**2, 0.0)) + spread * theta.sigma_alpha * noise
    droop = np.clip(np.nan_to_num(blocks.droop[child]) * nodes.step, -_LARGEST_TURN, _LARGEST_TURN)
    return (
        np.where(has, np.clip(bend, -_LARGEST_TURN, _LARGEST_TURN), 0.0),
        blocks.orientation[child],
        np.where(has, droop, 0.0),
    )


def _turned(frame, divergence, orientation, pull, guided):
    """Frames after the block's bend, gravity and the guides, all as transport along the limb."""
    heading = np.einsum("bij,bj->bi", frame, direction(divergence, orientation))
    if np.any(pull):
        heading = gravity(heading, pull)
    if guided is not None:
        heading = guided(heading)
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
        zone=nodes.zone,
        whole=whole,
        radius=np.maximum(open_.radius[owner] * taper, habit.twig_radius),
    )
    return grown.select(made), parent[made]
