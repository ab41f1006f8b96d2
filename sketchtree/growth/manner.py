"""How does this tree branch? Angles and lengths of parent-child pairs, with their spread, for branches that are grafted on.

Single-image growth, §II.3: "the parameters (that is, three rotation angles around the x-, y-, and z-axis and the scaling factor on the
parent-child branches) are estimated based on the shape of the initial skeleton 3D model". In the frame of a branch (y along it, x and
z across it) they are here

    lean    about x   from the branch's way to that of a branch it bears, 0-π
    turn    about y   from one branch that it bears to the next, 0-π either way round
    swing   about z   from a piece of a branch to its next; its mean is 0, since left is no better than right
    scale             length of the branch borne / length of the branch that bears it

A tree of few branches tells little: each estimate is that of its n pairs and of k = `_DOUBT` pairs more as broad-leaved trees have them,

    μ = (Σ x + k μ₀) / (n + k)        σ² = (Σ (x − μ)² + k (σ₀² + (μ₀ − μ)²)) / (n + k)
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float

from sketchtree.growth.across import unit
from sketchtree.skeleton import Kind, TreeSkeleton
from sketchtree.traverse import limb_chains

_DOUBT = 4.0
_FOOT = 0.04  # of the tree's height: the way on which a branch's direction at its foot is measured


@dataclass(frozen=True)
class Spread:
    """A normal distribution."""

    mean: float
    sd: float


@dataclass(frozen=True)
class Manner:
    """How branches stand on each other; angles in radians."""

    lean: Spread = Spread(np.radians(45.0), np.radians(12.0))
    turn: Spread = Spread(np.radians(137.5), np.radians(20.0))
    swing: Spread = Spread(0.0, np.radians(8.0))
    scale: Spread = Spread(0.55, 0.15)

    @classmethod
    def of(cls, tree: TreeSkeleton) -> "Manner":
        """That of a tree without curve points."""
        limbs, usual = _Limbs.of(tree), cls()
        return cls(
            _blended(limbs.leans(), usual.lean),
            _blended(limbs.turns(), usual.turn),
            Spread(0.0, _blended(limbs.swings(), usual.swing).sd),
            _blended(limbs.scales(), usual.scale),
        )


@dataclass(frozen=True, eq=False)
class _Limbs:
    vector: Float[np.ndarray, "segment 3"]  # of all rows, metres
    chain: list  # rows of each limb
    bearer: Float[np.ndarray, " limb"]  # number of the limb that bears each; -1 none
    way: Float[np.ndarray, "limb 3"]  # of unit length, at its foot
    along: Float[np.ndarray, "limb 3"]  # of the limb that bears it, there
    length: Float[np.ndarray, " limb"]

    @classmethod
    def of(cls, tree: TreeSkeleton) -> "_Limbs":
        start, vector, length = tree.start, tree.vector, tree.length
        wood = ~tree.is_base & (tree.kind != int(Kind.ROOT)) & (length > 0)
        chain = [rows[wood[rows]] for rows in limb_chains(tree.parent, tree.limb)]
        chain = [rows for rows in chain if len(rows)]
        number = np.full(len(tree) + 1, -1)
        for k, rows in enumerate(chain):
            number[rows] = k
        foot = np.array([tree.parent[rows[0]] for rows in chain], int)
        reach = _FOOT * tree.height
        end = [rows[min(int(np.searchsorted(np.cumsum(length[rows]), reach)), len(rows) - 1)] for rows in chain]
        way = unit(tree.tip[np.array(end, int)] - start[np.array([rows[0] for rows in chain], int)])
        return cls(vector, chain, number[foot], way, unit(vector[foot]), np.array([length[rows].sum() for rows in chain]))

    def leans(self):
        borne = self.bearer >= 0
        return np.arccos(np.clip(np.sum(self.way[borne] * self.along[borne], axis=1), -1.0, 1.0))

    def scales(self):
        borne = self.bearer >= 0
        return np.minimum(self.length[borne] / self.length[self.bearer[borne]], 1.0)

    def turns(self):
        side = self.way - np.sum(self.way * self.along, axis=1, keepdims=True) * self.along
        place = np.array([rows[0] for rows in self.chain], int)
        order = np.lexsort((place, self.bearer))
        one, other = order[:-1], order[1:]
        next_to = (self.bearer[one] == self.bearer[other]) & (self.bearer[one] >= 0)
        one, other = unit(side[one[next_to]]), unit(side[other[next_to]])
        return np.arccos(np.clip(np.sum(one * other, axis=1), -1.0, 1.0))

    def swings(self):
        bends = [np.zeros(0)]
        for rows in self.chain:
            way = unit(self.vector[rows])
            # half of what a piece turns by, squared, is sideways: the other half is within the plane of the lean
            bends.append(np.arccos(np.clip(np.sum(way[1:] * way[:-1], axis=1), -1.0, 1.0)) / np.sqrt(2.0))
        return np.concatenate(bends)


def _blended(seen: Float[np.ndarray, " pair"], usual: Spread) -> Spread:
    count = len(seen) + _DOUBT
    mean = (seen.sum() + _DOUBT * usual.mean) / count
    square = (np.sum((seen - mean) ** 2) + _DOUBT * (usual.sd**2 + (usual.mean - mean) ** 2)) / count
    return Spread(float(mean), float(np.sqrt(square)))
