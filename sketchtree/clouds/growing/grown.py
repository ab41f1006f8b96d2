"""The tree that grows toward points: every step in order.

    points → box of 10 m → weights (Eq. 8) [→ points of the unseen inside] → seeds at the roots → cycles of growth (`colonise`)
    → wood within thicker wood taken in → thickness (Eq. 5) → settled among the points → collapse → Hermite → TreeSkeleton

Guo et al. 2018, §5. It is a likely tree of its species that reaches the points; `clouds.tracing` gives the tree that stands in them.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from jaxtyping import Array, Float, Int, Key

from sketchtree import keys
from sketchtree.axes import NULL
from sketchtree.clouds.growing.box import SIDE, boxed
from sketchtree.clouds.growing.collapse import collapsed, kept
from sketchtree.clouds.growing.colonise import colonise
from sketchtree.clouds.growing.hermite import smoothed
from sketchtree.clouds.growing.hull_fill import crown_of, hull_fill, unseen_inside
from sketchtree.clouds.growing.logistic import Constant, Influence, Logistic
from sketchtree.clouds.growing.markers import Markers, gathered
from sketchtree.clouds.growing.metamer import seeds
from sketchtree.clouds.growing.roots import Roots, roots_of
from sketchtree.clouds.growing.settled import settled
from sketchtree.clouds.growing.shedding import absorbed
from sketchtree.clouds.growing.species import Species
from sketchtree.clouds.growing.thickness import radii
from sketchtree.clouds.growing.wanted import Growing
from sketchtree.clouds.growing.weights import point_weights
from sketchtree.clouds.growing.wood import Wood
from sketchtree.similarity import Similarity
from sketchtree.skeleton import Kind, TreeSkeleton
from sketchtree.skeleton_rows import limbs, tree_of
from sketchtree.watch import Pulse, no_pulse

APART = 4.0
"""Internodes between points of the unseen inside."""

THINNEST = 0.00015
"""Radius of a twig, as a share of the box."""

_CELL = 1 / 3  # internodes: points nearer to one another than that guide as one
_SETTLES = 2.0  # internodes: points so near tell where thin wood runs


@dataclass(frozen=True, eq=False)
class Grown:
    """A tree that grew, and how it came to be. Lengths are those of the box."""

    wood: Wood
    cycles: int
    left: int  # points, of the cloud's or of its inside, that nothing came to
    box: Similarity
    xyz: Float[np.ndarray, "point 3"]
    roots: Roots
    species: Species
    wanted: Growing

    @cached_property
    def skeleton(self) -> TreeSkeleton:
        """The tree, in metres of the cloud; kind GROWN."""
        return finished(self.wood, self.wood.standing(), self.roots.radius, self)

    def at(self, cycle: int) -> TreeSkeleton:
        """The tree after some cycles of growth, as the paper's Figure 12 shows it; what was shed later still stands.

        Its stems are as thick as Eq. 5 makes wood that bears so much: d_t = d_root (l_t / l)^γ."""
        rows, step = self.wood.standing(cycle), self.wood.step()
        share = min(step[rows].sum() / max(step[self.wood.standing()].sum(), 1e-12), 1.0)
        return finished(self.wood, rows, self.roots.radius * share**self.species.gamma, self)


def grown(
    xyz: Float[np.ndarray, "point 3"],
    feet: list[Int[np.ndarray, " start"]],
    species: Species,
    *,
    key: Key[Array, ""],
    wanted: Growing | None = None,
    radius: Float[np.ndarray, " root"] | None = None,
    pulse: Pulse = no_pulse,
) -> Grown:
    """The tree on feet, each of which is some of the points (metres, y up). `radius`: of the stems at their feet, metres, where it was measured;
    `wanted`: how, if not as the species says."""
    box, wanted = boxed(xyz), species.growing if wanted is None else wanted
    inside = box.to_sketch(xyz)
    roots = roots_of(inside, feet, None if radius is None else np.asarray(radius, float) / box.scale)
    markers = _markers(inside, species, wanted, keys.stage_key(key, "fill"))
    influence = influence_of(wanted, float(np.ptp(inside[:, 1])) / species.internode)
    word = keys.draw_key(keys.stage_key(key, "grow"))
    begun = Wood.of(np.full(len(feet), NULL), roots.place)
    buds = seeds(roots.place, roots.radius, 2.0 * np.pi * keys.uniform(word, np.arange(len(feet)), 7))
    result = colonise(markers, begun, buds, influence, species, wanted, roots.radius, word, pulse)
    return Grown(result.wood, result.cycles, result.left, box, inside, roots, species, wanted)


def influence_of(wanted: Growing, internodes: float) -> Influence:
    """How far buds look in every cycle, in a plant that is so many internodes high."""
    if wanted.influence is not None:
        return Constant(wanted.influence)
    return Logistic(internodes, wanted.start, wanted.rate, (wanted.least, wanted.most))


def _markers(inside, species: Species, wanted: Growing, key) -> Markers:
    """The cloud's points, and those of its unseen inside if they are wanted."""
    cloud = gathered(inside, point_weights(inside, eps_d=wanted.eps_d, eps_a=wanted.eps_a) if wanted.weighted else np.ones(len(inside)), _CELL * species.internode)
    if wanted.fill is False or (wanted.fill is None and not unseen_inside(inside)):
        return cloud
    apart = APART * species.internode
    more = hull_fill(crown_of(inside), apart, key=key, clear=apart)
    return Markers(np.concatenate([cloud.xyz, more]), np.r_[cloud.weight, np.ones(len(more))])


def finished(wood: Wood, rows: Int[np.ndarray, " row"], root: Float[np.ndarray, " root"], grows: Grown) -> TreeSkeleton:
    """Some of the wood as a skeleton in the cloud's metres: thick by Eq. 5, settled among the points, collapsed, smoothed. `root`: radius at the roots, which come first."""
    number = np.append(np.full(len(wood), NULL), NULL)
    number[rows] = np.arange(len(rows))
    parent, place, gamma = number[wood.parent[rows]], wood.place[rows], grows.species.gamma
    if grows.wanted.sheds:
        parent, place = absorbed(parent, place, root, gamma)
    step = np.where(parent == NULL, 0.0, np.linalg.norm(place - place[parent], axis=1))
    radius = radii(parent, step, np.append(root, np.ones(len(parent) - len(root))), gamma)
    if grows.wanted.settles:
        place = settled(parent, place, radius, grows.xyz, _SETTLES * grows.species.internode)
    stays, parent = collapsed(parent, place, radius)
    parent, place, radius = smoothed(kept(stays, parent), place[stays], radius[stays])
    radius = np.maximum(radius, THINNEST * SIDE)
    limb, order = limbs(parent, place, radius)
    kind = np.full(len(parent), int(Kind.GROWN))
    return TreeSkeleton.from_columns(parent, grows.box.to_world(place), radius * grows.box.scale, limb=limb, order=order, tree=tree_of(parent), kind=kind)
