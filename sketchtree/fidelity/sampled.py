"""Places that stand for a tree, evenly spread: along its axes, or over surfaces."""

from collections.abc import Sequence

import numpy as np
from jaxtyping import Array, Float, Int, Key

from sketchtree.geometry.mesh import Mesh
from sketchtree.skeleton import TreeSkeleton


def along(tree: TreeSkeleton, spacing: float) -> tuple[Float[np.ndarray, "place 3"], Int[np.ndarray, " place"]]:
    """(places on the axes, metres, about so far apart, in the middle of equal pieces; the row of each). Curves count as their chords."""
    rows = np.flatnonzero(tree.length > 0)
    pieces = np.maximum(np.round(tree.length[rows] / spacing), 1).astype(int)
    row = np.repeat(rows, pieces)
    step = np.arange(len(row)) - np.repeat(np.cumsum(pieces) - pieces, pieces)
    share = (step + 0.5) / np.repeat(pieces, pieces)
    return tree.start[row] + share[:, None] * tree.vector[row], row


def over(meshes: Sequence[Mesh], count: int, *, key: Key[Array, ""]) -> Float[np.ndarray, "place 3"]:
    """So many places on surfaces, each spot of them as likely as any other, metres."""
    position, triangle = joined_triangles(meshes)
    corner = position[triangle]
    area = np.linalg.norm(np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0]), axis=1)
    chance = _generator(key)
    chosen = chance.choice(len(triangle), count, p=area / area.sum())
    u, v = chance.random((2, count))
    u, v = np.where(u + v > 1, 1 - u, u), np.where(u + v > 1, 1 - v, v)
    first, second, third = corner[chosen].transpose(1, 0, 2)
    return first + u[:, None] * (second - first) + v[:, None] * (third - first)


def joined_triangles(meshes: Sequence[Mesh]) -> tuple[Float[np.ndarray, "vertex 3"], Int[np.ndarray, "triangle 3"]]:
    """All meshes as one table of places and one of triangles."""
    whole = [mesh.merged() for mesh in meshes]
    first = np.cumsum([0, *(len(mesh.position) for mesh in whole)])
    return np.concatenate([mesh.position for mesh in whole]), np.concatenate([mesh.triangle + at for mesh, at in zip(whole, first, strict=False)])


def _generator(key):
    import jax

    return np.random.default_rng(np.asarray(jax.random.bits(key, (4,)), np.uint32))
