"""How much does each vertex give way to the wind?

Four numbers a vertex, 0-1, made so that no shader need know the tree:

    sway     how far the whole tree carries it        beam(height / H)           0 at the ground, 1 at the top
    branch   how far its bough carries it             B / max B                  0 on stems, grows towards the twigs
    phase    when its bough swings                    golden ratio × hash of the bough's id; one number a bough
    flutter  how far its leaf carries it              0 on wood and at the petiole, 1 where the leaf ends

    beam(u) = u² (6 − 4u + u²) / 3                    bending of an even beam, fixed at one end, under an even load
                                                      (Timoshenko & Gere, "Theory of elastic stability"), 1 at u = 1
    B(limb, s) = B_p + B'_p a tanh(x·t / a) + L k^(d − 1) beam((s − b) / (L − b))

    B_p, B'_p   of the parent where the limb comes out of it, and its slope there: what grows from a branch turns with it
    x, t, a   from there to the point; the parent's direction; how far a limb goes along, four of the parent's radii
    L   length of the limb       b   what of it is buried in its parent       d   limbs between it and the stem, from 1
    k   how much less twigs add: they are short, but many lie behind each other

Main bending by height, bending of branches by how far out, and leaves by their edges is the scheme of Sousa 2007 ("Vegetation
procedural animation and shading in Crysis", GPU Gems 3, chapter 16); painted there, computed here. Since B goes on at forks, in value
and slope, the surface stays in one piece; since its own part starts level, phases may differ.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int

from sketchtree.axes import NULL
from sketchtree.foliage.leaves import Leaves
from sketchtree.geometry.instances import Instances
from sketchtree.geometry.limbs import CentreLines
from sketchtree.limb_ids import mix
from sketchtree.rig.boughs import Boughs, limb_of_row
from sketchtree.rig.collar import Collar, blended
from sketchtree.rig.place import Places, along, places_on
from sketchtree.skeleton import TreeSkeleton
from sketchtree.traverse import generations

_LESS = 0.75  # k
_ALONG = 4.0  # radii of the parent: a
CHANNELS = ("sway", "branch", "phase", "flutter")


@dataclass(frozen=True, eq=False)
class Wind:
    """What the wind does to the lines of a tree; vertices take it from where they are."""

    ground: float  # y of the ground, metres
    height: float  # of the tree above it, metres
    reach: float  # metres of bough that `branch` = 1 stands for
    branch: Float[np.ndarray, " point"]  # at the points of the lines
    phase: Float[np.ndarray, " limb"]


def beam(u: Float[np.ndarray, "*place"]) -> Float[np.ndarray, "*place"]:
    """Where an even beam bends to, `u` of the way from its fixed end (0-1; clipped)."""
    u = np.clip(u, 0.0, 1.0)
    return u * u * (6.0 - 4.0 * u + u * u) / 3.0


def wind_of(tree: TreeSkeleton, lines: CentreLines, limbs: Boughs) -> Wind:
    """The wind's doing on a tree."""
    ground = float(tree.tip[tree.is_base, 1].min()) if len(tree) else 0.0
    height = max(tree.height, 1e-6)
    branch = _branch(lines, limbs)
    reach = float(branch.max(initial=0.0))
    return Wind(ground, height, reach, branch / max(reach, 1e-12), _phase(lines, limbs))


def wood_wind(
    wind: Wind, lines: CentreLines, place: Places, over: Collar, position: Float[np.ndarray, "vertex 3"]
) -> Float[np.ndarray, "vertex 4"]:
    """Sway, branch, phase and flutter of vertices of the wood; `over` is their collar."""
    branch = blended(along(lines, wind.branch, place), along(lines, wind.branch, over.place), over)
    return np.column_stack([_sway(wind, position), branch, wind.phase[place.limb], np.zeros(len(position))])


def each_leaf_wind(wind: Wind, lines: CentreLines, place: Places, foot: Float[np.ndarray, "leaf 3"]) -> Float[np.ndarray, "leaf 3"]:
    """Sway, branch and phase of every leaf, from the foot of its petiole."""
    return np.column_stack([_sway(wind, foot), along(lines, wind.branch, place), wind.phase[place.limb]])


def instance_wind(wind: Wind, tree: TreeSkeleton, lines: CentreLines, leaves: Leaves, parts: Instances) -> Float[np.ndarray, "instance 3"]:
    """Sway, branch and phase of every instance, by the leaf whose foot is nearest to it; flutter is a matter of its vertices."""
    from scipy.spatial import cKDTree

    each = each_leaf_wind(wind, lines, leaf_places(tree, lines, leaves), leaves.position)
    return each[cKDTree(leaves.position).query(parts.translation)[1]]


def far_wind(wind: Wind, position: Float[np.ndarray, "vertex 3"]) -> Float[np.ndarray, "vertex 4"]:
    """The same of an impostor, which only sways as a whole."""
    return np.column_stack([_sway(wind, position), np.zeros((len(position), 3))])


def leaf_places(tree: TreeSkeleton, lines: CentreLines, leaves: Leaves) -> Places:
    """Where on the tree each leaf stands."""
    return places_on(lines, limb_of_row(tree, lines)[leaves.segment], leaves.position)


def hashed(limb_id: Int[np.ndarray, " limb"]) -> Float[np.ndarray, " limb"]:
    """A number in [0, 1) for each limb id; other limbs' stay as they are whatever limbs there are."""
    with np.errstate(over="ignore"):
        return (mix(np.asarray(limb_id, np.uint64)) >> np.uint64(11)).astype(float) * 2.0**-53


def _sway(wind: Wind, position):
    return beam((position[:, 1] - wind.ground) / wind.height)


def _branch(lines: CentreLines, limbs: Boughs) -> Float[np.ndarray, " point"]:
    """B at every point of the lines, metres."""
    limb, length = lines.of_point, lines.length
    own = beam((lines.s - limbs.buried[limb]) / np.maximum(length - limbs.buried, 1e-12)[limb])
    still = (limbs.depth == 0) | limbs.is_root
    scale = np.where(still, 0.0, length * _LESS ** np.maximum(limbs.depth - 1, 0))
    branch = own * scale[limb]
    for among in generations(lines.parent)[1:]:
        among = among[~still[among]]
        rows = np.flatnonzero(np.isin(limb, among))
        branch[rows] += _carried(lines, limbs, branch, rows)
    return np.maximum(branch, 0.0)


def _carried(lines: CentreLines, limbs: Boughs, branch, rows) -> Float[np.ndarray, " row"]:
    """What points of limbs have of their parents' B: its value where the limb comes out, and its slope while they run along."""
    limb = np.arange(len(lines))
    above, at = np.maximum(lines.parent, 0), limbs.exit_s
    point, radius = lines.at(above, at)
    low, high = np.maximum(at - radius, 0.0), np.minimum(at + radius, lines.length[above])
    rise = along(lines, branch, Places(above, high)) - along(lines, branch, Places(above, low))
    chord = lines.at(above, high)[0] - lines.at(above, low)[0]
    chord /= np.maximum(np.linalg.norm(chord, axis=1, keepdims=True), 1e-12)
    slope, value, reach = rise / np.maximum(high - low, 1e-12), along(lines, branch, Places(above, at)), _ALONG * radius
    limb = lines.of_point[rows]
    ahead = np.einsum("ij,ij->i", lines.point[rows] - point[limb], chord[limb])
    return value[limb] + slope[limb] * reach[limb] * np.tanh(ahead / reach[limb])


def _phase(lines: CentreLines, limbs: Boughs) -> Float[np.ndarray, " limb"]:
    bough = np.where(limbs.bough == NULL, 0, limbs.bough)
    return np.where(limbs.bough == NULL, 0.0, hashed(lines.limb_id)[bough])
