"""What does a bare trunk become when branches are grafted on its tips and sides?

Single-image growth, §II.3 and Figure 7: units of the library are grafted on existing tips and sides, level by level, with angles and
sizes drawn about those of the tree itself (its local self-similarity). A unit that goes on from a tip continues its limb; one at a side
begins a limb of the next branching order. Units never run through thick wood or into the ground, and don't hang much more than what
bears them: one that would is turned about the branch that bears it, and left out if that doesn't help.

What was there before stays as it was. Numbers are drawn by limb id: a limb more changes the branches on the others only as far as it
changes the tree's manner.
"""

from dataclasses import dataclass, field

import numpy as np
from jaxtyping import Array, Key

from sketchtree.axes import NULL
from sketchtree.errors import OptionError
from sketchtree.growth.clearance import Clearance
from sketchtree.growth.feet import Chance, Feet, feet_on, first_feet
from sketchtree.growth.grafted_radii import grafted_radii
from sketchtree.growth.library import LIBRARY, BranchUnit
from sketchtree.growth.manner import Manner
from sketchtree.growth.straight import straightened
from sketchtree.growth.unit_shape import shape
from sketchtree.keys import draw_key, stage_key
from sketchtree.limb_ids import child_limb_id
from sketchtree.skeleton import Kind, TreeSkeleton

LEAST, MOST = 0, 5  # levels
_TRIES = 4
_NEAR = 3.0  # radii of the wood that bears a unit, from its foot: there it may touch it
_HANGS = np.sin(np.radians([20.0, 40.0]))  # most that a unit's first piece, and any, falls a metre, beyond what bears it
_TWIG = 0.25  # of the thinnest wood there is


@dataclass(frozen=True, eq=False)
class Graft:
    """A stage: `levels` levels of units grafted on. Drawn curves become rows, since units stand on their points too."""

    levels: int = 3  # 0-5
    twig_radius: float | None = None  # metres; None: a quarter of the thinnest wood there is
    most_segments: int = 200_000  # the level that would go beyond is left out
    library: tuple[BranchUnit, ...] = field(default=LIBRARY)

    def __post_init__(self):
        if not LEAST <= self.levels <= MOST:
            raise OptionError(f"levels is {self.levels}, but must lie between {LEAST} and {MOST}.", remedy="0 grafts nothing on; a full tree has 3 to 5.")

    def __call__(self, tree: TreeSkeleton, *, key: Key[Array, ""]) -> TreeSkeleton:
        """The tree with branches grafted on."""
        if self.levels == 0 or tree.segment_count == 0:
            return tree
        host = straightened(tree)
        growth = _Growth(host, Chance(draw_key(stage_key(key, "graft")), Manner.of(host)))
        feet, largest = first_feet(host, growth.chance), max(map(len, self.library))
        for level in range(self.levels):
            if len(feet) == 0 or growth.rows + len(feet) * largest > self.most_segments:
                break
            feet = growth.graft(feet, self.library, last=level == self.levels - 1)
        return growth.finished(_TWIG * float(host.radius.min()) if self.twig_radius is None else self.twig_radius)


def variations(tree: TreeSkeleton, count: int, *, levels: int = 3, key: Key[Array, ""]) -> list[TreeSkeleton]:
    """One trunk with `count` different crowns; the first few are the same whatever `count` is."""
    return [Graft(levels)(tree, key=stage_key(key, f"variation {k}")) for k in range(count)]


class _Growth:
    """What has been grafted on a host so far: columns of rows after the host's."""

    def __init__(self, host: TreeSkeleton, chance: Chance):
        self.host, self.chance, self.clear = host, chance, Clearance.of(host)
        self.parent, self.tip, self.limb, self.order, self.tree = ([getattr(host, name)] for name in ("parent", "tip", "limb", "order", "tree"))
        self.rows = len(host)

    def graft(self, feet: Feet, library: tuple[BranchUnit, ...], last: bool) -> Feet:
        """Put a unit on every foot that has room; the feet on the new wood, none after the last level."""
        tip, tree = np.concatenate(self.tip), np.concatenate(self.tree)
        choice = np.minimum((self.chance.between(feet.number, 5) * len(library)).astype(int), len(library) - 1)
        onwards = [feet.select(np.zeros(0, int))]
        for which, unit in enumerate(library):
            some = feet.select(np.flatnonzero(choice == which))
            way, tips, room = self._with_room(some, unit, tip[some.node])
            some = some.select(room)
            columns = self._rows_of(some, unit)
            self._append(columns, tips[room], tree[some.node])
            if not last:
                onwards.append(feet_on(some, unit, columns["row"], way[room], columns["limb"], columns["order"], self.chance))
        return Feet.join(onwards)

    def _with_room(self, feet: Feet, unit: BranchUnit, start):
        """(ways and tips of the pieces (foot, piece, 3), which feet have room) after up to `_TRIES` turns."""
        thick = np.zeros(self.rows)
        thick[: len(self.host)] = self.host.radius
        way, tip = np.zeros((2, len(feet), len(unit), 3))
        room, left = np.zeros(len(feet), bool), np.arange(len(feet))
        for turn in range(_TRIES):
            ways, tips = shape(feet.select(left), unit, start[left], turn * 2 * np.pi / _TRIES, self.chance)
            starts = np.concatenate([start[left][:, None], tips], axis=1)[:, np.array(unit.parent) + 1]
            foot, near = np.repeat(start[left], len(unit), 0), np.repeat(_NEAR * thick[feet.node[left]], len(unit))
            bad = self.clear.blocked(starts.reshape(-1, 3), tips.reshape(-1, 3), foot, near).reshape(len(left), len(unit)).any(axis=1)
            falls = np.minimum(feet.way[left, 1], 0.0)[:, None] - ways[:, :, 1]
            bad |= (falls[:, 0] > _HANGS[0]) | (falls > _HANGS[1]).any(axis=1)
            good = left[~bad]
            way[good], tip[good], room[good] = ways[~bad], tips[~bad], True
            left = left[bad]
        return way, tip, room

    def _rows_of(self, feet: Feet, unit: BranchUnit) -> dict:
        """The columns (foot, piece) of the unit's pieces on these feet."""
        count, pieces = len(feet), len(unit)
        row = self.rows + np.arange(count)[:, None] * pieces + np.arange(pieces)
        parent = np.where(np.array(unit.parent) == NULL, feet.node[:, None], row[:, np.maximum(unit.parent, 0)])
        limb, order = np.repeat(feet.limb[:, None], pieces, 1), np.repeat(feet.order[:, None], pieces, 1)
        for piece, first in enumerate(unit.limb):
            if first != NULL:
                limb[:, piece] = child_limb_id(feet.number, np.full(count, 10 + first))
                order[:, piece] += 1
        return {"row": row, "parent": parent, "limb": limb, "order": order}

    def _append(self, columns: dict, tips, tree) -> None:
        for name in ("parent", "limb", "order"):
            getattr(self, name).append(columns[name].ravel())
        self.tip.append(tips.reshape(-1, 3))
        self.tree.append(np.repeat(tree, columns["row"].shape[1]))
        self.rows += columns["row"].size

    def finished(self, twig: float) -> TreeSkeleton:
        """The whole tree with its radii."""
        old, new = len(self.host), self.rows - len(self.host)
        more = {name: np.concatenate(getattr(self, name))[old:] for name in ("parent", "tip", "limb", "order", "tree")}
        tree = self.host.append(more | {"radius": np.ones(new), "kind": np.full(new, int(Kind.GROWN))})
        return tree.replace(radius=grafted_radii(tree, old, twig))
