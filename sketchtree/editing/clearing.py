"""What grows where a limb was deleted by hand? Nothing: an undrawn limb that runs through the room kept clear goes, with all it bears.

The room is a tube round the limb that was deleted. An undrawn limb is in it if more than half of its course, as long as the tube is, lies there, or if it is the
very limb (the same parent, the same rank).
"""

import dataclasses
from collections.abc import Iterable

import numpy as np
from jaxtyping import Bool, Float

from sketchtree.editing.edits import Cleared
from sketchtree.propagate.after.cutting import borne, cut
from sketchtree.propagate.generations import Propagation
from sketchtree.similarity import Similarity
from sketchtree.skeleton import Kind, TreeSkeleton

_MOST = 0.5  # share of a limb's course that may lie in the room


def cleared(grown: Propagation, rooms: Iterable[Cleared], similarity: Similarity) -> Propagation:
    """What has grown, without what grew in these rooms. Drawn rows stay."""
    rooms = tuple(rooms)
    if not rooms:
        return grown
    tree = grown.skeleton
    away = _in_rooms(tree, rooms, similarity)
    share = np.where(away | borne(tree.parent, away), 0.0, 1.0)
    left = cut(tree, share)
    place = np.full(len(tree), -1)
    place[left.rows] = np.arange(len(left.rows))
    return dataclasses.replace(
        grown, skeleton=left.skeleton, generation=grown.generation[left.rows], drawn_row=place[grown.drawn_row],
        tip_weight=None if grown.tip_weight is None else grown.tip_weight[left.rows],
    )  # fmt: skip


def _in_rooms(tree: TreeSkeleton, rooms: tuple[Cleared, ...], similarity: Similarity) -> Bool[np.ndarray, " segment"]:
    undrawn = (tree.kind == Kind.PROPAGATED) & ~tree.is_base
    away = np.zeros(len(tree), bool)
    for room in rooms:
        path, radius = similarity.to_world(room.path), room.radius * similarity.scale
        long = float(np.linalg.norm(np.diff(path, axis=0), axis=1).sum())
        near = undrawn & (_gap(tree.tip, path) <= radius) & (_gap(tree.start, path) <= 1.5 * radius)
        away |= undrawn & (tree.limb == room.limb) & near
        for limb in np.unique(tree.limb[near]):
            whole = undrawn & (tree.limb == limb)
            inside = float(tree.length[near & whole].sum())
            if inside > _MOST * min(float(tree.length[whole].sum()), long):
                away |= whole
    return away


def _gap(point: Float[np.ndarray, "point 3"], path: Float[np.ndarray, "node 3"]) -> Float[np.ndarray, " point"]:
    """How far each point is from a polyline."""
    best = np.full(len(point), np.inf)
    for a, b in zip(path[:-1], path[1:], strict=True):
        along = b - a
        share = np.clip((point - a) @ along / max(float(along @ along), 1e-300), 0.0, 1.0)
        best = np.minimum(best, np.linalg.norm(point - a - share[:, None] * along, axis=1))
    return best
