"""Where does every leaf of a tree sit, and which way does it face?

Chen et al. 2008, §6: "The leaves are replicated and placed on branches based on botanical laws governing
leaf arrangement." Nodes stand every `leaf_spacing` along the leafy wood, counted from each limb's tip; the
arrangement turns their leaves about the twig. In the twig's frame (t along, r outward at azimuth ψ):

    d ∝ cos α t + sin α r + δ g                    direction of the leaf
    n ∝ L − (L·d) d,   L = up + ⅖ outward + noise  its face, towards the light

    α   inclination    δ   droop    g   gravity    L   light

Every random number is tied to (limb id, node), so a new limb leaves the others' leaves as they were.
Above `max_leaves` an even share of the leaves is kept and grows by 1/√share, so their area stays.
"""

from dataclasses import dataclass, replace

import numpy as np
from jaxtyping import Array, Float, Int, Key

from sketchtree import keys
from sketchtree.errors import OptionError
from sketchtree.foliage.arrangement import azimuths, leaves_per_node
from sketchtree.foliage.leaves import Leaves
from sketchtree.foliage.models import LeafModel, leaf_model
from sketchtree.foliage.seasons import check_season
from sketchtree.foliage.twigs import Twigs, leafy, wood_pieces
from sketchtree.parameters import Habit
from sketchtree.skeleton import TreeSkeleton

_UP = np.array([0.0, 1.0, 0.0])
_SUNK = 0.85  # a petiole starts at this share of the wood's radius: never afloat
_THICKEST = 8.0  # leafy wood has at most this many twig radii
_YEARLING = 1.5  # above so many twig radii wood is older than a year and bears short shoots
_OUTER = 0.5  # outer share of a limb that carries leaves where it is thin enough
_SIZE, _SHARE = {"spring": 0.72}, {"autumn": 0.75}  # young leaves are small, some have fallen
_JITTER, _AZIMUTH, _TILT, _GROWTH, _TINT, _FALLEN, _CAP, _LIGHT = range(8)  # the draws of one leaf


@dataclass(frozen=True)
class _Wear:
    """What is worn: the model with the spacing, size and arrangement of this tree."""

    model: LeafModel
    arrangement: str
    size: float  # metres, of a blade or a whole tuft
    spacing: float  # metres between nodes, or between tufts
    phyllotaxis: float  # degrees
    whorl: int


@dataclass(frozen=True, eq=False)
class _Buds:
    """Where each leaf starts, before it has a direction."""

    piece: Int[np.ndarray, " leaf"]
    node: Int[np.ndarray, " leaf"]  # rank from the limb's tip
    at: Float[np.ndarray, " leaf"]  # 0-1 along its piece
    azimuth: Float[np.ndarray, " leaf"]  # radians about the twig
    spread: Float[np.ndarray, " leaf"]  # −1 to 1, place within the fan of a short shoot; 0 alone
    id: Int[np.ndarray, " leaf"]  # 63 bits


def populate(
    tree: TreeSkeleton,
    habit: Habit,
    *,
    key: Key[Array, ""],
    model: str | None = None,
    season: str = "summer",
    density: float = 1.0,
    max_leaves: int = 60_000,
) -> Leaves:
    """The leaves of a tree (Chen §6). `model` overrides the habit's leaf, and then brings its own size,
    spacing and arrangement; `density` (> 0) scales the nodes a metre. Raises OptionError."""
    check_season(season)
    if not density > 0:
        raise OptionError(f"The leaf density is {density}, but it must be above 0.", remedy="Use 1 for the species' own.")
    if max_leaves < 1:
        raise OptionError(f"At most {max_leaves} leaves were allowed.", remedy="Allow at least 1, or use season 'bare'.")
    wear = _wear(habit, model, density)
    if season == "bare" or tree.segment_count == 0:
        return Leaves.none(wear.model.name)
    pieces = _leafy_wood(tree, habit, wear)
    piece, node, at = _nodes(pieces, tree, wear, key)
    buds = _buds(tree, pieces, piece, node, at, wear, habit)
    leaves, ids = _place(tree, pieces, buds, wear, season, key), buds.id
    if season in _SHARE and not wear.model.evergreen:
        leaves, ids = _keep(leaves, ids, keys.uniform(key, ids, _FALLEN) < _SHARE[season])
    return _capped(leaves, ids, max_leaves, key)


def _wear(habit: Habit, model: str | None, density: float) -> _Wear:
    worn = leaf_model(model or habit.leaf)
    if worn.name == habit.leaf:
        arrangement, size, spacing = habit.leaf_arrangement, habit.leaf_size, habit.leaf_spacing
    else:
        arrangement, size, spacing = worn.arrangement, worn.size, worn.spacing
    leaves_per_node(arrangement)
    turn = habit.phyllotaxis if arrangement == habit.leaf_arrangement == "spiral" else 137.5
    return _Wear(worn, arrangement, size / worn.needle, spacing * worn.bundle / density, turn, habit.whorl)


def _leafy_wood(tree: TreeSkeleton, habit: Habit, wear: _Wear) -> Twigs:
    pieces = wood_pieces(tree)
    if wear.arrangement == "frond":
        return pieces.select((tree.order[pieces.row] > 0) & (pieces.length > 1e-9))
    reach = wear.model.shoot * habit.twig_length
    return leafy(pieces, tree.order, thickest=_THICKEST * habit.twig_radius, reach=reach, share=_OUTER)


def _nodes(pieces: Twigs, tree: TreeSkeleton, wear: _Wear, key):
    """Piece, rank from the limb's tip and place (0-1 along its piece) of every node."""
    length = pieces.length
    first = np.ceil(pieces.to_tip / wear.spacing - 1e-9).astype(int)
    beyond = np.ceil((pieces.to_tip + length) / wear.spacing - 1e-9).astype(int)
    count = np.maximum(beyond - first, 0)
    piece = np.repeat(np.arange(len(pieces)), count)
    node = np.arange(len(piece)) - np.repeat(np.cumsum(count) - count - first, count)
    ids = keys.child_limb_id(tree.limb[pieces.row[piece]], node)
    shift = 0.5 * (keys.uniform(key, ids, _JITTER) - 0.5) * (node > 0)
    back = (node + shift) * wear.spacing - pieces.to_tip[piece]
    at = 1 - np.clip(back / length[piece], 0, 1)
    if wear.arrangement == "frond":
        clear = np.maximum(pieces.foot_radius, 0.14 * pieces.limb_length)[piece]
    else:
        clear = np.minimum(pieces.foot_radius + 0.5 * wear.spacing, 0.6 * pieces.limb_length)[piece]
    free = pieces.from_foot[piece] + at * length[piece] >= clear
    return piece[free], node[free], at[free]


def _buds(tree: TreeSkeleton, pieces: Twigs, piece, node, at, wear: _Wear, habit: Habit) -> _Buds:
    """The leaves of every node; on wood older than a year a short shoot bears several for one."""
    azimuth = azimuths(wear.arrangement, node, phyllotaxis=wear.phyllotaxis, whorl=wear.whorl)
    per_node = azimuth.shape[1]
    old = (pieces.end_radius[piece] > _YEARLING * habit.twig_radius) & (node > 0)
    count = per_node * np.where(old, wear.model.spur, 1)
    of = np.repeat(np.arange(len(node)), count)
    rank = np.arange(len(of)) - np.repeat(np.cumsum(count) - count, count)
    shoot, size = rank // per_node, (count // per_node)[of]
    return _Buds(
        piece=piece[of],
        node=node[of],
        at=at[of],
        azimuth=azimuth[of, rank % per_node],
        spread=np.where(size > 1, 2 * shoot / np.maximum(size - 1, 1) - 1, 0.0),
        id=keys.child_limb_id(tree.limb[pieces.row[piece[of]]], (node[of] + 1) * 64 + rank),
    )


def _place(tree: TreeSkeleton, pieces: Twigs, buds: _Buds, wear: _Wear, season: str, key) -> Leaves:
    model, piece, at, ids = wear.model, buds.piece, buds.at, buds.id
    t, side = pieces.tangent[piece], pieces.side[piece]
    over = np.cross(side, t)
    loose = 0.0 if wear.arrangement == "frond" else np.radians(9.0)
    outward = _around(buds.azimuth, side, over)
    reaching = _around(buds.azimuth + loose * keys.normal(key, ids, _AZIMUTH) + np.radians(48.0) * buds.spread, side, over)
    centre = pieces.start[piece] + at[:, None] * (pieces.end - pieces.start)[piece]
    radius = pieces.start_radius[piece] + at * (pieces.end_radius - pieces.start_radius)[piece]
    lean = np.radians(model.inclination + 6.0 * keys.normal(key, ids, _TILT) - 12.0 * np.abs(buds.spread))
    lean = np.where(buds.node == 0, 0.35 * lean, lean)[:, None]
    direction = _unit(np.cos(lean) * t + np.sin(lean) * reaching - model.droop * _UP)
    size = wear.size * _growth(pieces, piece, at, buds.node, wear) * (0.85 + 0.35 * keys.uniform(key, ids, _GROWTH))
    return Leaves(
        model=model.name,
        position=centre + _SUNK * radius[:, None] * outward,
        direction=direction,
        normal=_facing(tree, centre, direction, over if wear.arrangement == "frond" else None, ids, key),
        size=size * (1.0 if model.evergreen else _SIZE.get(season, 1.0)),
        tint=keys.uniform(key, ids, _TINT),
        segment=pieces.row[piece],
    )


def _around(azimuth, side, over) -> Float[np.ndarray, "leaf 3"]:
    return np.cos(azimuth)[:, None] * side + np.sin(azimuth)[:, None] * over


def _growth(pieces: Twigs, piece, at, node, wear: _Wear) -> Float[np.ndarray, " leaf"]:
    """Relative size by place: on a frond long in the middle and short at both ends, on a shoot the
    youngest leaves at the tip are the smallest."""
    if wear.arrangement == "frond":
        foot = (pieces.from_foot[piece] + at * pieces.length[piece]) / pieces.limb_length[piece]
        return 0.35 + 0.65 * np.sin(np.pi * np.clip(0.12 + 0.82 * foot, 0, 1)) ** 0.8
    return 1 - 0.3 * np.exp(-node / 1.5) * wear.model.is_blade


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


def _capped(leaves: Leaves, ids: Int[np.ndarray, " leaf"], max_leaves: int, key) -> Leaves:
    """At most `max_leaves` leaves, of the same area in all; `kept` says which share is left."""
    if len(leaves) <= max_leaves:
        return leaves
    draw = keys.uniform(key, ids, _CAP)
    keep = np.zeros(len(leaves), bool)
    keep[np.argsort(draw, kind="stable")[:max_leaves]] = True
    area = float(np.sum(leaves.size**2))
    few, _ = _keep(leaves, ids, keep)
    grown = few.size * np.sqrt(area / np.sum(few.size**2))
    return replace(few, size=grown, kept=max_leaves / len(leaves))


def _keep(leaves: Leaves, ids, keep) -> tuple[Leaves, Int[np.ndarray, " leaf"]]:
    columns = ("position", "direction", "normal", "size", "tint", "segment")
    return replace(leaves, **{name: getattr(leaves, name)[keep] for name in columns}), ids[keep]


def _unit(vector):
    return vector / np.maximum(np.linalg.norm(vector, axis=-1, keepdims=True), 1e-12)
