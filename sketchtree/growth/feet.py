"""Where are branches grafted on: on tips, to go on, and at sides, as limbs of the next order?"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Float, Int

from sketchtree.growth.across import any_across, turned, unit
from sketchtree.growth.crown_base import crown_base
from sketchtree.growth.library import BranchUnit
from sketchtree.growth.manner import Manner, Spread
from sketchtree.keys import normal, uniform
from sketchtree.limb_ids import child_limb_id
from sketchtree.skeleton import Kind, TreeSkeleton
from sketchtree.traverse import child_count, generations

BARE = 0.3  # of a limb's way: no unit at the sides of its foot
SLENDER = 0.55  # of the radius at the ground: thicker wood gets no units at its sides
SHORTEST, LONGEST = 0.03, 0.13  # of the tree's height: a unit of the first level
SHRINK = 0.45, 0.85  # least and most that a unit is as long as the one that bears it
APART = 0.45  # of a unit's length, between units along a limb of the trunk
_ONWARD = 0.45  # of a limb's length: the unit that goes on from its tip
_BEARS = 0.65  # of the places at the sides of units that bear another
_RANK = 1_000_000  # ranks of grafted limbs begin here, apart from those of other laterals


@dataclass(frozen=True)
class Chance:
    """Random numbers by limb id, about the tree's manner."""

    key: np.uint64
    manner: Manner

    def of(self, spread: Spread, number: Int[np.ndarray, " limb"], draw: int) -> Float[np.ndarray, " limb"]:
        """One number of a spread for each id, within 2.5 standard deviations."""
        return spread.mean + spread.sd * np.clip(normal(self.key, number, draw), -2.5, 2.5)

    def between(self, number: Int[np.ndarray, " limb"], draw: int) -> Float[np.ndarray, " limb"]:
        """One number in [0, 1) for each id."""
        return uniform(self.key, number, draw)

    def azimuth(self, number: Int[np.ndarray, " limb"], draw: int) -> Float[np.ndarray, " limb"]:
        """An angle for each id, all round."""
        return 2 * np.pi * self.between(number, draw)


@dataclass(frozen=True, eq=False)
class Feet:
    """Where units are to be grafted on."""

    node: Int[np.ndarray, " foot"]  # row at whose tip
    way: Float[np.ndarray, "foot 3"]  # of the wood there, unit length
    across: Float[np.ndarray, "foot 3"]  # the side that the unit leans to, unit length
    length: Float[np.ndarray, " foot"]  # of the unit, metres
    limb: Int[np.ndarray, " foot"]  # its id
    order: Int[np.ndarray, " foot"]
    goes_on: Bool[np.ndarray, " foot"]  # from a tip
    number: Int[np.ndarray, " foot"]  # id that its random numbers are drawn by

    def __len__(self) -> int:
        return len(self.node)

    def select(self, which) -> "Feet":
        """Some of them."""
        return Feet(*(getattr(self, name)[which] for name in self.__dataclass_fields__))

    @classmethod
    def join(cls, feet) -> "Feet":
        """All of several."""
        return cls(*(np.concatenate([getattr(some, name) for some in feet]) for name in cls.__dataclass_fields__))


def first_feet(host: TreeSkeleton, chance: Chance) -> Feet:
    """On every tip of a tree without curve points, and along its slender wood."""
    wood = ~host.is_base & (host.kind != int(Kind.ROOT)) & (host.length > 0)
    run, length = _along_limbs(host)
    tall = host.height or 1.0
    tips = np.flatnonzero(wood & (child_count(host.parent) == 0))
    size = np.clip(_ONWARD * length[tips], SHORTEST * tall, LONGEST * tall)
    return Feet.join([_tip_feet(host, tips, size, chance), _side_feet(host, wood, run, length, tall, chance)])


def feet_on(feet: Feet, unit_of: BranchUnit, row, way, limb, order, chance: Chance) -> Feet:
    """On all tips of units grafted on these feet, and at the sides of pieces that nothing else stands on. All columns are (foot, piece)."""
    bears = np.bincount([above for above in unit_of.parent if above >= 0], minlength=len(unit_of))
    found = []
    for piece in np.flatnonzero(bears < 2):
        at_tip = bears[piece] == 0
        number = child_limb_id(feet.number, np.full(len(feet), 100 + piece))
        shrink = np.clip(chance.of(chance.manner.scale, number, 4), *SHRINK)
        side = turned(way[:, piece], any_across(way[:, piece]), chance.azimuth(number, 0))
        name, deeper = (limb[:, piece], order[:, piece]) if at_tip else (number, order[:, piece] + 1)
        some = Feet(row[:, piece], way[:, piece], side, feet.length * shrink, name, deeper, np.full(len(feet), at_tip), number)
        found.append(some if at_tip else some.select(chance.between(number, 7) < _BEARS))
    return Feet.join(found)


def _tip_feet(host: TreeSkeleton, tips, size, chance: Chance) -> Feet:
    way, number = unit(host.vector[tips]), child_limb_id(host.limb[tips], np.full(len(tips), _RANK))
    side = turned(way, any_across(way), chance.azimuth(number, 0))
    return Feet(tips, way, side, size, host.limb[tips], host.order[tips], np.ones(len(tips), bool), number)


def _side_feet(host: TreeSkeleton, wood, run, length, tall: float, chance: Chance) -> Feet:
    scale, turn = chance.manner.scale, chance.manner.turn
    size = np.clip(scale.mean * (length - run + 0.25 * length), SHORTEST * tall, LONGEST * tall)
    base = crown_base(host)
    above = True if base is None else host.tip[:, 1] >= base
    free = wood & (child_count(host.parent) == 1) & (run > BARE * length) & (host.radius < SLENDER * host.radius.max()) & above
    rows = np.flatnonzero(free)
    rows = rows[_spaced(host.limb[rows], run[rows], APART * size[rows])]
    limb, way, rank = host.limb[rows], unit(host.vector[rows]), _rank_of(host.limb[rows])
    number = child_limb_id(limb, _RANK + 1 + rank)
    way_round = np.where(chance.between(limb, 1) < 0.5, -1.0, 1.0)
    azimuth = chance.azimuth(limb, 2) + way_round * rank * turn.mean + chance.of(Spread(0.0, turn.sd), number, 3)
    size = size[rows] * np.clip(chance.of(scale, number, 4) / scale.mean, 0.6, 1.4)
    return Feet(rows, way, turned(way, any_across(way), azimuth), size, number, host.order[rows] + 1, np.zeros(len(rows), bool), number)


def _along_limbs(tree: TreeSkeleton):
    """(metres from the foot of each row's limb to its tip, length of the whole limb)."""
    run = np.where(tree.is_base, 0.0, tree.length)
    for rows in generations(tree.parent)[1:]:
        same = rows[tree.limb[rows] == tree.limb[tree.parent[rows]]]
        run[same] += run[tree.parent[same]]
    _, limb = np.unique(tree.limb, return_inverse=True)
    longest = np.zeros(limb.max(initial=-1) + 1)
    np.maximum.at(longest, limb, run)
    return run, longest[limb]


def _spaced(limb, run, apart):
    """Which rows, in the order of their limbs, are at least `apart` from the last one taken."""
    order, taken, last = np.lexsort((run, limb)), [], (None, 0.0)
    for k in order:
        if limb[k] != last[0] or run[k] - last[1] >= apart[k]:
            taken.append(k)
            last = (limb[k], run[k])
    return np.array(sorted(taken), int)


def _rank_of(limb):
    """The rank of each row among those of its limb, in the order given."""
    order = np.argsort(limb, kind="stable")
    first = np.r_[True, np.diff(limb[order]) != 0][: len(limb)]
    begin = np.maximum.accumulate(np.where(first, np.arange(len(limb)), 0))
    rank = np.empty(len(limb), np.int64)
    rank[order] = np.arange(len(limb)) - begin
    return rank
