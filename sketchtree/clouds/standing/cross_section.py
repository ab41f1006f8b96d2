"""How thick is the trunk at the root, by one closed curve round it (Guo et al. 2018, §5.3)?

    1. a plane perpendicular to the stem's axis at the root
    2. the points near it are projected on it
    3. a B-spline is fitted to them, closed; it gives the diameter d_root

Points are put in order by their direction from the middle; of those in the same direction (of 32) the median is taken, so that a few stray ones do no harm, and the spline passes the
medians as closely as their scatter asks. Its diameter is that of the circle of the same area: a choice of ours, the paper names none. A trunk that was seen from one side only has no
closed curve: the spline bridges the far side as it can, and the trunk comes out too thin; `trunk` is for that.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float
from scipy.interpolate import splev, splprep

from sketchtree.clouds.tracing.circles import circles

_DIRECTIONS = 32
_ALONG = 400  # points of the curve
_FEWEST = 5  # directions: fewer make no closed cubic
_NEAR, _FAR = 0.4, 1.8  # times the typical distance from the middle: other points are of something else


@dataclass(frozen=True, eq=False)
class CrossSection:
    """A closed curve round points of a plane."""

    curve: Float[np.ndarray, "along 2"]  # metres
    diameter: float  # of the circle of the same area, metres
    seen: float  # share of the directions that had points


def cross_section(plane: Float[np.ndarray, "point 2"]) -> CrossSection | None:
    """The closed B-spline round points of a cross-sectional plane; None where they are too few, or all on one side."""
    if len(plane) < _FEWEST:
        return None
    found = circles(plane[None], np.ones((1, len(plane)), bool))
    away = plane - found.centre[0]
    turn, far = np.arctan2(away[:, 1], away[:, 0]), np.linalg.norm(away, axis=1)
    kept = (far >= _NEAR * np.median(far)) & (far <= _FAR * np.median(far))
    sector = np.floor((turn / (2 * np.pi) + 0.5) * _DIRECTIONS).astype(int) % _DIRECTIONS
    seen = [k for k in range(_DIRECTIONS) if (kept & (sector == k)).any()]
    if len(seen) < _FEWEST:
        return None
    middle = np.array([(np.median(turn[kept & (sector == k)]), np.median(far[kept & (sector == k)])) for k in seen])
    ring = found.centre[0] + middle[:, 1:] * np.c_[np.cos(middle[:, 0]), np.sin(middle[:, 0])]
    off = np.concatenate([far[kept & (sector == k)] - value for k, value in zip(seen, middle[:, 1], strict=True)])
    scatter = len(ring) * 1.57 * (1.4826 * float(np.median(np.abs(off)))) ** 2 * len(seen) / kept.sum()  # of medians
    curve = np.stack(splev(np.linspace(0, 1, _ALONG, endpoint=False), splprep(np.vstack([ring, ring[:1]]).T, s=scatter, per=True)[0]), axis=1)
    x, z = curve.T
    area = 0.5 * abs(float(np.dot(x, np.roll(z, -1)) - np.dot(z, np.roll(x, -1))))
    return CrossSection(curve, 2.0 * float(np.sqrt(area / np.pi)), len(seen) / _DIRECTIONS)


def plane_points(xyz: Float[np.ndarray, "point 3"], origin: Float[np.ndarray, "3"], axis: Float[np.ndarray, "3"], thick: float) -> Float[np.ndarray, "near 2"]:
    """The points within half of `thick` of the plane through `origin` perpendicular to the axis, projected on it."""
    axis = axis / np.linalg.norm(axis)
    one, other = across(axis)
    away = xyz - origin
    near = np.abs(away @ axis) <= thick / 2
    return np.stack([away[near] @ one, away[near] @ other], axis=1)


def across(axis: Float[np.ndarray, "3"]) -> tuple[Float[np.ndarray, "3"], Float[np.ndarray, "3"]]:
    """Two unit vectors across a unit axis."""
    one = np.cross(axis, [0.31, 0.2, 0.93])
    one /= np.linalg.norm(one)
    return one, np.cross(axis, one)
