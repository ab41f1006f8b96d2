"""Where does a shoot point next? Small rotations of unit vectors.

    turn        Rodrigues' rotation of v about a unit axis
    tropism     v turned towards +y (or −y), never past it
    side        a horizontal unit vector perpendicular to v: azimuth 0 of its laterals
    lateral     the direction at divergence φ and azimuth ϕ about a limb
"""

import numpy as np
from jaxtyping import Float

UP = np.array([0.0, 1.0, 0.0])


def unit(v: Float[np.ndarray, " 3"]) -> Float[np.ndarray, " 3"]:
    """v / |v|."""
    return v / np.sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2])


def turn(v, axis, angle: float) -> Float[np.ndarray, " 3"]:
    """`v` rotated about the unit `axis` by `angle` (radians, right-handed)."""
    c, s = np.cos(angle), np.sin(angle)
    dot = v[0] * axis[0] + v[1] * axis[1] + v[2] * axis[2]
    return v * c + cross(axis, v) * s + axis * (dot * (1.0 - c))


def cross(a, b) -> Float[np.ndarray, " 3"]:
    """a × b."""
    return np.array([a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]])


def side(v) -> Float[np.ndarray, " 3"]:
    """A horizontal unit vector perpendicular to `v`; +x where `v` is vertical."""
    s = np.array([v[2], 0.0, -v[0]])
    norm = np.hypot(s[0], s[2])
    return s / norm if norm > 1e-6 else np.array([1.0, 0.0, 0.0])


def lateral(v, divergence: float, azimuth: float) -> Float[np.ndarray, " 3"]:
    """The direction `divergence` away from `v`, `azimuth` about it, counted from `side(v)`. Radians."""
    return turn(turn(v, cross(v, side(v)), divergence), v, azimuth)


def tropism(v, angle: float) -> Float[np.ndarray, " 3"]:
    """`v` turned by |angle| radians towards +y (angle > 0) or −y (angle < 0), never past it."""
    goal = UP if angle > 0 else -UP
    axis = cross(v, goal)
    size = np.sqrt(np.sum(axis * axis))
    if size < 1e-9:
        return v
    apart = np.arctan2(size, float(v[1] * goal[1]))
    return turn(v, axis / size, min(abs(angle), apart))
