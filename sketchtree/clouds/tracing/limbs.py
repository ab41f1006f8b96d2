"""Which nodes are one branch, and which are no branch at all?

Of a node's children the one that bears most wood goes on as the same limb. A limb that lies along the bark of what bears it is part of that bark: a ring that was seen with gaps
falls into pieces. So is the beginning of one: the way to a bough may come round a gap and run along a strip of bark first.
"""

import numpy as np
from jaxtyping import Float, Int

from sketchtree.axes import NULL
from sketchtree.traverse import generations, limb_chains, sum_to_root

_BARK = 1.5  # radii from an axis that still belong to its bark
_MOSTLY = 0.75  # of a limb's nodes that lie there
_STUB = 2.0  # layers: a limb of one node that ends no farther from bark that was seen as such is part of it
_ALONG = 2.0  # radii: a limb that begins with as long a course on bark runs along it
_HOSTS = 2  # limbs that a limb may be bark of: what bears it, and what bears that


def steps(parent: Int[np.ndarray, " node"], centre: Float[np.ndarray, "node 3"]) -> Float[np.ndarray, " node"]:
    """Metres from every node's parent to it; 0 at a foot."""
    return np.where(parent == NULL, 0.0, np.linalg.norm(centre - centre[parent], axis=1))


def limbs_of(parent: Int[np.ndarray, " node"], centre: Float[np.ndarray, "node 3"]) -> Int[np.ndarray, " node"]:
    """The limb of every node, named by its first; nodes stand with parents first."""
    borne = sum_to_root(parent, steps(parent, centre) + 1e-9)
    child = np.flatnonzero(parent != NULL)
    rank = np.lexsort((-borne[child], parent[child]))
    best = np.r_[True, np.diff(parent[child][rank]) != 0][: len(rank)]
    goes_on = np.zeros(len(parent), bool)
    goes_on[child[rank[best]]] = True
    limb = np.arange(len(parent))
    for rows in generations(parent)[1:]:
        limb[rows] = np.where(goes_on[rows], limb[parent[rows]], rows)
    return limb


def bumps(
    parent: Int[np.ndarray, " node"], centre: Float[np.ndarray, "node 3"], limb: Int[np.ndarray, " node"], radius: Float[np.ndarray, " node"], width: Float[np.ndarray, " node"],
    strips: bool = False,
) -> Int[np.ndarray, " node"]:  # fmt: skip
    """The node whose bark every node is part of; its own where it is wood of its own. `radius`: of the wood, metres, 0 where it is not known;
    `width`: of its layer, metres. `strips`: a limb may also begin with a course on bark, where layers are as wide as the wood is thick."""
    part_of = np.arange(len(parent))
    chains = limb_chains(parent, limb)
    seen, radius = radius > 0, _between(chains, radius)
    whole = {int(rows[0]): rows for rows in chains}
    for rows in chains:
        foot = parent[rows[0]]
        for _ in range(_HOSTS):
            if foot == NULL:
                break
            host = whole[int(limb[foot])]
            apart = np.linalg.norm(centre[rows][:, None] - centre[host][None], axis=2)
            nearest = apart.argmin(axis=1)
            bark = np.maximum(_BARK * np.maximum(radius[host][nearest], radius[rows]), width[host][nearest])
            if len(rows) == 1 and seen[host[nearest[0]]]:
                bark += _STUB * width[rows]
            on_bark = apart[np.arange(len(rows)), nearest] < bark
            if on_bark.mean() >= _MOSTLY:
                part_of[rows] = host[nearest]
                break
            strip = _strip(on_bark, centre[rows], radius[host][nearest]) if strips else 0
            if strip:
                part_of[rows[:strip]] = host[nearest[:strip]]
                break
            foot = parent[host[0]]
    while (part_of[part_of] != part_of).any():
        part_of = part_of[part_of]
    return part_of


def _strip(on_bark, centre, radius) -> int:
    """How many nodes a limb begins with that run along the bark of what bears it, as a strip does that was seen beside a gap; 0 where it only leaves."""
    run = len(on_bark) if on_bark.all() else int((~on_bark).argmax())
    long = np.linalg.norm(np.diff(centre[:run], axis=0), axis=1).sum()
    return run if run > 1 and long > _ALONG * radius[:run].max() else 0


def _between(chains, radius):
    """Thickness where it is not known, as that of the nearest places of the limb where it is."""
    filled = radius.copy()
    for rows in chains:
        known = np.flatnonzero(radius[rows] > 0)
        if len(known):
            filled[rows] = np.interp(np.arange(len(rows)), known, radius[rows[known]])
    return filled
