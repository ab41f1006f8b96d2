"""Which stack of circles, whose radii shrink evenly from the lowest to the highest, do the points of some slices of a stem lie round?

    |q − c_k| = a + b s_k + error,       for the points q of slice k, at s_k along the stem

Every slice has its own middle c_k, all share a and b: where a scanner saw one side only a slice alone says little of its radius, but all together do. Gauss and Newton on Σ ρ(error),
ρ of Geman and McClure. Its scale is that of the errors towards the inside: stray points of a scan lie outside the bark, behind its edges, and twigs do too.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float

from sketchtree.clouds.tracing.circles import circles

_STEPS, _FEW = 25, 5
_SCALE = 2.0  # of ρ, in typical errors
_HELD = 1e-3  # how strongly a middle stays where it was, for slices with hardly a bend


@dataclass(frozen=True, eq=False)
class Tapered:
    """Circles that share one taper."""

    centre: Float[np.ndarray, "slice 2"]
    a: float  # radius at s = 0, metres
    b: float  # per metre
    off: float  # how far points typically lie off it, metres
    error: float  # of the radius in the middle of the slices: one standard deviation, metres; as the points scatter

    def radius(self, s: float | Float[np.ndarray, " slice"]):
        """At so many metres along the stem."""
        return self.a + self.b * s


def tapered(slices: list[Float[np.ndarray, "_ 2"]], s: Float[np.ndarray, " slice"], near: Tapered | None = None) -> Tapered:
    """The circles of slices of three points or more each. `near`: circles that are almost right already."""
    middle, count = float(np.mean(s)), len(slices)
    value, steps = _begun(slices) if near is None else np.r_[near.centre.ravel(), near.radius(middle), near.b], _STEPS if near is None else _FEW
    radius = float(value[-2])
    q, k = np.concatenate(slices), np.repeat(np.arange(count), [len(some) for some in slices])
    for _ in range(steps):
        away = q - value[: 2 * count].reshape(-1, 2)[k]
        far = np.linalg.norm(away, axis=1) + 1e-12
        error = far - value[-2] - value[-1] * (s[k] - middle)
        typical = _typical(error) + 1e-3 * abs(value[-2])
        weight = 1.0 / (1.0 + (error / (_SCALE * typical)) ** 2) ** 2
        slope = np.zeros((len(q), 2 * count + 2))
        rows = np.arange(len(q))
        slope[rows, 2 * k], slope[rows, 2 * k + 1] = (-away / far[:, None]).T
        slope[:, -2], slope[:, -1] = -1.0, -(s[k] - middle)
        square = slope.T @ (weight[:, None] * slope)
        held = square + np.diag(np.r_[np.full(2 * count, _HELD * len(q) / count), 0.0, 1e-9 + _HELD * len(q) * float(np.ptp(s)) ** 2])
        value = value - np.linalg.solve(held, slope.T @ (weight * error))
        value[-2] = np.clip(value[-2], 0.2 * radius, 4.0 * radius)
    spread = float(np.sqrt(max(np.linalg.inv(held)[-2, -2], 0.0))) * typical
    return Tapered(value[: 2 * count].reshape(-1, 2), float(value[-2] - value[-1] * middle), float(value[-1]), typical, spread)


def _begun(slices):
    """Circles one by one, and the radius that most of them have; where one has quite another, its middle is moved to where that would put it."""
    size = max(map(len, slices))
    points, there = np.zeros((len(slices), size, 2)), np.zeros((len(slices), size), bool)
    for k, some in enumerate(slices):
        points[k, : len(some)], there[k, : len(some)] = some, True
    begun = circles(points, there)
    radius = float(np.median(begun.radius))
    alike = np.abs(begun.radius / radius - 1.0)[:, None] < 0.5
    return np.r_[np.where(alike, begun.centre, _shifted(begun, points, there, radius)).ravel(), radius, 0.0]


def _shifted(begun, points, there, radius: float):
    """Middles for circles of another radius: from the points' own middle towards the circle's, so far."""
    own = (points * there[..., None]).sum(axis=1) / there.sum(axis=1)[:, None]
    way = begun.centre - own
    return own + way / np.maximum(np.linalg.norm(way, axis=1, keepdims=True), 1e-12) * 0.6 * radius


def _typical(error) -> float:
    """1.48 × the median of what lies inside."""
    inside = -error[error < 0]
    return 1.4826 * float(np.median(inside if len(inside) else np.abs(error)))
