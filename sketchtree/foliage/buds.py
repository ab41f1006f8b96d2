"""Where does each leaf start: on a twig, or on a short shoot of an older one?

Nodes stand every leaf spacing along the leafy wood, counted from each limb's tip. On this year's wood every
node bears leaves. Older wood bears short shoots instead, one every few nodes: thin stems too fine for a
skeleton, each with a few nodes of its own. They fill the crown between the twigs.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Array, Float, Int, Key

from sketchtree import keys, limb_ids
from sketchtree.axes import NULL
from sketchtree.foliage.arrangement import azimuths
from sketchtree.foliage.twigs import Twigs, level_side
from sketchtree.foliage.wear import Wear

SUNK = 0.85  # a petiole starts at this share of the wood's radius: never afloat
_YEARLING = 1.5  # above so many twig radii wood is older than a year
_SHOOT_LEAN = 52.0  # degrees between a twig and its short shoots
STRETCH = 1.7  # times as far apart as on a twig, leaves stand on a shoot: it stands for the finest twigs, which spread
_FAN = 128.0  # degrees to either side that a fan opens
_LONGEST = 0.3  # metres, of a mean short shoot
_JITTER, _LEAN, _TURN, _LENGTH = 20, 21, 22, 23  # the draws of a node


@dataclass(frozen=True, eq=False)
class Buds:
    """One row a leaf to be: the stem it stands on, there, and its place about it. Metres."""

    foot: Float[np.ndarray, "leaf 3"]  # on the stem's centre line
    radius: Float[np.ndarray, " leaf"]  # of the stem there
    tangent: Float[np.ndarray, "leaf 3"]
    side: Float[np.ndarray, "leaf 3"]  # unit, ⟂ tangent; azimuth 0
    azimuth: Float[np.ndarray, " leaf"]  # radians about the stem
    node: Int[np.ndarray, " leaf"]  # rank from the stem's tip
    along: Float[np.ndarray, " leaf"]  # 0-1 from the limb's foot to its tip
    segment: Int[np.ndarray, " leaf"]  # row of the skeleton
    id: Int[np.ndarray, " leaf"]  # 63 bits, from the limb's id and the node
    shoot: Int[np.ndarray, " leaf"]  # the short shoot it stands on; NULL on a twig

    def __len__(self) -> int:
        return len(self.node)

    def select(self, keep) -> "Buds":
        """Only some of them, by mask or by rows."""
        return _rows(self, keep)

    def followed_by(self, other: "Buds") -> "Buds":
        """These and the others, in this order."""
        return Buds(*(np.concatenate([getattr(self, name), getattr(other, name)]) for name in self.__dataclass_fields__))


def buds(
    pieces: Twigs, limb: Int[np.ndarray, " segment"], wear: Wear, twig_radius: float, key: Key[Array, ""]
) -> tuple[Buds, Float[np.ndarray, "shoot 2 3"]]:
    """The buds of all leafy wood, and the short shoots (start and end of each, metres)."""
    if wear.model.fan:
        return _fan(pieces, limb, wear), np.zeros((0, 2, 3))
    nodes = stem_nodes(pieces, limb, wear, key)
    if wear.model.spur == 1:
        return spread(nodes, wear), np.zeros((0, 2, 3))
    old = (nodes.radius > _YEARLING * twig_radius) & (nodes.node > 0)
    bears = old & (nodes.node % wear.model.every == 0)
    stems, shoots = short_shoots(_rows(nodes, bears), wear, key)
    return spread(_rows(nodes, ~old), wear).followed_by(spread(stems, wear)), shoots


def around(azimuth, side, tangent) -> Float[np.ndarray, "leaf 3"]:
    """The unit vector out of a stem at an azimuth about it."""
    return np.cos(azimuth)[:, None] * side + np.sin(azimuth)[:, None] * np.cross(side, tangent)


def _fan(pieces: Twigs, limb, wear: Wear) -> Buds:
    """The folds of a fan at the tip of every limb, spread in the plane of the limb and its side."""
    tips = pieces.select(pieces.to_tip < 1e-9)
    of = np.repeat(np.arange(len(tips)), wear.model.fan)
    rank = np.tile(np.arange(wear.model.fan), len(tips))
    turn = np.radians(_FAN) * (2 * rank / max(wear.model.fan - 1, 1) - 1)[:, None]
    tangent, side = tips.tangent[of], tips.side[of]
    return Buds(
        foot=(tips.end + SUNK * tips.end_radius[:, None] * tips.tangent)[of],
        radius=np.zeros(len(of)),
        tangent=np.cos(turn) * tangent + np.sin(turn) * side,
        side=np.cos(turn) * side - np.sin(turn) * tangent,
        azimuth=np.zeros(len(of)),
        node=rank,
        along=1 - 0.5 * np.abs(turn[:, 0]) / np.radians(_FAN),
        segment=tips.row[of],
        id=limb_ids.child_limb_id(limb[tips.row[of]], rank),
        shoot=np.full(len(of), NULL),
    )


def stem_nodes(pieces: Twigs, limb, wear: Wear, key) -> Buds:
    """One row a node of the leafy wood."""
    length = pieces.length
    first = np.ceil(pieces.to_tip / wear.spacing - 1e-9).astype(int)
    beyond = np.ceil((pieces.to_tip + length) / wear.spacing - 1e-9).astype(int)
    count = np.maximum(beyond - first, 0)
    piece = np.repeat(np.arange(len(pieces)), count)
    node = np.arange(len(piece)) - np.repeat(np.cumsum(count) - count - first, count)
    ids = limb_ids.child_limb_id(limb[pieces.row[piece]], node)
    shift = 0.5 * (keys.uniform(key, ids, _JITTER) - 0.5) * (node > 0)
    back = (node + shift) * wear.spacing - pieces.to_tip[piece]
    at = 1 - np.clip(back / length[piece], 0, 1)
    way = pieces.from_foot[piece] + at * length[piece]
    free = way >= _bare(pieces, wear)[piece]
    piece, at, way = piece[free], at[free], way[free]
    return Buds(
        foot=pieces.start[piece] + at[:, None] * (pieces.end - pieces.start)[piece],
        radius=pieces.start_radius[piece] + at * (pieces.end_radius - pieces.start_radius)[piece],
        tangent=pieces.tangent[piece],
        side=pieces.side[piece],
        azimuth=np.zeros(len(piece)),
        node=node[free],
        along=way / pieces.limb_length[piece],
        segment=pieces.row[piece],
        id=ids[free],
        shoot=np.full(free.sum(), NULL),
    )


def _bare(pieces: Twigs, wear: Wear) -> Float[np.ndarray, " piece"]:
    """How far from its foot a limb is bare: inside the wood it stands on, or the stalk of a frond."""
    if wear.arrangement == "frond":
        return np.maximum(pieces.foot_radius, 0.14 * pieces.limb_length)
    return np.minimum(pieces.foot_radius + 0.5 * wear.spacing, 0.6 * pieces.limb_length)


def short_shoots(nodes: Buds, wear: Wear, key, longest: float = _LONGEST) -> tuple[Buds, Float[np.ndarray, "shoot 2 3"]]:
    """A short shoot at every given node, on average at most `longest` metres: its own nodes, one row each, and where it starts and ends."""
    turn = azimuths(wear.arrangement, nodes.node // wear.model.every, phyllotaxis=wear.phyllotaxis, whorl=wear.whorl)[:, 0]
    turn = turn + np.radians(28.0) * keys.normal(key, nodes.id, _TURN)
    outward = around(turn, nodes.side, nodes.tangent)
    lean = np.radians(_SHOOT_LEAN + 9.0 * keys.normal(key, nodes.id, _LEAN))[:, None]
    tangent = np.cos(lean) * nodes.tangent + np.sin(lean) * outward - 0.35 * wear.model.droop * np.array([0.0, 1.0, 0.0])
    tangent /= np.linalg.norm(tangent, axis=1, keepdims=True)
    length = min(STRETCH * wear.model.spur * wear.spacing, longest) * (0.7 + 0.6 * keys.uniform(key, nodes.id, _LENGTH))
    start = nodes.foot + SUNK * nodes.radius[:, None] * outward
    end = start + length[:, None] * tangent
    of = np.repeat(np.arange(len(nodes)), wear.model.spur)
    rank = np.tile(np.arange(wear.model.spur), len(nodes))
    back = (rank / wear.model.spur)[:, None]
    stems = Buds(
        foot=end[of] + back * (start - end)[of],
        radius=np.zeros(len(of)),
        tangent=tangent[of],
        side=level_side(tangent)[of],
        azimuth=np.zeros(len(of)),
        node=rank,
        along=nodes.along[of],
        segment=nodes.segment[of],
        id=limb_ids.child_limb_id(nodes.id[of], rank + 1000),
        shoot=of,
    )
    return stems, np.stack([start, end], axis=1)


def spread(nodes: Buds, wear: Wear) -> Buds:
    """One row a leaf: each node's leaves at the azimuths of the arrangement."""
    azimuth = azimuths(wear.arrangement, nodes.node, phyllotaxis=wear.phyllotaxis, whorl=wear.whorl)
    per_node = azimuth.shape[1]
    wide = _rows(nodes, np.repeat(np.arange(len(nodes)), per_node))
    rank = np.tile(np.arange(per_node), len(nodes))
    columns = {name: getattr(wide, name) for name in Buds.__dataclass_fields__}
    return Buds(**columns | {"azimuth": azimuth.ravel(), "id": limb_ids.child_limb_id(wide.id, rank)})


def _rows(nodes: Buds, rows) -> Buds:
    return Buds(*(getattr(nodes, name)[rows] for name in Buds.__dataclass_fields__))
