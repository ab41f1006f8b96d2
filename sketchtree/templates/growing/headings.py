"""Where does a shoot point next? Small rotations of unit vectors.

    turn        Rodrigues' rotation of v about a unit axis
    towards     v turned towards another vector, never past it
    tropism     v turned towards +y (or −y)
    level_off   v turned towards an elevation, in its own vertical plane
    side        a horizontal unit vector perpendicular to v: azimuth 0 of its laterals
    lateral     the direction at divergence φ and azimuth ϕ about a limb

One shoot at a time, so vectors are plain triples of floats (a numpy array of three costs ten times as much).
"""

from math import atan2, cos, hypot, pi, sin, sqrt

Vector = tuple[float, float, float]  # x right, y up, z towards the viewer

UP: Vector = (0.0, 1.0, 0.0)
DOWN: Vector = (0.0, -1.0, 0.0)


def along(a: Vector, step: float, v: Vector) -> Vector:
    """a + step · v."""
    return (a[0] + step * v[0], a[1] + step * v[1], a[2] + step * v[2])


def unit(v: Vector) -> Vector:
    """v / |v|."""
    size = sqrt(dot(v, v))
    return (v[0] / size, v[1] / size, v[2] / size)


def dot(a: Vector, b: Vector) -> float:
    """a · b."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a: Vector, b: Vector) -> Vector:
    """a × b."""
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def turn(v: Vector, axis: Vector, angle: float) -> Vector:
    """`v` rotated about the unit `axis` by `angle` (radians, right-handed)."""
    c, s = cos(angle), sin(angle)
    level = (1.0 - c) * dot(v, axis)
    return along(along((v[0] * c, v[1] * c, v[2] * c), s, cross(axis, v)), level, axis)


def side(v: Vector) -> Vector:
    """A horizontal unit vector perpendicular to `v`; +x where `v` is vertical."""
    size = hypot(v[0], v[2])
    return (v[2] / size, 0.0, -v[0] / size) if size > 1e-6 else (1.0, 0.0, 0.0)


def lateral(v: Vector, divergence: float, azimuth: float) -> Vector:
    """The direction `divergence` away from `v`, `azimuth` about it, counted from `side(v)`. Radians."""
    return turn(turn(v, cross(v, side(v)), divergence), v, azimuth)


def bend(v: Vector, angle: float, azimuth: float) -> Vector:
    """`v` turned by `angle` about the axis across it at `azimuth`."""
    return unit(turn(v, lateral(v, pi / 2, azimuth), angle))


def towards(v: Vector, goal: Vector, angle: float) -> Vector:
    """`v` turned by `angle` (radians, ≥ 0) towards the unit vector `goal`, never past it."""
    axis = cross(v, goal)
    size = sqrt(dot(axis, axis))
    if size < 1e-9:
        return v
    apart = atan2(size, dot(v, goal))
    return turn(v, unit(axis), min(angle, apart))


def tropism(v: Vector, angle: float) -> Vector:
    """`v` turned by |angle| radians towards +y (angle > 0) or −y (angle < 0), never past it."""
    return towards(v, UP if angle > 0 else DOWN, abs(angle))


def level_off(v: Vector, elevation: float, angle: float) -> Vector:
    """`v` turned by |angle| in its own vertical plane towards the elevation (radians), never past it."""
    across = side(v)
    out = (-across[2], 0.0, across[0])  # level, the way `v` points
    goal = along((cos(elevation) * out[0], 0.0, cos(elevation) * out[2]), sin(elevation), UP)
    return towards(v, goal, abs(angle))
