"""What is the outline of a crown? The footprint descriptor.

Chen et al. 2008, §7: the convex hull of crown and branch strokes without the root branch is scaled so
that max(w, h) = 1; from the centre C of its bounding rectangle the radial distance to the curve is taken in
K_f regularly sampled directions, giving the vector f.

    K_f = 64 directions, counter-clockwise from +x        V = 36 azimuths at 0° elevation

The root branch is the stem from its base to its first lateral: segments from which everything hangs.
"""

import numpy as np
from jaxtyping import Bool, Float, Int
from scipy.spatial import ConvexHull, QhullError

from sketchtree.axes import NULL
from sketchtree.traverse import child_count

DIRECTIONS = 64  # K_f
VIEWS = 36  # V


def view_azimuths() -> Float[np.ndarray, " view"]:
    """Azimuths of the views, degrees: 0, 10, … 350. At azimuth v the camera stands at (sin v, 0, cos v)."""
    return np.arange(VIEWS) * (360.0 / VIEWS)


def project(point: Float[np.ndarray, "point 3"], azimuth_deg: float) -> Float[np.ndarray, "point 2"]:
    """Orthographic view of world points: x to the camera's right, y up."""
    v = np.radians(azimuth_deg)
    return np.stack([point[:, 0] * np.cos(v) - point[:, 2] * np.sin(v), point[:, 1]], axis=1)


def footprint(point: Float[np.ndarray, "point 2"]) -> Float[np.ndarray, " direction"]:
    """f of the convex hull of `point`. A hull without area (one stroke) gives the distances of its line."""
    low, high = point.min(axis=0), point.max(axis=0)
    size = float((high - low).max())
    if size <= 0:
        return np.zeros(DIRECTIONS)
    normal, offset = _half_planes((point - (low + high) / 2) / size)
    angle = 2 * np.pi * np.arange(DIRECTIONS) / DIRECTIONS
    toward = normal @ np.stack([np.cos(angle), np.sin(angle)])  # n · d, (edge, direction)
    with np.errstate(divide="ignore", invalid="ignore"):
        distance = np.where(toward > 1e-12, offset[:, None] / toward, np.inf)
    return np.minimum(np.maximum(distance.min(axis=0), 0.0), 1.0)


def _half_planes(point):
    """The hull as n · x ≤ c, C its origin: normals (edge, 2) and offsets (edge)."""
    try:
        equations = ConvexHull(point).equations
    except QhullError:  # all on one line
        equations = ConvexHull(_thicken(point)).equations
    return equations[:, :2], -equations[:, 2]


def _thicken(point, half: float = 1e-4):
    far = point[[np.argmin(point @ (1.0, 1e-3)), np.argmax(point @ (1.0, 1e-3))]]
    if np.ptp(point[:, 1]) > np.ptp(point[:, 0]):
        far = point[[np.argmin(point[:, 1]), np.argmax(point[:, 1])]]
    along = far[1] - far[0]
    across = half * np.array([-along[1], along[0]]) / np.hypot(*along)
    return np.concatenate([far + across, far - across])


def root_branch(parent: Int[np.ndarray, " segment"]) -> Bool[np.ndarray, " segment"]:
    """Rows of the root branch: bases, and the rows of a stem up to and with the first that branches.
    A stem that never branches is no root branch but its last row stays: it is all there is."""
    count = child_count(parent)
    root = parent == NULL
    for row, above in enumerate(parent.tolist()):
        if above != NULL:
            root[row] = root[above] and count[above] == 1 and count[row] > 0
    return root


def crown_points(start, tip, parent) -> Float[np.ndarray, "point axis"]:
    """Ends of all segments but the root branch's, in 2D or 3D; all points where nothing else is there."""
    keep = ~root_branch(parent)
    return np.concatenate([start[keep], tip[keep]]) if keep.any() else tip
