"""What shape is a leaf's edge?

Blade coordinates: the petiole joins at (0, 0), the tip lies at (0, 1), x runs across to the right.
A half outline runs from the joint to the tip along the right margin; the left one mirrors it. Teeth are
a sawtooth along the margin's normal, leaning towards the tip:

    margin(s) + d(s) [n(s) cos λ + t(s) sin λ]

    s   arc length along the margin     t, n   its tangent and outward normal
    d   depth of the sawtooth at s      λ      how far the teeth lean forward
"""

import numpy as np
from jaxtyping import Float
from scipy import ndimage

Curve = Float[np.ndarray, "_ 2"]  # points x, y; one curve need not be as long as another
Places = list[tuple[float | int, float | int]]

_LEAN = np.radians(50.0)


def smooth(points: Places, samples: int = 24) -> Curve:
    """A half outline through the points: a centripetal Catmull-Rom spline (no loops at tight lobes)."""
    knots = np.asarray(points, float)
    padded = np.vstack([2 * knots[0] - knots[1], knots, 2 * knots[-1] - knots[-2]])
    p0, p1, p2, p3 = padded[:-3], padded[1:-2], padded[2:-1], padded[3:]
    d1, d2, d3 = (np.linalg.norm(b - a, axis=1)[:, None, None] ** 0.5 for a, b in ((p0, p1), (p1, p2), (p2, p3)))
    p0, p1, p2, p3 = (p[:, None] for p in (p0, p1, p2, p3))
    m1 = (p2 - p1) + d2 * ((p1 - p0) / d1 - (p2 - p0) / (d1 + d2))
    m2 = (p2 - p1) + d2 * ((p3 - p2) / d3 - (p3 - p1) / (d2 + d3))
    t = np.linspace(0, 1, samples, endpoint=False)[None, :, None]
    curve = (2 * t**3 - 3 * t**2 + 1) * p1 + (t**3 - 2 * t**2 + t) * m1 + (3 * t**2 - 2 * t**3) * p2 + (t**3 - t**2) * m2
    return np.vstack([curve.reshape(-1, 2), knots[-1]])


def rounded(points: Places, radius: float) -> Curve:
    """A half outline along the points with every corner rounded off at about `radius` (blade lengths)."""
    knots = np.asarray(points, float)
    arc = np.r_[0, np.cumsum(np.linalg.norm(np.diff(knots, axis=0), axis=1))]
    step = radius / 6
    s = np.linspace(0, arc[-1], int(arc[-1] / step))
    line = np.stack([np.interp(s, arc, knots[:, axis]) for axis in (0, 1)], axis=1)
    around = np.vstack([(line * [-1, 1])[::-1][:-1], line, (line * [-1, 1])[::-1][1:]])
    curve = ndimage.gaussian_filter1d(around, 6.0, axis=0)[len(line) - 1 : 2 * len(line) - 1]
    curve[[0, -1], 0] = 0.0
    return curve


def pointed(points: Places, sag: float, samples: int = 10) -> Curve:
    """A half outline with a sharp corner at every point and a hollow of depth `sag` (of the chord) between."""
    knots = np.asarray(points, float)
    chord = np.diff(knots, axis=0)
    inward = np.stack([-chord[:, 1], chord[:, 0]], axis=1)
    t = np.linspace(0, 1, samples, endpoint=False)[None, :, None]
    curve = knots[:-1, None] + t * chord[:, None] + 4 * sag * t * (1 - t) * inward[:, None]
    return np.vstack([curve.reshape(-1, 2), knots[-1]])


def serrate(half: Curve, teeth: int, depth: float, *, double: float = 0.0, phase: float = 0.0) -> Curve:
    """The half outline with `teeth` teeth of the given depth (blade lengths); `double` is the share of
    depth given to three smaller teeth on each."""
    step = np.linalg.norm(np.diff(half, axis=0), axis=1)
    arc = np.r_[0, np.cumsum(step)] / step.sum()
    s = np.linspace(0, 1, max(len(half), teeth * 24))
    margin = np.stack([np.interp(s, arc, half[:, axis]) for axis in (0, 1)], axis=1)
    tangent = np.gradient(margin, axis=0)
    tangent /= np.linalg.norm(tangent, axis=1, keepdims=True) + 1e-12
    outward = np.stack([tangent[:, 1], -tangent[:, 0]], axis=1)
    saw = (1 - double) * _saw(teeth * s + phase) + double * _saw(3 * teeth * s + phase)
    fade = np.clip(np.minimum(s / 0.08, (1 - s) / 0.04), 0, 1)
    return margin + (depth * saw * fade)[:, None] * (np.cos(_LEAN) * outward + np.sin(_LEAN) * tangent)


def wavy(half: Curve, waves: int, depth: float) -> Curve:
    """The half outline with a gentle wave of the given depth (blade lengths)."""
    s = np.linspace(0, 1, len(half))
    tangent = np.gradient(half, axis=0)
    tangent /= np.linalg.norm(tangent, axis=1, keepdims=True) + 1e-12
    outward = np.stack([tangent[:, 1], -tangent[:, 0]], axis=1)
    return half + (depth * np.sin(2 * np.pi * waves * s) * np.sin(np.pi * s))[:, None] * outward


def closed(right: Curve, left: Curve | None = None) -> Curve:
    """The whole outline, counter-clockwise from the joint: right margin up, left margin down.
    `left` is a half outline too, drawn to the right; the two sides of a leaf are never quite alike."""
    left = right if left is None else left
    return np.vstack([right, (left * [-1, 1])[::-1][1:]])


def inside(point: Curve, outline: Curve):
    """Bool[point]: which points lie inside a closed outline (even-odd rule)."""
    x, y = point[:, None, 0], point[:, None, 1]
    (x0, y0), (x1, y1) = outline.T, np.roll(outline, -1, axis=0).T
    crosses = (y0 > y) != (y1 > y)
    with np.errstate(divide="ignore", invalid="ignore"):
        at = x0 + (y - y0) * (x1 - x0) / (y1 - y0)
    return (crosses & (x < at)).sum(axis=1) % 2 == 1


def _saw(phase):
    """0 to 1 rising slowly, falling fast, smooth enough to draw."""
    part = phase % 1.0
    return np.where(part < 0.75, part / 0.75, (1 - part) / 0.25)
