"""How many leaves does the tree wear, and where? As many as the points say, where they say.

Leaves are made as on any tree (`foliage.populate`), at tips and along young wood, by the model's arrangement, angle and size; on wood that no leaf was seen near none stays. Of the others that share
stays of which a scan would show as much (`shown`):

    n(t) = cubes that hold what is seen of a share t of the leaves that were made        t* : n(t*) = cubes that hold points of leaves that were scanned

Cubes are as large as a leaf, or as two spacings of the points, and what is seen is thinned to as many spots in each as it has points: how densely a leaf was scanned makes no odds. In greater cubes more stay or fewer, as there are more or fewer of those cubes there.
Where the species bears too few, they stand closer.
"""

from dataclasses import dataclass, replace

import numpy as np
from jaxtyping import Array, Bool, Float, Int, Key
from scipy.spatial import cKDTree

from sketchtree.clouds.leafy.shown import cubes, pixel_of, shown, spots
from sketchtree.dressing import Dress
from sketchtree.foliage.blossom import blossom
from sketchtree.foliage.leaves import Leaves, select
from sketchtree.foliage.models import leaf_painting
from sketchtree.foliage.populate import populate
from sketchtree.foliage.triangles import drawn_area
from sketchtree.foliage.twigs import THICKEST
from sketchtree.keys import numpy_generator, stage_key
from sketchtree.parameters import Habit
from sketchtree.skeleton import TreeSkeleton

_REGION = 0.06  # of the cloud's longest side: edge of a greater cube
_REACH, _SPACINGS = 0.015, 2.0  # of that side, or so many spacings of the points: how near a leaf that was made is to one that was seen
_CUBE = 2.0  # spacings: edge of a cube at least; a leaf's length where that is more
_SHARES = (1.0, 0.5, 0.25, 0.125, 0.0625, 0.03125)  # of the leaves, that are looked at
_DENSER, _THIN = 2.5, 1.2  # times the species' density, where so many times what it shows was seen
_NEIGHBOURS = 6  # that a spacing is told by
_FEW = 2.0  # cubes that are added to both counts of a greater cube: few tell little


@dataclass(frozen=True, eq=False)
class Covering:
    """Makes the leaves of one tree (`pipeline.Leafing`)."""

    place: Float[np.ndarray, "point 3"]  # of points that are leaves for sure, metres

    def __call__(self, tree: TreeSkeleton, dress: Dress, key: Key[Array, ""]) -> tuple[Leaves, Leaves | None]:
        """(leaves, blossoms of a spring)."""
        key = stage_key(key, "foliage")
        if dress.leaf is None:
            return Leaves.none(dress.habit.leaf), None
        how = {"key": key, "model": dress.leaf, "season": dress.season}
        leaves = self._near(_on_twigs(populate(tree, dress.habit, **how), tree, dress.habit))
        look = Look.of(leaves, self.place, key)
        if look is not None and look.seen > _THIN * look.counts[0]:
            leaves = self._near(_on_twigs(populate(tree, dress.habit, density=_DENSER, **how), tree, dress.habit))
            look = Look.of(leaves, self.place, key)
        flowers = blossom(tree, dress.habit, **how)
        return leaves if look is None else _kept(leaves, look.stays(_REGION * self._side)), flowers if flowers is None else self._near(flowers)

    @property
    def _side(self) -> float:
        return float(np.ptp(self.place, axis=0).max())

    def _near(self, leaves: Leaves) -> Leaves:
        """Those that stand where leaves were seen."""
        if not len(leaves):
            return leaves
        middle = leaves.position + 0.5 * leaves.size[:, None] * leaves.direction
        reach = max(_REACH * self._side, _SPACINGS * spacing_of(self.place), float(np.median(leaves.size)))
        return _kept(leaves, cKDTree(self.place).query(middle, distance_upper_bound=reach)[0] < np.inf)


@dataclass(frozen=True, eq=False)
class Look:
    """What a scan would show of some of the leaves, beside what it did."""

    spots: Float[np.ndarray, "leaf spot 3"]
    pixel: float
    edge: float  # of a cube, metres
    rank: Float[np.ndarray, " leaf"]  # 0-1: of a share t those below t stay
    place: Float[np.ndarray, "point 3"]
    seen: int  # cubes that hold points
    counts: tuple[int, ...]  # and that hold what is seen of each of _SHARES

    @classmethod
    def of(cls, leaves: Leaves, place: Float[np.ndarray, "point 3"], key: Key[Array, ""]) -> "Look | None":
        """None where there are no leaves."""
        if not len(leaves) or not len(place):
            return None
        edge = max(float(np.median(leaves.size)), _CUBE * spacing_of(place), 1e-6)
        rank = numpy_generator(stage_key(key, "as many")).random(len(leaves))
        begun = cls(spots(leaves), pixel_of(leaves), edge, rank, place, len(cubes(place, edge)), ())
        return replace(begun, counts=tuple(len(begun.cubes_at(share)) for share in _SHARES))

    def cubes_at(self, share: float) -> Int[np.ndarray, "cube 3"]:
        """Those that hold what is seen of so many of the leaves."""
        some = self.spots[self.rank < share].reshape(-1, 3)
        if not len(some):
            return np.zeros((0, 3), np.int64)
        some = some[shown(some, self.pixel)]
        whole = cubes(some, self.edge)
        thin = len(whole) * len(self.place) / (self.seen * len(some))  # as many points in a cube as were scanned
        return whole if thin >= 1.0 else cubes(some[np.floor(np.arange(1, int(thin * len(some)) + 1) / thin).astype(int) - 1], self.edge)

    @property
    def share(self) -> float:
        """t*, 0 to 1."""
        count = np.maximum.accumulate(np.maximum(self.counts[::-1], 1))
        if self.seen <= count[0]:
            return _SHARES[-1] * self.seen / float(count[0])
        return float(np.exp(np.interp(np.log(self.seen), np.log(count), np.log(_SHARES[::-1]))))

    def stays(self, region: float) -> Bool[np.ndarray, " leaf"]:
        """Which leaves stay: a share of them all, more in those greater cubes where more was seen. `region`: edge of one, metres."""
        share, many = self.share, max(round(region / self.edge), 1)
        if share >= 1.0:
            return np.ones(len(self.rank), bool)
        own = np.floor(self.spots[:, 0] / self.edge).astype(np.int64)
        parts = [np.floor_divide(part, many) for part in (cubes(self.place, self.edge), self.cubes_at(share), own)]
        _, of = np.unique(np.concatenate(parts), axis=0, return_inverse=True)
        of, ends = of.ravel(), np.cumsum([len(part) for part in parts])
        was, is_now = (np.bincount(part, minlength=of.max() + 1) + _FEW for part in (of[: ends[0]], of[ends[0] : ends[1]]))
        likely = share * (was / is_now)[of[ends[1] :]]
        for _ in range(8):  # as many in all as t* says, however they are spread
            likely = np.minimum(likely * share * len(likely) / max(np.minimum(likely, 1.0).sum(), 1e-12), 1.0)
        return self.rank < likely


def _on_twigs(leaves: Leaves, tree: TreeSkeleton, habit: Habit) -> Leaves:
    """Without those of shoots out of thick wood: points near a limb are more likely of leaves before it."""
    return _kept(leaves, tree.radius[leaves.segment] <= THICKEST * habit.twig_radius)


def spacing_of(place: Float[np.ndarray, "point 3"]) -> float:
    """How far points lie from the nearest others, metres: the median."""
    count = min(_NEIGHBOURS, len(place) - 1)
    return float(np.median(cKDTree(place).query(place, k=count + 1)[0][:, 1:])) if count > 0 else 0.0


def leaf_area_of(leaves: Leaves) -> Float[np.ndarray, " leaf"]:
    """What is drawn on each, m²."""
    return drawn_area(leaf_painting(leaves.model)) * leaves.size**2


def _kept(leaves: Leaves, keep: Bool[np.ndarray, " leaf"]) -> Leaves:
    """Some of the leaves, and the short shoots that still bear one."""
    few = select(leaves, keep)
    if not len(leaves.shoot) or keep.all():
        return few
    if not len(few):
        return replace(few, shoot=leaves.shoot[:0])
    foot, end = leaves.shoot[:, 0], leaves.shoot[:, 1]
    far = cKDTree(few.position).query((foot + end) / 2)[0]
    return replace(few, shoot=leaves.shoot[far <= 0.75 * np.linalg.norm(end - foot, axis=1)])
