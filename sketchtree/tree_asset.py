"""What of a tree goes into its file: which levels of detail, with which leaves?"""

import dataclasses
from collections.abc import Sequence
from typing import Protocol

from sketchtree.asset import Asset, Level
from sketchtree.foliage.instanced import leaf_instances
from sketchtree.geometry.instances import Instances
from sketchtree.geometry.mesh import Mesh
from sketchtree.levels.make import Model, as_fine_as, make_levels
from sketchtree.options import FileOptions
from sketchtree.skeleton import TreeSkeleton


def tree_asset(model: Model, options: FileOptions = FileOptions(), *, about: dict | None = None) -> Asset:
    """The tree as writers take it. `about` is JSON that the file keeps: seed, version, template …"""
    if options.levels == "one":
        levels = (Level(as_fine_as(model, options)),)
    else:
        levels = make_levels(model, pixel_error=options.pixel_error)
    if options.leaves == "instanced":
        levels = (dataclasses.replace(levels[0], parts=_instanced(model, levels[0].parts)), *levels[1:])
    return Asset(levels, model.skeleton, about=about or {})


class Forest(Protocol):
    """What a forest's file is made of: `forest.Forest` is one."""

    skeleton: TreeSkeleton
    trees: Sequence[Model]


def forest_asset(forest: Forest, options: FileOptions = FileOptions(), *, about: dict | None = None) -> Asset:
    """Several trees, each part named by its tree: `wood_1`, `leaf_1`, `wood_2` … One level of detail."""
    parts = [
        _renamed(part, f"{part.name}_{number}")
        for number, model in enumerate(forest.trees, 1)
        for part in (_instanced(model, model.meshes) if options.leaves == "instanced" else model.meshes)
    ]
    return Asset.of(parts, skeleton=forest.skeleton, about=about or {})


def _renamed(part: Mesh | Instances, name: str) -> Mesh | Instances:
    return dataclasses.replace(part, mesh=dataclasses.replace(part.mesh, name=name)) if isinstance(part, Instances) else dataclasses.replace(part, name=name)


def _instanced(model: Model, parts: tuple[Mesh | Instances, ...]) -> tuple[Mesh | Instances, ...]:
    """The wood, and the leaves as a few meshes at many places."""
    wood = tuple(part for part in parts if not part.name.startswith("leaf"))
    worn = [leaves for leaves in (model.leaves, model.blossom) if leaves is not None and len(leaves)]
    return (*wood, *(places for leaves in worn for places in leaf_instances(leaves, season=model.dress.season)))
