"""Where does the trunk end? Its contour between pixels, as polygons (Algorithm 1, line 1: the input polygon P with n vertices).

Marching squares at alpha ½ (Lorensen & Cline 1987 in two dimensions; scikit-image), two vertices a pixel at most. Pixels, x right, y DOWN. The trunk lies on the left of every ring as it is seen in the mathematical
frame x, y: the outer ring has positive area ½ Σ (x_i y_{i+1} − x_{i+1} y_i), a hole's a negative one.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float
from skimage.measure import find_contours

from sketchtree.trunk.binary import HALF, Binary


@dataclass(frozen=True, eq=False)
class Outline:
    """The contour of a trunk: one polygon a piece, and the holes in them. Rings are closed; the first point is not repeated."""

    polygons: tuple[Float[np.ndarray, "point 2"], ...]
    holes: tuple[Float[np.ndarray, "point 2"], ...] = ()

    @property
    def rings(self) -> tuple[Float[np.ndarray, "point 2"], ...]:
        """All rings, the outer ones first."""
        return self.polygons + self.holes

    @property
    def length(self) -> float:
        """Length of all rings, pixels."""
        return sum(float(np.hypot(*(np.roll(ring, -1, axis=0) - ring).T).sum()) for ring in self.rings)


def outline(binary: Binary) -> Outline:
    """The contour of the piece."""
    rings = [_ring(line) for line in find_contours(binary.level, HALF, fully_connected="high")]
    rings = [ring for ring in rings if len(ring) >= 3]
    areas = [signed_area(ring) for ring in rings]
    outer = int(np.argmax(np.abs(areas)))
    rings = rings if areas[outer] > 0 else [ring[::-1].copy() for ring in rings]
    return Outline((rings[outer],), tuple(ring for k, ring in enumerate(rings) if k != outer))


def _ring(line) -> Float[np.ndarray, "point 2"]:
    """Rows and columns of the padded picture → x, y of the picture; points at the same place once."""
    points = line[:-1, ::-1] - 0.5
    far = np.hypot(*(points - np.roll(points, 1, axis=0)).T) > 1e-6
    return np.ascontiguousarray(points[far])


def signed_area(ring: Float[np.ndarray, "point 2"]) -> float:
    """½ Σ (x_i y_{i+1} − x_{i+1} y_i)."""
    onward = np.roll(ring, -1, axis=0)
    return 0.5 * float(np.sum(ring[:, 0] * onward[:, 1] - onward[:, 0] * ring[:, 1]))
