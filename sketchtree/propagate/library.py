"""Which replication block for which node?

Chen et al. 2008, §6: blocks are picked at random. Here the odds follow

    w(block | node) = exp(−Δo²/2τ_o²) exp(−Δu²/2τ_u²) max(P(angles | Θ), floor)

    Δo   difference of branching orders          τ_o   `ORDER_SD`, wider where there is no exemplar
    Δu   difference of positions along the limb  τ_u   `POSITION_SD`
    P    likelihood of the block's angles under Θ, relative to its mode (§4)

Self-similarity needs enough to be similar to: a sketch of a trunk and four limbs says nothing about twigs. So the
tree's own blocks *claim* some of the slots of a table, each its own by hash, and an exemplar's (or the habit's)
blocks fill the rest. One more stroke claims a few slots and leaves all other choices as they were.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int

from sketchtree.keys import child_limb_id
from sketchtree.parameters import TreeParameters
from sketchtree.propagate.block import Blocks, log_likelihood

SLOTS = 256  # of each cell of the table
POSITION_BINS = 10  # of a limb
POSITION_SD = 0.1  # of the limb's length
ORDER_SD = 0.5  # where a supplement has blocks of every order
OWN_SHARE = 1 / 8  # of a cell's slots that one fitting block of the tree's own claims
_LEAST = 0.2  # an own block that fits a cell less than this claims nothing there, if there is a supplement


@dataclass(frozen=True, eq=False)
class Library:
    """Blocks, and for every order and position along a limb a table of slots to pick them from."""

    blocks: Blocks
    table: Int[np.ndarray, "order bin slot"]  # block of each slot
    bare: Float[np.ndarray, " order"]  # fraction of a limb before its first lateral

    def choose(
        self,
        order: Int[np.ndarray, " node"],
        position: Float[np.ndarray, " node"],
        draw: Float[np.ndarray, " node"],
    ) -> Int[np.ndarray, " node"]:
        """A block for every node, by its order, its position along its limb (0-1) and a number in [0, 1)."""
        orders, bins, slots = self.table.shape
        return self.table[
            np.minimum(order, orders - 1),
            np.clip((position * bins).astype(np.int64), 0, bins - 1),
            (draw * slots).astype(np.int64),
        ]


def library(own: Blocks, supplement: Blocks, theta: TreeParameters, max_order: int) -> Library:
    """The library of one run: the tree's own blocks, and those that fill in for what it lacks.

    `supplement` must not be empty. Cells of orders that the supplement does not know are filled from its
    nearest order.
    """
    orders = max(max_order, 1)
    table = np.empty((orders, POSITION_BINS, SLOTS), np.int64)
    known = np.unique(supplement.order)
    spare_fit, own_fit = _fit(supplement, theta), _fit(own, theta)
    claim = _hash_uniform(own.id, SLOTS)
    for order in range(orders):
        nearest = known[np.argmin(np.abs(known - order))]
        for cell in range(POSITION_BINS):
            at = (cell + 0.5) / POSITION_BINS
            weight = spare_fit * _near(supplement.order - nearest, ORDER_SD) * _near(supplement.position - at, POSITION_SD)
            slots = len(own) + _systematic(weight, order * POSITION_BINS + cell)
            near = own_fit * _near(own.order - order, ORDER_SD) * _near(own.position - at, 2 * POSITION_SD)
            near = np.where(near < _LEAST, 0.0, near)
            table[order, cell] = _claimed(slots, claim, near * OWN_SHARE)
    bare = np.array([_first_lateral(supplement, order) for order in range(orders)])
    return Library(_concatenate(own, supplement), table, bare)


def _claimed(slots, claim, share):
    """The slots after each own block took the slots whose hash lies below its share; the lowest wins."""
    if len(share) == 0:
        return slots
    bid = np.where(claim < share[:, None], claim / np.maximum(share, 1e-12)[:, None], np.inf)
    best = np.argmin(bid, axis=0)
    return np.where(np.isfinite(bid[best, np.arange(SLOTS)]), best, slots)


def _systematic(weight, cell):
    """Blocks in proportion to their weights, spread over the slots by a fixed shuffle."""
    total = np.cumsum(np.maximum(weight, 1e-12))
    shuffle = np.argsort(_hash_uniform(np.array([cell]), SLOTS)[0], kind="stable")
    return np.searchsorted(total, (shuffle + 0.5) / SLOTS * total[-1]).clip(0, len(weight) - 1)


def _hash_uniform(ids, slots):
    """One number in [0, 1) for each id and slot; the same in every run."""
    word = child_limb_id(np.repeat(ids, slots), np.tile(np.arange(slots), len(ids)))
    return (word.reshape(len(ids), slots) / 2.0**63).clip(0, 1 - 1e-12)


def _near(difference, sd):
    return np.exp(-0.5 * (difference / sd) ** 2)


def _fit(blocks, theta):
    return np.exp(np.maximum(log_likelihood(blocks, theta), -4.0))


def _first_lateral(blocks, order):
    """Where the first laterals sit on limbs of this order; 15 % of the limb where nothing is known."""
    at = blocks.position[blocks.order == order]
    return float(np.quantile(at, 0.03)) if len(at) >= 8 else 0.15


def _concatenate(a: Blocks, b: Blocks) -> Blocks:
    names = ("id", "order", "position", "apical", "scale", "divergence", "orientation", "reach")
    joined = {name: np.concatenate([getattr(a, name), getattr(b, name)]) for name in names}
    return Blocks(**joined, start=np.concatenate([a.start, a.start[-1] + b.start[1:]]))
