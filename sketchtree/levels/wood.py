"""The wood of a tree with few triangles.

Limbs are tubes through some of the full tree's rings, open at the foot, inside their parent's wood; which limbs, of how many rings and sides,
`shapes` decides. Bark lies on them as on the full tree (`geometry.unwrap`).
"""

from dataclasses import dataclass, replace

import numpy as np
from jaxtyping import Bool, Float, Int

from sketchtree.geometry.bark import Colour
from sketchtree.geometry.detail import Detail
from sketchtree.geometry.limbs import centre_lines
from sketchtree.geometry.mesh import Material, Mesh
from sketchtree.geometry.rings import Rings
from sketchtree.geometry.rootflare import faded
from sketchtree.geometry.unwrap import circumference, lengthwise, repeats
from sketchtree.geometry.wood import WoodPlan, frond_rows, limb_skins, plan_wood
from sketchtree.levels.shapes import Choices, Shapes, choices_of, choose_shapes, circumradius
from sketchtree.parameters import Habit
from sketchtree.skeleton import TreeSkeleton


@dataclass(frozen=True, eq=False)
class LevelWood:
    """The wood of a tree, ready to be drawn with any number of triangles."""

    plan: WoodPlan  # of the full tree
    ring: Rings  # its rings, flared
    choices: Choices | None  # None: no limb
    full: Int[np.ndarray, " limb"]  # sides
    weight: Float[np.ndarray, " limb"]  # how much of each limb is seen
    kind: tuple[tuple[str, Material, Bool[np.ndarray, " limb"]], ...]  # name, material and limbs of each mesh

    @classmethod
    def of(
        cls, tree: TreeSkeleton, *, bark: str, habit: Habit, leafy: Bool[np.ndarray, " segment"] | None = None, hidden: float = 0.5, detail: Detail = Detail(),  # noqa: B008 (frozen)
        bark_colour: Colour | None = None, surface: bool = False,
    ) -> "LevelWood":
        """Of a tree. Limbs of rows that are `leafy` are hidden by their leaves, and weigh only 1 − `hidden`; `detail` is that of the full
        tree; `surface`: triangles go where they keep the surface, rather than the outline alone (`shapes`). Raises `OptionError` for an unknown bark."""
        frond = frond_rows(tree, habit)
        plan = plan_wood(tree, centre_lines(tree, apart=frond), detail)
        lines, ring = plan.lines, _flared(plan, detail.flare)
        full = (plan.side[ring.limb] >> plan.level)[(ring.start[:-1] + ring.start[1:]) // 2] if len(lines) else plan.side
        weight = np.ones(len(lines)) if leafy is None else 1.0 - hidden * leafy[lines.first_row]
        kind = limb_skins(lines, frond, bark, bark_colour)
        return cls(plan, ring, choices_of(ring, full, surface) if len(lines) else None, full, weight, kind)

    def meshes(self, triangles: int) -> tuple[Mesh, ...]:
        """At most so many triangles: `wood` first, then `wood_twigs` and `wood_rachis` where there are any."""
        if self.choices is None:
            return (_empty("wood", self.kind[0][1]),)
        shapes = choose_shapes(self.ring, self.choices, self.plan.lines.parent, self.weight, triangles)
        drawn = shapes.side > 0
        made = [_tubes(self.ring, self.full, shapes, among & drawn, name, skin, self.plan.detail.tile) for name, skin, among in self.kind]
        return (made[0], *(mesh for mesh in made[1:] if mesh.triangle_count))


def _flared(plan: WoodPlan, amount: float) -> Rings:
    """The rings of the full tree, stems widened at the ground, without the buttresses (`geometry.rootflare`)."""
    ring = plan.ring
    return replace(ring, radius=ring.radius * (1.0 + amount * faded(plan.lines, ring.limb, ring.s)))


def _empty(name: str, material: Material) -> Mesh:
    return Mesh(name, np.zeros((0, 3)), np.zeros((0, 3)), np.zeros((0, 2)), np.zeros((0, 3), np.int64), material)


def _tubes(all_rings: Rings, full, shapes: Shapes, among, name: str, material: Material, tile: float) -> Mesh:
    """The limbs `among` all, as one mesh."""
    limbs = np.flatnonzero(among)
    if len(limbs) == 0:
        return _empty(name, material)
    ring = _thinned(all_rings, np.flatnonzero(shapes.kept & among[all_rings.limb]))
    side, spike = shapes.side[limbs], shapes.spike[limbs]
    radius = ring.radius * circumradius(side, full[limbs])[ring.limb]
    radius[ring.start[:-1][spike]] = (radius[ring.start[:-1]] + radius[ring.start[1:] - 1])[spike]
    radius[ring.start[1:][spike] - 1] = 0.0
    of_ring = side[ring.limb]
    first = np.r_[0, np.cumsum(of_ring + 1)]
    which = np.repeat(np.arange(len(of_ring)), of_ring + 1)
    corner = np.arange(first[-1]) - first[which]
    out = _outward(ring, which, 2.0 * np.pi * (corner % of_ring[which]) / of_ring[which])
    around = circumference(ring, of_ring)
    repeat = repeats(ring, around, tile)[ring.start[:-1]][ring.limb]
    uv = np.stack([(repeat / of_ring)[which] * corner, -lengthwise(ring, around, repeat, tile)[which]], axis=1)
    return Mesh(name, ring.point[which] + radius[which, None] * out, out, uv, _triangles(first, of_ring, ring, spike), material)


def _thinned(ring: Rings, stand) -> Rings:
    """Only the rings `stand`; limbs that keep none are no more. Their vertices stand as they stood, so that fine and coarse agree."""
    limb = ring.limb[stand]
    start = np.r_[0, np.flatnonzero(np.diff(limb)) + 1, len(stand)].astype(np.int64)
    return Rings(start, ring.s[stand], ring.point[stand], ring.tangent[stand], ring.reference[stand], ring.radius[stand])


def _outward(ring: Rings, which, theta):
    """Unit vectors from the middle of each ring to its vertices."""
    across = np.cross(ring.tangent, ring.reference)
    return np.cos(theta)[:, None] * ring.reference[which] + np.sin(theta)[:, None] * across[which]


def _triangles(first, side, ring: Rings, spike):
    """Two a side between rings, and a lid on the last ring of a limb. A spike's last ring is its point: one a side and no lid."""
    last = np.zeros(len(side), bool)
    last[ring.start[1:] - 1] = True
    below, within = _each(np.flatnonzero(~last), side)
    a, d = first[below] + within, first[below + 1] + within
    sharp = spike[ring.limb[below]]
    full = np.stack([a, a + 1, d + 1, a, d + 1, d], axis=1)[~sharp].reshape(-1, 3)
    lid, within = _each(np.flatnonzero(last & ~spike[ring.limb]), side - 2)
    lids = np.stack([first[lid], first[lid] + within + 1, first[lid] + within + 2], axis=1)
    return np.concatenate([full, np.stack([a, a + 1, d], axis=1)[sharp], lids])


def _each(rows, count):
    """Every row as often as it counts, and which time it is."""
    which = np.repeat(rows, count[rows])
    return which, np.arange(len(which)) - np.repeat(np.cumsum(count[rows]) - count[rows], count[rows])
