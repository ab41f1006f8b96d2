"""Do the surfaces about a point look all ways, as leaves do, or only away from one axis, as bark does?

The normals of a limb's bark, or of a plane, lie in one plane; those of leaves in none:

    κ_i = the smallest eigenvalue of mean_j n_j n_jᵀ        n_j  normal of point j, of its 30 nearest (the direction in which those lie least apart)

0 on a cylinder, 1/3 at most. And how do points fill the space about them, as lines (1), surfaces (2) or bodies (3)?

    D_i = log(30 / 6) / log(d_30 / d_6)        d_k  how far the k-th nearest is
"""

import numpy as np
from jaxtyping import Float
from scipy.spatial import cKDTree

_NEAREST, _FEW = 30, 6
_AT_ONCE = 40_000  # points, which bounds the memory


def turning(xyz: Float[np.ndarray, "point 3"]) -> Float[np.ndarray, " point"]:
    """κ of every point."""
    tree, count = cKDTree(xyz), min(_NEAREST, len(xyz))
    near = np.concatenate([tree.query(xyz[rows], k=count)[1].reshape(len(rows), -1) for rows in _parts(len(xyz))])
    normal = np.concatenate([_normals(xyz[near[rows]]) for rows in _parts(len(xyz))])
    return np.concatenate([_least(normal[near[rows]]) for rows in _parts(len(xyz))])


def filling(xyz: Float[np.ndarray, "point 3"], at: Float[np.ndarray, "place 3"]) -> Float[np.ndarray, " place"]:
    """D about some of the points."""
    distance = cKDTree(xyz).query(at, k=min(_NEAREST, len(xyz) - 1) + 1)[0]
    near, far = distance[:, min(_FEW, distance.shape[1] - 1)], distance[:, -1]
    return np.log(_NEAREST / _FEW) / np.log(np.maximum(far / np.maximum(near, 1e-12), 1.05))


def _parts(count: int):
    return np.split(np.arange(count), range(_AT_ONCE, count, _AT_ONCE))


def _normals(group: Float[np.ndarray, "point near 3"]) -> Float[np.ndarray, "point 3"]:
    away = group - group.mean(axis=1, keepdims=True)
    return np.linalg.eigh(np.einsum("nki,nkj->nij", away, away))[1][:, :, 0]


def _least(normal: Float[np.ndarray, "point near 3"]) -> Float[np.ndarray, " point"]:
    return np.maximum(np.linalg.eigvalsh(np.einsum("nki,nkj->nij", normal, normal))[:, 0] / normal.shape[1], 0.0)
