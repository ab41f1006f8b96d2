"""What does a bare trunk become when branches are grafted on its tips and sides?

Single-image growth, §II.3 and Figure 7: units of the library are grafted on existing tips and sides, level by level, with angles and
sizes drawn about those of the tree itself (its local self-similarity). Units never run through thick wood or into the ground: one that
would is turned about the branch that bears it, and left out if that doesn't help.

A unit that goes on from a tip continues its limb; one at a side begins a limb of the next branching order. Where wood is grafted on it
is as thick as what bears it allows, and from there on as thick as what it bears:

    r_i² = ρ² + (r_foot² − ρ²) L_i / L_foot          L  metres of wood at or beyond a piece;  ρ  the radius of a twig
    r_foot = r at a tip's end;  r √(L_foot / (L_foot + L_host)), at most `SIDE` r, at a side, L_host the wood that the host bears there

What was there before stays as it was. Numbers are drawn by limb id: a limb more changes the branches on the others only as far as it
changes the tree's manner.
"""

from dataclasses import dataclass, field

import numpy as np
from jaxtyping import Array, Float, Int, Key

from sketchtree.axes import NULL
from sketchtree.errors import OptionError
from sketchtree.growth.clearance import Clearance
from sketchtree.growth.library import LIBRARY, BranchUnit
from sketchtree.growth.manner import Manner, Spread
from sketchtree.growth.straight import straightened
from sketchtree.keys import draw_key, normal, stage_key, uniform
from sketchtree.limb_ids import child_limb_id
from sketchtree.skeleton import Kind, TreeSkeleton
from sketchtree.traverse import child_count, generations, sum_from_root, sum_to_root

LEAST, MOST = 0, 5  # levels
SIDE = 0.7  # r_foot / r at a side
_BARE = 0.3  # of a limb's way: no unit at the sides of its foot
_SLENDER = 0.55  # of the radius at the ground: thicker wood gets no units at its sides
_SHORTEST, _LONGEST = 0.03, 0.17  # of the tree's height: a unit of the first level
_SHRINK = 0.45, 0.85  # least and most that a unit is as long as the one that bears it
_APART = 0.45  # of a unit's length, between units along a limb of the trunk
_TRIES = 4
_RANK = 1_000_000  # ranks of grafted limbs begin here, apart from those of other laterals


@dataclass(frozen=True, eq=False)
class Graft:
    """A stage: `levels` levels of units grafted on. Drawn curves become rows, since units stand on their points too."""

    levels: int = 3  # 0-5
    twig_radius: float | None = None  # metres; None: a quarter of the thinnest wood there is
    most_segments: int = 200_000
    library: tuple[BranchUnit, ...] = field(default=LIBRARY)

    def __post_init__(self):
        if not LEAST <= self.levels <= MOST:
            raise OptionError(f"levels is {self.levels}, but must lie between {LEAST} and {MOST}.", remedy="0 grafts nothing on; a full tree has 3 to 5.")

    def __call__(self, tree: TreeSkeleton, *, key: Key[Array, ""]) -> TreeSkeleton:
        """The tree with branches grafted on."""
        if self.levels == 0 or tree.segment_count == 0:
            return tree
        host = straightened(tree)
        growth = _Growth.of(host, Manner.of(host), draw_key(stage_key(key, "graft")))
        feet = growth.first_feet()
        for level in range(self.levels):
            if len(feet) == 0 or growth.rows + len(feet) * max(map(len, self.library)) > self.most_segments:
                break
            feet = growth.graft(feet, self.library, level, last=level == self.levels - 1)
        return growth.finished(self.twig_radius)


def variations(tree: TreeSkeleton, count: int, *, levels: int = 3, key: Key[Array, ""]) -> list[TreeSkeleton]:
    """One trunk with `count` different crowns; the first few are the same whatever `count` is."""
    return [Graft(levels)(tree, key=stage_key(key, f"variation {k}")) for k in range(count)]


@dataclass(frozen=True, eq=False)
class _Feet:
    """Where units are to be grafted on."""

    node: Int[np.ndarray, " foot"]  # row at whose tip
    way: Float[np.ndarray, "foot 3"]  # of the wood there, unit length
    across: Float[np.ndarray, "foot 3"]  # the side that the unit leans to, unit length
    length: Float[np.ndarray, " foot"]  # of the unit, metres
    limb: Int[np.ndarray, " foot"]  # its id
    order: Int[np.ndarray, " foot"]
    goes_on: np.ndarray  # from a tip
    number: Int[np.ndarray, " foot"]  # id that its random numbers are drawn by

    def __len__(self) -> int:
        return len(self.node)

    def select(self, which) -> "_Feet":
        return _Feet(*(getattr(self, name)[which] for name in self.__dataclass_fields__))

    @classmethod
    def join(cls, feet) -> "_Feet":
        return cls(*(np.concatenate([getattr(some, name) for some in feet]) for name in cls.__dataclass_fields__))


@dataclass(eq=False)
class _Growth:
    host: TreeSkeleton
    manner: Manner
    key: np.uint64
    clear: Clearance
    parts: list = field(default_factory=list)  # columns of what was grafted on
    rows: int = 0

    @classmethod
    def of(cls, host: TreeSkeleton, manner: Manner, key) -> "_Growth":
        return cls(host, manner, key, Clearance.of(host), [], len(host))

    def drawn(self, spread: Spread, number, draw: int):
        return spread.mean + spread.sd * np.clip(normal(self.key, number, draw), -2.5, 2.5)

    # -- where

    def first_feet(self) -> _Feet:
        """On every tip of the host, and along its slender wood."""
        host = self.host
        wood = ~host.is_base & (host.kind != int(Kind.ROOT)) & (host.length > 0)
        tips = np.flatnonzero(wood & (child_count(host.parent) == 0))
        limb_run, limb_length = _along_limbs(host)
        tall = host.height or 1.0
        size = np.clip(0.45 * limb_length[tips], _SHORTEST * tall, _LONGEST * tall)
        return _Feet.join([self._tip_feet(tips, size, host), self._side_feet(wood, limb_run, limb_length, tall)])

    def _tip_feet(self, tips, size, tree) -> _Feet:
        way, number = _unit(tree.vector[tips]), child_limb_id(tree.limb[tips], np.full(len(tips), _RANK))
        across = _turned(way, _any_across(way), 2 * np.pi * uniform(self.key, number, 0))
        return _Feet(tips, way, across, size, tree.limb[tips], tree.order[tips], np.ones(len(tips), bool), number)

    def _side_feet(self, wood, run, length, tall) -> _Feet:
        host = self.host
        size = np.clip(self.manner.scale.mean * (length - run + 0.25 * length), _SHORTEST * tall, _LONGEST * tall)
        free = wood & (child_count(host.parent) == 1) & (run > _BARE * length) & (host.radius < _SLENDER * host.radius.max())
        rows = np.flatnonzero(free)
        rows = rows[_spaced(host.limb[rows], run[rows], _APART * size[rows])]
        rank = _rank_of(host.limb[rows])
        way = _unit(host.vector[rows])
        number = child_limb_id(host.limb[rows], _RANK + 1 + rank)
        way_round = np.where(uniform(self.key, host.limb[rows], 1) < 0.5, -1.0, 1.0)
        first = 2 * np.pi * uniform(self.key, host.limb[rows], 2)
        azimuth = first + way_round * rank * self.manner.turn.mean + self.manner.turn.sd * normal(self.key, number, 3)
        size = size[rows] * np.clip(self.drawn(self.manner.scale, number, 4) / self.manner.scale.mean, 0.6, 1.4)
        return _Feet(rows, way, _turned(way, _any_across(way), azimuth), size, number, host.order[rows] + 1, np.zeros(len(rows), bool), number)

    # -- what

    def graft(self, feet: _Feet, library, level: int, last: bool) -> _Feet:
        """Put a unit on every foot that has room; returns the feet on the new wood, none on the last level."""
        choice = np.minimum((uniform(self.key, feet.number, 5) * len(library)).astype(int), len(library) - 1)
        onwards = []
        for which, unit in enumerate(library):
            some = feet.select(choice == which)
            way, tip, keep = self._with_room(some, unit)
            if len(some) == 0 or not keep.any():
                continue
            onwards.append(self._appended(some.select(keep), unit, way[keep], tip[keep], last))
        return _Feet.join(onwards) if onwards and not last else feet.select(np.zeros(len(feet), bool))

    def _with_room(self, feet: _Feet, unit: BranchUnit):
        """(ways of the pieces (foot, piece, 3), their tips, which feet have room) after up to `_TRIES` turns."""
        start = self._places(feet.node)
        near = 3.0 * self._thick(feet.node)
        way, tip = np.zeros((2, len(feet), len(unit), 3))
        keep, left = np.zeros(len(feet), bool), np.arange(len(feet))
        for turn in range(_TRIES):
            if len(left) == 0:
                break
            some = feet.select(left)
            ways, tips = self._shape(some, unit, start[left], turn * 2 * np.pi / _TRIES)
            starts = np.concatenate([start[left][:, None], tips], axis=1)[:, np.array(unit.parent) + 1]
            foot, close = np.repeat(start[left], len(unit), 0), np.repeat(near[left], len(unit))
            bad = self.clear.blocked(starts.reshape(-1, 3), tips.reshape(-1, 3), foot, close).reshape(len(left), -1).any(axis=1)
            good = left[~bad]
            way[good], tip[good], keep[good] = ways[~bad], tips[~bad], True
            left = left[bad]
        return way, tip, keep

    def _shape(self, feet: _Feet, unit: BranchUnit, start, turn: float):
        """(ways, tips) of a unit's pieces on every foot, `turn` about the wood that bears it."""
        ways, across, tips = np.zeros((3, len(feet), len(unit), 3))
        foot_across = _turned(feet.way, feet.across, np.full(len(feet), turn))
        lean = np.clip(self.drawn(self.manner.lean, feet.number, 6), np.radians(12.0), np.radians(100.0))
        foot_way = np.where(feet.goes_on[:, None], feet.way, np.cos(lean)[:, None] * feet.way + np.sin(lean)[:, None] * foot_across)
        foot_across = _unit(foot_across - np.sum(foot_across * foot_way, axis=1, keepdims=True) * foot_way)
        for piece, above in enumerate(unit.parent):
            before, side = (foot_way, foot_across) if above == NULL else (ways[:, above], across[:, above])
            draws = 20 + 4 * piece
            bend = unit.lean[piece] * np.clip(self.drawn(self.manner.lean, feet.number, draws), 0.2, 1.6)
            ahead = bend + self.manner.swing.sd * np.clip(normal(self.key, feet.number, draws + 1), -2, 2)
            aside = self.manner.swing.sd * np.clip(normal(self.key, feet.number, draws + 2), -2, 2)
            third = np.cross(before, side)
            way = _unit(before + np.tan(np.clip(ahead, -1.3, 1.3))[:, None] * side + np.tan(aside)[:, None] * third)
            if unit.is_new[piece]:
                side = _turned(way, _unit(side - np.sum(side * way, axis=1, keepdims=True) * way), self.drawn(self.manner.turn, feet.number, draws + 3))
            ways[:, piece], across[:, piece] = way, _unit(side - np.sum(side * way, axis=1, keepdims=True) * way)
            from_ = start if above == NULL else tips[:, above]
            tips[:, piece] = from_ + (unit.length[piece] * feet.length)[:, None] * way
        return ways, tips

    def _appended(self, feet: _Feet, unit: BranchUnit, way, tip, last: bool) -> _Feet:
        """Write down the unit's pieces on these feet; the feet on them."""
        count, pieces = len(feet), len(unit)
        row = self.rows + np.arange(count)[:, None] * pieces + np.arange(pieces)
        parent = np.where(np.array(unit.parent) == NULL, feet.node[:, None], row[:, np.maximum(unit.parent, 0)])
        limb, order = np.repeat(feet.limb[:, None], pieces, 1), np.repeat(feet.order[:, None], pieces, 1)
        for piece, first in enumerate(unit.limb):
            if first != NULL:
                limb[:, piece] = child_limb_id(feet.number, np.full(count, 10 + first))
                order[:, piece] += 1
        self.parts.append((parent.ravel(), tip.reshape(-1, 3), limb.ravel(), order.ravel(), np.repeat(self._tree_of(feet.node), pieces), np.repeat(feet.goes_on, pieces)))
        self.rows += count * pieces
        return None if last else self._feet_on(feet, unit, row, way, limb, order)

    def _feet_on(self, feet, unit, row, way, limb, order) -> _Feet:
        """On all tips of new units, and at the sides of pieces that nothing else stands on."""
        bears = np.bincount([above for above in unit.parent if above != NULL], minlength=len(unit))
        found = []
        for piece in range(len(unit)):
            if bears[piece] > 1:
                continue
            at_tip = bears[piece] == 0
            number = child_limb_id(feet.number, np.full(len(feet), 100 + piece))
            shrink = np.clip(self.drawn(self.manner.scale, number, 4), *_SHRINK)
            across = _turned(way[:, piece], _any_across(way[:, piece]), 2 * np.pi * uniform(self.key, number, 0))
            some = _Feet(
                row[:, piece], way[:, piece], across, feet.length * shrink, limb[:, piece] if at_tip else number, order[:, piece] + (not at_tip),
                np.full(len(feet), at_tip), number,
            )  # fmt: skip
            found.append(some if at_tip else some.select(uniform(self.key, number, 7) < 0.5))
        return _Feet.join(found)

    # -- what there is

    def _column(self, which: int, of_host):
        return np.concatenate([of_host, *(part[which] for part in self.parts)])

    def _places(self, node):
        return self._column(1, self.host.tip)[node]

    def _tree_of(self, node):
        return self._column(4, self.host.tree)[node]

    def _thick(self, node):
        grafted = self.rows - len(self.host)
        return np.concatenate([self.host.radius, np.zeros(grafted)])[node]

    def finished(self, twig: float | None) -> TreeSkeleton:
        """The whole tree with its radii."""
        host = self.host
        if not self.parts:
            return host
        new = self.rows - len(host)
        more = {name: self._column(k, getattr(host, name))[len(host) :] for k, name in enumerate(("parent", "tip", "limb", "order", "tree"))}
        tree = host.append(more | {"radius": np.ones(new), "kind": np.full(new, int(Kind.GROWN))})
        twig = 0.25 * float(host.radius[~host.is_base].min()) if twig is None else twig
        return tree.replace(radius=grafted_radii(tree, len(host), twig))


def grafted_radii(tree: TreeSkeleton, old: int, twig: float) -> Float[np.ndarray, " segment"]:
    """The radii of a tree whose rows from `old` on were grafted on: see above. No row is thicker than its parent."""
    wood = sum_to_root(tree.parent, tree.length)
    radius, foot, whole = np.array(tree.radius), np.full(len(tree), np.nan), np.ones(len(tree))
    for rows in generations(tree.parent)[1:]:
        rows = rows[rows >= old]
        above = tree.parent[rows]
        starts = above < old
        side = starts & (tree.limb[rows] != tree.limb[above])
        share = np.where(side, np.minimum(SIDE, np.sqrt(wood[rows] / np.maximum(wood[above] - tree.length[above], 1e-300))), 1.0)
        foot[rows] = np.where(starts, share * radius[above], foot[above])
        whole[rows] = np.where(starts, wood[rows], whole[above])
        thin = np.minimum(twig, foot[rows])
        radius[rows] = np.minimum(np.sqrt(thin**2 + (foot[rows] ** 2 - thin**2) * np.minimum(wood[rows] / whole[rows], 1.0)), radius[above])
    return radius


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


def _any_across(way):
    upright = np.abs(way[:, 1:2]) > 0.9
    return _unit(np.cross(way, np.where(upright, [1.0, 0.0, 0.0], [0.0, 1.0, 0.0])))


def _turned(axis, vector, angle):
    """Vectors perpendicular to unit axes, turned about them."""
    return np.cos(angle)[:, None] * vector + np.sin(angle)[:, None] * np.cross(axis, vector)


def _unit(vector):
    return vector / np.maximum(np.linalg.norm(vector, axis=1, keepdims=True), 1e-300)
