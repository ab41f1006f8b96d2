"""How far do a tree's surfaces lie from the points of a scan, and the points from the surfaces?

    scan → mesh     for each point the distance to the nearest spot of a surface, exact                 what was seen and is not there
    mesh → scan     for places spread evenly over the surfaces the distance to the nearest point         what is there and was not seen
    vertex → scan   the same for the mesh's vertices                                                     Guo et al. 2018 §6.2, Figure 14; hangs on how the mesh is cut

All are metres; `share` is the mean over the height of the scan.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from jaxtyping import Array, Float, Int, Key
from scipy.spatial import cKDTree

from sketchtree.fidelity.distance_colours import ramp
from sketchtree.fidelity.sampled import joined_triangles, over
from sketchtree.geometry.mesh import Mesh

PLACES = 200_000


@dataclass(frozen=True, eq=False)
class Distances:
    """Distances of many places."""

    metres: Float[np.ndarray, " place"]
    height: float  # of the scan, metres

    @property
    def mean(self) -> float:
        """Metres."""
        return float(self.metres.mean())

    @property
    def sd(self) -> float:
        """Standard deviation, metres."""
        return float(self.metres.std())

    @property
    def share(self) -> float:
        """The mean over the height."""
        return self.mean / self.height

    def within(self, share: float) -> float:
        """How many of the places lie no farther off than that share of the height, 0-1."""
        return float(np.mean(self.metres <= share * self.height))


def scan_to_mesh(scan: Float[np.ndarray, "point 3"], meshes: Sequence[Mesh]) -> Distances:
    """Of every point of a scan to the nearest surface."""
    import pyvista

    position, triangle = joined_triangles(meshes)
    surface = pyvista.PolyData.from_regular_faces(position, triangle)
    _, nearest = surface.find_closest_cell(np.asarray(scan, float), return_closest_point=True)
    return Distances(np.linalg.norm(scan - nearest, axis=1), float(np.ptp(scan[:, 1])))


def mesh_to_scan(meshes: Sequence[Mesh], scan: Float[np.ndarray, "point 3"], *, key: Key[Array, ""], places: int = PLACES) -> Distances:
    """Of places all over the surfaces to the nearest point of a scan."""
    return Distances(cKDTree(scan).query(over(meshes, places, key=key))[0], float(np.ptp(scan[:, 1])))


def vertices_to_scan(meshes: Sequence[Mesh], scan: Float[np.ndarray, "point 3"]) -> Distances:
    """Of the surfaces' vertices to the nearest point of a scan, mesh after mesh: `coloured` draws it."""
    position, _ = joined_triangles(meshes)
    return Distances(cKDTree(scan).query(position)[0], float(np.ptp(scan[:, 1])))


def coloured(distance: Float[np.ndarray, " place"], most: float) -> Int[np.ndarray, "place 3"]:
    """sRGB colours, 0-255, from blue (0) through yellow to red (`most` metres and more), even steps for the eye."""
    return np.round(255 * ramp(np.asarray(distance) / most)).astype(np.int64)
