"""Where can the tree grow on, and how is it turned there?

An *open branch* (Chen et al. 2008, §6) is a limb that is not yet grown to its length: the tip of a
drawn limb, or a lateral that a replication block has just put on a node. Its frame has the branch's direction
as y. Frames follow §4: a child's frame is its parent's, turned by

    lateral   R_y(ϕ) R_x(φ)            so that x is normal to the plane of parent and child
    apical    R_y(ϕ) R_x(φ) R_y(−ϕ)    the least turn: parallel transport along the limb

Along a limb nothing spins, and on a level limb of an upright trunk ±x lies level, so blocks of a flat
spray stay flat wherever round the trunk they are attached.
"""

from dataclasses import dataclass, fields
from functools import lru_cache

import numpy as np
from jaxtyping import Bool, Float, Int

from sketchtree.axes import NULL
from sketchtree.skeleton import TreeSkeleton
from sketchtree.traverse import generations

_STEEP = np.sin(np.radians(15.0))  # level part of a unit direction: a limb within 15° of the vertical has no above and below
Frame = Float[np.ndarray, "branch 3 3"]  # columns are the axes x, y, z


@dataclass(frozen=True, eq=False)
class OpenBranches:
    """One row an open branch: where it starts, where it points, how far it is to grow."""

    row: Int[np.ndarray, " branch"]  # row of the skeleton it starts from
    origin: Float[np.ndarray, "branch 3"]  # metres
    frame: Frame  # y: the direction of the branch at its start
    limb: Int[np.ndarray, " branch"]  # limb id its rows will carry
    order: Int[np.ndarray, " branch"]
    tree: Int[np.ndarray, " branch"]
    length: Float[np.ndarray, " branch"]  # metres still to grow
    grown: Float[np.ndarray, " branch"]  # metres of the limb that exist (0 for a new lateral)
    node: Int[np.ndarray, " branch"]  # number of its next node along the limb
    radius: Float[np.ndarray, " branch"]  # metres, where it starts
    bends: Bool[np.ndarray, " branch"]  # its first segment takes a block's apical angle (the tip of a drawn limb)

    def __len__(self) -> int:
        return len(self.row)

    def select(self, keep) -> "OpenBranches":
        """Only some of the branches, by mask or by rows."""
        return OpenBranches(**{f.name: getattr(self, f.name)[keep] for f in fields(self)})

    def join(self, other: "OpenBranches") -> "OpenBranches":
        """These branches and then those."""
        return OpenBranches(
            **{f.name: np.concatenate([getattr(self, f.name), getattr(other, f.name)]) for f in fields(self)}
        )


def polar(local: Float[np.ndarray, "child 3"]) -> tuple[Float[np.ndarray, " child"], Float[np.ndarray, " child"]]:
    """(divergence φ, orientation ϕ) of vectors in their parent's frame; the inverse of `direction`."""
    across = np.hypot(local[:, 0], local[:, 2])
    return np.arctan2(across, local[:, 1]), np.arctan2(local[:, 0], local[:, 2])


def direction(divergence: Float[np.ndarray, " child"], orientation: Float[np.ndarray, " child"]) -> Float[np.ndarray, "child 3"]:
    """R_y(ϕ) R_x(φ) e_y = (sin φ sin ϕ, cos φ, sin φ cos ϕ), in the parent's frame (§4)."""
    side = np.sin(divergence)
    return np.stack([side * np.sin(orientation), np.cos(divergence), side * np.cos(orientation)], axis=1)


def turn(
    frame: Frame,
    divergence: Float[np.ndarray, " branch"],
    orientation: Float[np.ndarray, " branch"],
    apical: Bool[np.ndarray, " branch"],
) -> Frame:
    """The frames of children at these angles: transported along the limb if apical, else turned to the
    plane of parent and child (module docstring)."""
    c, s, co, so = np.cos(divergence), np.sin(divergence), np.cos(orientation), np.sin(orientation)
    zero = np.zeros_like(c)
    local = np.empty((len(c), 3, 3))
    local[:, :, 1] = np.stack([s * so, c, s * co], axis=1)
    bent_x = np.stack([co, zero, -so], axis=1)  # R_y(ϕ) R_x(φ) e_x
    bent_z = np.stack([c * so, -s, c * co], axis=1)  # R_y(ϕ) R_x(φ) e_z
    spin_c, spin_s = np.where(apical, co, 1.0)[:, None], np.where(apical, so, 0.0)[:, None]
    local[:, :, 0] = spin_c * bent_x + spin_s * bent_z
    local[:, :, 2] = spin_c * bent_z - spin_s * bent_x
    return np.einsum("bij,bjk->bik", frame, local)


@lru_cache(maxsize=4)  # a skeleton is one frozen object for all that ask; what they get is read-only
def frames(tree: TreeSkeleton) -> Float[np.ndarray, "segment 3 3"]:
    """The frame of every row. A base stands upright: y up, z to the viewer. A row of zero length
    keeps its parent's frame."""
    frame = np.tile(np.eye(3), (len(tree), 1, 1))
    vector = tree.vector
    still = np.linalg.norm(vector, axis=1) == 0
    for rows in generations(tree.parent)[1:]:
        above = tree.parent[rows]
        local = np.einsum("cji,cj->ci", frame[above], vector[rows])
        divergence, orientation = polar(local)
        divergence = np.where(still[rows], 0.0, divergence)
        apical = (tree.limb[rows] == tree.limb[above]) | (np.sin(divergence) < 1e-9)
        frame[rows] = turn(frame[above], divergence, orientation, apical)
    frame.flags.writeable = False
    return frame


def levelled(frame: Frame, order: Int[np.ndarray, " branch"]) -> Frame:
    """The frames of limbs (order 1 and more), spun about their own direction until x lies level and z below it.

    What grows above a limb, beside and below it is decided by the vertical, however the limb came to where it is; a frame
    carried along a limb that winds has forgotten where that is. Limbs steeper than `_STEEP` and trunks keep theirs.
    """
    y = frame[:, :, 1]
    level = np.hypot(y[:, 0], y[:, 2])
    spun = (order > 0) & (level > _STEEP)
    x = np.stack([-y[:, 2], np.zeros(len(y)), y[:, 0]], axis=1) / np.where(level > _STEEP, level, 1.0)[:, None]
    fresh = np.stack([-x, y, np.cross(-x, y)], axis=2)
    return np.where(spun[:, None, None], fresh, frame)


def arc_length(tree: TreeSkeleton) -> Float[np.ndarray, " segment"]:
    """Length of every row along its drawn curve, metres."""
    count = np.diff(tree.curve_start)
    length = tree.length
    rows = np.flatnonzero(count)
    if len(rows):
        owner = np.repeat(np.arange(len(tree)), count)
        previous = np.concatenate([np.zeros((1, 3)), tree.curve_points[:-1]])
        first = tree.curve_start[rows]
        previous[first] = tree.start[rows]
        total = np.bincount(owner, np.linalg.norm(tree.curve_points - previous, axis=1), minlength=len(tree))
        last = tree.curve_points[tree.curve_start[rows + 1] - 1]
        length = length.copy()
        length[rows] = total[rows] + np.linalg.norm(tree.tip[rows] - last, axis=1)
    return length


@lru_cache(maxsize=4)
def limb_arcs(tree: TreeSkeleton) -> tuple[Float[np.ndarray, " segment"], Float[np.ndarray, " segment"]]:
    """(arc from the limb's insertion to each row's tip, length of the row's whole limb), metres."""
    step = arc_length(tree)
    arc = step.copy()
    same = (tree.parent != NULL) & (tree.limb == tree.limb[tree.parent])
    for rows in generations(tree.parent)[1:]:
        on = rows[same[rows]]
        arc[on] += arc[tree.parent[on]]
    _, limb = np.unique(tree.limb, return_inverse=True)
    whole = np.zeros(limb.max() + 1 if len(limb) else 0)
    np.maximum.at(whole, limb, arc)
    whole = whole[limb]
    arc.flags.writeable = whole.flags.writeable = False
    return arc, whole


def limb_positions(tree: TreeSkeleton) -> tuple[Float[np.ndarray, " segment"], Float[np.ndarray, " segment"]]:
    """(position of each row's tip along its limb, 0-1; length of its whole limb, metres)."""
    arc, whole = limb_arcs(tree)
    return arc / np.where(whole > 0, whole, 1.0), whole
