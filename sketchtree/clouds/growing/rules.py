"""What becomes of buds that grow in one cycle?

Guo et al. 2018, L-system 1:

    Seed(p, v)     → A(p, v)
    A(p, v)        → { Metamer(p', v')* } A(p'', v'')
    Metamer(p, v)  → Internode(p, v) L(p', v')
    L(p, v)        → A(p', v')

    A   apical bud       L   lateral bud, which next cycle is the apical bud of an axis of its own       *   up to ρ_t times

A shoot is as long as it is from the bud to the centroid of the points that it perceives, a whole number of internodes, ρ_t at most. `steered` shoots turn towards those of their points
that still lie ahead at every internode, and end where none does (ours); the paper's are straight.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int
from scipy.spatial import cKDTree

from sketchtree import keys
from sketchtree.axes import NULL
from sketchtree.clouds.growing.heading import decided, headed, optimal, unit
from sketchtree.clouds.growing.metamer import Buds, branched, carried, rolled
from sketchtree.clouds.growing.species import Species
from sketchtree.clouds.growing.wanted import Growing

_THICK = 1.5  # internodes: the radius of thick wood
_LATERAL = 0.5  # of an axis' thickness that its laterals come to have


@dataclass(frozen=True, eq=False)
class Seen:
    """What growing buds perceive: pairs of a bud and a point."""

    bud: Int[np.ndarray, " pair"]
    point: Float[np.ndarray, "pair 3"]
    weight: Float[np.ndarray, " pair"]


@dataclass(frozen=True, eq=False)
class Shoots:
    """What has grown: nodes in the order in which they are to be appended, and their buds."""

    parent: Int[np.ndarray, " node"]
    place: Float[np.ndarray, "node 3"]
    thick: Float[np.ndarray, " node"]
    buds: Buds


def shoots(grows: Buds, seen: Seen, most: float, first: int, species: Species, wanted: Growing, taper: float, word: np.uint64) -> Shoots:
    """One shoot of every bud, each of which perceives a point. `most`: ρ_t; `first`: number of the first new node; `taper`: metres of thickness lost a metre; `word`: of a key."""
    l, count = species.internode, len(grows)  # noqa: E741 (the paper's letter)
    centroid = optimal(seen.point, np.ones(len(seen.bud)), seen.bud, count)
    number = np.clip(np.rint(np.linalg.norm(centroid - grows.place, axis=1) / l), 1, max(1, int(most))).astype(int)
    place, heading, side, node, thick, length = (getattr(grows, name).copy() for name in ("place", "heading", "side", "node", "thick", "length"))
    parents, places, thicks, buds = [], [], [], []
    for i in range(int(number.max())):
        best, ahead = _best(place, heading, thick, l, seen, i, wanted)
        number = np.where((number > i) & ~ahead & (i > 0), i, number)
        rows = np.flatnonzero(number > i)
        if not len(rows):
            break
        if i == 0 or wanted.steered:
            heading[rows] = headed(heading[rows], best[rows], np.asarray(wanted.tropism), wanted.alpha, wanted.beta)
        side[rows] = carried(side[rows], heading[rows])
        place[rows] += l * heading[rows]
        length[rows] += l
        thick[rows] = np.maximum(thick[rows] - l * taper, 0.0)
        new = first + np.arange(len(rows))
        first += len(rows)
        parents.append(node[rows])
        places.append(place[rows].copy())
        thicks.append(thick[rows].copy())
        node[rows] = new
        psi, phi = (np.radians(angle + wanted.spread * keys.normal(word, new, draw)) for draw, angle in enumerate((species.branching, species.roll)))
        lateral = branched(heading[rows], side[rows], psi)
        buds.append(Buds(place[rows].copy(), lateral, carried(-side[rows], lateral), new, _LATERAL * thick[rows], length[rows].copy(), grows.root[rows]))
        side[rows] = rolled(side[rows], heading[rows], phi)
    buds.append(Buds(place, heading, side, node, thick, length, grows.root))
    return Shoots(np.concatenate(parents), np.concatenate(places), np.concatenate(thicks), Buds.joined(buds))


def _best(place, heading, thick, length: float, seen: Seen, i: int, wanted: Growing):
    """(V_opt of every bud, whether any of its points lies ahead)."""
    count = len(place)
    if i and not wanted.steered:
        return heading, np.ones(count, bool)
    way = seen.point - place[seen.bud]
    far = np.linalg.norm(way, axis=1)
    way = way / np.maximum(far, 1e-12)[:, None]
    inside = (far > 1e-9) & (np.einsum("pi,pi->p", way, heading[seen.bud]) >= np.cos(np.radians(wanted.theta / 2)) - 1e-9)
    bud, way, weight = seen.bud[inside], way[inside], seen.weight[inside]
    best = optimal(way, weight, bud, count)
    if wanted.decided:  # a bud of thick wood stands among points of its own bark: it keeps to their middle
        best = np.where((thick > _THICK * length)[:, None], best, decided(way, weight, bud, unit(best)))
    return best, np.bincount(bud, minlength=count) > 0


def pairs(holder: Int[np.ndarray, " point"], point: Float[np.ndarray, "point 3"], weight: Float[np.ndarray, " point"], least: int) -> tuple[Int[np.ndarray, " grows"], Seen]:
    """(buds that perceive `least` points or more, what they perceive)."""
    held = np.flatnonzero(holder != NULL)
    bud, inverse, count = np.unique(holder[held], return_inverse=True, return_counts=True)
    enough = count >= least
    number = np.cumsum(enough) - 1
    kept = enough[inverse]
    return bud[enough], Seen(number[inverse[kept]], point[held[kept]], weight[held[kept]])


def one_each(grows: Int[np.ndarray, " grows"], seen: Seen, place: Float[np.ndarray, "bud 3"], apart: float) -> tuple[Int[np.ndarray, " kept"], Seen]:
    """One bud for each place that buds grow for: that with the most points, of several the nearest. The others wait, so that no limb is a bundle of shoots."""
    count = len(grows)
    centroid = optimal(seen.point, np.ones(len(seen.bud)), seen.bud, count)
    far = np.linalg.norm(centroid - place[grows], axis=1)
    close = cKDTree(centroid).query_ball_point(centroid, apart)
    kept, open_ = np.zeros(count, bool), np.ones(count, bool)
    for bud in np.lexsort((far, -np.bincount(seen.bud, minlength=count))):
        if open_[bud]:
            kept[bud] = True
            open_[close[bud]] = False
    number = np.cumsum(kept) - 1
    mine = kept[seen.bud]
    return grows[kept], Seen(number[seen.bud[mine]], seen.point[mine], seen.weight[mine])
