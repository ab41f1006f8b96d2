"""One photo and a few strokes in, a complete tree out (Tan et al. 2008): every stage in order.

    photo, strokes → foliage → limbs traced → depths → growth towards attractors → radii → leaves that the photo confirms → meshes

Several trees in one photo are each made of their own strokes, in one scale: that of the first, whose height is the template's or the one asked for.
"""

import dataclasses
import itertools
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from jaxtyping import Array, Bool, Float, Key

from sketchtree.choose import bark_model, leaf_model
from sketchtree.drawn_tree import DrawnTree, draw_out_graph
from sketchtree.errors import OptionError
from sketchtree.forest import Forest
from sketchtree.geometry.wood import check_wood
from sketchtree.keys import stage_key
from sketchtree.options import ReadingOptions, TreeOptions
from sketchtree.parameters import Habit
from sketchtree.photo.as_graph import as_drawing
from sketchtree.photo.bark_colour import SeenBark, seen_bark
from sketchtree.photo.foliage import Foliage
from sketchtree.photo.foliage_mask import foliage_mask
from sketchtree.photo.known_foliage import known_foliage
from sketchtree.photo.leafing import PhotoLeafing
from sketchtree.photo.marked import Marked
from sketchtree.photo.photo import Photo
from sketchtree.photo.photo_leaves import SeenFoliage, leafy_pixels
from sketchtree.photo.read_photo import read_photo
from sketchtree.photo.trace.palette import Palette
from sketchtree.photo.trace.traced import Traced
from sketchtree.photo.wanted import PhotoOptions
from sketchtree.photo_choice import Choice, choose_for_photo
from sketchtree.pipeline import Grown, TreeModel, finish
from sketchtree.planting import tree_key
from sketchtree.propagate.after.prune import Prune
from sketchtree.propagate.attractors.lifted_within import lifted_within
from sketchtree.propagate.attractors.regrown import grown_free
from sketchtree.propagate.attractors.stage import Attract, Attraction
from sketchtree.propagate.attractors.target import Target
from sketchtree.propagate.scale import to_scale
from sketchtree.similarity import Similarity
from sketchtree.skeleton import TreeSkeleton
from sketchtree.skeleton_joined import joined, moved
from sketchtree.templates.store.database import Database
from sketchtree.watch import Watch

_ROUND = 0.96  # of what is left of the growth, for all that its pulse knows, is left after one round


@dataclass(frozen=True, eq=False)
class GrownInPhoto:
    """One tree of a photo, and all that was found on the way to it; its trunk's foot at the origin."""

    marked: Marked
    foliage: Foliage
    traced: Traced
    drawn: DrawnTree  # its visible limbs, in space
    grown: Attraction
    seen: SeenFoliage
    choice: Choice  # of its template, height and leaf, where nobody named them
    bark: SeenBark


@dataclass(frozen=True, eq=False)
class PhotoTree(GrownInPhoto):
    """The same with radii, leaves and meshes, where it stands."""

    model: TreeModel


@dataclass(frozen=True, eq=False)
class PhotoModel:
    """All trees of a photo."""

    photo: Photo
    trees: tuple[PhotoTree, ...]
    place: Float[np.ndarray, "tree 3"]  # of each foot, metres; the first at the origin

    @property
    def model(self) -> TreeModel | Forest:
        """What files are written of: the one tree, or all of them as a forest."""
        if len(self.trees) == 1:
            return self.trees[0].model
        names = tuple(f"{self.photo.name} ({k})" for k in range(1, len(self.trees) + 1))
        warnings = tuple(dict.fromkeys(told for tree in self.trees for told in tree.model.warnings))
        copies = tuple(range(len(self.trees)))
        return Forest(names, copies, names, self.place, tuple(tree.model for tree in self.trees), warnings)

    @property
    def frame(self) -> tuple[float, float, float, float]:
        """Left, bottom, right and top edge of the photo in the world, metres."""
        corners = self.trees[0].seen.similarity.to_world(np.array([(0.0, -self.photo.height), (self.photo.width, 0.0)]))
        return tuple(corners.reshape(-1).tolist())

    def in_pixels(self) -> TreeSkeleton:
        """The grown trees in the photo's pixels, y up; depths and radii in pixels too."""
        return joined(_numbered([_in_pixels(tree.model.skeleton, tree.seen.moved(at)) for tree, at in zip(self.trees, self.place, strict=True)]))

    def visible_in_pixels(self) -> TreeSkeleton:
        """The same of the limbs that show in the photo."""
        return joined(_numbered([_in_pixels(tree.drawn.skeleton, tree.seen) for tree in self.trees]))


def photo_to_tree(
    photo: Photo,
    marked: Sequence[Marked],
    templates: Database | None = None,
    *,
    key: Key[Array, ""],
    wanted: PhotoOptions = PhotoOptions(),
    reading: ReadingOptions = ReadingOptions(),
    tree: TreeOptions = TreeOptions(),
    mask: Bool[np.ndarray, "row column"] | None = None,
    depths: Sequence[float] | None = None,
    watch: Watch | None = None,
) -> PhotoModel:
    """Every stage in order. `mask`: the foliage, if it is known; `depths`: how far each further tree stands in front of the first, metres (§5: "the relative positions of trees
    in 3D is set manually"). Raises SketchError, OptionError."""
    watch = watch or Watch()
    leaf_model(tree.leaf, Habit(), templates), bark_model(tree.bark, Habit())  # refuse a wrong name before the work
    Prune(tree.prune), check_wood(tree.wood, tree.solid)
    templates = templates if templates is not None or reading.template == "none" else Database.open()
    grown = each_grown(photo, marked, templates, key=key, wanted=wanted, reading=reading, mask=mask, depths=depths, watch=watch)
    return complete_photo(photo, grown, templates, key=key, wanted=wanted, tree=tree, watch=watch)


def complete_photo(
    photo: Photo,
    grown: Iterable[tuple[GrownInPhoto, Float[np.ndarray, " 3"]]],
    templates: Database | None,
    *,
    key: Key[Array, ""],
    wanted: PhotoOptions = PhotoOptions(),
    tree: TreeOptions = TreeOptions(),
    watch: Watch | None = None,
) -> PhotoModel:
    """Trees that `each_grown` grew, with radii, leaves and meshes."""
    trees, places = [], []
    for number, (found, at) in enumerate(grown):
        trees.append(_dressed(found, tree_key(key, number), tree, templates, at, wanted, watch or Watch()))
        places.append(at)
    return PhotoModel(photo, tuple(trees), np.array(places))


def each_grown(
    photo: Photo,
    marked: Sequence[Marked],
    templates: Database | None,
    *,
    key: Key[Array, ""],
    wanted: PhotoOptions = PhotoOptions(),
    reading: ReadingOptions = ReadingOptions(),
    mask: Bool[np.ndarray, "row column"] | None = None,
    depths: Sequence[float] | None = None,
    foliages: Sequence[Foliage | None] | None = None,
    watch: Watch | None = None,
) -> Iterator[tuple[GrownInPhoto, Float[np.ndarray, " 3"]]]:
    """Every tree of the photo, grown in the scale of the first, and where its foot stands, metres. `foliages`: of each, if it was found before. Raises SketchError, OptionError."""
    watch = watch or Watch()
    check_further(len(marked), depth=depths or (), library=wanted.libraries)
    with watch("read"):
        palette = Palette.of(photo)
    scale = None
    for number, own in enumerate(marked):
        at = place_of(own, marked[0], scale, depths[number - 1] if 0 < number <= len(depths or ()) else 0.0)
        found = grow_in_photo(
            photo, own, templates, key=tree_key(key, number), wanted=wanted.of_tree(number), reading=reading, palette=palette, mask=mask, scale=scale,
            foliage=None if foliages is None else foliages[number], watch=watch,
        )  # fmt: skip
        scale = found.drawn.similarity.scale if scale is None else scale
        yield found, at


def check_further(trees: int, **given: Sequence) -> None:
    """Refuse what is given for more trees than there are beside the first. Raises OptionError."""
    for name, values in given.items():
        if len(values) >= trees > 0:
            raise OptionError(f"`--{name}` is given for {len(values) + 1} trees, and {trees} {'is' if trees == 1 else 'are'} marked.", remedy="Give it once for each tree.")


def grow_in_photo(
    photo: Photo,
    own: Marked,
    templates: Database | None = None,
    *,
    key: Key[Array, ""],
    wanted: PhotoOptions = PhotoOptions(),
    reading: ReadingOptions = ReadingOptions(),
    palette: Palette | None = None,
    mask: Bool[np.ndarray, "row column"] | None = None,
    scale: float | None = None,
    foliage: Foliage | None = None,
    watch: Watch | None = None,
) -> GrownInPhoto:
    """One tree of the photo, up to its last twig. `scale`: metres a pixel; None: as the template's height, or the one asked for, has it. `foliage`: if it was found before."""
    watch = watch or Watch()
    with watch("read"):
        foliage = foliage or _foliage(photo, own, stage_key(key, "foliage mask"), wanted, mask)
        traced = wanted.tracing(photo, own, foliage, key=stage_key(key, "trace"), palette=palette)
        sketch, graph = as_drawing([(traced, own)], photo.name)
    similarity = None if scale is None else Similarity(scale, tuple((-scale * np.array([*graph.xy[0], 0.0])).tolist()))
    with watch("match"):
        templates = templates if templates is not None or reading.template == "none" else Database.open()
        leafy = leafy_pixels(photo, foliage, traced)
        choice = choose_for_photo(photo, own, foliage, traced, graph, templates, reading, leafy=leafy, scaled=similarity is not None)
    drawn = draw_out_graph(sketch, graph, templates, key=key, options=choice.reading, similarity=similarity, watch=watch)
    seen = SeenFoliage(photo, foliage.mask, drawn.similarity, leafy)
    drawn = dataclasses.replace(drawn, skeleton=lifted_within(drawn.skeleton, target_of(seen)))
    with watch("propagate"):
        stage = Attract(targets=target_of(seen), library=wanted.library, iterations=wanted.replacements, alternate=wanted.alternate, twigs=wanted.replacements > 0)
        scaled = to_scale(drawn.habit, drawn.skeleton, drawn.crown)
        grown = grown_free(stage, drawn.skeleton, drawn.radius, drawn.habit, scaled, key=stage_key(key, "attract"), pulse=_pulse(watch))
    return GrownInPhoto(own, foliage, traced, drawn, grown, seen, choice, seen_bark(photo, foliage, traced))


def _foliage(photo: Photo, own: Marked, key: Key[Array, ""], wanted: PhotoOptions, mask: Bool[np.ndarray, "row column"] | None) -> Foliage:
    """The foliage of one tree: found, or known by its mask."""
    return foliage_mask(photo, own, key=key, rule=wanted.foliage) if mask is None else known_foliage(photo, own, mask, key=key)


def _pulse(watch: Watch) -> Callable[[], None]:
    """Tells how far the growth is, of which nobody knows how long it goes on: each round a little of the way that is left."""
    rounds = itertools.count()
    return lambda: watch.on_part(1.0 - _ROUND ** next(rounds))


@dataclass(frozen=True)
class PhotoSource:
    """The built-in source: a photo becomes the grown trees that are marked in it, as wood; without marks, the tree that it seems to show (`photo.auto`)."""

    wanted: PhotoOptions = PhotoOptions()
    reading: ReadingOptions = ReadingOptions()

    def __call__(self, input: Photo | str | Path | tuple[Photo, Sequence[Marked]], *, key: Key[Array, ""]) -> TreeSkeleton:
        from sketchtree.photo.auto.propose import propose

        photo, marked = input if isinstance(input, tuple) else (input, None)
        photo = photo if isinstance(photo, Photo) else read_photo(photo, max_mb=self.reading.max_mb, max_megapixels=self.reading.max_megapixels)
        marked = propose(photo, key=key).trees if marked is None else marked
        templates = None if self.reading.template == "none" else Database.open()
        grown = each_grown(photo, marked, templates, key=key, wanted=self.wanted, reading=self.reading)
        return joined(_numbered([moved(found.grown.skeleton, at) for found, at in grown]))


def place_of(own: Marked, first: Marked, scale: float | None, depth: float) -> Float[np.ndarray, " 3"]:
    """Where a tree's foot stands: as far to the side of the first as the photo shows, so far in front of it, on level ground; metres."""
    aside = 0.0 if scale is None else scale * float(own.branches[0][0][0] - first.branches[0][0][0])
    return np.array([aside, 0.0, float(depth)])


def to_finish(found: GrownInPhoto, key: Key[Array, ""], options: TreeOptions, templates: Database | None, place: Float[np.ndarray, " 3"], wanted: PhotoOptions) -> Grown:
    """A grown tree, and what it is to wear, at its place: for `pipeline.leafy` and `pipeline.finish`."""
    if wanted.bare_as_seen and found.foliage.bare and options.leaf is None:
        options = dataclasses.replace(options, leaf="none", season="bare")
    options = dataclasses.replace(options, leaf=options.leaf or found.choice.leaf)
    return Grown(found.drawn, found.grown, key, options, templates, place, PhotoLeafing(found.seen.moved(place), wanted), found.bark if wanted.bark_colour == "photo" else None)


def _dressed(found: GrownInPhoto, key: Key[Array, ""], options: TreeOptions, templates: Database | None, place, wanted: PhotoOptions, watch: Watch) -> PhotoTree:
    """A grown tree with radii, leaves and meshes, at its place."""
    model = finish(to_finish(found, key, options, templates, place, wanted), watch)
    told = (*found.seen.photo.warnings, *found.marked.warnings, *found.foliage.warnings, *found.choice.warnings(options.leaf), *model.warnings)
    return PhotoTree(**vars(found), model=dataclasses.replace(model, warnings=tuple(dict.fromkeys(told))))


def target_of(seen: SeenFoliage) -> Target:
    """The foliage as what the tree grows to: its pixels in the world."""
    left, top = seen.similarity.to_world(np.zeros((1, 2)))[0]
    return Target(seen.mask, float(left), float(top), seen.similarity.scale)


def _numbered(trees: Sequence[TreeSkeleton]) -> list[TreeSkeleton]:
    """The same, their column `tree` counting from 0."""
    return [tree.replace(tree=np.full(len(tree), number)) for number, tree in enumerate(trees)]


def _in_pixels(tree: TreeSkeleton, seen: SeenFoliage) -> TreeSkeleton:
    """A skeleton of the world in the pixels of its photo, y up."""
    scale = seen.similarity.scale
    return tree.replace(
        tip=seen.similarity.to_sketch(tree.tip), radius=tree.radius / scale, depth_sd=tree.depth_sd / scale, curve_points=seen.similarity.to_sketch(tree.curve_points)
    )
