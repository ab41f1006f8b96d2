"""How do branches that run through each other part?

Rank after rank (`branches`) they find their places among those that have theirs: what is drawn first, then the heavy and what bears,
then the light. A branch that overlaps (`overlaps`) with wood that has its place, or with a heavier one of its rank, turns about where it
starts, rigidly, with all it bears (`turning`). Of its choices it takes the one that costs least, then the smallest; a turn costs
the wood that would be lost if all that still overlaps were cut, and what would leave the space or sink into the ground: that is
cut there. Else radii, lengths and the angles of all that it bears stay. Small turns are tried first (`_ROUNDS`), so that only what
would else be cut turns by more than 12°.

What no turn parts is cut: whichever of the two bears less wood from there on ends just before the other, or goes altogether where the
rest would be shorter than `_TWIG` twigs. By then all heavier branches have their places, so that none is cut for the sake of
one that goes itself. What is drawn is never moved or cut. A limb may take `_CROTCH` radii of the limb that bears it to leave that:
a sharp fork is no knot.
"""

from dataclasses import dataclass, field, replace

import numpy as np
from jaxtyping import Array, Float, Key

from sketchtree.parameters import Habit
from sketchtree.propagate.after.capsules import Capsules
from sketchtree.propagate.after.cutting import Cut, cut
from sketchtree.propagate.after.overlaps import Overlaps, is_undrawn
from sketchtree.propagate.after.settling import Settling, Wood
from sketchtree.propagate.after.turning import angle_of, choices
from sketchtree.propagate.space.space import Space
from sketchtree.skeleton import TreeSkeleton
from sketchtree.watch import Pulse, no_pulse

LARGEST = 250_000  # rows: a larger tree is left as it is, since it would take longer than twenty seconds or so
_ROUNDS = ((12.0, False), (12.0, True), (20.0, True), (30.0, True), (45.0, True))  # of a rank: degrees at most, and whether with the star
_TOO_LARGE = (
    "With {:,} rows the tree is too large to look for branches that run through each other (at most {:,}), so some may. "
    "Ask for fewer with --max-segments."
)
_SWELL = 1.1  # times the radii count: limbs become smooth curves that leave their rows a little, and radii change once others are cut
_HAIR = 0.15  # of what both are thick, `clears` moves them farther apart than that, and a cut ends before it
_TWIG = 0.5  # twig lengths, what is left of a cut branch is at least
_CROTCH = 3.0  # radii of the limb that bears it, a branch may take to leave that: sharp forks are no knots
_TOUCHES = 1e-9  # metres between two axes, at most, that cross


@dataclass(frozen=True, eq=False)
class Untangled(Cut):
    """What is left, and what it took."""

    turned: Float[np.ndarray, " branch"]  # radians, by which branches turned; those that stayed left out
    warnings: tuple[str, ...] = ()


@dataclass(frozen=True)
class Untangle:
    """A stage: undrawn branches that run through others give way. The tree needs its final radii (`PipeRadii`)."""

    habit: Habit = Habit()  # to the tree's scale (`scale.to_scale`): what counts as a twig
    spaces: dict[int, Space] = field(default_factory=dict)  # of every tree, by the column `tree`; no branch is turned out of its own

    def __call__(self, tree: TreeSkeleton, *, key: Key[Array, ""] | None = None) -> TreeSkeleton:
        """The tree without knots. `key` is part of the stage's door; nothing here is random."""
        return self.run(tree).skeleton

    def run(self, tree: TreeSkeleton, pulse: Pulse = no_pulse) -> Untangled:
        """As the call, with the rows that are left and the turns."""
        as_it_was = Untangled(tree, np.arange(len(tree)), np.zeros(0))
        if not is_undrawn(tree).any():
            return as_it_was
        if len(tree) > LARGEST:
            return replace(as_it_was, warnings=(_TOO_LARGE.format(len(tree), LARGEST),))
        now = Settling(tree, self.spaces, _SWELL, _CROTCH)
        for rank in np.unique(now.branches.rank):
            rows = now.take_up(rank)
            self._part(now, rows, pulse)
            now.settle(rows)
        if not now.moved.any() and (now.share == 1.0).all():
            return as_it_was
        left, turned = cut(tree.replace(tip=now.tip), now.share), angle_of(now.turned)
        return Untangled(left.skeleton, left.rows, turned[turned > 0])

    def _part(self, now: Settling, rows, pulse: Pulse) -> None:
        """Turn, then cut what overlaps among these rows and with what has its place."""
        asking = peers = Wood.of(now.wood_of(rows))
        for most, star in _ROUNDS:
            pulse()
            found = _yielding(now, asking, peers)
            if len(found) == 0:
                return
            pulse()
            turned = _turn(now, found, peers, np.radians(most), star)
            asking, peers = Wood.of(now.wood_of(turned)), Wood.of(now.wood_of(rows))
        found = _yielding(now, asking, peers)
        if len(found):
            self._cut(now, found)

    def _cut(self, now: Settling, found: Overlaps) -> None:
        """Whichever of each two bears less wood from there on ends before the other."""
        its = now.branches
        found = found.swapped(its.wood[found.other] < its.wood[found.one])
        row, other = found.one, found.other
        share = now.clear_share(row, other, 1.0 + _HAIR)
        first = its.first[its.of_row[row]]
        node = its.node[its.of_row[row]]
        left = now.run[row] - now.run[node] - (1.0 - share) * now.length[row]
        short = left < _TWIG * self.habit.twig_length
        now.cut(np.where(short, first, row), np.where(short, 0.0, share))


def _yielding(now: Settling, asking: Wood, peers: Wood) -> Overlaps:
    """Overlaps of what is `asking` with what has its place and with its peers; `one` is the one that gives way."""
    found = now.overlaps(asking, peers)
    return found.swapped(np.isin(found.other, peers.pieces.row) & _lesser(now, found.other, found.one))


def _lesser(now: Settling, row, other):
    """Which rows of rank are of lighter branches than others; of equal ones, of the limb with the higher id."""
    its, limb = now.branches, now.tree.limb
    mine, its_own = its.wood[its.first[its.of_row[row]]], its.wood[its.first[its.of_row[other]]]
    return (mine < its_own) | ((mine == its_own) & (limb[row] > limb[other]))


def _turn(now: Settling, found: Overlaps, peers: Wood, most: float, star: bool):
    """Turn the branches of `found.one` to where they cost least; their rows."""
    branch, worst = _worst(now, found)
    mine = now.rows_of(branch)
    turns, angle = choices(now.turned[branch], _way(now, branch, mine), *_push(now, branch, worst), most, star)
    cost = np.where(np.isfinite(angle), _costs(now, branch, mine, turns, peers), np.inf)
    best = _best(now, branch, turns, cost, angle)
    change = best > 0
    now.turn(branch[change], turns[change, best[change]])
    return mine


def _worst(now: Settling, found: Overlaps):
    """(branches of `found.one`, the deepest overlap of each)."""
    branch = now.branches.of_row[found.one]
    order = np.lexsort((*found.at_one.T, -found.depth, branch))
    order = order[np.r_[True, np.diff(branch[order]) != 0]]
    return branch[order], found.select(order)


def _push(now: Settling, branch, worst: Overlaps):
    """(from where each branch starts to its overlap, unit direction out of it, how far), metres."""
    between = worst.at_one - worst.at_other
    gap = np.linalg.norm(between, axis=1, keepdims=True)
    across = np.cross(now.axis_of(worst.one), now.axis_of(worst.other))
    across /= np.maximum(np.linalg.norm(across, axis=1, keepdims=True), 1e-300)
    away = np.where(gap > _TOUCHES, between / np.maximum(gap, _TOUCHES), across)
    missing = worst.depth + _HAIR * (now.radius[worst.one] + now.radius[worst.other])
    return worst.at_one - now.tip[now.branches.node[branch]], away, missing


def _way(now: Settling, branch, mine):
    """From where each branch starts to its last row's tip, as it is carried, metres."""
    of = np.searchsorted(branch, now.branches.of_row[mine])
    last = mine[np.r_[np.diff(of) != 0, True]]
    start, tip = now.posed(last, np.arange(len(branch)), now.unturned(branch), branch)
    return tip - now.tip[now.branches.node[branch]]


def _costs(now: Settling, branch, mine, turns, peers: Wood) -> Float[np.ndarray, "branch choice"]:
    """The wood that is lost if all that overlaps is cut, micrometres, were the branches turned so."""
    of, many = np.searchsorted(branch, now.branches.of_row[mine]), turns.shape[1]
    choice = np.tile(np.arange(many), len(mine))
    row, of = np.repeat(mine, many), np.repeat(of, many)
    start, tip = now.posed(row, of * many + choice, turns.reshape(-1, 3, 3), np.repeat(branch, many))
    found = now.overlaps(Wood.of(Capsules.cut(row, start, tip, now.radius[row], now.usual)), peers)
    lost = np.minimum(now.branches.wood[found.one], now.branches.wood[found.other])
    return np.bincount((of * many + choice)[found.owner], lost, minlength=len(branch) * many).reshape(-1, many)


def _best(now: Settling, branch, turns, cost, angle):
    """The choice of each branch that costs least, with the wood that would leave the space, and of those the smallest turn; 0, to stay,
    where none costs less."""
    order = np.lexsort((angle, cost), axis=1)
    best, least, open_ = np.zeros(len(branch), np.int64), cost[:, 0].copy(), np.arange(len(branch))
    for place in range(cost.shape[1]):
        open_ = open_[cost[open_, order[open_, place]] < least[open_]]
        if len(open_) == 0:
            break
        choice = order[open_, place]
        _, _, lost = now.outside(branch[open_], turns[open_, choice])
        whole = cost[open_, choice] + lost
        better = whole < least[open_]
        best[open_[better]], least[open_[better]] = choice[better], whole[better]
    return best
