"""The wood of a whole tree as textured meshes."""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Array, Bool, Float, Int, Key

from sketchtree import keys
from sketchtree.axes import NULL
from sketchtree.errors import OptionError
from sketchtree.geometry.bark import Colour, bark_material, rachis_material, twig_material
from sketchtree.geometry.collars import collar_tops
from sketchtree.geometry.detail import Detail
from sketchtree.geometry.limbs import CentreLines, centre_lines
from sketchtree.geometry.mesh import Material, Mesh
from sketchtree.geometry.one_piece.joints import joined
from sketchtree.geometry.radii import is_frond
from sketchtree.geometry.resolution import collar_rings, halvings, sides
from sketchtree.geometry.rings import Rings, rings
from sketchtree.geometry.solid import require_solid, united
from sketchtree.geometry.stitch import Surface
from sketchtree.geometry.tubes import sweep
from sketchtree.parameters import Habit
from sketchtree.skeleton import TreeSkeleton
from sketchtree.watch import Pulse, no_pulse

WAYS = ("one-piece", "tubes")
"""How wood can be made."""

MOST_JOINED = 2_000
"""Limbs up to which wood is made in one piece unless told otherwise."""

_YOUNG = 0.012  # metres, radius at its foot of a limb that has no bark yet


@dataclass(frozen=True, eq=False)
class Wood:
    """The wood of a tree, and how it was made."""

    meshes: tuple[Mesh, ...]  # `wood` first
    made: str  # one-piece | tubes | solid
    warnings: tuple[str, ...] = ()


def wood_mesh(
    tree: TreeSkeleton, *, bark: str, key: Key[Array, ""], detail: Detail = Detail(), wood: str | None = None  # noqa: B008 (frozen)
) -> Mesh:
    """All limbs in one mesh called `wood`, made as `wood` says (see `wood_of`).

    `bark` is a name of `bark_names()`; `key` shifts the bark of each limb. A tree without a segment gives an
    empty mesh. With more than `detail.most_triangles` the tolerances grow until it fits; the coarsest tubes have
    about 12 triangles a limb. Raises `OptionError` for an unknown bark or way.
    """
    material = bark_material(bark)
    lines = centre_lines(tree)
    skin, lines, _ = _skin(tree, lines, None, made_as(wood, len(lines)), key, detail)
    return skin(np.ones(len(lines), bool), "wood", material)


def wood_meshes(
    tree: TreeSkeleton, *, bark: str, habit: Habit, key: Key[Array, ""], detail: Detail = Detail(), wood: str | None = None  # noqa: B008 (frozen)
) -> tuple[Mesh, ...]:
    """The meshes of `wood_of`."""
    return wood_of(tree, bark=bark, habit=habit, key=key, detail=detail, wood=wood).meshes


def wood_of(
    tree: TreeSkeleton,
    *,
    bark: str,
    habit: Habit,
    key: Key[Array, ""],
    detail: Detail = Detail(),  # noqa: B008 (frozen)
    wood: str | None = None,
    solid: bool = False,
    bark_colour: Colour | None = None,
) -> Wood:
    """The same limbs as `wood_mesh`, in up to three meshes: `wood`, which has bark; `wood_twigs`, limbs too young for it;
    and `wood_rachis`, the midribs of a palm's fronds. `wood` comes first and is always there; the others where there are any.

    `wood` is "one-piece" (all meshes together, welded, are one closed surface a base), "tubes" (each limb a closed tube that
    dips into its parent) or None: one piece up to `MOST_JOINED` limbs, else tubes, with a warning. `detail.most_triangles` holds for
    all together. `bark_colour` is the bark's mean colour, linear, where that is not its own. `solid` unites the tubes, whatever `wood` says: the surface then meets itself nowhere. Raises `OptionError` for an
    unknown bark or way, and where a solid is wanted without manifold3d.
    """
    check_wood(wood, solid)
    bark_material(bark)  # refuse a wrong name before the work
    frond = frond_rows(tree, habit)
    lines = centre_lines(tree, apart=frond)
    made = WAYS[1] if solid else made_as(wood, len(lines))
    skin, lines, sunk = _skin(tree, lines, frond, made, key, detail)
    meshes = [skin(among, name, surface) for name, surface, among in limb_skins(lines, frond, bark, bark_colour) if name == "wood" or among.any()]
    if solid:
        whole, crumbs = united(meshes)
        return Wood(whole, "solid", (f"{crumbs} small pieces of wood touch no other and are not in the solid.",) if crumbs else ())
    return Wood(tuple(meshes), made, _warnings(wood, made, len(lines), sunk))


def frond_rows(tree: TreeSkeleton, habit: Habit) -> Bool[np.ndarray, " segment"]:
    """Rows that are fronds of a palm; none of other trees."""
    return is_frond(tree) if habit.leaf_arrangement == "frond" else np.zeros(len(tree), bool)


def limb_skins(
    lines: CentreLines, frond: Bool[np.ndarray, " segment"], bark: str, colour: Colour | None = None
) -> tuple[tuple[str, Material, Bool[np.ndarray, " limb"]], ...]:
    """Name and material of each mesh of wood, and the limbs it holds: `wood` first. Raises `OptionError` for an unknown bark."""
    midrib = frond[lines.first_row]
    twig = (lines.radius[lines.start[:-1]] < _YOUNG) & (lines.parent != NULL) & ~midrib
    return ("wood", bark_material(bark, colour=colour), ~(midrib | twig)), ("wood_twigs", twig_material(bark, colour=colour), twig), ("wood_rachis", rachis_material(), midrib)


def check_wood(wood: str | None, solid: bool) -> None:
    """Raises `OptionError` for an unknown way, and where a solid is wanted without manifold3d."""
    made_as(wood, 0)
    if solid:
        require_solid()


def made_as(wood: str | None, limbs: int) -> str:
    """The way to make the wood of so many limbs, where `wood` is wished for. Raises `OptionError` for an unknown way."""
    if wood not in (None, *WAYS):
        raise OptionError(f"There is no way `{wood}` to make wood.", remedy=f"Choose one of: {', '.join(WAYS)}.")
    return wood or (WAYS[0] if limbs <= MOST_JOINED else WAYS[1])


def _warnings(wished: str | None, made: str, limbs: int, sunk: int) -> tuple[str, ...]:
    if sunk:
        return (f"{sunk} of {limbs} limbs found no room on the limbs they grow from: each is a closed tube that stands in the wood.",)
    if wished is None and made != WAYS[0]:
        return (f"The wood has {limbs:,} limbs, more than {MOST_JOINED:,}, so each is a tube of its own. `--wood one-piece` joins them.",)
    return ()


def _skin(tree: TreeSkeleton, lines: CentreLines, apart, made: str, key: Key[Array, ""], detail: Detail):
    """What makes the mesh of some limbs, by a name and a material; the lines it uses; and how many limbs could not be joined."""
    if made == WAYS[0] and len(lines):
        from sketchtree.geometry.one_piece.piece import within_budget

        lines = joined(centre_lines(tree, apart=apart, onward=True), tree)
        piece = within_budget(lines, _shift(lines, key), detail, _extent(tree))
        return lambda among, name, material: Mesh(name, *_of(piece.part(among)), material), lines, len(piece.sunk)
    plan = plan_wood(tree, lines, detail)
    return lambda among, name, material: swept(plan, among, name, material, key), lines, 0


def _of(surface: Surface):
    return surface.position, surface.normal, surface.uv, surface.triangle


def _shift(lines: CentreLines, key: Key[Array, ""]) -> Float[np.ndarray, "limb 2"]:
    """How far each limb's bark is shifted, tiles."""
    return np.stack([keys.uniform(key, lines.limb_id, draw) for draw in (0, 1)], axis=1)


def _extent(tree: TreeSkeleton) -> float:
    """The longest side of the tree's box, metres."""
    return max(float(np.ptp(tree.tip, axis=0).max()), 1e-9) if len(tree) else 1.0


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


def plan_wood(tree: TreeSkeleton, lines: CentreLines, detail: Detail, pulse: Pulse = no_pulse) -> WoodPlan:
    """The rings of every limb, within the budget of `detail`."""
    height = _extent(tree)
    while True:
        plan = _plan(lines, detail, height, pulse)
        if plan.triangle_count <= detail.most_triangles or detail.is_coarsest:
            return plan
        detail = detail.coarser(max(1.5, plan.triangle_count / detail.most_triangles))


def swept(plan: WoodPlan, among: Bool[np.ndarray, " limb"], name: str, material: Material, key: Key[Array, ""]) -> Mesh:
    """The mesh of the limbs `among` all."""
    return Mesh(name, *_of(swept_surface(plan, among, key)), material)


def swept_surface(plan: WoodPlan, among: Bool[np.ndarray, " limb"], key: Key[Array, ""]) -> Surface:
    """The same before it is a mesh: each vertex knows its limb."""
    shape = plan.side, plan.level
    return sweep(plan.lines, plan.ring, shape, plan.collar_top, _shift(plan.lines, key), plan.detail, plan.tolerance, among)


def _plan(lines: CentreLines, detail: Detail, height: float, pulse: Pulse) -> WoodPlan:
    tolerance = detail.tolerance * height
    foot = sides(lines.radius[lines.start[:-1]], tolerance, detail)
    top = collar_tops(lines, detail, height)
    ring = rings(lines, top, collar_rings(foot), detail, height, pulse=pulse)
    needed = np.minimum(sides(ring.radius, tolerance, detail), foot[ring.limb])
    side, level = halvings(needed, np.where(top > 0, collar_rings(foot), 1), ring.start, detail.most_sides)
    return WoodPlan(lines, top, ring, side, level, detail, tolerance)
