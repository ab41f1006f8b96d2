"""Which part of the bark belongs to a branch that grows out of it?

A branch that is young, or not there yet, has a small foot, or none, while the collar that the final mesh has round it is as large as the final
branch. So the bark around the place where it comes out, of both, draws together with the branch's foot,

    share of the foot = (1 − smoothstep((d − a) / (b − a))) · smoothstep(2 cos φ)       a = `NEAR` r,  b = `FAR` r

    d   from the vertex to where the centre line comes out      r   the branch's radius there      φ   angle between both round the bearing limb; 0 on the branch itself
"""

from typing import NamedTuple

import numpy as np
from jaxtyping import Float, Int

from sketchtree.animation.hosts import Hosts
from sketchtree.axes import NULL
from sketchtree.geometry.limbs import CentreLines
from sketchtree.rig.boughs import Boughs
from sketchtree.rig.collar import smoothstep
from sketchtree.rig.place import Places

NEAR, FAR = 2.4, 4.0
SLIGHT = 0.2  # of the radius of what bears it: thinner branches have no rim, twice as thick ones a whole one; theirs would stay large on a thin young stem


class Rim(NamedTuple):
    """One row a vertex that draws together with a branch."""

    vertex: Int[np.ndarray, " row"]
    limb: Int[np.ndarray, " row"]  # the branch
    share: Float[np.ndarray, " row"]


def rims(lines: CentreLines, limbs: Boughs, hosts: Hosts, place: Places, position: Float[np.ndarray, "vertex 3"]) -> Rim:
    """The vertices round all feet; each goes with the branch that has the largest share of it."""
    from scipy.spatial import cKDTree

    child = np.flatnonzero((lines.parent != NULL) & (hosts.first != NULL))
    if not len(child) or not len(position):
        return Rim(np.zeros(0, np.int64), np.zeros(0, np.int64), np.zeros(0))
    out, radius = lines.at(child, limbs.buried[child])
    slight = radius / lines.at(lines.parent[child], limbs.exit_s[child])[1]
    counts = smoothstep((slight - SLIGHT) / SLIGHT)
    child, out, radius, counts = (column[slight > SLIGHT] for column in (child, out, radius, counts))
    if not len(child):
        return Rim(np.zeros(0, np.int64), np.zeros(0, np.int64), np.zeros(0))
    found = cKDTree(position).query_ball_point(out, FAR * radius, workers=-1)
    which = np.repeat(np.arange(len(child)), [len(rows) for rows in found])
    vertex = np.concatenate([np.asarray(rows, np.int64) for rows in found])
    own = place.limb[vertex] == child[which]
    both = own | (place.limb[vertex] == lines.parent[child[which]])
    which, vertex, own = which[both], vertex[both], own[both]
    away = np.linalg.norm(position[vertex] - out[which], axis=1) / radius[which]
    axis = lines.at(place.limb[vertex], place.s[vertex])[0]
    share = counts[which] * (1.0 - smoothstep((away - NEAR) / (FAR - NEAR))) * np.where(own, 1.0, smoothstep(2.0 * _cosine(position[vertex] - axis, out[which] - axis)))
    order = np.lexsort((which, -share, vertex))
    first = order[np.r_[True, np.diff(vertex[order]) != 0][: len(order)] & (share[order] > 0)]
    return Rim(vertex[first], child[which[first]], share[first])


def _cosine(a, b):
    return np.einsum("ij,ij->i", a, b) / np.maximum(np.linalg.norm(a, axis=1) * np.linalg.norm(b, axis=1), 1e-12)
