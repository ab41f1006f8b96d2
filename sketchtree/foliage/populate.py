"""Where does every leaf of a tree sit, and which way does it face?

Chen et al. 2008, §6: "The leaves are replicated and placed on branches based on botanical laws governing
leaf arrangement." In the frame of the twig or short shoot (t along, r outward at azimuth ψ):

    d ∝ cos α t + sin α r + δ g                    direction of the leaf
    n ∝ L − (L·d) d,   L = up + ⅖ outward + noise  its face, towards the light

    α   inclination    δ   droop    g   gravity    L   light

Every random number is tied to (limb id, node), so a new limb leaves the others' leaves as they were.
Above `max_leaves` an even share of the leaves is kept and grows by 1/√share, so their area stays; the leaves of a
short shoot are kept or left out together, and a shoot without leaves goes too.
"""

from dataclasses import replace

import numpy as np
from jaxtyping import Array, Float, Int, Key

from sketchtree import keys
from sketchtree.axes import NULL
from sketchtree.errors import OptionError
from sketchtree.foliage.buds import SUNK, Buds, around, buds
from sketchtree.foliage.leaves import Leaves, select
from sketchtree.foliage.seasons import check_season
from sketchtree.foliage.twigs import THICKEST, Twigs, fronds, leafy, wood_pieces
from sketchtree.foliage.water_shoots import water_shoots
from sketchtree.foliage.wear import Wear, wear_of
from sketchtree.parameters import Habit
from sketchtree.roots import without_roots
from sketchtree.skeleton import TreeSkeleton
from sketchtree.traverse import is_tip
from sketchtree.watch import Pulse, no_pulse

_UP = np.array([0.0, 1.0, 0.0])
_OUTER = 0.7  # outer share of a limb that carries leaves where it is thin enough
_SIZE, _SHARE = {"spring": 0.82}, {"autumn": 0.82}  # young leaves are small, some have fallen
_AZIMUTH, _TILT, _GROWTH, _TINT, _FALLEN, _CAP, _LIGHT = range(7)  # the draws of one leaf


def populate(
    tree: TreeSkeleton,
    habit: Habit,
    *,
    key: Key[Array, ""],
    model: str | None = None,
    season: str = "summer",
    density: float = 1.0,
    scale: float = 1.0,
    arrangement: str | None = None,
    max_leaves: int = 60_000,
    pulse: Pulse = no_pulse,
) -> Leaves:
    """The leaves of a tree (Chen §6). `model` overrides the habit's leaf, and then brings its own size,
    spacing and arrangement; `density` (> 0) scales the nodes a metre, `scale` (> 0) the leaves; `arrangement` (`wear.FREE`) overrides the leaf's. In the season `bare` evergreens keep theirs. Raises OptionError."""
    check_season(season)
    if not density > 0:
        raise OptionError(f"The leaf density is {density}, but it must be above 0.", remedy="Use 1 for the species' own.")
    if not scale > 0:
        raise OptionError(f"The leaves' scale is {scale}, but it must be above 0.", remedy="Use 1 for the species' own.")
    if max_leaves < 1:
        raise OptionError(f"At most {max_leaves} leaves were allowed.", remedy="Allow at least 1, or use season 'bare'.")
    wear = wear_of(habit, model, density, scale, arrangement)
    tree, _ = without_roots(tree)
    if (season == "bare" and not wear.model.evergreen) or tree.segment_count == 0:
        return Leaves.none(wear.model.name)
    budding, shoots = all_buds(tree, habit, wear, key, pulse)
    pulse()
    leaves, unit = unfold(tree, budding, shoots, wear, season, key), _units(budding)
    if season in _SHARE and not (wear.model.evergreen or wear.model.flower):
        held = keys.uniform(key, budding.id, _FALLEN) < _SHARE[season]
        leaves, unit = select(leaves, held), unit[held]
        budding = budding.select(held)
    pulse()
    return capped(leaves, budding.shoot, unit, max_leaves, key)


def _units(stand: Buds) -> Int[np.ndarray, " leaf"]:
    """What is kept or left out together: the id of a leaf, or of the first leaf of its short shoot."""
    unit = stand.id.copy()
    on = np.flatnonzero(stand.shoot != NULL)
    _, first, index = np.unique(stand.shoot[on], return_index=True, return_inverse=True)
    unit[on] = stand.id[on[first]][index.ravel()]
    return unit


def all_buds(tree: TreeSkeleton, habit: Habit, wear: Wear, key: Key[Array, ""], pulse: Pulse = no_pulse) -> tuple[Buds, Float[np.ndarray, "shoot 2 3"]]:
    """Every bud of the tree, on its twigs, on short shoots and on water shoots; and both kinds of shoots, start and end of each, metres."""
    pieces = wood_pieces(tree, pulse)
    pulse()
    bearing = leafy_wood(pieces, tree, habit, wear)
    pulse()
    borne, short = buds(bearing, tree.limb, wear, habit.twig_radius, key)
    pulse()
    more, water = water_shoots(pieces, tree.order, tree.limb, borne, wear, habit, key)
    more = replace(more, shoot=more.shoot + len(short))
    return borne.followed_by(more), np.concatenate([short, water])


def leafy_wood(pieces: Twigs, tree: TreeSkeleton, habit: Habit, wear: Wear) -> Twigs:
    """Of all wood, what carries leaves; of a palm, its fronds. A palm's fans stand on its leaf stalks, not on their ribs. The thick end of a
    limb carries none, however its surface runs out."""
    if wear.arrangement == "frond":
        pieces = fronds(pieces, tree)
        stalks = wear.model.fan > 0 and habit.leaf_arrangement == "frond"
        return pieces.select(tree.order[pieces.row] <= 1) if stalks else pieces
    reach = wear.model.shoot * habit.twig_length
    stump = is_tip(tree.parent) & (tree.radius > THICKEST * habit.twig_radius)
    return leafy(pieces.select(~stump[pieces.row]), tree.order, thickest=THICKEST * habit.twig_radius, reach=reach, share=_OUTER)


def unfold(tree: TreeSkeleton, stand: Buds, shoots, wear: Wear, season: str, key) -> Leaves:
    """A leaf from every bud."""
    model, ids = wear.model, stand.id
    loose = 0.0 if wear.arrangement == "frond" else np.radians(9.0)
    reaching = around(stand.azimuth + loose * keys.normal(key, ids, _AZIMUTH), stand.side, stand.tangent)
    lean = np.radians(model.inclination + (1.0 if model.fan else 6.0) * keys.normal(key, ids, _TILT))
    lean = np.where((stand.node == 0) & (model.fan == 0), 0.35 * lean, lean)[:, None]
    direction = _unit(np.cos(lean) * stand.tangent + np.sin(lean) * reaching - model.droop * _UP)
    over = np.cross(stand.side, stand.tangent) if wear.arrangement == "frond" else None
    size = wear.size * _growth(stand, wear) * (0.90 + 0.40 * keys.uniform(key, ids, _GROWTH))
    return Leaves(
        model=model.name,
        position=stand.foot + SUNK * stand.radius[:, None] * around(stand.azimuth, stand.side, stand.tangent),
        direction=direction,
        normal=_facing(tree, stand.foot, direction, over, ids, key),
        size=size * (1.0 if model.evergreen or model.flower else _SIZE.get(season, 1.0)),
        tint=keys.uniform(key, ids, _TINT),
        segment=stand.segment,
        shoot=shoots,
    )


def _growth(stand: Buds, wear: Wear) -> Float[np.ndarray, " leaf"]:
    """Relative size by place: on a frond long in the middle and short at both ends, on a shoot the
    youngest leaves at the tip are the smallest."""
    if wear.model.fan:
        return 0.4 + 0.6 * stand.along
    if wear.arrangement == "frond":
        return 0.35 + 0.65 * np.sin(np.pi * np.clip(0.12 + 0.82 * stand.along, 0, 1)) ** 0.8
    return 1 - 0.3 * np.exp(-stand.node / 1.5) * wear.model.is_blade


def _facing(tree, centre, direction, over, ids, key) -> Float[np.ndarray, "leaf 3"]:
    """Unit normals ⟂ direction, turned to the light; a frond's leaflets face its upper side (`over`)."""
    if over is None:
        axis = tree.tip[tree.is_base].mean(axis=0)
        away = (centre - axis) * [1, 0, 1]
        noise = np.stack([keys.normal(key, ids, _LIGHT + i) for i in range(3)], axis=1)
        light = _UP + 0.4 * _unit(away) + 0.3 * noise
    else:
        light = over
    normal = light - np.einsum("ij,ij->i", light, direction)[:, None] * direction
    weak = np.linalg.norm(normal, axis=1) < 1e-6
    spare = np.cross(direction, np.where(np.abs(direction[:, :1]) < 0.9, [[1.0, 0, 0]], [[0, 0, 1.0]]))
    return _unit(np.where(weak[:, None], spare, normal))


def capped(leaves: Leaves, shoot, unit: Int[np.ndarray, " leaf"], max_leaves: int, key) -> Leaves:
    """At most `max_leaves` leaves, of the same area in all; `kept` says which share is left. Short shoots go with
    their leaves."""
    keep = np.ones(len(leaves), bool)
    if len(leaves) > max_leaves:
        keep[np.argsort(keys.uniform(key, unit, _CAP), kind="stable")[max_leaves:]] = False
    few = replace(select(leaves, keep), shoot=leaves.shoot[np.unique(shoot[keep & (shoot != NULL)])])
    if keep.all():
        return few
    area = float(np.sum(leaves.size**2))
    return replace(few, size=few.size * np.sqrt(area / np.sum(few.size**2)), kept=max_leaves / len(leaves))


def _unit(vector):
    return vector / np.maximum(np.linalg.norm(vector, axis=-1, keepdims=True), 1e-12)
