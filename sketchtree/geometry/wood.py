"""The wood of a whole tree as textured meshes."""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Array, Bool, Float, Int, Key

from sketchtree import keys
from sketchtree.axes import NULL
from sketchtree.geometry.bark import bark_material, rachis_material, twig_material
from sketchtree.geometry.collars import collar_tops
from sketchtree.geometry.detail import Detail
from sketchtree.geometry.limbs import CentreLines, centre_lines
from sketchtree.geometry.mesh import Material, Mesh
from sketchtree.geometry.radii import is_frond
from sketchtree.geometry.resolution import collar_rings, halvings, sides
from sketchtree.geometry.rings import Rings, rings
from sketchtree.geometry.tubes import sweep
from sketchtree.parameters import Habit
from sketchtree.skeleton import TreeSkeleton

_YOUNG = 0.012  # metres, radius at its foot of a limb that has no bark yet


def wood_mesh(tree: TreeSkeleton, *, bark: str, key: Key[Array, ""], detail: Detail = Detail()) -> Mesh:  # noqa: B008 (frozen)
    """Limbs as closed tubes that grow out of each other, in one mesh called `wood`.

    `bark` is a name of `bark_names()`; `key` shifts the bark of each limb. A tree without a segment gives an
    empty mesh. With more than `detail.most_triangles` the tolerances grow until it fits; the coarsest mesh has
    about 12 triangles a limb. Raises `OptionError` for an unknown bark.
    """
    material = bark_material(bark)
    plan = plan_wood(tree, centre_lines(tree), detail)
    return swept(plan, np.ones(len(plan.lines), bool), "wood", material, key)


def wood_meshes(
    tree: TreeSkeleton, *, bark: str, habit: Habit, key: Key[Array, ""], detail: Detail = Detail()  # noqa: B008 (frozen)
) -> tuple[Mesh, ...]:
    """The same limbs as `wood_mesh`, in up to three meshes: `wood`, which has bark; `wood_twigs`, limbs too young for it;
    and `wood_rachis`, the midribs of a palm's fronds. `wood` comes first and is always there; the others where there are any.

    `detail.most_triangles` holds for all together. Raises `OptionError` for an unknown bark.
    """
    material = bark_material(bark)
    frond = is_frond(tree) if habit.leaf_arrangement == "frond" else np.zeros(len(tree), bool)
    plan = plan_wood(tree, centre_lines(tree, apart=frond), detail)
    lines = plan.lines
    midrib = frond[lines.first_row]
    twig = (lines.radius[lines.start[:-1]] < _YOUNG) & (lines.parent != NULL) & ~midrib
    meshes = [swept(plan, ~(midrib | twig), "wood", material, key)]
    for name, among, skin in (("wood_twigs", twig, twig_material(bark)), ("wood_rachis", midrib, rachis_material())):
        if among.any():
            meshes.append(swept(plan, among, name, skin, key))
    return tuple(meshes)


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
        """Triangles of the mesh, at most: two for each vertex of the rings."""
        return int(2 * (self.side[self.ring.limb] >> self.level).sum())


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
