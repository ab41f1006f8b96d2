"""What of a tree goes into its file: which levels of detail, with which leaves?"""

import dataclasses

from sketchtree.asset import Asset, Level
from sketchtree.foliage.instanced import leaf_instances
from sketchtree.geometry.instances import Instances
from sketchtree.geometry.mesh import Mesh
from sketchtree.levels.make import Model, level_of_detail, make_levels
from sketchtree.options import FileOptions


def tree_asset(model: Model, options: FileOptions = FileOptions(), *, about: dict | None = None) -> Asset:
    """The tree as writers take it. `about` is JSON that the file keeps: seed, version, template …"""
    if options.levels == "one":
        levels = (Level(level_of_detail(model, options.lod)),)
    else:
        levels = make_levels(model, pixel_error=options.pixel_error)
    if options.leaves == "instanced":
        levels = (dataclasses.replace(levels[0], parts=_instanced(model, levels[0].parts)), *levels[1:])
    return Asset(levels, model.skeleton, about=about or {})


def _instanced(model: Model, parts: tuple[Mesh | Instances, ...]) -> tuple[Mesh | Instances, ...]:
    """The wood, and the leaves as a few meshes at many places."""
    wood = tuple(part for part in parts if not part.name.startswith("leaf"))
    worn = [leaves for leaves in (model.leaves, model.blossom) if leaves is not None and len(leaves)]
    return (*wood, *(places for leaves in worn for places in leaf_instances(leaves, season=model.dress.season)))
