"""What does a replication block look like, once attached to a node?

Chen et al. 2008, §6: the block is scaled and oriented in the frame of the branch it is attached to, and its
children inherit its angles; Θ's spread (§4) keeps copies from being copies:

    φ' = φ + κ σ_φ ε₁        ϕ' = ϕ + κ σ_γ ε₂        length' = reach · |limb| · exp(0.1 ε₃)

    φ, ϕ   divergence and orientation of the block's child, radians
    σ_φ    σ_α of an apical child, σ_β of a lateral one
    κ      `spread`, the share of Θ's spread that is added to what the blocks differ by themselves
    ε      standard normal numbers of the child's own limb id

On an excurrent limb (one whose tip stays ahead) no lateral is longer than half its way to the tip. The children of
a level limb alternate: a block is mirrored in the plane of limb and parent limb
(ϕ → −ϕ) where it would put its lateral on the side of the previous one. On a trunk, nodes turn by the habit's
phyllotaxis instead.
"""

from dataclasses import dataclass, fields

import numpy as np
from jaxtyping import Array, Float, Int, Key

from sketchtree import keys, limb_ids
from sketchtree.parameters import Habit, TreeParameters
from sketchtree.propagate.blocks.block import Blocks
from sketchtree.propagate.blocks.open_branch import Frame, OpenBranches, levelled, turn

RANKS = 64  # ranks along a limb are 64 · node + 1 + number of the lateral at that node
MINIMUM_LENGTH = 0.6  # of the habit's twig length: shorter laterals are not grown
LARGEST_REACH = 1.5  # of the habit's ratio of lateral to limb: longer children of a block are forks of it
EXCURRENT = 0.7  # apical control from which a limb's tip stays ahead of its laterals
_CONE = 0.5  # of the way to that tip: no lateral of it is longer
_LENGTH_SD = 0.1
_STOUTNESS = 0.02  # radius over length of a new limb, at most


@dataclass(frozen=True, eq=False)
class Nodes:
    """One row a node that may bear laterals."""

    row: Int[np.ndarray, " node"]  # row of the skeleton that ends there
    tip: Float[np.ndarray, "node 3"]
    frame: Frame
    limb: Int[np.ndarray, " node"]
    order: Int[np.ndarray, " node"]
    tree: Int[np.ndarray, " node"]
    number: Int[np.ndarray, " node"]  # along the limb
    position: Float[np.ndarray, " node"]  # 0-1 along the limb
    zone: Float[np.ndarray, " node"]  # 0-1 from where the limb may bear laterals to its tip; < 0 before
    whole: Float[np.ndarray, " node"]  # length of the whole limb once grown, metres
    radius: Float[np.ndarray, " node"]

    def __len__(self) -> int:
        return len(self.row)

    @property
    def id(self) -> Int[np.ndarray, " node"]:
        """What the node's random numbers are drawn by."""
        return limb_ids.child_limb_id(self.limb, self.number * RANKS)

    def join(self, other: "Nodes") -> "Nodes":
        """These nodes and then those."""
        return Nodes(**{f.name: np.concatenate([getattr(self, f.name), getattr(other, f.name)]) for f in fields(self)})

    def select(self, keep) -> "Nodes":
        """Only some of the nodes, by mask or by rows."""
        return Nodes(**{f.name: getattr(self, f.name)[keep] for f in fields(self)})


def attach(
    nodes: Nodes,
    block: Int[np.ndarray, " node"],
    blocks: Blocks,
    habit: Habit,
    theta: TreeParameters,
    key: Key[Array, ""],
    *,
    spread: float = 0.35,
) -> OpenBranches:
    """The open branches that the laterals of these blocks make, one block a node (Chen §6).

    `spread` is κ. Laterals shorter than `MINIMUM_LENGTH` twig lengths are left out.
    """
    at, child, rank = _laterals(blocks, block)
    limb = limb_ids.child_limb_id(nodes.limb[at], nodes.number[at] * RANKS + 1 + rank)
    reach = np.minimum(blocks.reach[child], LARGEST_REACH * habit.lateral_ratio)
    length = reach * nodes.whole[at] * np.exp(_LENGTH_SD * keys.normal(key, limb, 0))
    if habit.apical_control >= EXCURRENT:
        to_tip = (1.0 - nodes.position[at]) * nodes.whole[at]
        length = np.minimum(length, _CONE * to_tip + MINIMUM_LENGTH * habit.twig_length)
    keep = length >= MINIMUM_LENGTH * habit.twig_length
    at, child, rank, limb, length = (column[keep] for column in (at, child, rank, limb, length))

    divergence = blocks.divergence[child] + spread * theta.sigma_beta * keys.normal(key, limb, 1)
    orientation = _orientation(nodes, at, child, block, blocks, habit, key)
    orientation = orientation + spread * theta.sigma_gamma * keys.normal(key, limb, 2)
    frame = turn(levelled(nodes.frame[at], nodes.order[at]), np.abs(divergence), orientation, np.zeros(len(at), bool))
    return OpenBranches(
        row=nodes.row[at],
        origin=nodes.tip[at],
        frame=frame,
        limb=limb,
        order=nodes.order[at] + 1,
        tree=nodes.tree[at],
        length=length,
        grown=np.zeros(len(at)),
        node=np.zeros(len(at), np.int64),
        radius=np.minimum(nodes.radius[at] * np.clip(length / nodes.whole[at], 0.15, 0.65), _STOUTNESS * length),
        bends=np.zeros(len(at), bool),
    )


def _laterals(blocks, block):
    """(node, child, rank at the node) of every lateral of every node's block."""
    first = blocks.start[block] + blocks.apical[blocks.start[block]]
    count = blocks.start[block + 1] - first
    at = np.repeat(np.arange(len(block)), count)
    rank = np.arange(len(at)) - np.repeat(np.cumsum(count) - count, count)
    return at, first[at] + rank, rank


def _orientation(nodes, at, child, block, blocks, habit, key):
    """The blocks' own azimuths, mirrored to alternate along limbs, turned to spiral up trunks."""
    own = blocks.orientation[child]
    lead = blocks.start[block] + blocks.apical[blocks.start[block]]
    first = blocks.orientation[lead]
    phase = keys.uniform(key, nodes.limb, 3)
    left = (nodes.number + (phase < 0.5)) % 2 == 0
    mirror = np.where((np.sin(first) > 0) == left, 1.0, -1.0)
    spiral = 2 * np.pi * phase + nodes.number * np.radians(habit.phyllotaxis) - first
    return np.where(nodes.order[at] == 0, own + spiral[at], own * mirror[at])
