"""What stands in the tree's way?

Meshes and regions of the page (`obstacle`), as one barrier and one guide. Growth ends where it would come too near; from a
distance D on, branches that head for an obstacle turn to pass along it, the more the nearer:

    d ← (1 − s) d + s t / |t|       t = d + κ (n + u_⊥ / 3 + r_⊥ / 6),   κ = −d·n > 0,   s = w² (3 − 2w),   w = 1 − m / D

    n     away from the nearest obstacle;  m  the margin halfway along the step, as the heading goes
    t     d without its part against n: along the surface; what heads straight for it turns up (u), each limb a little to a side of its own (r)

A heading that leads away stays as it is.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Float, Int

from sketchtree import keys
from sketchtree.propagate.space.domain import Domain
from sketchtree.propagate.space.obstacle import Obstacle, from_mesh, from_region, name_of, refuse_around
from sketchtree.skeleton import TreeSkeleton

_CORNERS = 250_000  # of all grids together
_CLOSELY = 16
_UP, _ASIDE = 1 / 3, 1 / 6  # of a head-on heading: what turns it upwards, and to its limb's own side
_SIDES = np.uint64(0x6F6273)  # in a key's place: a limb's own side is the same whatever the seed
_ROUNDS = 8  # of pushing a path aside and evening it
_BESIDE = 0.25  # of D: how far from where wood may not be a path that is pushed aside lies


@dataclass(frozen=True, eq=False)
class Obstacles:
    """All that is in reach of one tree: a barrier and a guide of its space."""

    obstacles: tuple[Obstacle, ...]
    domain: Domain
    cut_off: bool = False  # whether some of them go on beyond the domain, where they are not known: no growth there
    out_of_reach: tuple[str, ...] = ()  # names of the meshes that change nothing

    @classmethod
    def build(cls, meshes, regions, domain: Domain) -> "Obstacles":
        """From meshes (trimesh.Trimesh, world metres) and closed outlines on the page (each point 2, world metres).

        Raises OptionError for one that encloses a root, and for an outline without area."""
        refuse_around(meshes, domain.root)
        most = _CORNERS / max(len(meshes) + len(regions), 1)
        found = [from_mesh(mesh, domain, most) for mesh in meshes]
        found += [from_region(outline, f"The obstacle region {k + 1} of the drawing", domain, most) for k, outline in enumerate(regions)]
        points = [*(mesh.bounds for mesh in meshes), *(np.asarray(outline, float) for outline in regions)]
        cut_off = any(one is not None and not domain.holds(point).all() for point, one in zip(points, found, strict=True))
        far = tuple(name_of(mesh, k) for k, mesh in enumerate(meshes) if found[k] is None)
        return cls(tuple(one for one in found if one is not None), domain, cut_off, far)

    def __len__(self) -> int:
        return len(self.obstacles)

    @property
    def clearance(self) -> float:
        """The widest of the obstacles' clearances, metres."""
        return max((one.clearance for one in self.obstacles), default=0.0)

    def inside(self, point: Float[np.ndarray, "point 3"]) -> Bool[np.ndarray, " point"]:
        """Which points wood may be at."""
        free = self.domain.holds(point) if self.cut_off else np.ones(len(point), bool)
        for one in self.obstacles:
            free &= one.clear(point) > 0
        return free

    def exit_fraction(
        self, start: Float[np.ndarray, "branch 3"], end: Float[np.ndarray, "branch 3"], bisections: int = 16
    ) -> Float[np.ndarray, " branch"]:
        """The fraction of each way from `start` to `end` before it comes too near to an obstacle; 0 for what starts there.

        With fewer `bisections` than `_CLOSELY`, where growth is only planned, the grid alone is asked."""
        fraction = np.ones(len(start))
        for one in self.obstacles:
            fraction = np.minimum(fraction, one.free(start, end, bisections >= _CLOSELY))
        return np.where(self.domain.holds(end), fraction, 0.0) if self.cut_off else fraction

    def turned(
        self,
        start: Float[np.ndarray, "branch 3"],
        heading: Float[np.ndarray, "branch 3"],
        step: Float[np.ndarray, " branch"],
        limb: Int[np.ndarray, " branch"],
    ) -> Float[np.ndarray, "branch 3"]:
        """Headings that pass along what they would run into; those in the open are the same to the last bit."""
        margin, nearest = self._nearest(start)
        rows = np.flatnonzero(margin < self.domain.influence)
        away = self._away(start[rows], nearest[rows])
        against = -np.einsum("bi,bi->b", heading[rows], away)
        meets = against > 1e-9
        rows, away, against = rows[meets], away[meets], against[meets]
        if len(rows) == 0:
            return heading
        margin = np.maximum(margin[rows] - 0.5 * step[rows] * against, 0.0)
        near = 1.0 - np.minimum(margin / self.domain.influence, 1.0)
        weight = (near * near * (3.0 - 2.0 * near))[:, None]
        along = heading[rows] + against[:, None] * (away + _tangential(away, limb[rows]))
        along /= np.linalg.norm(along, axis=1)[:, None]
        found = heading.copy()
        turned = (1.0 - weight) * heading[rows] + weight * along
        found[rows] = turned / np.linalg.norm(turned, axis=1)[:, None]
        return found

    def clear(self, path: Float[np.ndarray, "point 3"]) -> Float[np.ndarray, "point 3"]:
        """A path laid out beforehand, led round the obstacles from its first point on, which stays; it ends where that fails."""
        if (self._nearest(path)[0] >= self.domain.influence).all():
            return path
        path = path.copy()
        for _ in range(_ROUNDS):
            margin, nearest = self._nearest(path)
            lacks = np.maximum(_BESIDE * self.domain.influence - margin, 0.0)
            lacks[0] = 0.0
            path += lacks[:, None] * self._away(path, nearest)
            path[1:-1] += 0.5 * (0.5 * (path[:-2] + path[2:]) - path[1:-1])
        met = np.flatnonzero(self.exit_fraction(path[:-1], path[1:]) < 1.0)
        return path[: met[0] + 1] if len(met) else path

    def touched(self, tree: TreeSkeleton) -> int:
        """How many limbs of a tree go through an obstacle or come too near to it; not those that only start so, on the ground."""
        start, tip = tree.start[~tree.is_base], tree.tip[~tree.is_base]
        met = ~self.inside(tip) | (self.inside(start) & (self.exit_fraction(start, tip) < 1.0))
        return len(np.unique(tree.limb[~tree.is_base][met]))

    def _nearest(self, point):
        """(the least margin at each point, metres, infinite where nothing is near; whose it is)."""
        margin, nearest = np.full(len(point), np.inf), np.zeros(len(point), np.int64)
        for k, one in enumerate(self.obstacles):
            its = one.margin(point, self.domain.influence)
            nearest[its < margin] = k
            margin = np.minimum(margin, its)
        return margin, nearest

    def _away(self, point, nearest):
        """Unit directions away from each point's nearest obstacle."""
        away = np.zeros((len(point), 3))
        for k, one in enumerate(self.obstacles):
            away[nearest == k] = one.away(point[nearest == k])
        return away


def _tangential(away, limb):
    """What turns a head-on heading: upwards, and to the limb's own side, along the surface."""
    turn = 2 * np.pi * keys.uniform(_SIDES, limb, 0)
    wanted = np.stack([_ASIDE * np.cos(turn), np.full(len(turn), _UP), _ASIDE * np.sin(turn)], axis=1)
    return wanted - np.einsum("bi,bi->b", wanted, away)[:, None] * away
