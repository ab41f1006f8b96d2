"""How do leaves unfold in a file? Each out of its own foot, together with those that come at about the same time.

The leaves of a mesh are cut into `COHORTS` meshes by the time at which their wood is there; each has one morph target in which every
leaf is drawn back to its foot. A cohort unfolds when the last of its wood is there, so no leaf hangs in the air.
"""

from dataclasses import replace

import numpy as np
from jaxtyping import Float

from sketchtree.asset import Morph
from sketchtree.foliage.leaves import Leaves
from sketchtree.geometry.mesh import Mesh
from sketchtree.growth.age import WHOLE
from sketchtree.growth.leafing import UNFOLDS, unfolded
from sketchtree.rig.leaf_rows import leaf_rows

COHORTS = 16
_STEPS = np.array([0.0, 0.15, 0.35, 0.6, 1.0])  # of the time in which a leaf unfolds: where its size has a key


def cohorts(mesh: Mesh, leaves: Leaves, end: Float[np.ndarray, " segment"], first_part: int, seconds: float, count: int = COHORTS) -> list[tuple[Mesh, Morph]]:
    """The mesh of these leaves in parts named `<name>_1` … as they unfold. `end`: when each row of the skeleton has its length, 0-1."""
    leaf = leaf_rows(mesh, leaves).leaf
    back = leaves.position[leaf] - mesh.position
    when = end[leaves.segment]
    bins = np.minimum((when / WHOLE * count).astype(int), count - 1)
    found = []
    for number in np.unique(bins):
        piece, rows = _only(mesh, bins[leaf] == number)
        starts = min(float(when[bins == number].max()), WHOLE)
        moment = starts + UNFOLDS * _STEPS
        size = unfolded_at(moment, starts)
        time, weight = np.r_[0.0, moment * seconds], np.r_[1.0, 1.0 - size]
        if time[1] <= time[0]:
            time, weight = time[1:], weight[1:]
        name = f"{mesh.name}_{len(found) + 1}"
        found.append((replace(piece, name=name), Morph(first_part + len(found), back[rows].astype(np.float32), time, weight)))
    return found


def unfolded_at(moment, end: float):
    """The size of leaves whose wood was there at `end`, at several times."""
    return np.array([float(unfolded(now, np.array([end]))[0]) for now in moment])


def _only(mesh: Mesh, keep):
    """The triangles whose vertices are kept, and which vertices those are."""
    rows = np.flatnonzero(keep)
    number = np.zeros(len(keep), np.int64)
    number[rows] = np.arange(len(rows))
    triangle = number[mesh.triangle[keep[mesh.triangle[:, 0]]]]
    color = None if mesh.color is None else mesh.color[rows]
    extra = {name: column[rows] for name, column in mesh.extra.items()}
    return replace(mesh, position=mesh.position[rows], normal=mesh.normal[rows], uv=mesh.uv[rows], triangle=triangle, color=color, extra=extra), rows
