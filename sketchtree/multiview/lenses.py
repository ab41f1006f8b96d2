"""Where does a lens put what a camera without one would put here? And the picture as such a camera sees it.

Brown's model with a quotient (OpenCV's, all of COLMAP's models without fisheye are cases of it), on (x, y) = K⁻¹ pixel, r² = x² + y²:

    q = (1 + k₁r² + k₂r⁴ + k₃r⁶) / (1 + k₄r² + k₅r⁴ + k₆r⁶)      x′ = q x + 2 p₁ x y + p₂ (r² + 2x²)      y′ = q y + p₁ (r² + 2y²) + 2 p₂ x y

and of a fisheye, θ = atan r:   θ′ = θ (1 + k₁θ² + k₂θ⁴ + k₃θ⁶ + k₄θ⁸),   (x′, y′) = θ′ / r · (x, y).
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Float
from scipy.ndimage import map_coordinates

from sketchtree.multiview.cameras import Camera


@dataclass(frozen=True)
class Lens:
    """One lens; the default bends nothing."""

    radial: tuple[float, ...] = ()  # k₁ …; of a fisheye four at most, else six
    tangential: tuple[float, float] = (0.0, 0.0)  # p₁, p₂
    fisheye: bool = False

    @property
    def bends(self) -> bool:
        """Whether it does anything."""
        return self.fisheye or any(self.radial) or any(self.tangential)

    def distort(self, xy: Float[np.ndarray, "point 2"]) -> Float[np.ndarray, "point 2"]:
        """Where the lens puts what would be at `xy` (in focal lengths from the principal point)."""
        square = (xy**2).sum(axis=1)
        if self.fisheye:
            radius = np.sqrt(square)
            theta = np.arctan(radius)
            bent = theta * (1.0 + sum(k * theta ** (2 * n) for n, k in enumerate(self.radial, 1)))
            return xy * np.where(radius > 1e-9, bent / np.maximum(radius, 1e-9), 1.0)[:, None]
        k = tuple(self.radial) + (0.0,) * (6 - len(self.radial))
        quotient = (1.0 + square * (k[0] + square * (k[1] + square * k[2]))) / (1.0 + square * (k[3] + square * (k[4] + square * k[5])))
        p, q = self.tangential
        both = 2.0 * xy[:, 0] * xy[:, 1]
        shift = np.column_stack([p * both + q * (square + 2.0 * xy[:, 0] ** 2), p * (square + 2.0 * xy[:, 1] ** 2) + q * both])
        return xy * quotient[:, None] + shift


def undistorted(
    rgb: Float[np.ndarray, "row column channel"], camera: Camera, lens: Lens
) -> tuple[Float[np.ndarray, "row column channel"], Bool[np.ndarray, "row column"]]:
    """(the picture as `camera` would take it without the lens; which of its pixels the photo shows)."""
    height, width = rgb.shape[:2]
    if not lens.bends:
        return rgb, np.ones((height, width), bool)
    focal, middle = camera.matrix[[0, 1], [0, 1]], camera.matrix[:2, 2]
    from_pixel = (lens.distort((camera.pixels() - middle) / focal) * focal + middle - 0.5)[:, ::-1].T
    seen = ((from_pixel > -0.5) & (from_pixel < np.array([[height - 0.5], [width - 0.5]]))).all(axis=0).reshape(height, width)
    channels = [map_coordinates(rgb[..., k], from_pixel, order=1, mode="nearest").reshape(height, width) for k in range(rgb.shape[2])]
    return np.stack(channels, axis=2).astype(rgb.dtype), seen
