"""How many leaves does the tree wear, and where? As many as the points say, where they say.

Leaves are made as on any tree (`foliage.populate`), at tips and along young wood, by the model's arrangement, angle and size; on wood that no leaf was seen near none stays. In cubes of the crown
so many stay that their area is that of the leaves that were scanned:

    share kept in a cube = min(1, Σ a_i / Σ A)        a_i  area that a point of a leaf stands for (`Leafiness.area`)        A  area of a leaf that was made

Where the species bears too few, they stand closer.
"""

from dataclasses import dataclass, replace

import numpy as np
from jaxtyping import Array, Bool, Float, Key
from scipy.spatial import cKDTree

from sketchtree.dressing import Dress
from sketchtree.foliage.blossom import blossom
from sketchtree.foliage.leaves import Leaves, select
from sketchtree.foliage.models import leaf_painting
from sketchtree.foliage.populate import populate
from sketchtree.foliage.triangles import drawn_area
from sketchtree.keys import numpy_generator, stage_key
from sketchtree.skeleton import TreeSkeleton

_CUBE = 0.06  # of the cloud's longest side
_REACH, _SPACINGS = 0.015, 2.0  # of that side, or so many spacings of the points: how near a leaf that was made is to one that was seen
_DENSEST, _THINNEST = 4.0, 1.05  # times the species' density: the most, and what is not worth asking for


@dataclass(frozen=True, eq=False)
class Covering:
    """Makes the leaves of one tree (`pipeline.Leafing`)."""

    place: Float[np.ndarray, "point 3"]  # of leaves that were seen, metres
    area: Float[np.ndarray, " point"]  # m² that each stands for

    def __call__(self, tree: TreeSkeleton, dress: Dress, key: Key[Array, ""]) -> tuple[Leaves, Leaves | None]:
        """(leaves, blossoms of a spring)."""
        key = stage_key(key, "foliage")
        if dress.leaf is None:
            return Leaves.none(dress.habit.leaf), None
        how = {"key": key, "model": dress.leaf, "season": dress.season}
        leaves = self._near(populate(tree, dress.habit, **how))
        wanted, made = self.area.sum(), leaf_area_of(leaves).sum()
        if len(leaves) and wanted > _THINNEST * made:
            leaves = self._near(populate(tree, dress.habit, density=float(min(wanted / made, _DENSEST)), **how))
        flowers = blossom(tree, dress.habit, **how)
        return self._as_many(leaves, key), flowers if flowers is None else self._near(flowers)

    @property
    def _side(self) -> float:
        return float(np.ptp(self.place, axis=0).max())

    def _near(self, leaves: Leaves) -> Leaves:
        """Those that stand where leaves were seen."""
        if not len(leaves):
            return leaves
        middle = leaves.position + 0.5 * leaves.size[:, None] * leaves.direction
        reach = max(_REACH * self._side, _SPACINGS * float(np.sqrt(np.median(self.area))), float(np.median(leaves.size)))
        return _kept(leaves, cKDTree(self.place).query(middle, distance_upper_bound=reach)[0] < np.inf)

    def _as_many(self, leaves: Leaves, key) -> Leaves:
        """No more in any cube than the points say."""
        if not len(leaves):
            return leaves
        edge, low = max(_CUBE * self._side, 1e-6), self.place.min(axis=0)
        every = np.floor((np.concatenate([self.place, leaves.position]) - low) / edge).astype(np.int64)
        _, cube = np.unique(every, axis=0, return_inverse=True)
        cube = cube.ravel()
        seen = np.bincount(cube[: len(self.place)], self.area, cube.max() + 1)
        made = np.bincount(cube[len(self.place) :], leaf_area_of(leaves), cube.max() + 1)
        share = np.minimum(seen / np.maximum(made, 1e-12), 1.0)
        draw = numpy_generator(stage_key(key, "as many")).random(len(leaves))
        return _kept(leaves, draw < share[cube[len(self.place) :]])


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
