"""How far off is a coarser tree, and from how far away does that not show?

Seen from the side, the outlines of two trees differ by the pixels that only one of them covers. Along the outline of the full tree, that is a mean displacement

    e = #(full ⊕ coarse) / #(outline of full) · p        p: metres a pixel

(the outline: covered pixels with an uncovered neighbour, holes between leaves included), averaged over sides. A tree of height H that fills a share c of a screen of P
rows shows it as e c P / H pixels. So a level whose next coarser one is off by e serves while the tree fills at least

    c = τ H / (e P)        τ: the error that is allowed, pixels
"""

from collections.abc import Sequence

import numpy as np
from jaxtyping import Bool
from scipy import ndimage

from sketchtree.geometry.mesh import Mesh
from sketchtree.levels.raster import View

ROWS = 1080  # P, of the screen that coverages are reckoned for


def views_round(meshes: Sequence[Mesh], sides: int, pixels: int) -> tuple[View, ...]:
    """Parallel views of the whole tree from `sides` azimuths, evenly round it, the drawing's view first."""
    point = np.vstack([mesh.position[np.unique(mesh.triangle)] for mesh in meshes] or [np.zeros((0, 3))])
    if len(point) == 0:
        return ()
    low, high = point.min(axis=0), point.max(axis=0)
    centre = 0.5 * (low + high)
    across = float(np.hypot(point[:, 0] - centre[0], point[:, 2] - centre[2]).max())
    half = 1.02 * max(across, 0.5 * float(high[1] - low[1]), 1e-6)
    return tuple(View.round(2.0 * np.pi * k / sides, centre, half, pixels) for k in range(sides))


def overlap(full: Bool[np.ndarray, "row column"], coarse: Bool[np.ndarray, "row column"]) -> float:
    """Intersection over union of two silhouettes; 1 where both are empty."""
    union = int((full | coarse).sum())
    return float((full & coarse).sum() / union) if union else 1.0


def displacement(full: Bool[np.ndarray, "row column"], coarse: Bool[np.ndarray, "row column"], view: View) -> float:
    """e, metres, from one side."""
    rim = full & ~ndimage.binary_erosion(full)
    return float((full ^ coarse).sum()) / max(int(rim.sum()), 1) * 2.0 * view.half / view.pixels


def coverage(error: float, height: float, pixel_error: float) -> float:
    """c, at most 1: from how much of the screen's height downwards an outline `error` metres off is fine."""
    return float(min(pixel_error * height / max(error * ROWS, 1e-12), 1.0))
