"""Which pixels probably show one surface, and on which plane does it lie? The segments of Guo et al. 2018, Eq. 2, and their planes d_Ω.

Segments are the modes of colour and place that mean shift climbs to. They are found by quick shift (Vedaldi & Soatto 2008), which climbs the same density from
pixel to pixel. A segment's plane is fitted to the inverse depths of its pixels, counted by how well they match, three times, those far off counting less each
time. A segment of few pixels that match has none.
"""

import numpy as np
from jaxtyping import Bool, Float, Int
from skimage.color import rgb2lab
from skimage.segmentation import quickshift

LEAST = 12  # pixels that match, for a plane
MATCHES = 0.5  # energy under which a pixel tells something
OFF = 0.004  # of the range sought: so far off the plane counts half


def segments_of(rgb: Float[np.ndarray, "row column 3"], used: Bool[np.ndarray, "row column"]) -> Int[np.ndarray, "row column"]:
    """A number for every segment; pixels that are not used have −1."""
    label = quickshift(rgb2lab(rgb), kernel_size=2, max_dist=8, ratio=0.6, convert2lab=False, rng=0)
    return np.where(used, label, -1)


def planes_of(
    label: Int[np.ndarray, "row column"], plane: Float[np.ndarray, "row column 3"], energy: Float[np.ndarray, "row column"], low: float, high: float
) -> Float[np.ndarray, "row column 3"]:
    """(ρ, ∂ρ/∂x, ∂ρ/∂y) of its segment's plane at every pixel; 0 where there is none."""
    found = np.zeros_like(plane)
    y, x = np.nonzero((label >= 0) & (energy < MATCHES))
    if not len(y):
        return found
    which, count = label[y, x], int(label.max()) + 1
    size = np.maximum(np.bincount(which, minlength=count), 1)
    middle = np.stack([np.bincount(which, at, count) / size for at in (x, y)], axis=1)
    design = np.stack([np.ones(len(x)), x - middle[which, 0], y - middle[which, 1]], axis=1)
    rho, trust = plane[y, x, 0].astype(np.float64), 1.0 - energy[y, x].astype(np.float64)
    weight, fit = trust, np.zeros((count, 3))
    for _ in range(3):
        square = np.stack([[np.bincount(which, weight * design[:, i] * design[:, j], count) for j in range(3)] for i in range(3)]).transpose(2, 0, 1)
        right = np.stack([np.bincount(which, weight * design[:, i] * rho, count) for i in range(3)], axis=1)
        fit = np.linalg.solve(square + np.diag([1e-9, 1e-3, 1e-3]), right[..., None])[..., 0]
        weight = trust / (1.0 + (((design * fit[which]).sum(axis=1) - rho) / (OFF * (high - low))) ** 2)
    enough = np.bincount(which, weight, count) >= 0.25 * LEAST
    enough &= size >= LEAST
    rows, columns = np.nonzero((label >= 0) & enough[np.maximum(label, 0)])
    own = label[rows, columns]
    there = fit[own, 0] + fit[own, 1] * (columns - middle[own, 0]) + fit[own, 2] * (rows - middle[own, 1])
    inside = (there > low) & (there < high)
    found[rows[inside], columns[inside]] = np.column_stack([there, fit[own, 1], fit[own, 2]])[inside]
    return found
