"""Which limbs are only points that lie off the wood that bears them?

Points scatter round bark, and the layers of thin wood are thin, so a point that lies a little aside becomes a node, and the node a limb. Such a *spur* bears no other limb, and its end lies
no farther off the bark of what bears it than

    most(scatter · noise, spaced · spacing)

    noise     how far points typically lie off the bark where it was seen      spacing     from point to point on what bears it, there

It is part of that wood. And where the way to the end of a limb *leaps*, over several spacings and farther than all that it leads to is long, nobody saw that those points are joined to
it: they are of no limb.
"""

import numpy as np
from jaxtyping import Float, Int

from sketchtree.axes import NULL
from sketchtree.traverse import limb_chains

SCATTER, SPACED = 3.0, 0.6
LEAP, USUAL = 4.0, 1.5  # spacings; and how much of the tree's own spacing counts where points are sparser
_BESIDE = 8  # nodes of what bears it, before and after its foot, that its end may lie beside


def spurs(
    parent: Int[np.ndarray, " node"],
    centre: Float[np.ndarray, "node 3"],
    end: Float[np.ndarray, "node 3"],
    limb: Int[np.ndarray, " node"],
    radius: Float[np.ndarray, " node"],
    spacing: Float[np.ndarray, " node"],
    noise: float,
) -> Int[np.ndarray, " node"]:
    """The node that every node is part of: its own; for a spur's the nearest of what bears it; NULL beyond a leap. `end`: the point of each node that is farthest from the foot, metres;
    `radius`: metres, 0 where it is not known; `spacing`, `noise`: metres. Nodes stand with parents first."""
    part_of, chains = np.arange(len(parent)), limb_chains(parent, limb)
    whole = {int(rows[0]): rows for rows in chains}
    usual = USUAL * float(np.median(spacing))
    last = {}  # of every limb, by its first node, the place on it of the last node that bears a limb
    for first in sorted(whole, reverse=True):
        rows, foot = whole[first], parent[first]
        if foot == NULL:
            continue
        rows = rows[: _seen(np.r_[foot, rows], last.get(first, -1), centre, spacing, usual)]
        part_of[whole[first][len(rows) :]] = NULL
        host = whole[int(limb[foot])]
        at = int(np.searchsorted(host, foot))
        if first not in last and (not len(rows) or _is_off(rows, host[max(0, at - _BESIDE) : at + _BESIDE + 1], centre, end, radius, spacing, noise, part_of)):
            continue
        last[int(limb[foot])] = max(last.get(int(limb[foot]), -1), at)
    return part_of


def _is_off(rows, beside, centre, end, radius, spacing, noise: float, part_of) -> bool:
    """Whether a limb is a spur of the nodes beside it; if so it is made part of them."""
    out = np.linalg.norm(centre[beside] - end[rows[-1]], axis=1)
    nearest = int(out.argmin())
    if out[nearest] - radius[beside[nearest]] > max(SCATTER * noise, SPACED * spacing[beside[nearest]]):
        return False
    part_of[rows] = beside[np.linalg.norm(centre[rows][:, None] - centre[beside][None], axis=2).argmin(axis=1)]
    return True


def _seen(way, bears: int, centre, spacing, usual: float) -> int:
    """How many nodes of a limb, from what it hangs on outwards, are there before a leap. `bears`: the last that bears a limb, which stays."""
    step = np.linalg.norm(np.diff(centre[way], axis=0), axis=1)
    beyond = np.cumsum(step[::-1])[::-1] - step
    leap = (step > LEAP * np.minimum(spacing[way[:-1]], usual)) & (step > beyond)
    leap[: bears + 1] = False
    return int(leap.argmax()) if leap.any() else len(step)
