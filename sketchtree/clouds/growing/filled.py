"""What else grows inside a crown that was seen from outside only?

Guo et al. 2018, §6.1 and Figure 8, for a tree that stands already, however it was found: buds all along its wood grow towards points of the unseen inside (`hull_fill`).
What they grow is thick by Eq. 5, with d_root / l_root^γ as the standing wood has it, and no thicker than what bears it.
"""

import dataclasses

import numpy as np
from jaxtyping import Array, Float, Key
from scipy.spatial import cKDTree

from sketchtree import keys
from sketchtree.axes import NULL
from sketchtree.clouds.growing.box import SIDE, boxed
from sketchtree.clouds.growing.colonise import colonise
from sketchtree.clouds.growing.grown import APART, THINNEST, influence_of
from sketchtree.clouds.growing.heading import unit
from sketchtree.clouds.growing.hull_fill import crown_of, hull_fill
from sketchtree.clouds.growing.markers import Markers
from sketchtree.clouds.growing.metamer import Buds, branched, carried, rolled
from sketchtree.clouds.growing.perception import KILL
from sketchtree.clouds.growing.species import Species
from sketchtree.clouds.growing.wanted import Growing
from sketchtree.clouds.growing.wood import Wood
from sketchtree.similarity import Similarity
from sketchtree.skeleton import Kind, TreeSkeleton
from sketchtree.skeleton_rows import limbs
from sketchtree.traverse import generations, sum_from_root, sum_to_root
from sketchtree.watch import Pulse, no_pulse


def filled(
    tree: TreeSkeleton, xyz: Float[np.ndarray, "point 3"], species: Species, *, key: Key[Array, ""], wanted: Growing | None = None, pulse: Pulse = no_pulse
) -> TreeSkeleton:
    """The tree and, after its own rows, those that fill its inside (kind GROWN). `xyz`: the cloud that it was made of, metres; `wanted`: how, if not as the species says."""
    box = boxed(xyz)
    inside, apart = box.to_sketch(xyz), APART * species.internode
    more = hull_fill(crown_of(inside), apart, key=keys.stage_key(key, "fill"), clear=apart)
    return reaching(tree, box, more, float(np.ptp(inside[:, 1])), species, key=key, wanted=wanted, pulse=pulse)


def reaching(
    tree: TreeSkeleton,
    box: Similarity,
    points: Float[np.ndarray, "point 3"],
    high: float,
    species: Species,
    *,
    key: Key[Array, ""],
    wanted: Growing | None = None,
    pulse: Pulse = no_pulse,
) -> TreeSkeleton:
    """The tree and, after its own rows, those that grow from it to points of the box (kind GROWN), but for points that it comes near to already. `high`: the plant in the box, metres."""
    place, apart = box.to_sketch(tree.tip), APART * species.internode
    points = points[cKDTree(place).query(points)[0] > apart] if len(points) else points
    if not len(points):
        return tree
    word = keys.draw_key(keys.stage_key(key, "grow"))
    wanted = dataclasses.replace(wanted or species.growing, sheds=False, kill=KILL)  # what stands stays; points of the inside are spread in space, as the paper's markers
    influence = influence_of(wanted, high / species.internode)
    begun, radius = Wood.of(tree.parent, place), tree.radius / box.scale
    result = colonise(Markers(points, np.ones(len(points))), begun, _buds(tree, place, species, word), influence, species, wanted, radius, word, pulse)
    return _appended(tree, result.wood, species.gamma, box)


def _buds(tree: TreeSkeleton, place, species: Species, word: np.uint64) -> Buds:
    """A lateral bud at every node."""
    base = np.arange(len(tree))
    for rows in generations(tree.parent)[1:]:
        base[rows] = base[tree.parent[rows]]
    length = sum_from_root(tree.parent, np.linalg.norm(place - np.where(tree.is_base[:, None], place, place[tree.parent]), axis=1))
    rows = np.flatnonzero(~tree.is_base)
    heading = unit(tree.vector[rows])
    heading[np.linalg.norm(heading, axis=1) < 0.5] = [0.0, 1.0, 0.0]
    side = rolled(carried(np.tile([1.0, 0.0, 0.0], (len(rows), 1)), heading), heading, 2.0 * np.pi * keys.uniform(word, rows, 9))
    lateral = branched(heading, side, np.full(len(rows), np.radians(species.branching)))
    return Buds(place[rows], lateral, carried(-side, lateral), rows, np.zeros(len(rows)), length[rows], base[rows])


def _appended(tree: TreeSkeleton, wood: Wood, gamma: float, box) -> TreeSkeleton:
    """The tree and the wood beyond its rows."""
    own, place = len(tree), box.to_world(wood.place)
    place[:own] = tree.tip
    new = np.arange(own, len(wood))
    if not len(new):
        return tree
    step = np.where(wood.parent == NULL, 0.0, np.linalg.norm(place - place[wood.parent], axis=1))
    borne = sum_to_root(wood.parent, step)
    stands = borne[:own] > 0
    radius = np.append(tree.radius, np.median(tree.radius[stands] / borne[:own][stands] ** gamma) * borne[own:] ** gamma)
    radius[new] = np.maximum(radius[new], THINNEST * SIDE * box.scale)
    for rows in generations(wood.parent)[1:]:
        rows = rows[rows >= own]
        radius[rows] = np.minimum(radius[rows], radius[wood.parent[rows]])
    above = wood.parent[:own]
    goes_on = np.append((above != NULL) & (tree.limb == tree.limb[above]), wood.parent[own:] >= own)
    limb, order = limbs(wood.parent, place, radius, goes_on)
    rows = {"parent": wood.parent[new], "tip": place[new], "radius": radius[new], "limb": int(tree.limb.max()) + 1 + limb[new]}
    rows |= {"order": tree.order[0] + order[new], "tree": _tree_of(tree, wood.parent)[new], "kind": np.full(len(new), int(Kind.GROWN))}
    return tree.append(rows)


def _tree_of(tree: TreeSkeleton, parent):
    """The tree that every row belongs to."""
    found = np.append(tree.tree, np.zeros(len(parent) - len(tree), np.int64))
    for rows in generations(parent)[1:]:
        rows = rows[rows >= len(tree)]
        found[rows] = found[parent[rows]]
    return found
