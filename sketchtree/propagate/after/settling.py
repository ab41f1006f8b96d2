"""A tree while its branches find their places: where everything is, what has its place, and what is left."""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int

from sketchtree.axes import NULL
from sketchtree.propagate.after.branches import GRAIN, Branches
from sketchtree.propagate.after.capsules import Balls, Capsules
from sketchtree.propagate.after.cutting import pieces
from sketchtree.propagate.after.nearest import nearest
from sketchtree.propagate.after.overlaps import Kinship, Overlaps, capsule_radius, touching, usual_length
from sketchtree.propagate.space.space import Space
from sketchtree.skeleton import TreeSkeleton
from sketchtree.traverse import sum_from_root

_BISECTIONS = 12  # to 2e-4 of a row
_STUMP = 0.05  # of a row: what is cut shorter at a barrier is left out


@dataclass(frozen=True, eq=False)
class Wood:
    """Pieces, and the balls that find them."""

    pieces: Capsules
    balls: Balls

    @classmethod
    def of(cls, pieces: Capsules) -> "Wood":
        """These pieces."""
        return cls(pieces, Balls.of(pieces))


class Settling:
    """The rows' places, changed in place: ranks of branches are taken up, turned and cut in turn."""

    def __init__(self, tree: TreeSkeleton, spaces: dict[int, Space], swell: float, crotch: float):
        """`swell` times the radii count; a limb may take `crotch` radii of the one that bears it to leave that.
        `spaces` by the column `tree`."""
        self.tree, self.spaces = tree, {name: _binding(space) for name, space in spaces.items()}
        self.branches, self.kin = Branches.of(tree), Kinship.of(tree, crotch)
        self.radius, self.usual = swell * capsule_radius(tree), usual_length(tree)
        self.start = tree.start  # as it grew
        self.tip = np.array(tree.tip)
        self.end = np.array(tree.tip)  # of what is left of each row
        self.share = np.ones(len(tree))
        self.there = np.ones(len(tree), bool)
        self.turned = np.broadcast_to(np.eye(3), (len(self.branches.first), 3, 3)).copy()  # by itself
        self.carried = self.turned.copy()  # by what bears it
        self.moved = np.zeros(len(self.branches.first), bool)
        self.length = tree.length
        self.run = sum_from_root(tree.parent, self.length)
        row, start, end, _ = pieces(tree)
        self.axis = np.searchsorted(row, np.arange(len(tree) + 1)), start, end - start
        fixed = ~self.branches.moves[row]
        self.settled = Wood.of(Capsules.cut(row[fixed], start[fixed], end[fixed], self.radius[row[fixed]], self.usual))
        self.ground = float(tree.tip[tree.is_base, 1].min())

    def take_up(self, rank: int) -> Int[np.ndarray, " row"]:
        """Put the branches of a rank where what bears them has come to; their rows that are left."""
        its = self.branches
        some = np.flatnonzero((its.rank == rank) & self.there[its.first])
        some_above = its.above[some]
        borne = some[(some_above != NULL) & self.moved[some_above]]
        above = its.above[borne]
        self.carried[borne], self.moved[borne] = self.turned[above] @ self.carried[above], True
        rows = self.rows_of(some)
        self._put(rows[self.moved[its.of_row[rows]]])
        return rows

    def turn(self, branch: Int[np.ndarray, " branch"], turns: Float[np.ndarray, "branch 3 3"]) -> None:
        """Turn branches of the rank taken up, from the way they grew; what thereby leaves the space is cut there."""
        out, share, _ = self.outside(branch, turns)
        self.turned[branch], self.moved[branch] = turns, True
        self.cut(out, share)
        self._put(self.rows_of(branch))

    def posed(self, row, of, turns: Float[np.ndarray, "branch 3 3"], branch) -> tuple[np.ndarray, np.ndarray]:
        """(start, tip) of rows, were the `of`th of some branches turned so, metres."""
        node = self.branches.node[branch]
        whole = (turns @ self.carried[branch])[of]
        pivot, grew = self.tip[node][of], self.tree.tip[node][of]
        place = [pivot + np.einsum("bij,bj->bi", whole, at - grew) for at in (self.start[row], self.tree.tip[row])]
        return place[0], place[1]

    def _put(self, rows) -> None:
        branch, of = np.unique(self.branches.of_row[rows], return_inverse=True)
        start, self.tip[rows] = self.posed(rows, of, self.turned[branch], branch)
        self.end[rows] = start + self.share[rows, None] * (self.tip[rows] - start)

    def rows_of(self, branch):
        """The rows of branches that are there, by branch."""
        which, row = self.branches.borne(self.branches.first[branch])
        mine = (self.branches.of_row[row] == branch[which]) & self.there[row]
        return row[mine]

    def unturned(self, branch: Int[np.ndarray, " branch"]) -> Float[np.ndarray, "branch 3 3"]:
        """No turns."""
        return np.broadcast_to(np.eye(3), (len(branch), 3, 3))

    def axis_of(self, row: Int[np.ndarray, " row"]) -> Float[np.ndarray, "row 3"]:
        """From start to tip of rows where they are, metres."""
        return self.tip[row] - self.tip[self.tree.parent[row]]

    def wood_of(self, row) -> Capsules:
        """What is left of rows that move, where it is."""
        row = row[self.there[row]]
        return Capsules.cut(row, self.tip[self.tree.parent[row]], self.end[row], self.radius[row], self.usual)

    def overlaps(self, wood: Wood, peers: Wood) -> Overlaps:
        """Where pieces overlap with what has its place and with their peers, the deepest of each owner and rows."""
        others = (self.settled, peers)
        found = [touching(self.kin, self.tip, wood.pieces, i, its.pieces, j) for its in others for i, j in wood.balls.meeting(its.balls)]
        return Overlaps.join(found).deepest()

    def outside(self, branch: Int[np.ndarray, " branch"], turns: Float[np.ndarray, "branch 3 3"]) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """(rows, shares up to where they do, wood lost thereby a branch, micrometres) of what would leave the space or sink into the
        ground, were branches turned so. What did so as it grew is left out."""
        of, row = self.branches.borne(self.branches.first[branch])
        share = np.where(self.there[row], self._held(row, *self.posed(row, of, turns, branch)), 1.0)
        out = np.flatnonzero(share < 1.0)
        out = out[self._held(row[out], self.start[row[out]], self.tree.tip[row[out]]) == 1.0]
        share[out] = np.where(share[out] > _STUMP, share[out], 0.0)
        ends = np.zeros(len(row) + 1, np.int64)
        np.add.at(ends, out + 1, 1)
        np.add.at(ends, out + self.branches.size[row[out]], -1)
        kept = np.where(np.cumsum(ends)[:-1] > 0, 0.0, 1.0)
        kept[out] *= share[out]
        lost = np.bincount(of, np.rint((1.0 - kept) * self.length[row] / GRAIN), minlength=len(branch))
        return row[out], share[out], lost

    def _held(self, row, start, tip) -> Float[np.ndarray, " row"]:
        """The share of rows that lead from start to tip up to a barrier or the ground, 0-1."""
        share, name = np.ones(len(row)), self.tree.tree[row]
        for one in np.unique(name):
            if one in self.spaces:
                its = np.flatnonzero(name == one)
                share[its] = self.spaces[one].exit_fraction(start[its], tip[its])
        sinks = np.flatnonzero((tip[:, 1] < self.ground) & (tip[:, 1] < start[:, 1]))
        above = np.maximum(start[sinks, 1] - self.ground, 0.0)
        share[sinks] = np.minimum(share[sinks], above / (start[sinks, 1] - tip[sinks, 1]))
        return share

    def settle(self, rows: Int[np.ndarray, " row"]) -> None:
        """Rows have their places."""
        rows, wood = rows[self.there[rows]], self.settled.pieces
        short = self.there[wood.row] & (self.share[wood.row] < 1.0)
        again = np.unique(np.concatenate([rows, wood.row[short]]))
        self.settled = Wood.of(wood.select(self.there[wood.row] & ~short).join(self.wood_of(again)))

    def cut(self, row: Int[np.ndarray, " row"], share: Float[np.ndarray, " row"]) -> None:
        """Rows end at a share of what they were; what they bore goes, and so do those of which nothing is left."""
        np.minimum.at(self.share, row, share)
        row = np.unique(row)
        _, borne = self.branches.borne(row)
        gone = np.zeros(len(self.tip), bool)
        gone[borne] = True
        gone[row] = False
        self.there[gone] = False
        self.there[row[self.share[row] == 0]] = False
        start = self.tip[self.tree.parent[row]]
        self.end[row] = start + self.share[row, None] * (self.tip[row] - start)

    def clear_share(self, row: Int[np.ndarray, " pair"], other: Int[np.ndarray, " pair"], apart: float) -> Float[np.ndarray, " pair"]:
        """The share of each row up to where it comes nearer to another than `apart` times what both are thick, 0-1."""
        first, begin, vector = self.axis
        count = first[other + 1] - first[other]
        of = np.repeat(np.arange(len(row)), count)
        piece = first[other][of] + np.arange(len(of)) - (np.cumsum(count) - count)[of]
        stands = ~self.branches.moves[other][of]
        q = np.where(stands[:, None], begin[piece], self.tip[self.tree.parent[other]][of])
        e = np.where(stands[:, None], vector[piece], self.end[other][of] - q)
        p = self.tip[self.tree.parent[row]][of]
        d, reach = self.tip[row][of] - p, apart * (self.radius[row] + self.radius[other])[of]
        low, high = np.zeros(len(of)), np.ones(len(of))
        for _ in range(_BISECTIONS):
            middle = 0.5 * (low + high)
            s, t = nearest(p, middle[:, None] * d, q, e)
            free = np.linalg.norm(p + (s * middle)[:, None] * d - q - t[:, None] * e, axis=1) >= reach
            low, high = np.where(free, middle, low), np.where(free, high, middle)
        share = np.ones(len(row))
        np.minimum.at(share, of, low)
        return share


def _binding(space: Space) -> Space:
    """The barriers that bind; an implied crown does not."""
    return Space(tuple(barrier for barrier in space.barriers if getattr(barrier, "binding", True)))
