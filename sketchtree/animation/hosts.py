"""Which limbs move by themselves, and how finely?

    by nodes    a joint at the foot and one at every node, each as large as the wood is thick there: stems, and what bears other limbs
    as one      a single joint: twigs, which stretch from their feet
    ridden      none: what is beyond the number of joints moves with what it grows from

Joints go first to the limbs that carry most wood. A limb by nodes grows from a limb by nodes.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Float, Int

from sketchtree.axes import NULL
from sketchtree.geometry.limbs import CentreLines
from sketchtree.growth.straight import Straight
from sketchtree.rig.boughs import Boughs, limb_of_row
from sketchtree.rig.place import Places, places_on

_SAME = 1e-9  # metres along a limb: nodes that are nearer are one


@dataclass(frozen=True, eq=False)
class Nodes:
    """The ends of the straight pieces, as places on the limbs; ragged: limb i owns the nodes start[i]:start[i + 1], from its foot to its tip."""

    start: Int[np.ndarray, " limb+1"]
    piece: Int[np.ndarray, " node"]
    s: Float[np.ndarray, " node"]  # metres along the limb, rising

    @classmethod
    def of(cls, straight: Straight, lines: CentreLines) -> "Nodes":
        """The nodes of all limbs that have a line; bases have none."""
        pieces = straight.pieces
        limb = limb_of_row(straight.tree, lines)[straight.row]
        piece = np.flatnonzero((limb != NULL) & ~pieces.is_base)
        s = places_on(lines, limb[piece], pieces.tip[piece]).s
        order = np.lexsort((s, limb[piece]))
        piece, s = piece[order], s[order]
        limb = limb[piece]
        new = np.r_[True, (np.diff(limb) != 0) | (np.diff(s) > _SAME)][: len(piece)] & (s > _SAME)
        return cls(np.r_[0, np.cumsum(np.bincount(limb[new], minlength=len(lines)))].astype(np.int64), piece[new], s[new])

    @property
    def count(self) -> Int[np.ndarray, " limb"]:
        """How many each limb has."""
        return np.diff(self.start)


@dataclass(frozen=True, eq=False)
class Hosts:
    """One row a limb of the centre lines."""

    first: Int[np.ndarray, " limb"]  # number of its first joint, that of its foot, counted from 0; NULL: it has none
    joints: Int[np.ndarray, " limb"]  # how many it has: 0 ridden, 1 as one, else by nodes
    by_nodes: Bool[np.ndarray, " limb"]
    count: int  # joints in all


def choose_hosts(lines: CentreLines, limbs: Boughs, nodes: Nodes, most: int, *, twins: bool = False) -> Hosts:
    """The limbs that get joints, at most `most` in all (≥ the number of stems). `twins`: every joint of a limb by nodes will have a twin, which counts too."""
    order = np.lexsort((np.arange(len(lines)), -limbs.carried, lines.parent != NULL))
    alone = order[: max(most // 2, int((lines.parent == NULL).sum()))]
    has = np.zeros(len(lines), bool)
    has[alone] = True
    bears = np.zeros(len(lines), bool)
    bears[lines.parent[lines.parent != NULL]] = True
    wanted = np.where(bears | (nodes.count > 2) | (lines.parent == NULL), nodes.count, 0)
    cost = np.where(twins, 2 * wanted + 1, wanted)
    left, by_nodes = most - len(alone), np.zeros(len(lines), bool)
    for limb in alone.tolist():
        above = lines.parent[limb]
        if wanted[limb] and cost[limb] <= left and (above == NULL or by_nodes[above]):
            by_nodes[limb] = True
            left -= int(cost[limb])
    for limb in order[len(alone) :][:left].tolist():
        has[limb] = lines.parent[limb] == NULL or has[lines.parent[limb]]
    joints = np.where(has, 1 + np.where(by_nodes, wanted, 0), 0)
    first = np.cumsum(joints) - joints
    return Hosts(np.where(has, first, NULL), joints, by_nodes, int(joints.sum()))


def hosted(lines: CentreLines, limbs: Boughs, hosts: Hosts, place: Places) -> Places:
    """The places, those on limbs without joints moved down to where what bears them comes out of a limb that has some."""
    limb, s = place.limb.copy(), place.s.copy()
    while (ridden := hosts.first[limb] == NULL).any():
        s[ridden] = limbs.exit_s[limb[ridden]]
        limb[ridden] = lines.parent[limb[ridden]]
    return Places(limb, s)
