"""How like its model is a tree? S_T with its thirds, Chamfer distance, length and tips recall (`docs/fidelity.md`); feet, limbs and metres of wood beside the model's."""

from benchmarks.twenty_views.models import Model
from sketchtree.fidelity.limb_tree import limb_tree
from sketchtree.fidelity.recall import recall
from sketchtree.fidelity.similarity import stava_like
from sketchtree.skeleton import TreeSkeleton


def scored(model: Model, tree: TreeSkeleton, *, placed: bool = True) -> dict[str, float]:
    """A row. `placed`: whether it stands where the model stands; where not, distances are none."""
    like = stava_like(model.tree, tree)
    row = {"S_T": like.total, "shape": like.shape, "geometry": like.geometry, "structure": like.structure}
    if placed:
        near = recall(model.tree, tree)
        row |= {"chamfer": near.chamfer, "recall": near.length_recall, "precision": near.length_precision, "tips": near.tip_recall}
    return row | {"limbs": len(limb_tree(tree)), "length": float(tree.length.sum()), "feet": int(tree.is_base.sum())}
