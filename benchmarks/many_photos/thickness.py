"""Are limbs as thick in a cloud as they are? Distances of its points from the true axes, over the true radii, by how many pixels wide a limb is in the photos.

A point belongs to the limb whose surface it is nearest to, and to none if it is farther than `REACH` pixels from all. 1 is right; points of a twig that the depth
along the ray scatters make it several times too thick.
"""

from pathlib import Path
from typing import NamedTuple

import numpy as np
from jaxtyping import Float
from scipy.spatial import cKDTree

from sketchtree.export.gltf import read_glb, read_glb_skeleton
from sketchtree.view.picture import footing

WIDTHS = (0.0, 1.5, 3.0, 6.0, 12.0, np.inf)  # pixels: limits of the classes
REACH = 8.0  # pixels
_NEIGHBOURS = 16


class Axes(NamedTuple):
    """Places along all limbs of a tree."""

    xyz: Float[np.ndarray, "place 3"]
    radius: Float[np.ndarray, " place"]


def axes_of(glb: Path, step: float) -> Axes:
    """Of a GLB of ours that holds its skeleton, in the frame of its renders; `step`: metres between places."""
    tree = read_glb_skeleton(glb)
    shift = footing(np.vstack([mesh.position[np.unique(mesh.triangle)] for mesh in read_glb(glb) if len(mesh.triangle)]))
    wood = np.flatnonzero(~tree.is_base)
    count = np.maximum(np.ceil(tree.length[wood] / step).astype(int), 1)
    row, share = np.repeat(wood, count), np.concatenate([(np.arange(n) + 0.5) / n for n in count])
    start, first = tree.start[row], np.where(tree.is_base[tree.parent[row]], tree.radius[row], tree.radius[tree.parent[row]])
    return Axes(start + share[:, None] * (tree.tip[row] - start) - shift, np.minimum(first, 1.5 * tree.radius[row]) * (1 - share) + tree.radius[row] * share)


def thickness(cloud: Float[np.ndarray, "point 3"], axes: Axes, pixel: float, lowest: float = 0.0) -> dict[str, tuple[int, float, float]]:
    """By class of width in pixels: (how many points, median and 90 % quantile of distance over radius)."""
    cloud = cloud[cloud[:, 1] > lowest]
    away, row = cKDTree(axes.xyz).query(cloud, k=_NEIGHBOURS)
    best = np.argmin(np.abs(away - axes.radius[row]), axis=1)
    away, radius = away[np.arange(len(cloud)), best], axes.radius[row[np.arange(len(cloud)), best]]
    near, wide = away - radius < REACH * pixel, 2 * radius / pixel
    found = {}
    for low, high in zip(WIDTHS, WIDTHS[1:], strict=False):
        own = near & (wide >= low) & (wide < high)
        if own.sum() >= 50:
            found[f"{low:g}-{high:g} px"] = (int(own.sum()), float(np.median(away[own] / radius[own])), float(np.quantile(away[own] / radius[own], 0.9)))
    return found
