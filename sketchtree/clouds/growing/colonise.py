"""How does a tree come to its points, cycle after cycle?

    every bud perceives points (`perception`) → buds that do grow a shoot towards them (`rules`, `heading`) → points near new wood are taken → what can't be is shed (`shedding`)

until no bud sees a point any more. Several roots are one set of buds: a point goes to the nearest bud, whichever root that grew from, so roots compete.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int
from scipy.spatial import cKDTree

from sketchtree.axes import NULL
from sketchtree.clouds.growing.logistic import Influence
from sketchtree.clouds.growing.markers import Markers
from sketchtree.clouds.growing.metamer import Buds
from sketchtree.clouds.growing.patience import Patience
from sketchtree.clouds.growing.perception import Detour, perceived, taken, workers
from sketchtree.clouds.growing.rules import one_each, pairs, shoots
from sketchtree.clouds.growing.shedding import buried
from sketchtree.clouds.growing.species import Species
from sketchtree.clouds.growing.thickness import radii
from sketchtree.clouds.growing.wanted import Growing
from sketchtree.clouds.growing.wood import Wood
from sketchtree.watch import Pulse, no_pulse

_LOOKS, _TAKES = 5.0, 1.3  # radii of thick wood that its bud looks at least, and that are taken
_BARK = 1.3  # radii within which points are bark
_TIDIES, _HOPES = 4, 12  # cycles between two looks for what can't be, and for buds that will never grow
_CYCLES = 1000


@dataclass(frozen=True, eq=False)
class Colonised:
    """What has grown, and in how many cycles."""

    wood: Wood
    cycles: int
    left: int  # points that nothing came to


def colonise(
    markers: Markers,
    wood: Wood,
    buds: Buds,
    influence: Influence,
    species: Species,
    wanted: Growing,
    root: Float[np.ndarray, " node"],
    word: np.uint64,
    pulse: Pulse = no_pulse,
) -> Colonised:
    """Wood grown on until no bud sees a point. `root`: radius at the bases of `wood`, anything elsewhere; `word`: of a key (`keys.draw_key`)."""
    points, alive, begun = cKDTree(markers.xyz), np.ones(len(markers.xyz), bool), len(wood)
    taper = float(buds.thick.max(initial=0.0)) / max(float(np.ptp(markers.xyz[:, 1])), 1e-9)
    l, cycle, last, patience = species.internode, 0, 0, Patience(influence, wanted)  # noqa: E741 (the paper's letter)
    while cycle < _CYCLES and len(buds) and alive.any():
        pulse()
        look, known, rows = patience.look(cycle) * l, takes(cycle, influence, wanted) * l, np.flatnonzero(alive)
        detour = Detour(buds.length, wood.place[buds.root], patience.detour)
        holder = perceived(markers.xyz[rows], buds.place, buds.heading, np.maximum(look, _LOOKS * buds.thick), wanted.theta, detour)
        grow, seen = pairs(holder, markers.xyz[rows], markers.weight[rows], patience.least)
        cycle += 1
        if not len(grow):
            if not patience.lost(cycle - 1):
                break
            continue
        if wanted.dominant:
            grow, seen = one_each(grow, seen, buds.place, max(known, 0.5 * look if patience.wider > 1.0 else 0.0))
        patience.grew()
        new = shoots(buds.select(grow), seen, look / l, len(wood), species, wanted, taper, word)
        alive[taken(points, new.place, np.maximum(known, _TAKES * new.thick))] = False
        buds = Buds.joined([buds.select(~np.isin(np.arange(len(buds)), grow)), new.buds])
        wood, last = wood.with_nodes(new.parent, new.place, cycle), cycle
        if cycle % _TIDIES == 0:
            alive[_in_wood(points, wood, root, species.gamma, known)] = False
            wood, buds = _tidied(wood, buds, root, species, wanted, cycle, begun)
        if cycle % _HOPES == 0 and influence.falling(cycle):
            buds = _hopeful(buds, markers.xyz[alive], patience.farthest * l)
    if wanted.sheds:
        wood, _ = _tidied(wood, buds, root, species, wanted, cycle + _TIDIES, begun)
    return Colonised(wood, last, int(alive.sum()))


def takes(cycle: int, influence: Influence, wanted: Growing) -> float:
    """d_k, internodes: points so near to new wood are taken."""
    return wanted.kill * (wanted.least if wanted.holds and wanted.influence is None else influence(cycle))


def _tidied(wood: Wood, buds: Buds, root, species: Species, wanted: Growing, cycle: int, begun: int) -> tuple[Wood, Buds]:
    """Without branches that can't be, and without their buds."""
    if not wanted.sheds:
        return wood, buds
    rows = wood.standing()
    place = np.append(np.full(len(wood), NULL), NULL)
    place[rows] = np.arange(len(rows))
    thick = np.append(root, np.ones(len(wood) - len(root)))
    young = (wood.born[rows] > cycle - _TIDIES) | (rows < begun)
    bad = buried(place[wood.parent[rows]], wood.place[rows], thick[rows], species.gamma, young)
    shed = np.zeros(len(wood), bool)
    shed[rows[bad]] = True
    return wood.without(shed, cycle), buds.select(~shed[buds.node])


def _in_wood(points: cKDTree, wood: Wood, root, gamma: float, known: float) -> Int[np.ndarray, " point"]:
    """Points of bark: within wood that is so far, by Eq. 5, thicker than the distance within which points are taken anyhow."""
    rows = wood.standing()
    number = np.append(np.full(len(wood), NULL), NULL)
    number[rows] = np.arange(len(rows))
    radius = _BARK * radii(number[wood.parent[rows]], wood.step()[rows], np.append(root, np.ones(len(rows) - len(root))), gamma)
    thick = radius > known
    return taken(points, wood.place[rows[thick]], radius[thick])


def _hopeful(buds: Buds, xyz, far: float) -> Buds:
    """Buds with a point within so many metres: all others wait in vain."""
    if not len(xyz):
        return buds.select(np.zeros(len(buds), bool))
    distance, _ = cKDTree(xyz).query(buds.place, distance_upper_bound=max(far, _LOOKS * float(buds.thick.max(initial=0.0))), workers=workers(len(buds)))
    return buds.select(np.isfinite(distance))
