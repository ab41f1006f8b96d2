"""The wood of a whole tree as one textured mesh."""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Array, Bool, Float, Int, Key

from sketchtree import keys
from sketchtree.geometry.bark import bark_material
from sketchtree.geometry.collars import collar_tops
from sketchtree.geometry.detail import Detail
from sketchtree.geometry.limbs import CentreLines, centre_lines
from sketchtree.geometry.mesh import Material, Mesh
from sketchtree.geometry.resolution import collar_rings, halvings, sides
from sketchtree.geometry.rings import Rings, rings
from sketchtree.geometry.tubes import sweep
from sketchtree.skeleton import TreeSkeleton


def wood_mesh(tree: TreeSkeleton, *, bark: str, key: Key[Array, ""], detail: Detail = Detail()) -> Mesh:  # noqa: B008 (frozen)
    """Limbs as closed tubes that grow out of each other, in one mesh called `wood`.

    `bark` is a name of `bark_names()`; `key` shifts the bark of each limb. A tree without a segment gives an
    empty mesh. With more than `detail.most_triangles` the tolerances grow until it fits; the coarsest mesh has
    about 12 triangles a limb. Raises `OptionError` for an unknown bark.
    """
    material = bark_material(bark)
    plan = plan_wood(tree, centre_lines(tree), detail)
    return swept(plan, np.ones(len(plan.lines), bool), "wood", material, key)


@dataclass(frozen=True, eq=False)
class WoodPlan:
    """Where the rings of all limbs stand, and how many sides they have."""

    lines: CentreLines
    collar_top: Float[np.ndarray, " limb"]  # metres
    ring: Rings
    side: Int[np.ndarray, " limb"]  # at the foot
    level: Int[np.ndarray, " ring"]  # how often the sides were halved
    detail: Detail  # as used: no finer than asked for
    tolerance: float  # metres

    @property
    def triangle_count(self) -> int:
        """Triangles of the mesh, at most: what it costs if no ring halved its sides on the way."""
        n = (self.side[self.ring.limb] >> self.level)
        return int(2 * n.sum())


def plan_wood(tree: TreeSkeleton, lines: CentreLines, detail: Detail) -> WoodPlan:
    """The rings of every limb, within the budget of `detail`."""
    height = max(float(np.ptp(tree.tip, axis=0).max()), 1e-9) if len(tree) else 1.0  # the longest side of the tree's box
    while True:
        plan = _plan(lines, detail, height)
        if plan.triangle_count <= detail.most_triangles or detail.is_coarsest:
            return plan
        detail = detail.coarser(max(1.5, plan.triangle_count / detail.most_triangles))


def swept(plan: WoodPlan, among: Bool[np.ndarray, " limb"], name: str, material: Material, key: Key[Array, ""]) -> Mesh:
    """The mesh of the limbs `among` all."""
    shift = np.stack([keys.uniform(key, plan.lines.limb_id, draw) for draw in (0, 1)], axis=1)
    shape = plan.side, plan.level
    surface = sweep(plan.lines, plan.ring, shape, plan.collar_top, shift, plan.detail, plan.tolerance, among)
    return Mesh(name, surface.position, surface.normal, surface.uv, surface.triangle, material)


def _plan(lines: CentreLines, detail: Detail, height: float) -> WoodPlan:
    tolerance = detail.tolerance * height
    foot = sides(lines.radius[lines.start[:-1]], tolerance, detail)
    top = collar_tops(lines, detail, height)
    ring = rings(lines, top, collar_rings(foot), detail, height)
    needed = np.minimum(sides(ring.radius, tolerance, detail), foot[ring.limb])
    side, level = halvings(needed, np.where(top > 0, collar_rings(foot), 1), ring.start, detail.most_sides)
    return WoodPlan(lines, top, ring, side, level, detail, tolerance)
