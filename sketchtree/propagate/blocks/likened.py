"""How does an exemplar's branching become more like what was drawn?

Trees differ more from one another than the orders of one tree do: on nine measured trees the mean divergence of order-2 laterals
lies within 5° (median) of the order-1 laterals' of the same tree, while exemplars of the best species are 10-40° off.
That is the self-similarity of Chen et al. 2008, §6, as statistics. So the exemplar's laterals of every order
are moved towards the drawn ones, n of them:

    φ' = φ + w Δ                                    a few long limbs were drawn; w Δ in whole steps of `STEP`
    φ' = w (Q(F_o(φ)) + δ) + (1 − w) P(F_o(φ))      the drawing is thorough (`thoroughness` t mixes the two)
    w  = n / (n + `EVIDENCE`)

    φ     divergence of a lateral, radians; where t > 0 also the log of its reach
    Δ     mean of the drawn laterals less that of the exemplar's laterals of the same orders
    F_o   rank of φ, 0-1, among the exemplar's laterals of its order o
    Q     quantiles of the drawn laterals: Q(F(φ)) makes one distribution the other (optimal transport on a line)
    P     quantiles of the laterals of order 2 and more of nine measured trees, nearly normal: what any tree is like
    δ     how much closer these stand than order 1 of the same tree (`DEEPER`); 0 for the reach
"""

from dataclasses import replace

import numpy as np
from jaxtyping import Float
from scipy.special import ndtri

from sketchtree.propagate.blocks.block import Blocks

EVIDENCE = 20.0  # laterals that the exemplar counts for, or all measured trees
STEP = np.radians(6.0)  # a drawing that is not thorough moves divergences by whole steps: a stroke more seldom moves the rest
DIVERGENCE = (np.radians(57.0), np.radians(26.0))  # mean and spread of the laterals of order 2 and more of nine measured trees
DEEPER = np.radians(-5.0)  # how much closer they stand than the order-1 laterals of the same tree
LOG_REACH = (np.log(0.14), 0.95)  # the same for the log of a limb's length over its parent limb's
BEHIND = (1.1, 0.12)  # of the way to its limb's tip, and of the limb: a reach is moved no farther than both together
_ANGLES = (np.radians(8.0), np.radians(130.0))
_REACH = (0.01, 2.0)
_FEWEST = 8  # drawn laterals of a trunk, to say how thoroughly it was drawn
_SHORT = 0.12  # of the way to the tip: on eight of nine measured trees 4 to 56 % of the trunk's laterals are shorter, in sketches hardly any
_SHORT_LIMBS = (0.1, 0.25)  # shares of them


def likened(supplement: Blocks, own: Blocks, thorough: float) -> Blocks:
    """The supplement's blocks with divergences and reaches moved towards the drawn ones (`thorough`: 0-1)."""
    divergence = _moved(supplement, own, lambda blocks: blocks.divergence, thorough, DIVERGENCE, DEEPER, STEP)
    reach = _moved(supplement, own, lambda blocks: np.log(np.maximum(blocks.reach, 1e-3)), thorough, LOG_REACH, 0.0, 0.0)
    lateral = ~supplement.apical
    behind = np.maximum(BEHIND[0] * (1.0 - supplement.position) + BEHIND[1], 0.0)[supplement.owner]
    reach = np.minimum(np.exp(reach), np.fmax(supplement.reach, behind))
    return replace(
        supplement,
        divergence=np.where(lateral, np.clip(divergence, *_ANGLES), supplement.divergence),
        reach=np.where(lateral, np.clip(reach, *_REACH), supplement.reach),
        droop=supplement.droop * (1.0 - thorough),
    )


def thoroughness(own: Blocks, supplement: Blocks) -> float:
    """0-1: was the tree drawn down to its small limbs, or only the long ones that people draw first?

    A lateral is as short as its reach over the way from it to its limb's tip: those near the top of a cone are no short ones. Of
    the exemplar's laterals on the trunk the shorter quarter counts as short, if below `_SHORT`. A drawing in which they are
    a tenth or fewer says nothing of short limbs (0); one in which a quarter are is thorough (1), and limbs it lacks are not there. One
    standard deviation of that share is put down to chance. The answer is 0, a half or 1, so that a stroke more seldom changes it."""
    drawn, lent = (_reach_of_the_way(blocks) for blocks in (own, supplement))
    if len(drawn) < _FEWEST or len(lent) == 0:
        return 0.0
    least, most = _SHORT_LIMBS
    by_chance = np.sqrt(least * (1.0 - least) / len(drawn))
    found = (np.mean(drawn < min(np.quantile(lent, 0.25), _SHORT)) - by_chance - least) / (most - least)
    return float(np.clip(np.round(2.0 * found) / 2.0, 0.0, 1.0) + 0.0)


def _reach_of_the_way(blocks: Blocks) -> Float[np.ndarray, " lateral"]:
    """Reaches of the laterals of order-0 limbs, each over `BEHIND` of the way to the limb's tip."""
    at = ~blocks.apical & (blocks.order[blocks.owner] == 0)
    return blocks.reach[at] / (BEHIND[0] * (1.0 - blocks.position[blocks.owner[at]]) + BEHIND[1])


def _moved(supplement: Blocks, own: Blocks, value, thorough: float, usual, deeper: float, step: float) -> Float[np.ndarray, " child"]:
    x, y = value(supplement), value(own)
    order, lateral = supplement.order[supplement.owner], ~supplement.apical
    orders = np.unique(order[lateral])
    drawn = own.order[own.owner]
    known = ~own.apical & np.isin(drawn, orders)
    n = np.sum(known)
    if n == 0:
        return x
    mean = {o: x[lateral & (order == o)].mean() for o in orders}
    w = n / (n + EVIDENCE)
    off = w * np.mean(y[known] - [mean[o] for o in drawn[known]])
    moved = x + step * np.round(off / step) if step else x.copy()
    for o in orders if thorough > 0 else ():
        rows = np.flatnonzero(lateral & (order == o))
        rank = (np.argsort(np.argsort(x[rows], kind="stable")) + 0.5) / len(rows)
        like = np.quantile(y[known], rank) + deeper * (o > drawn[known].min())
        like = w * like + (1.0 - w) * (usual[0] + usual[1] * ndtri(rank))
        moved[rows] += thorough * (like - moved[rows])
    return moved
