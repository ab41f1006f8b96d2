"""Leaves as Tan et al. 2008 have them, §4: "Each leaf is represented by a flat rectangle with the size of 1/10 of the main trunk radius. Each branch generates from a range of 50 to 200
leaves proportional to it length. The arrangement of the leaves around the branch is randomized."

    count of a branch = 50 + (200 − 50) length / longest          size = r / 10

A branch is a limb, the trunk left out. Directions are even over the sphere, places even along the limb. What is more than `most` in all is left out evenly, and the rest is larger,
so that the area stays.
"""

import numpy as np
from jaxtyping import Array, Key

from sketchtree.foliage.leaves import Leaves
from sketchtree.foliage.twigs import wood_pieces
from sketchtree.keys import numpy_generator, stage_key
from sketchtree.roots import without_roots
from sketchtree.skeleton import TreeSkeleton

RECTANGLE = "rectangle"
FEWEST, MANIEST = 50, 200  # leaves of a branch
SHARE = 0.1  # of the trunk's radius


def paper_leaves(tree: TreeSkeleton, *, key: Key[Array, ""], scale: float = 1.0, density: float = 1.0, most: int = 60_000) -> Leaves:
    """The paper's leaves of a whole tree; those outside the foliage are still there. `scale` and `density` are times the paper's."""
    tree, _ = without_roots(tree)
    pieces = wood_pieces(tree)
    pieces = pieces.select(tree.order[pieces.row] > 0)
    if len(pieces) == 0:
        return Leaves.none(RECTANGLE)
    _, limb = np.unique(tree.limb[pieces.row], return_inverse=True)
    limb = limb.reshape(-1)
    length = np.bincount(limb, pieces.length)
    count = np.round(density * (FEWEST + (MANIEST - FEWEST) * length / length.max())).astype(np.int64)
    kept = min(1.0, most / count.sum())
    draw = numpy_generator(stage_key(key, "paper leaves"))
    of = np.repeat(np.arange(len(count)), count)
    of = of[draw.random(len(of)) < kept]
    piece, share = _places(pieces, limb, length, of, draw.random(len(of)))
    direction, normal = _turned(draw, len(of))
    radius = pieces.start_radius[piece] + share * (pieces.end_radius - pieces.start_radius)[piece]
    size = SHARE * scale * float(tree.radius[tree.is_base].max()) / np.sqrt(kept)
    return Leaves(
        RECTANGLE, pieces.start[piece] + share[:, None] * (pieces.end - pieces.start)[piece] + 0.85 * radius[:, None] * direction, direction, normal, np.full(len(of), size), draw.random(len(of)),
        pieces.row[piece], kept=float(kept),
    )  # fmt: skip


def _places(pieces, limb, length, of, along):
    """(piece, share of it) of leaves at parts `along` (0-1) of their limbs `of`."""
    order = np.lexsort((pieces.from_foot, limb))
    run = np.cumsum(pieces.length[order])
    before = np.concatenate([[0.0], np.cumsum(length)])[of]
    at = np.minimum(np.searchsorted(run, before + along * length[of], side="right"), len(order) - 1)
    piece = order[at]
    share = (before + along * length[of] - (run[at] - pieces.length[piece])) / np.maximum(pieces.length[piece], 1e-12)
    return piece, np.clip(share, 0.0, 1.0)


def _turned(draw: np.random.Generator, count: int):
    """(directions even over the sphere, normals even about them)."""
    direction, other = draw.normal(size=(count, 3)), draw.normal(size=(count, 3))
    direction /= np.linalg.norm(direction, axis=1, keepdims=True)
    normal = np.cross(direction, other)
    return direction, normal / np.linalg.norm(normal, axis=1, keepdims=True)
