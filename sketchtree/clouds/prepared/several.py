"""How many trees stand in the cloud, and which points are whose?

Stems that come out of the ground (`standing.stems`) are grouped into plants. Every point belongs to the plant from whose feet it is reached most easily, along wood rather than
through the air (`standing.reached`), so crowns that touch are parted where they do. Trees are numbered from the one with most points.

A plant that is much lower than the highest, or has few points beside the largest, is undergrowth, and so is what doesn't reach breast height: it is left out, and that is said;
unless it goes on into a tree, as a branch does that hangs to the ground. A stem that is much too thin for its height may be such a branch too; or one whose points lie round no bark, far
more scattered than those of the clearest trunk, as sprays do that weep to the ground.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int
from scipy.spatial import cKDTree

from sketchtree.axes import NULL
from sketchtree.clouds.standing.reached import reached
from sketchtree.clouds.standing.stems import Stems, breast_height, stems
from sketchtree.clouds.standing.trunk import trunk
from sketchtree.clouds.voxels import voxel_rows, voxel_size
from sketchtree.errors import OptionError, SeveralTrees

_LOOKED_AT = 60_000  # points that ways are sought through
_SAID = 9  # trees that an error names
_TOUCHES = 2.0  # times as far as its own points' sixth neighbours
_SLENDER = 0.15  # of the largest tree's thickness for its height: what is thinner may be a branch that hangs to the ground
_MANY, _BLURRED, _LOOSE, _SWELLS = 40, 2.5, 0.08, 1.2  # points of a stem that is judged; times as scattered as the clearest trunk, and of its own radius; times as thick at breast height as at the foot: then it is a spray
_LOW, _FEW = 0.35, 0.1  # of the highest plant, of the largest's points: less is undergrowth


@dataclass(frozen=True, eq=False)
class Plants:
    """The trees in a cloud, largest first."""

    of_point: Int[np.ndarray, " point"]  # 0, 1, ...: whose each point is; NULL for undergrowth
    place: Float[np.ndarray, "tree 2"]  # (x, z) where each stands, metres
    height: Float[np.ndarray, " tree"]  # metres

    def __len__(self) -> int:
        return len(self.place)


def plants(xyz: Float[np.ndarray, "point 3"], above: Float[np.ndarray, " point"]) -> Plants:
    """The trees among points so high above the ground."""
    found = stems(xyz, above)
    weeds = np.zeros(len(xyz), bool)
    weeds[found.weeds] = True
    number = int(found.plant.max()) + 1
    of_point = np.zeros(len(xyz), np.int64) if number == 1 else _whose(xyz, found, number)
    height, count, place, thick = np.zeros(number), np.bincount(of_point, minlength=number), np.zeros((number, 2)), np.zeros(number)
    for k in range(number):
        held = above[of_point == k]
        height[k] = np.percentile(held, 99.5) if len(held) else 0.0
        place[k], thick[k] = np.mean(found.place[found.plant == k], axis=0), found.thick[found.plant == k].max()
    tall = (height >= _LOW * height.max()) & (count >= _FEW * count.max())
    slender = thick * height.max() < _SLENDER * height * thick[count.argmax()]
    spray = _sprays(xyz, above, found, number)
    trees = np.flatnonzero(tall & ~slender & ~spray)
    trees = trees[np.argsort(-count[trees], kind="stable")]
    name = np.full(number, NULL)
    name[trees] = np.arange(len(trees))
    sure = name[of_point]
    for k in np.flatnonzero(name == NULL):
        name[k] = _borne_by(xyz, of_point == k, above, sure, height[k])
    for k in np.flatnonzero((name == NULL) & tall):  # slender or scattered, and for itself: a young tree, or one whose trunk was hardly seen
        name[k], trees = len(trees), np.append(trees, k)
    return Plants(np.where(weeds, NULL, name[of_point]), place[trees], height[trees])


def _sprays(xyz, above, found: Stems, number: int):
    """Which plants have stems that points lie round far less closely than round the clearest trunk."""
    breast = breast_height(float(np.percentile(above, 99.9)))
    most = [max((s for s in np.flatnonzero(found.plant == k)), key=lambda s: len(found.rows[s])) for k in range(number)] if number > 1 else []
    many = np.array([len(found.rows[s]) >= _MANY for s in most], bool)
    bark = [trunk(xyz[found.rows[s]], breast) for s in most]
    off = np.array([np.inf if one is None else one.off for one in bark])
    loose = np.array([one is None or one.off > _LOOSE * one.breast / 2 for one in bark], bool)
    swells = np.array([one is not None and one.breast > _SWELLS * one.root for one in bark], bool)
    least = off.min(initial=np.inf, where=many & ~swells)
    return many & (swells | loose & (off > _BLURRED * least)) if np.isfinite(least) else np.zeros(number, bool)


def _borne_by(xyz, low, above, tree, height: float) -> int:
    """The tree on which a low plant hangs: a branch that reaches the ground goes on into a tree, higher than its own half. NULL for one that stands for itself."""
    upper, others = np.flatnonzero(low & (above > 0.5 * height)), np.flatnonzero(tree != NULL)
    if len(upper) < 3 or not len(others):
        return NULL
    own = cKDTree(xyz[low]).query(xyz[upper], k=min(7, int(low.sum())))[0].reshape(len(upper), -1)[:, -1]
    gap, nearest = cKDTree(xyz[others]).query(xyz[upper])
    touching = gap <= _TOUCHES * np.median(own)
    return int(np.bincount(tree[others[nearest[touching]]]).argmax()) if touching.sum() >= 3 else NULL


def one_tree(found: Plants, tree: int | None, places: Sequence[str]) -> Int[np.ndarray, " kept"]:
    """Rows of the one tree, or of the tree of that number (from 1). `places`: where each stands, in words.

    Raises SeveralTrees where there are several and none was chosen, OptionError for a number that none has.
    """
    if tree is None and len(found) > 1:
        each = [f"{height:.1f} m high, at {place}" for height, place in zip(found.height, places, strict=True)]
        said = "; ".join(f"{k}: {words}" for k, words in enumerate(each[:_SAID], 1))
        stand = f"{len(found)} trees stand in the cloud ({said}{'; ...' if len(found) > _SAID else ''})."
        raise SeveralTrees(stand, remedy="Say which with `--tree K`, or cut it out of the cloud.", trees=tuple(each))
    if tree is not None and not 1 <= tree <= len(found):
        raise OptionError(f"There is no tree {tree}: the cloud has {len(found)}.", remedy=f"Say 1 to {len(found)}; 1 is the largest.")
    return np.flatnonzero(found.of_point == (0 if tree is None else tree - 1))


def _whose(xyz, found: Stems, number: int):
    """The plant that each point is reached from, through some of the points; the rest go with the nearest of those."""
    low = np.zeros(len(xyz), bool)
    low[np.concatenate(found.rows)] = True
    rest = np.flatnonzero(~low)
    if len(rest) > _LOOKED_AT:
        rest = rest[voxel_rows(xyz[rest], voxel_size(xyz[rest], _LOOKED_AT))]
    starts = [np.concatenate([found.rows[s] for s in np.flatnonzero(found.plant == k)]) for k in range(number)]
    starts = [some[voxel_rows(xyz[some], voxel_size(xyz[some], 4000))] if len(some) > 4000 else some for some in starts]
    rows = np.concatenate([*starts, rest])
    ends = np.cumsum([len(some) for some in starts])
    from_feet = reached(xyz[rows], [np.arange(end - len(some), end) for end, some in zip(ends, starts, strict=True)])
    known = np.flatnonzero(from_feet != NULL)
    return from_feet[known][cKDTree(xyz[rows[known]]).query(xyz)[1]]
