"""What if limbs that have nothing to do with each other are one surface?

Where limbs touch, a mesh in one piece joins them. A triangle between them would become a web as they grow apart, so it goes with the limb that most
of its vertices are on: it gets vertices of its own there, at the same places.
"""

from dataclasses import replace

import numpy as np

from sketchtree.geometry.limbs import CentreLines
from sketchtree.geometry.mesh import Mesh
from sketchtree.rig.boughs import Boughs
from sketchtree.rig.islands import foreign_edges
from sketchtree.rig.place import Places, places_on


def parted(mesh: Mesh, lines: CentreLines, limbs: Boughs, place: Places) -> tuple[Mesh, Places]:
    """The mesh without triangles between limbs that don't grow from each other, and the places of its vertices."""
    corner = mesh.triangle
    torn = np.flatnonzero(foreign_edges(lines, limbs, place, corner.ravel(), np.roll(corner, -1, axis=1).ravel()).reshape(-1, 3).any(axis=1))
    if not len(torn):
        return mesh, place
    limb = place.limb[corner[torn]]
    own = np.where(limb[:, 1] == limb[:, 2], limb[:, 1], limb[:, 0])
    rows, side = np.nonzero(limb != own[:, None])
    old = corner[torn[rows], side]
    pair, new = np.unique(np.column_stack([old, own[rows]]), axis=0, return_inverse=True)
    triangle = corner.copy()
    triangle[torn[rows], side] = len(mesh.position) + new.ravel()
    found = places_on(lines, pair[:, 1], mesh.position[pair[:, 0]])
    more = {name: np.concatenate([column, column[pair[:, 0]]]) for name in ("position", "normal", "uv", "color") if (column := getattr(mesh, name)) is not None}
    extra = {name: np.concatenate([column, column[pair[:, 0]]]) for name, column in mesh.extra.items()}
    return replace(mesh, triangle=triangle, extra=extra, **more), Places(np.r_[place.limb, found.limb], np.r_[place.s, found.s])

