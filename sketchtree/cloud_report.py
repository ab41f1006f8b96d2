"""What was done to make a tree of a point cloud: the report of every tree, with a block `cloud`. What only a drawing has is empty or null."""

import numpy as np

from sketchtree.cloud_tree import CloudTree
from sketchtree.clouds.growing.wanted import RANGES
from sketchtree.reading_report import frame, plain


def cloud_report(tree: CloudTree, others: dict | None = None, *, command: str, seed: int, seconds: dict[str, float], options: dict, warnings: tuple[str, ...] = ()) -> dict:
    """The report of one run, by `report.schema.json`. `others`: `series` and `variations`, what was written beside a tree that grew."""
    run = frame(command, seed, seconds, options, (*tree.warnings, *warnings))
    return plain(run | _found(tree) | {"cloud": _cloud(tree) | {"growth": _growth(tree, others or {"series": [], "variations": []})}})


def _found(tree: CloudTree) -> dict:
    skeleton, model = tree.skeleton, tree.model
    leaf = sum(mesh.triangle_count for mesh in model.meshes if mesh.name.startswith("leaf"))
    placed = tree.prepared.placement.similarity
    stems, trees = int(skeleton.is_base.sum()), len(np.unique(skeleton.tree))
    return {
        "attachments": [],
        "roles": [],
        "cuts": [],
        "segments": {"drawn": tree.seen - stems, "total": skeleton.segment_count, "limbs": len(np.unique(skeleton.limb)), "roots": 0, "stems": stems, "trees": trees},
        "template_used": model.template,
        "height": skeleton.height,
        "leaves": len(model.leaves),
        "triangles": {"wood": sum(mesh.triangle_count for mesh in model.meshes) - leaf, "leaf": leaf},
        "wood_used": model.wood_used,
        "transform": {"scale": placed.scale, "translate": list(placed.translate)},
    }


def _cloud(tree: CloudTree) -> dict:
    prepared, feet = tree.prepared, tree.feet
    trunks = [{"root": one.root, "breast": one.breast, "error": one.error, "seen": one.seen} if one is not None else None for one in tree.trunks]
    return {
        "points": len(prepared.cloud),
        "up": prepared.placement.up,
        "up_sure": prepared.up_sure,
        "ground": prepared.ground,
        "trees": prepared.trees,
        "leaves": {"in_leaf": tree.leafy.in_leaf, "share": tree.leafy.share, "area": float(tree.leafy.area.sum()), "green": tree.leafy.green},
        "pieces": tree.pieces,
        "feet": [{"place": place.tolist(), "diameter": thick} for place, thick in zip(feet.place, trunks, strict=True)],
        "species": {"name": tree.species.name, "internode": tree.species.internode, "roll": tree.species.roll, "branching": tree.species.branching, "gamma": tree.species.gamma},
    }


def _growth(tree: CloudTree, others: dict) -> dict | None:
    """How it came to be, and what was written beside it."""
    if tree.grows is None:
        return None
    how = tree.grows.wanted
    figures = {name: getattr(how, name) for name in (*RANGES, "influence", "weighted")} | {"tropism": list(how.tropism)}
    return {"cycles": tree.grows.cycles, "left": tree.grows.left, "figures": figures} | others
