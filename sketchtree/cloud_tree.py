"""A point cloud in, the tree that stands in it out: every stage in order.

    file → points in metres → upright, one tree, clean → feet, trunk's thickness → leaves told from wood → traced | grown → twigs to leaves, what nobody saw → leaves, meshes

*traced* (the default, ours): the wood runs where the points are. *grown* (Guo et al. 2018, §5): a tree of a species grows toward the points.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import reduce
from pathlib import Path

import numpy as np
from jaxtyping import Array, Float, Key
from scipy.spatial import cKDTree

from sketchtree.clouds.cloud import PointCloud
from sketchtree.clouds.files.placed import Placed, Placement
from sketchtree.clouds.files.read_cloud import read_placed
from sketchtree.clouds.growing.collapse import collapsed, kept
from sketchtree.clouds.growing.ends import gone_on
from sketchtree.clouds.growing.estimated import estimated
from sketchtree.clouds.growing.figures import changes
from sketchtree.clouds.growing.filled import filled
from sketchtree.clouds.growing.grown import Grown, grown
from sketchtree.clouds.growing.hull_fill import unseen_inside
from sketchtree.clouds.growing.species import Species, species
from sketchtree.clouds.leafy.bearing import bearing
from sketchtree.clouds.leafy.covering import Covering
from sketchtree.clouds.leafy.leafiness import Leafiness, check_in_leaf, leafiness, left_out, off_bark
from sketchtree.clouds.prepared.prepare import POINTS, Prepared, prepare
from sketchtree.clouds.standing.feet import Feet, feet
from sketchtree.clouds.standing.stems import breast_height
from sketchtree.clouds.standing.trunk import Trunk, foot_radii, trunk
from sketchtree.clouds.tracing.traced import Traced, traced
from sketchtree.errors import OptionError
from sketchtree.fidelity.sampled import along
from sketchtree.growth_tree import Beginning, GrowthOptions, Worn, grown_tree, of_skeleton
from sketchtree.keys import stage_key
from sketchtree.options import TreeOptions
from sketchtree.skeleton import TreeSkeleton
from sketchtree.templates.store.database import Database
from sketchtree.watch import Watch

METHODS = ("traced", "grown")
Follow = Callable[[TreeSkeleton, Placement], TreeSkeleton]
"""A tree that was traced, metres, and where its points were placed → the tree with what they are too coarse for."""
_THICKEST = 0.25  # of the height: diameter of a trunk
_BESIDE = 1.5  # pixels: wood that is farther from points has none
_LEFT_OUT = 0.12  # of the points of wood that were traced past, where leaves were told
GENERAL = "broadleaf"
"""The species whose figures are taken where the points say nothing."""


@dataclass(frozen=True)
class CloudOptions:
    """How a tree is taken from points."""

    up: str = "auto"  # auto | y | z
    tree: int | None = None  # which of several, 1 the largest
    unit: float = 1.0  # metres that 1 in the file means
    points: int = POINTS  # of the tree, at most
    method: str = "traced"  # of METHODS
    species: str = "auto"  # of `clouds.growing.species.names()`, or a recipe of one's own, a .toml file; auto: estimated from the points
    figures: tuple[str, ...] = ()  # of the species and its growth that are to be others: NAME=VALUE (`clouds.growing.figures`)
    roots: int | None = None  # feet; None: as many as there are stems
    keep_pot: bool = False  # a pot, or a lump of ground under the stem, is not looked for
    in_leaf: str = "auto"  # auto | yes | no: whether some of the points are leaves
    inside: bool | None = None  # branches inside a crown that was seen from outside only; None: where the points leave it out
    pixel: float | None = None  # metres of the plant that a pixel of its photos is: what is thinner goes on beyond the points; None, 0: it ends with them

    def __post_init__(self):
        if self.pixel is not None and not 0 <= self.pixel < 10:
            raise OptionError(f"`--pixel {self.pixel:g}` is out of range.", remedy="Give metres of the plant that one pixel of its photos is, 0.005 say, or 0: then twigs end where the points end.")
        if self.method not in METHODS:
            raise OptionError(f"There is no method called {self.method!r}.", remedy=f"Choose one of: {', '.join(METHODS)}.")
        check_in_leaf(self.in_leaf)
        if not 100 <= self.points <= 10_000_000:
            raise OptionError(f"`--points {self.points}` is out of range.", remedy="Give 100 to 10,000,000.")
        if self.species != "auto":
            species(self.species)
        if self.figures and self.method != "grown":
            raise OptionError(f"`--set {self.figures[0]}` says how a tree grows, and one that is {self.method} is where its points are.", remedy="Add `--method grown`, or leave it out.")
        for said in self.figures:
            if len(changes(said)) > 1:
                raise OptionError(f"`--set {said}` gives several values.", remedy="Give one; `--vary` makes a tree of each of several.")


@dataclass(frozen=True, eq=False)
class Finish:
    """How wood that was found is pruned, put in leaf and made into meshes."""

    key: Key[Array, ""]
    tree: TreeOptions = TreeOptions()  # noqa: RUF009 (frozen)
    templates: Database | None = None
    template: str | None = None  # the exemplar whose leaves and bark it wears
    leafing: Covering | None = None  # puts leaves where some were seen; None of a plant that isn't in leaf

    def begun(self, wood: TreeSkeleton) -> Beginning:
        """What grows and is finished: wood that was found, and which leaves it is to bear."""
        tree = replace(self.tree, leaf="none") if self.tree.leaf == "auto" and self.leafing is None else self.tree
        return replace(of_skeleton(wood, tree, self.templates, key=self.key, template=self.template), leafing=self.leafing)

    def __call__(self, wood: TreeSkeleton, watch: Watch | None = None) -> tuple[Worn, tuple[str, ...]]:
        """(the finished tree, what a person should know about it)."""
        begun = self.begun(wood)
        model = grown_tree(begun, GrowthOptions(levels=0), self.tree, watch=watch).model
        return model, (*begun.warnings, *model.warnings)


@dataclass(frozen=True, eq=False)
class CloudTree:
    """A tree that stands in points, and how it was found."""

    prepared: Prepared
    feet: Feet
    trunks: tuple[Trunk | None, ...]  # of each foot; None where its thickness can't be told
    species: Species
    leafy: Leafiness
    pieces: int | None  # that the points fell into; None of one that was grown
    grows: Grown | None  # how it came to be; None of one that was traced
    toward: Float[np.ndarray, "point 3"] | None  # what it grew toward: its points, and what was followed beyond them
    followed: bool  # whether its thin twigs were followed in what the points were made of
    seen: int  # rows that were seen, the first ones; the others bear leaves, or fill the inside
    model: Worn
    wanted: CloudOptions
    finish: Finish
    warnings: tuple[str, ...]

    @property
    def skeleton(self) -> TreeSkeleton:
        """Metres, the foot of the largest stem at the origin."""
        return self.model.skeleton


def cloud_to_tree(
    given: str | Path | Placed | PointCloud | Prepared,
    templates: Database | None = None,
    *,
    key: Key[Array, ""],
    wanted: CloudOptions = CloudOptions(),
    tree: TreeOptions = TreeOptions(),
    template: str | None = None,
    follow: Follow | None = None,
    watch: Watch | None = None,
) -> CloudTree:
    """The tree in a cloud. `template`: the exemplar whose leaves and bark it wears; `follow`: finds the twigs that points are too coarse for, in what the points were made of. Raises SketchError for a cloud that can't be read or holds no tree, or several; OptionError."""
    watch = watch or Watch()
    with watch("read"):
        prepared = given if isinstance(given, Prepared) else _prepared(given, wanted)
        stands = feet(prepared.cloud.xyz, prepared.above, count="auto" if wanted.roots is None else wanted.roots)
    with watch("infer"):
        found = _wood(prepared, stands, wanted, key, follow)
    return whole_tree(found, prepared, stands, wanted, Finish(key, tree, templates, template, found.leafing(prepared)), watch)


def whole_tree(found: "Found", prepared: Prepared, stands: Feet, wanted: CloudOptions, finish: Finish, watch: Watch) -> CloudTree:
    """What was found, with what nobody saw, and finished."""
    with watch("propagate"):
        wood, seen = _whole(found, prepared, wanted, finish.key)
    model, told = finish(wood, watch)
    told = (*prepared.remarks, *_remarks(found, stands, wanted.roots), *told)
    return CloudTree(prepared, stands, found.trunks, found.species, found.leafy, found.pieces, found.grows, found.toward, found.followed, seen, model, wanted, finish, tuple(dict.fromkeys(told)))


def _prepared(given: str | Path | Placed | PointCloud, wanted: CloudOptions) -> Prepared:
    placed = read_placed(given, unit=wanted.unit) if isinstance(given, str | Path) else given
    return prepare(placed, up=wanted.up, tree=wanted.tree, points=wanted.points, keep_pot=wanted.keep_pot)


@dataclass(frozen=True, eq=False)
class Found:
    """What was seen, as a skeleton."""

    tree: TreeSkeleton
    trunks: tuple[Trunk | None, ...]
    species: Species
    leafy: Leafiness
    pieces: int | None
    grows: Grown | None = None
    toward: Float[np.ndarray, "point 3"] | None = None
    followed: bool = False  # whether its ends are where what the points were made of shows them

    def leafing(self, prepared: Prepared) -> Covering | None:
        """What puts leaves where some were seen."""
        return Covering(prepared.cloud.xyz[self.leafy.sure]) if self.leafy.sure.any() else None


def _wood(prepared: Prepared, stands: Feet, wanted: CloudOptions, key, follow: Follow | None = None) -> Found:
    """What was seen, as a skeleton."""
    xyz = prepared.cloud.xyz
    trunks = tuple(_believed(trunk(xyz[rows], breast_height(prepared.cloud.height)), prepared.cloud.height) for rows in stands.stems)
    known = trunks[0].root / 2 if len(trunks) == 1 and trunks[0] is not None else None
    leafy = leafiness(xyz, stands.rows, prepared.cloud.colour, wanted.in_leaf)
    found = _traced(xyz, stands.rows, leafy, known) if wanted.method == "traced" or wanted.species == "auto" else None
    if found is not None and leafy.in_leaf and wanted.in_leaf == "auto" and left_out(xyz[~leafy.leaf], found.skeleton) > _LEFT_OUT:
        leafy = leafiness(xyz, stands.rows, wanted="no")  # leaves were most of what there is to see of it: a herb, a rosette
        found = _traced(xyz, stands.rows, leafy, known)
    leafy = leafy if found is None else off_bark(leafy, xyz, found.skeleton)
    kind = estimated(xyz, species(GENERAL), found.skeleton, found.gamma) if wanted.species == "auto" else species(wanted.species)
    follows = follow is not None and found is not None and not leafy.in_leaf
    if follows:
        found = replace(found, skeleton=follow(found.skeleton, prepared.placement))
    if wanted.method == "traced":
        return Found(_refined(found.skeleton), trunks, kind, leafy, found.pieces, followed=follows)
    kind = reduce(lambda kind, said: changes(said)[0].of(kind), wanted.figures, kind)
    toward = _with_wood(xyz, found.skeleton, wanted.pixel) if follows and wanted.pixel else xyz
    grows = growth(toward, stands, trunks, kind, key)
    return Found(grows.skeleton, trunks, kind, leafy, None, grows, toward, follows)


def _with_wood(xyz: Float[np.ndarray, "point 3"], tree: TreeSkeleton, apart: float) -> Float[np.ndarray, "point 3"]:
    """Points, and more along wood that has none: what was followed beyond them."""
    place = along(tree, apart)[0]
    return np.concatenate([xyz, place[cKDTree(xyz).query(place)[0] > _BESIDE * apart]])


def _believed(found: Trunk | None, height: float) -> Trunk | None:
    """A trunk, unless it is as thick as no stem is of a plant so high: leaves round a foot, or a pot."""
    return found if found is not None and found.root <= _THICKEST * height else None


def growth(toward: Float[np.ndarray, "point 3"], stands: Feet, trunks: tuple[Trunk | None, ...], kind: Species, key: Key[Array, ""]) -> Grown:
    """The tree of a species that grows toward the points, as thick at its feet as was measured."""
    return grown(toward, stands.rows, kind, key=stage_key(key, "toward points"), radius=foot_radii(trunks))


def _traced(xyz, rows, leafy: Leafiness, foot_radius: float | None) -> Traced:
    """The wood among the points, what isn't leaves."""
    if not leafy.in_leaf:
        return traced(xyz, rows, foot_radius=foot_radius)
    wood = np.flatnonzero(~leafy.leaf)
    place = np.cumsum(~leafy.leaf) - 1
    return traced(xyz[wood], [place[foot] for foot in rows], foot_radius=foot_radius)


def _whole(found: Found, prepared: Prepared, wanted: CloudOptions, key) -> tuple[TreeSkeleton, int]:
    """(the tree with what nobody saw, how many of its rows were seen)."""
    tree, xyz = found.tree, prepared.cloud.xyz
    seen = len(tree)
    if found.leafy.in_leaf and found.grows is None:
        tree = bearing(tree, xyz, xyz[found.leafy.leaf], found.species, key=stage_key(key, "to leaves"))
    elif wanted.pixel and not found.followed:
        tree = gone_on(tree, wanted.pixel / 2, found.species.gamma)
    if wanted.inside is False or (wanted.inside is None and (found.followed or not unseen_inside(xyz))):  # into a bare crown photos see
        return tree, seen
    return filled(tree, xyz, found.species, key=stage_key(key, "inside")), seen


def _refined(tree: TreeSkeleton) -> TreeSkeleton:
    """The same with fewer rows where limbs run straight (§5.3, branch collapse)."""
    stays, parent = collapsed(tree.parent, tree.tip, tree.radius)
    parent, place, radius = kept(stays, parent), tree.tip[stays], tree.radius[stays]
    return TreeSkeleton.from_columns(parent, place, radius, limb=tree.limb[stays], order=tree.order[stays], tree=tree.tree[stays], kind=tree.kind[stays])


def _remarks(found: Found, stands: Feet, roots: int | None) -> list[str]:
    told = [found.leafy.remark] if found.leafy.remark else []
    if found.pieces is not None and found.pieces > 1:
        told.append(f"The points fall into {found.pieces:,} pieces; gaps between them were bridged where they are narrow.")
    if roots is not None and len(stands.rows) < roots:
        told.append(f"{roots} roots were asked for; the points show {len(stands.rows)}.")
    elif len(stands.rows) > 1:
        told.append(f"The plant stands on {len(stands.rows)} feet.")
    if found.trunks[0] is None:
        told.append("How thick the trunk is can't be told from the points at its foot; the rest of the wood says so.")
    return told


@dataclass(frozen=True)
class CloudSource:
    """A source: a point cloud, or a file of one, becomes the tree that stands in it, metres."""

    wanted: CloudOptions = CloudOptions()

    def __call__(self, input: str | Path | Placed | PointCloud, *, key: Key[Array, ""]) -> TreeSkeleton:
        return cloud_to_tree(input, key=key, wanted=self.wanted, tree=TreeOptions(leaf="none")).skeleton
