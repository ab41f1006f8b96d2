"""Which short limbs are roughness of the cloud? Those that no photos show beside what they stand on: the points of a limb lie a pixel or two off its bark."""

import numpy as np
from jaxtyping import Float, Int

from sketchtree.axes import NULL
from sketchtree.multiview.compiled import compiled
from sketchtree.multiview.thin.contrasts import BESIDE, LEAST, Contrasts, told
from sketchtree.skeleton import TreeSkeleton
from sketchtree.traverse import is_tip

SPUR = 10.0  # pixels: shorter limbs must be shown
_OUTER = 0.5  # of a spur, that must be


def smooth(tree: TreeSkeleton, photos: Contrasts, pixel: float) -> TreeSkeleton:
    """The tree without them."""
    for _ in range(3):  # a spur may stand on a spur
        long = np.bincount(tree.limb, tree.length)
        first = np.flatnonzero((tree.parent != NULL) & (tree.limb != tree.limb[tree.parent]))  # rows with which limbs leave others
        foot, bears = np.full(len(long), NULL), np.zeros(len(long), bool)
        foot[tree.limb[first]] = tree.parent[first]
        bears[tree.limb[tree.parent[first]]] = True
        tips = np.flatnonzero(is_tip(tree.parent) & (foot[tree.limb] != NULL) & ~bears[tree.limb] & (long[tree.limb] < SPUR * pixel))
        keep = ~np.isin(tree.limb, tree.limb[tips[_seen(tree, foot[tree.limb[tips]], tips, photos, pixel) < LEAST]])
        if keep.all():
            break
        tree = tree.select(keep)
    return tree


def _seen(tree: TreeSkeleton, foot: Int[np.ndarray, " spur"], tip: Int[np.ndarray, " spur"], photos: Contrasts, pixel: float) -> Int[np.ndarray, " spur"]:
    """How many photos show the outer half of each beside the limb that it stands on."""
    start, end = tree.tip[foot], tree.tip[tip]
    outer = start + (1.0 - _OUTER) * (end - start)
    inverse = [_moves(start, one) for one in photos.to_pixel]
    clear = np.maximum(tree.radius[foot] / pixel, 0.5) + BESIDE
    found = np.zeros(len(tip), np.int64)
    for view, (move, depth) in enumerate(inverse):
        along, across = (np.einsum("kij,kj->ki", move, vector) for vector in (tree.vector[foot], end - start))
        off = np.abs(along[:, 0] * across[:, 1] - along[:, 1] * across[:, 0]) / np.maximum(np.linalg.norm(along, axis=1), 1e-12)
        rows = np.flatnonzero((depth > 0) & (off >= clear))
        found[rows] += _shows(outer[rows], end[rows], view, *photos)
    return found


def _moves(place: Float[np.ndarray, "place 3"], to_pixel: Float[np.ndarray, "3 4"]) -> tuple[Float[np.ndarray, "place 2 3"], Float[np.ndarray, " place"]]:
    """(by how many pixels a small move of each place moves its picture, its depth)."""
    seen = place @ to_pixel[:, :3].T + to_pixel[:, 3]
    depth = seen[:, 2]
    safe = np.where(depth > 0, depth, 1.0)
    return np.stack([(to_pixel[k, :3] - (seen[:, k] / safe)[:, None] * to_pixel[2, :3]) / safe[:, None] for k in range(2)], axis=1), depth


@compiled
def _shows(start, end, view, to_pixel, contrast, sizes):
    found = np.zeros(len(start), np.int64)
    for k in range(len(start)):
        found[k] = told(start[k], end[k], to_pixel[view : view + 1], contrast[view : view + 1], sizes[view : view + 1])[0]
    return found
