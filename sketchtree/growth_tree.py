"""A picture, a drawing or any skeleton in, a tree that grows out: every stage in order.

    picture, scribbles → matte → edits → trunk's skeleton → depths ┐
    drawing → drawn branches → propagation                         ├→ grafts → shears → leaves → meshes → plan of growth
    skeleton, project, glTF, USD                                   ┘

What a tree begins as (`Beginning`) is made once; each crown on it is one number: the first is that of the plain run, others have random keys of their own.
"""

import dataclasses
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from jaxtyping import Array, Float, Key

from sketchtree import pipeline
from sketchtree.choose import bark_model, leaf_model
from sketchtree.drawn_tree import DrawnTree, draw_out
from sketchtree.dressing import Dress, wood_worn
from sketchtree.errors import OptionError, SkeletonError
from sketchtree.foliage.cards import leaf_mesh
from sketchtree.foliage.leaves import Leaves
from sketchtree.geometry.mesh import Mesh
from sketchtree.geometry.wood import check_wood
from sketchtree.growth import bending
from sketchtree.growth.grafting import Graft
from sketchtree.growth.grafting import MOST as MOST_LEVELS
from sketchtree.growth.plan import MODES, GrowthPlan
from sketchtree.keys import stage_key
from sketchtree.matting.alpha import Matte
from sketchtree.matting.matte import DEFAULT, find_matte
from sketchtree.matting.scribbles import Scribbles, read_scribbles
from sketchtree.options import ReadingOptions, TreeOptions
from sketchtree.page import page_to_world
from sketchtree.parameters import Habit
from sketchtree.photo.photo import Photo
from sketchtree.photo.read_photo import read_photo
from sketchtree.photo_choice import choose_for_trunk
from sketchtree.pipeline import TreeModel
from sketchtree.propagate.after.prune import Prune
from sketchtree.similarity import Similarity
from sketchtree.skeleton import TreeSkeleton
from sketchtree.sketch.graph import SketchGraph
from sketchtree.sketch.strokes import Sketch
from sketchtree.templates.store.database import Database
from sketchtree.trunk.as_tree import as_tree
from sketchtree.trunk.edit_matte import edit_matte
from sketchtree.trunk.edits import VertexEdits
from sketchtree.trunk.limbs import trunk_drawing
from sketchtree.trunk.skeletonise import GAP, trunk_skeleton
from sketchtree.trunk.trunk_skeleton import TrunkSkeleton
from sketchtree.watch import Watch

LEVELS = 3  # of grafts on a picture's trunk, unless said otherwise
_LARGE = 10_000  # segments from which the next level may have been too many


@dataclass(frozen=True)
class GrowthOptions:
    """What grows on a trunk, and how."""

    levels: int | None = None  # 0-5 levels of grafts; None: 3 on a picture's trunk, 0 on what is a tree already
    mode: str = "full"  # of `growth.plan.MODES`
    bend: float = 0.0  # δ, degrees

    def __post_init__(self):
        if self.levels is not None and not 0 <= self.levels <= MOST_LEVELS:
            raise OptionError(f"`--levels {self.levels}` is out of range.", remedy=f"Give 0 to {MOST_LEVELS}: 0 grafts nothing on, a full crown has 3.")
        if self.mode not in MODES:
            raise OptionError(f"There is no mode of growth called {self.mode!r}.", remedy=f"Choose one of: {', '.join(MODES)}.")
        if not bending.LEAST <= self.bend <= bending.MOST:
            raise OptionError(f"`--bend {self.bend:g}` is out of range.", remedy=f"Give {bending.LEAST:g} to {bending.MOST:g} degrees: above 0 branches rise, below 0 they hang.")


@dataclass(frozen=True)
class TrunkOptions:
    """How a trunk is taken from a picture."""

    matting: str = DEFAULT  # of `matting.matte.MATTINGS`
    lift: str = "siblings"  # of `trunk.wanted.LIFTS`
    gap: float = GAP  # pixels over which pieces of the matte belong together, ≥ 0
    root: tuple[float, float] | None = None  # a point where the trunk stands, pixels, y down; None: the middle of its foot

    def __post_init__(self):
        if not 0 <= self.gap <= 10_000:
            raise OptionError(f"`--gap {self.gap:g}` is out of range.", remedy="Give pixels, 0 or more.")


@dataclass(frozen=True, eq=False)
class FoundTrunk:
    """A trunk in a picture, and all that was found on the way to it."""

    photo: Photo
    wanted: TrunkOptions
    matte: Matte  # with what was edited by hand
    skeleton: TrunkSkeleton  # pixels, y down
    graph: SketchGraph  # its limbs, pixels, y up
    similarity: Similarity  # pixels, y up → metres
    tree: TreeSkeleton  # metres
    template: str | None
    habit: Habit
    warnings: tuple[str, ...]

    @property
    def in_pixels(self) -> TreeSkeleton:
        """The trunk in the picture's pixels, y up; depths and radii in pixels too."""
        back, scale = self.similarity.to_sketch, self.similarity.scale
        return self.tree.replace(
            tip=back(self.tree.tip), radius=self.tree.radius / scale, depth_sd=self.tree.depth_sd / scale, curve_points=back(self.tree.curve_points)
        )


@dataclass(frozen=True, eq=False)
class Beginning:
    """What a growing tree is made of, before anything is grafted on."""

    kind: str  # picture | drawing | skeleton
    key: Key[Array, ""]
    dress: Dress
    skeleton: TreeSkeleton | None = None  # metres; None for a drawing, each of whose crowns is grown
    trunk: FoundTrunk | None = None
    drawn: DrawnTree | None = None
    template: str | None = None
    templates: Database | None = None
    obstacles: tuple = ()
    warnings: tuple[str, ...] = ()
    leafing: pipeline.Leafing | None = None  # what makes its leaves and blossoms, where that is not `foliage`
    levels: int | None = None  # of grafts, as its project says; None: 3 on a picture's trunk, 0 on what is a tree already


@dataclass(frozen=True, eq=False)
class Worn:
    """A finished tree, as `pipeline.TreeModel` but for the drawing that it does not have."""

    template: str | None
    skeleton: TreeSkeleton
    leaves: Leaves
    blossom: Leaves | None
    meshes: tuple[Mesh, ...]
    warnings: tuple[str, ...]
    dress: Dress
    wood_used: str
    leaves_seen: bool = False  # whether they stand where leaves were seen, not wherever the species bears some


@dataclass(frozen=True, eq=False)
class GrownTree:
    """A finished tree and the plan by which it grows."""

    beginning: Beginning
    model: TreeModel | Worn
    plan: GrowthPlan
    levels: int
    warnings: tuple[str, ...] = field(default=())


def find_trunk(
    photo: Photo,
    scribbles: Scribbles | None = None,
    templates: Database | None = None,
    *,
    key: Key[Array, ""],
    wanted: TrunkOptions = TrunkOptions(),
    reading: ReadingOptions = ReadingOptions(),
    edits: VertexEdits = VertexEdits(),
    painted: Path | None = None,
    known: Matte | None = None,
    watch: Watch | None = None,
) -> FoundTrunk:
    """The trunk that scribbles mark in a photo, in space. `known`: its matte, if there is one; `painted`: a file of edits of the matte. Raises SketchError, OptionError."""
    watch = watch or Watch()
    with watch("read"):
        matte = known or find_matte(photo, scribbles, key=stage_key(key, "matte"), method=wanted.matting)
        matte = matte if painted is None else dataclasses.replace(matte, alpha=edit_matte(matte.alpha, painted))
        found = trunk_skeleton(matte.alpha, edits=edits, root=wanted.root, gap=wanted.gap)
    with watch("match"):
        if len(found) < 2:
            raise OptionError("The trunk's skeleton is a single point.", remedy="Ask for more vertices, mark more of the tree, or give a larger picture.")
        _, graph = trunk_drawing(found)
        templates = templates if templates is not None or reading.template == "none" else Database.open()
        choice = choose_for_trunk(graph, templates, reading)
        named = None if templates is None or choice.reading.template in ("none", "auto") else choice.reading.template
        habit = _habit(named, templates)
    with watch("infer"):
        height = choice.reading.height or habit.height
        tree = as_tree(found, key=stage_key(key, "trunk"), lift=wanted.lift, height=height, options=choice.reading, templates=templates)
    told = (*photo.warnings, *matte.warnings, *found.warnings, *choice.told)
    return FoundTrunk(photo, wanted, matte, found, graph, page_to_world(graph.above_ground(), height), tree, named, habit, tuple(dict.fromkeys(told)))


def of_picture(trunk: FoundTrunk, tree: TreeOptions, templates: Database | None, *, key: Key[Array, ""]) -> Beginning:
    """A picture's trunk, with leaves and bark of its template."""
    return Beginning("picture", key, _dress(tree, trunk.habit, templates), trunk.tree, trunk, template=trunk.template, templates=templates, warnings=trunk.warnings)


def of_drawing(
    sketch: Sketch | str | Path, templates: Database | None, *, key: Key[Array, ""], reading: ReadingOptions, tree: TreeOptions, watch: Watch | None = None
) -> Beginning:
    """The drawn branches of a sketch in space, as `build` makes them."""
    obstacles = pipeline.read_obstacles(tree)
    drawn = draw_out(sketch, templates, key=key, options=reading, watch=watch or Watch())
    name = drawn.exemplar.name if drawn.exemplar else None
    return Beginning("drawing", key, _dress(tree, drawn.habit, templates), None, None, drawn, name, templates, obstacles)


def of_skeleton(
    skeleton: TreeSkeleton, tree: TreeOptions, templates: Database | None, *, key: Key[Array, ""], template: str | None = None, height: float | None = None
) -> Beginning:
    """A tree that is there already. Without a template it wears leaves only where `tree.leaf` names some; `height`: to which it is scaled, metres."""
    if skeleton.segment_count == 0 or skeleton.length.sum() == 0:
        raise SkeletonError("It has no branch of any length, so nothing can grow.", remedy="Give a skeleton with a trunk.")
    habit = _habit(template, templates)
    options = tree if tree.leaf or template else dataclasses.replace(tree, leaf="none")
    told = () if tree.leaf or template else ("It bears no leaves, since nothing says which: `--template NAME` or `--leaf MODEL` does.",)
    return Beginning("skeleton", key, _dress(options, habit, templates), skeleton if height is None else _as_high(skeleton, height), template=template, templates=templates, warnings=told)


def check_tree(tree: TreeOptions, templates: Database | None) -> None:
    """Refuse before the work what can't be worn. Raises OptionError."""
    leaf_model(tree.leaf, Habit(), templates), bark_model(tree.bark, Habit())
    Prune(tree.prune), check_wood(tree.wood, tree.solid)


def grown_tree(
    beginning: Beginning, growth: GrowthOptions = GrowthOptions(), tree: TreeOptions = TreeOptions(), *, crown: int = 0, watch: Watch | None = None
) -> GrownTree:
    """The tree whole, with the plan of its growth. `crown`: which of its variations."""
    watch, key = watch or Watch(), crown_key(beginning.key, crown)
    levels = growth.levels if growth.levels is not None else beginning.levels if beginning.levels is not None else LEVELS if beginning.kind == "picture" else 0
    told: tuple[str, ...] = ()
    if beginning.kind == "drawing" and levels == 0:
        model = pipeline.complete(beginning.drawn, beginning.templates, key=key, options=tree, obstacles=beginning.obstacles, watch=watch)
    else:
        with watch("propagate"):
            host, told = _host(beginning, tree, key)
            skeleton, more = _grafted(host, levels, tree.max_segments, beginning.dress.habit, key)
            pruned = skeleton if beginning.kind == "drawing" else Prune(tree.prune).run(skeleton).skeleton
        model = _worn(pruned, beginning, key, (*told, *more), watch)
    plan = GrowthPlan.of(model.skeleton, mode=growth.mode, bend=growth.bend)
    return GrownTree(beginning, model, plan, levels, tuple(dict.fromkeys((*beginning.warnings, *model.warnings))))


def crown_key(key: Key[Array, ""], crown: int) -> Key[Array, ""]:
    """The key of a variation; the first one's is that of the plain run."""
    return key if crown == 0 else stage_key(key, f"variation {crown}")


def _habit(template: str | None, templates: Database | None) -> Habit:
    return Habit() if template is None or templates is None else templates.exemplar(template).habit


def _dress(tree: TreeOptions, habit: Habit, templates: Database | None) -> Dress:
    return Dress(bark_model(tree.bark, habit), leaf_model(tree.leaf, habit, templates), tree.season, habit, tree.wood, tree.solid)


def _as_high(tree: TreeSkeleton, height: float) -> TreeSkeleton:
    """The same, as high as asked for, its first foot where it was."""
    if tree.height <= 0:
        raise SkeletonError("It is nowhere higher than its foot, so `--height` can't scale it.", remedy="Leave `--height` out, or turn the skeleton upright (y is up).")
    scale, foot = height / tree.height, tree.tip[np.flatnonzero(tree.is_base)[0]]

    def scaled(points: Float[np.ndarray, "point 3"]) -> Float[np.ndarray, "point 3"]:
        return foot + scale * (points - foot)

    return tree.replace(tip=scaled(tree.tip), radius=scale * tree.radius, depth_sd=scale * tree.depth_sd, curve_points=scaled(tree.curve_points))


def _host(beginning: Beginning, tree: TreeOptions, key: Key[Array, ""]) -> tuple[TreeSkeleton, tuple[str, ...]]:
    """(what is grafted on, what a person should know about it)."""
    if beginning.skeleton is not None:
        return beginning.skeleton, ()
    grown = pipeline.grow(beginning.drawn, tree, beginning.obstacles, key=key)
    skeleton, told = pipeline.weathered(beginning.drawn, grown, tree)
    return skeleton, (*beginning.drawn.warnings, *told)


def _grafted(host: TreeSkeleton, levels: int, most: int, habit: Habit, key: Key[Array, ""]) -> tuple[TreeSkeleton, tuple[str, ...]]:
    """(the host with branches on it, a remark where they would have been too many)."""
    twig = min(habit.twig_radius, float(host.radius.min()))
    tree = Graft(levels, twig, most)(host, key=key)
    if levels and tree is not host and len(tree) > min(_LARGE, most // 20):
        fewer = Graft(levels - 1, twig, most)(host, key=key)
        if len(fewer) == len(tree):
            return tree, (f"Of {levels} levels of branches not all were grafted on: there would be more than {most:,} segments (`--max-segments`).",)
    return tree, ()


def _worn(skeleton: TreeSkeleton, beginning: Beginning, key: Key[Array, ""], told: tuple[str, ...], watch: Watch) -> Worn:
    """Leaves and meshes, as `pipeline.finish` makes them."""
    dress = beginning.dress
    with watch("foliage"):
        leaves, flowers = pipeline.foliage(skeleton, dress, key=key) if beginning.leafing is None else beginning.leafing(skeleton, dress, key)
        if leaves.kept < 1:
            told += (f"Only {leaves.kept:.1%} of the leaves were kept (at most {len(leaves)}), each larger, so that their area is right.",)
        if dress.leaf is not None and dress.season != "bare" and not len(leaves):
            told += ("No leaf grew: no branch is thin enough to bear them.",)
    with watch("mesh"):
        wood = wood_worn(skeleton, dress, key=key)
        meshes = (*wood.meshes, *(leaf_mesh(worn, season=dress.season) for worn in (leaves, flowers) if worn is not None and len(worn)))
    return Worn(beginning.template, skeleton, leaves, flowers, meshes, (*told, *wood.warnings), dress, wood.made, beginning.leafing is not None)


@dataclass(frozen=True)
class TrunkSource:
    """A source: a photo and the scribbles on it become the trunk in space, metres."""

    wanted: TrunkOptions = TrunkOptions()
    reading: ReadingOptions = ReadingOptions()

    def __call__(self, input: tuple[Photo | str | Path, Scribbles | str | Path | None], *, key: Key[Array, ""]) -> TreeSkeleton:
        photo, scribbles = input
        photo = photo if isinstance(photo, Photo) else read_photo(photo, max_mb=self.reading.max_mb, max_megapixels=self.reading.max_megapixels)
        scribbles = scribbles if scribbles is None or isinstance(scribbles, Scribbles) else read_scribbles(scribbles, photo)
        return find_trunk(photo, scribbles, key=key, wanted=self.wanted, reading=self.reading).tree
