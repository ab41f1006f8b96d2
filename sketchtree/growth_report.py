"""What was done to make a tree that grows: the report of every tree, with a block `growth`.

Of a drawing the other keys are those of `build`; of a picture or a skeleton, what only a drawing has is empty or null.
"""

import numpy as np

from sketchtree.growth_tree import FoundTrunk, GrownTree
from sketchtree.reading_report import frame, plain, reading
from sketchtree.report import of_tree


def growth_report(
    tree: GrownTree, crowns: list[dict], asset, *, command: str, seed: int, seconds: dict[str, float], options: dict, warnings: tuple[str, ...] = ()
) -> dict:
    """The report of one run, by `report.schema.json`. `tree` is the first crown, `crowns` what `of_crown` says of every one; `asset` what was animated, if anything was."""
    run = frame(command, seed, seconds, options, (*tree.warnings, *warnings))
    return plain(run | _reading(tree) | _found(tree) | {"growth": _growth(tree, crowns, asset)})


def of_crown(tree: GrownTree, file: str) -> dict:
    """One entry of `growth.crowns`."""
    return {"file": file, "segments": tree.model.skeleton.segment_count, "height": tree.model.skeleton.height, "leaves": len(tree.model.leaves)}


def _reading(tree: GrownTree) -> dict:
    """How the input was read."""
    begun, total = tree.beginning, tree.model.skeleton.segment_count
    graph = begun.drawn.graph if begun.drawn is not None else begun.trunk.graph if begun.trunk is not None else None
    if graph is not None:
        return reading(graph, total)
    skeleton = begun.skeleton
    count = {"drawn": skeleton.segment_count, "limbs": len(np.unique(skeleton.limb)), "roots": 0, "stems": int(skeleton.is_base.sum()), "trees": len(np.unique(skeleton.tree))}
    return {"attachments": [], "roles": [], "cuts": [], "segments": count | {"total": total}}


def _found(tree: GrownTree) -> dict:
    model, begun = tree.model, tree.beginning
    if begun.drawn is not None:
        return of_tree(begun.drawn, model)
    leaf = sum(mesh.triangle_count for mesh in model.meshes if mesh.name.startswith("leaf"))
    triangles = {"wood": sum(mesh.triangle_count for mesh in model.meshes) - leaf, "leaf": leaf}
    similarity = None if begun.trunk is None else begun.trunk.similarity
    return {
        "template_used": begun.template,
        "height": model.skeleton.height,
        "leaves": len(model.leaves),
        "triangles": triangles,
        "wood_used": model.wood_used,
        "transform": None if similarity is None else {"scale": similarity.scale, "translate": list(similarity.translate)},
    }


def _growth(tree: GrownTree, crowns: list[dict], asset) -> dict:
    moved = asset is not None and asset.animation is not None
    tracks = (asset.animation.translation, asset.animation.rotation, asset.animation.scale) if moved else ()
    return {
        "input": tree.beginning.kind,
        "mode": tree.plan.mode,
        "bend": tree.plan.bend,
        "levels": tree.levels,
        "joints": len(asset.armature) if moved else None,
        "keys": sum(len(track.time) for track in (*tracks, *getattr(asset.animation, "morphs", ()))) if moved else None,
        "seconds": asset.animation.seconds if moved else None,
        "crowns": crowns,
        "trunk": None if tree.beginning.trunk is None else _trunk(tree.beginning.trunk),
    }


def _trunk(trunk: FoundTrunk) -> dict:
    alpha = trunk.matte.alpha
    return {
        "matting": trunk.matte.method,
        "opaque": round(float((alpha >= 0.5).mean()), 6),
        "vertices": trunk.skeleton.vertex_count,
        "nodes": len(trunk.skeleton),
        "tips": len(trunk.skeleton.tips),
        "limbs": len(trunk.graph.limb_id),
    }
