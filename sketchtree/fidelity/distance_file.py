"""How far is each point of a scan from the tree that was made of it? A PLY file that any viewer of clouds opens: the points, coloured, and the distance as a number of each.

It lies over the tree's own mesh: metres, y up, the foot at the origin.
"""

import os
from collections.abc import Sequence

from sketchtree.clouds.cloud import PointCloud
from sketchtree.clouds.files.write_cloud import write_cloud
from sketchtree.fidelity.scan_distance import Distances, coloured, scan_to_mesh
from sketchtree.geometry.mesh import Mesh

RED = 0.015
"""Of the height: a point so far off, or farther, is red."""


def write_distances(cloud: PointCloud, meshes: Sequence[Mesh], path: str | os.PathLike) -> Distances:
    """Write the points of a cloud with their distances from surfaces; the distances. Raises ExportError for another extension than .ply or a place that can't be written."""
    found = scan_to_mesh(cloud.xyz, meshes)
    most = RED * found.height
    told = f"distance: metres from the tree; blue 0, yellow {most / 2:.4g}, red {most:.4g} and more; mean {found.mean:.4g}, {found.share:.3%} of the height"
    write_cloud(PointCloud(cloud.xyz, coloured(found.metres, most) / 255.0, cloud.normal), path, (told,), {"distance": found.metres})
    return found
