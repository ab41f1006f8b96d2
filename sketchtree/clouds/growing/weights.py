"""Which points are wood that leads somewhere?

Guo et al. 2018, §5.2, Eq. 8: a point counts as much as there are points near it that run the same way,

    w_i = #{ j :  |p_i − p_j| < ε_D   and   n_i ⋆ n_j > ε_A }

    n_i   the direction in which the points round p_i spread most (first axis of a PCA)
    ε_D   3 cm, in a cloud scaled to a box of 10 m        ε_A   0.9

An axis has no sign, so n_i ⋆ n_j is the cosine's size. Where points lie so far apart that 3 cm hold none, ε_D grows with how far they do (ours).
"""

import numpy as np
from jaxtyping import Float
from scipy.spatial import cKDTree

from sketchtree.clouds.growing.perception import workers

EPS_D, EPS_A = 0.03, 0.9
AROUND = 16  # points that an axis is found from
_SPACINGS = 3.0  # ε_D is never less than so many times the median distance to the nearest point
_PAIRS = 20_000_000  # more would not fit into memory: ε_D gives way


def axes(xyz: Float[np.ndarray, "point 3"], tree: cKDTree, around: int = AROUND) -> Float[np.ndarray, "point 3"]:
    """The unit direction in which points spread most round each."""
    _, near = tree.query(xyz, k=min(around, len(xyz)), workers=workers(len(xyz)))
    near = near.reshape(len(xyz), -1)
    away = xyz[near] - xyz[near].mean(axis=1, keepdims=True)
    return np.linalg.eigh(np.einsum("pki,pkj->pij", away, away))[1][:, :, 2]


def point_weights(
    xyz: Float[np.ndarray, "point 3"], *, eps_d: float = EPS_D, eps_a: float = EPS_A, around: int = AROUND
) -> Float[np.ndarray, " point"]:
    """w_i of every point, itself counted, so that none is 0. `eps_d` in the cloud's units, more where points lie far apart."""
    tree = cKDTree(xyz)
    eps_d = max(eps_d, _SPACINGS * spacing(xyz, tree))
    while tree.count_neighbors(tree, eps_d) > 2 * _PAIRS:
        eps_d *= 0.7
    pair = tree.query_pairs(eps_d * (1.0 - 1e-12), output_type="ndarray")
    axis = axes(xyz, tree, around)
    alike = pair[np.abs(np.einsum("pi,pi->p", axis[pair[:, 0]], axis[pair[:, 1]])) > eps_a]
    return 1.0 + np.bincount(alike.ravel(), minlength=len(xyz))


def spacing(xyz: Float[np.ndarray, "point 3"], tree: cKDTree | None = None) -> float:
    """The median distance from a point to the nearest other place."""
    tree = cKDTree(xyz) if tree is None else tree
    some = xyz[:: max(1, len(xyz) // 20_000)]
    distance, _ = tree.query(some, k=min(7, len(xyz)))
    distance = distance.reshape(len(some), -1)[:, 1:]
    apart = distance[distance > 0]
    return float(np.median(np.where(distance > 0, distance, np.inf).min(axis=1, initial=np.inf))) if apart.size else 0.0
