"""Which replication block for which node?

Chen et al. 2008, §6: blocks are picked at random. Here the odds follow

    w(block | node) = exp(−Δo²/2τ_o²) exp(−Δu²/2τ_u²) max(P(angles | Θ), floor)

    Δo   difference of branching orders          τ_o   `ORDER_SD`, wider where there is no exemplar
    Δu   difference of places along the limb     τ_u   `POSITION_SD`
    P    likelihood of the block's angles under Θ, relative to its mode (§4)

Self-similarity needs enough to be similar to: a sketch of a trunk and four limbs says nothing about twigs. So the
tree's own blocks *claim* some of the slots of a table, each its own by hash, and an exemplar's (or the habit's)
blocks fill the rest. An own block claims the less, the fewer laterals it has for its order: of a whorl of
five one is drawn. One more stroke claims a few slots and leaves all other choices as they were.
"""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from jaxtyping import Float, Int

from sketchtree.limb_ids import child_limb_id
from sketchtree.parameters import TreeParameters
from sketchtree.propagate.blocks.block import Blocks, log_likelihood
from sketchtree.propagate.blocks.open_branch import limb_positions
from sketchtree.skeleton import TreeSkeleton

SLOTS = 256  # of each cell of the table
POSITION_BINS = 10  # of a limb
POSITION_SD = 0.05  # of the limb's length
ORDER_SD = 0.5  # where a supplement has blocks of every order
OWN_SHARE = 1 / 8  # of a cell's slots that one fitting block of the tree's own claims
_OWN_POSITION_SD = 0.2  # a sketch has few blocks, so each serves a longer stretch
_ENOUGH = 12  # blocks of an order: with fewer, those of the neighbouring orders serve too
_LEAST = 0.2  # an own block that fits a cell less than this claims nothing there, if there is a supplement


@dataclass(frozen=True, eq=False)
class Library:
    """Blocks, and for every order and place on a limb a table of slots to pick them from."""

    blocks: Blocks
    lateral: Int[np.ndarray, "order bin slot"]  # blocks that bear laterals, by place in the bearing zone
    apical: Int[np.ndarray, "order bin slot"]  # blocks whose limb goes on, by position along the limb
    bare: Float[np.ndarray, " order"]  # fraction of a limb before its first lateral
    spacing: Float[np.ndarray, " order"]  # between bearing nodes, over the tree's height; NaN unknown
    longest: Float[np.ndarray, " order"]  # limb, over the tree's height; inf unknown

    def choose(
        self,
        table: Int[np.ndarray, "order bin slot"],
        order: Int[np.ndarray, " node"],
        place: Float[np.ndarray, " node"],
        draw: Float[np.ndarray, " node"],
    ) -> Int[np.ndarray, " node"]:
        """A block for every node out of `lateral` or `apical`, by its order, its place (0-1) and a number in [0, 1)."""
        orders, bins, slots = table.shape
        return table[
            np.minimum(order, orders - 1),
            np.clip((place * bins).astype(np.int64), 0, bins - 1),
            (draw * slots).astype(np.int64),
        ]


def library(
    own: Blocks, supplement: Blocks, theta: TreeParameters, max_order: int, lender: TreeSkeleton | None, *, likened: bool = False
) -> Library:
    """The library of one run: the tree's own blocks, and those that fill in for what it lacks.

    `supplement` holds at least one block with a lateral and one that goes on; `lender` is the exemplar it was taken
    from, if any; `likened` blocks have the tree's angles already, so Θ weighs them no more. Orders that the supplement does not know are served by its nearest one.
    """
    orders = max_order + 1
    typical = np.array([_mean_laterals(supplement, order) for order in range(orders)])
    whole = np.minimum(own.lateral_count / np.maximum(typical[np.minimum(own.order, max_order)], 1.0), 1.0)
    fit, own_fit = np.ones(len(supplement)) if likened else _fit(supplement, theta), _fit(own, theta)
    blocks = _concatenate(own, supplement)
    return Library(
        blocks=blocks,
        lateral=_table(own, own_fit * whole, supplement, np.where(supplement.lateral_count > 0, fit, 0.0), orders, "zone"),
        apical=_table(
            own, own_fit * own.has_apical, supplement, np.where(supplement.has_apical, 1.0, 0.0), orders, "position"
        ),
        bare=np.array([first_lateral(supplement, order) for order in range(orders)]),
        spacing=np.array([lent_spacing(supplement, lender, order) for order in range(orders)]),
        longest=_longest(lender, orders),
    )


def _table(own, own_fit, supplement, fit, orders, place):
    """Blocks for every slot of every (order, place): the supplement's, but where an own block claims one."""
    table = np.empty((orders, POSITION_BINS, SLOTS), np.int64)
    known = np.unique(supplement.order[fit > 0])
    own_rows = np.flatnonzero(own_fit > 0)
    claim = _hash_uniform(own.id[own_rows], SLOTS)
    at = (np.arange(POSITION_BINS)[:, None] + 0.5) / POSITION_BINS
    own_near = _near(getattr(own, place)[own_rows] - at, _OWN_POSITION_SD)
    for order in range(orders):
        nearest = known[np.argmin(np.abs(known - order))]
        rows = np.flatnonzero((supplement.order == nearest) & (fit > 0))
        if len(rows) < _ENOUGH:
            rows = np.flatnonzero((np.abs(supplement.order - nearest) <= 1) & (fit > 0))
        base = fit[rows] * _near(supplement.order[rows] - nearest, ORDER_SD)
        weight = base * _near(getattr(supplement, place)[rows] - at, POSITION_SD)
        slots = len(own) + rows[_systematic(weight, order * POSITION_BINS)]
        near = own_fit[own_rows] * _near(own.order[own_rows] - order, ORDER_SD) * own_near
        for cell in range(POSITION_BINS):
            fits = near[cell] >= _LEAST
            table[order, cell] = _claimed(slots[cell], own_rows[fits], claim[fits], near[cell, fits] * OWN_SHARE)
    return table


def _claimed(slots, rows, claim, share):
    """The slots after each own block took the slots whose hash lies below its share; the lowest wins."""
    if len(share) == 0:
        return slots
    bid = np.where(claim < share[:, None], claim / np.maximum(share, 1e-12)[:, None], np.inf)
    best = np.argmin(bid, axis=0)
    return np.where(np.isfinite(bid[best, np.arange(SLOTS)]), rows[best], slots)


def _systematic(weight, first_cell):
    """Blocks in proportion to their weights (cell, block), spread over each cell's slots by a fixed shuffle."""
    total = np.cumsum(np.maximum(weight, 1e-12), axis=1)
    want = [(_shuffle(first_cell + cell) + 0.5) / SLOTS * total[cell, -1] for cell in range(len(weight))]
    found = np.array([np.searchsorted(total[cell], wanted) for cell, wanted in enumerate(want)])
    return found.clip(0, weight.shape[1] - 1)


@lru_cache(maxsize=1024)
def _shuffle(cell):
    return np.argsort(_hash_uniform(np.array([cell]), SLOTS)[0], kind="stable")


def _hash_uniform(ids, slots):
    """One number in [0, 1) for each id and slot; the same in every run."""
    word = child_limb_id(np.repeat(ids, slots), np.tile(np.arange(slots), len(ids)))
    return (word.reshape(len(ids), slots) / 2.0**63).clip(0, 1 - 1e-12)


def _near(difference, sd):
    return np.exp(-0.5 * (difference / sd) ** 2)


def _fit(blocks, theta):
    return np.exp(np.maximum(log_likelihood(blocks, theta), -4.0))


def _bearing(blocks, order):
    return (blocks.order == order) & (blocks.lateral_count > 0)


def _mean_laterals(blocks, order):
    count = blocks.lateral_count[_bearing(blocks, order)]
    return float(count.mean()) if len(count) else 1.0


def first_lateral(blocks, order):
    """Where the first laterals sit on limbs of this order; 15 % of the limb where nothing is known."""
    at = blocks.position[_bearing(blocks, order)]
    return float(np.quantile(at, 0.03)) if len(at) >= 3 else 0.15


def lent_spacing(blocks, lender, order):
    """Metres of limb per bearing node beyond the bare base, over the lender's height."""
    bearing = np.sum(_bearing(blocks, order))
    if lender is None or bearing < 4:
        return np.nan
    length = lender.length[lender.order == order].sum()
    return float(length * (1.0 - first_lateral(blocks, order)) / bearing / lender.height)


def _longest(lender, orders):
    """All but the longest twentieth of the lender's limbs are shorter; deeper orders as its deepest."""
    if lender is None:
        return np.full(orders, np.inf)
    _, whole = limb_positions(lender)
    known = [order for order in range(orders) if np.sum(lender.order == order) >= _ENOUGH]
    longest = {order: np.quantile(whole[lender.order == order], 0.95) / lender.height for order in known}
    return np.array([longest[max(k for k in known if k <= order)] if 0 in longest else np.inf for order in range(orders)])


def _concatenate(a: Blocks, b: Blocks) -> Blocks:
    names = ("id", "order", "position", "zone", "apical", "scale", "divergence", "orientation", "reach", "length", "droop")
    joined = {name: np.concatenate([getattr(a, name), getattr(b, name)]) for name in names}
    return Blocks(**joined, start=np.concatenate([a.start, a.start[-1] + b.start[1:]]))
