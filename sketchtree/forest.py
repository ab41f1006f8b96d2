"""Several sketches in, a forest out: each read and inferred for itself, all grown together.

    sketches → drawn trees → places → growth in lockstep → radii, leaves, meshes of each → one forest
"""

import dataclasses
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from jaxtyping import Array, Float, Key

from sketchtree import limb_ids, planting
from sketchtree.axes import NULL
from sketchtree.choose import bark_model, leaf_model
from sketchtree.editing.clearing import cleared
from sketchtree.errors import SketchTreeError
from sketchtree.geometry.mesh import Mesh
from sketchtree.geometry.wood import check_wood
from sketchtree.keys import stage_key
from sketchtree.options import ReadingOptions, TreeOptions
from sketchtree.parameters import Habit
from sketchtree.pipeline import DrawnTree, Grown, TreeModel, draw_out, finish, propagation, read_obstacles
from sketchtree.propagate.after.prune import Prune
from sketchtree.propagate.generations import Planted, Propagation, propagate_together
from sketchtree.sketch.strokes import Sketch
from sketchtree.skeleton import TreeSkeleton
from sketchtree.skeleton_joined import joined
from sketchtree.templates.store.database import Database
from sketchtree.watch import Watch

_OUT_OF_REACH = "is out of the tree's reach"


@dataclass(frozen=True, eq=False)
class Forest:
    """Trees that grew up together, one for each sketch given, in world coordinates."""

    names: tuple[str, ...]  # of the sketches
    copies: tuple[int, ...]  # how many of the same sketch stand before each
    digests: tuple[str, ...]  # the same for sketches that are the same
    place: Float[np.ndarray, "tree 3"]  # of each foot, metres
    trees: tuple[TreeModel, ...]
    warnings: tuple[str, ...]

    @property
    def meshes(self) -> tuple[Mesh, ...]:
        """All meshes, named by their trees: `wood_1`, `leaf_1`, `wood_2`, …"""
        return tuple(dataclasses.replace(mesh, name=f"{mesh.name}_{k}") for k, tree in enumerate(self.trees, 1) for mesh in tree.meshes)

    @property
    def skeleton(self) -> TreeSkeleton:
        """All trees in one table, one after the other; limb ids, strokes and the column `tree` run on, so that none is used twice."""
        found, strokes, trees = [], 0, 0
        for model, copy, digest in zip(self.trees, self.copies, self.digests, strict=True):
            one = model.skeleton
            salt = limb_ids.stroke_limb_id(f"{digest} {copy}")
            _, number = np.unique(one.tree, return_inverse=True)
            drawn_by = np.where(one.stroke == NULL, NULL, one.stroke + strokes)
            found.append(one.replace(limb=limb_ids.child_limb_id(one.limb, np.full(len(one), salt)), stroke=drawn_by, tree=number + trees))
            strokes, trees = strokes + len(model.drawn.graph.stroke_ids), trees + number.max(initial=-1) + 1
        return joined(found)


def sketches_to_forest(
    sketches: Sequence[Sketch | str | Path],
    templates: Database | None = None,
    *,
    key: Key[Array, ""],
    spacing: float | None = None,
    reading: ReadingOptions = ReadingOptions(),
    tree: TreeOptions = TreeOptions(),
    watch: Watch | None = None,
) -> Forest:
    """Every stage in order. `spacing` is from foot to foot, metres; None: so that the drawings touch (`planting`).

    `tree.max_segments` is shared evenly. Raises the error of the first sketch that fails, which it names."""
    watch = watch or Watch()
    planting.check_stand(len(sketches), spacing)
    leaf_model(tree.leaf, Habit(), templates), bark_model(tree.bark, Habit())  # refuse a wrong name before the work
    Prune(tree.prune), check_wood(tree.wood, tree.solid)  # and a mesh that can't be used, and what isn't installed
    obstacles = read_obstacles(tree)
    names = [_name(sketch) for sketch in sketches]
    drawn = _drawn(sketches, names, templates, key, reading, watch)
    digests = [planting.digest(one.graph) for one in drawn]
    copies, place = planting.copy_numbers(digests), planting.places(drawn, spacing)
    keys = [planting.tree_key(key, copy) for copy in copies]
    with watch("propagate"):
        grown = _grown(drawn, place, keys, obstacles, tree)
    trees, lap = [], Watch(seconds=watch.seconds)
    watch.on_stage("mesh")
    for one, its, name, at, its_key in zip(drawn, grown, names, place, keys, strict=True):
        with _named(name):
            trees.append(finish(Grown(one, its, its_key, tree, templates, at), lap))
        watch.on_part(len(trees) / len(drawn))
    return Forest(tuple(names), tuple(copies), tuple(digests), place, tuple(trees), _warnings(names, place, trees))


def _drawn(sketches, names, templates, key, reading, watch) -> list[DrawnTree]:
    """Every sketch in 3D; a file that is named again is read once."""
    known: dict = {}
    found, lap = [], Watch(seconds=watch.seconds)
    watch.on_stage("read")
    for sketch, name in zip(sketches, names, strict=True):
        source = id(sketch) if isinstance(sketch, Sketch) else Path(sketch).resolve()
        if source not in known:
            with _named(name):
                known[source] = draw_out(sketch, templates, key=key, options=reading, watch=lap)
        found.append(known[source])
        watch.on_part(len(found) / len(sketches))
    return found


def _grown(drawn, place, keys, obstacles, options: TreeOptions) -> list[Propagation]:
    share = dataclasses.replace(options, max_segments=max(options.max_segments // len(drawn), 1))
    planted = []
    for one, at, key in zip(drawn, place, keys, strict=True):
        near = tuple(mesh.copy().apply_translation(-at) for mesh in obstacles)
        planted.append(Planted(one.skeleton, propagation(one, share, near), stage_key(key, "propagate"), at))
    return [cleared(grown, one.edits.cleared.values(), one.similarity) for one, grown in zip(drawn, propagate_together(planted), strict=True)]


def _name(sketch) -> str:
    return sketch.name if isinstance(sketch, Sketch) else Path(sketch).name


class _named:
    """Errors from within name the sketch."""

    def __init__(self, name: str):
        self.name = name

    def __enter__(self) -> None:
        pass

    def __exit__(self, kind, error, trace) -> None:
        if isinstance(error, SketchTreeError) and self.name not in error.message:
            named = type(error)(f"{self.name}: {error.message}", remedy=error.remedy)
            named.__dict__.update({at: value for at, value in error.__dict__.items() if at != "message"})
            raise named from error


def _warnings(names, place, trees) -> tuple[str, ...]:
    """What every tree has to say, with its name; what all say alike, once."""
    told = []
    for name, tree in zip(names, trees, strict=True):
        for warning in tree.warnings:
            common = all(warning in other.warnings for other in trees)
            if common or _OUT_OF_REACH not in warning:
                told.append(warning if common else f"{name}: {warning}")
    radius = np.array([tree.skeleton.radius[tree.skeleton.is_base].max() for tree in trees])
    return tuple(dict.fromkeys((*told, *planting.crowded(names, place, radius))))
