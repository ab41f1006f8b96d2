"""Which circle do points lie round? Many small problems at once.

Kåsa's linear fit begins; then Gauss and Newton on Σ ρ(|q − c| − r), where ρ (Geman and McClure) lets points that lie elsewhere, of twigs or of another limb, count little.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Float

_STEPS = 12
_SECTORS = 12  # of which those with points say how much of the circle was seen


@dataclass(frozen=True, eq=False)
class Circles:
    """One circle for each set of points."""

    centre: Float[np.ndarray, "set 2"]
    radius: Float[np.ndarray, " set"]
    off: Float[np.ndarray, " set"]  # how far a point typically lies from the circle: 1.48 × the median
    seen: Float[np.ndarray, " set"]  # share of the circle with points, 0-1
    near: Float[np.ndarray, " set"]  # share of the points that lie near it


def circles(points: Float[np.ndarray, "set point 2"], there: Bool[np.ndarray, "set point"]) -> Circles:
    """Circles of sets of three points or more; `there` says which entries are points."""
    weight = there.astype(float)
    number = weight.sum(axis=1)
    middle = (points * weight[..., None]).sum(axis=1) / number[:, None]
    x = points - middle[:, None]
    scale = np.sqrt((weight * (x**2).sum(axis=2)).sum(axis=1) / number) + 1e-12
    x = x / scale[:, None, None]
    centre, radius = _linear(x, weight)
    for _ in range(_STEPS):
        away = x - centre[:, None]
        distance = np.linalg.norm(away, axis=2) + 1e-9
        error = distance - radius[:, None]
        typical = _typical(error, there) + 0.02 * radius
        w = weight / (1.0 + (error / (1.5 * typical[:, None])) ** 2) ** 2
        slope = np.concatenate([-away / distance[..., None], -np.ones((*error.shape, 1))], axis=2)
        weighted = (slope * w[..., None]).transpose(0, 2, 1)
        square = weighted @ slope + 1e-4 * np.eye(3) * number[:, None, None]
        step = np.linalg.solve(square, weighted @ error[..., None])[..., 0]
        centre, radius = centre - step[:, :2], np.clip(radius - step[:, 2], 1e-3, 10.0)
    away = x - centre[:, None]
    distance = np.linalg.norm(away, axis=2)
    error = distance - radius[:, None]
    typical = _typical(error, there)
    near = there & (np.abs(error) < np.maximum(2.5 * typical, 0.1 * radius)[:, None])
    sector = np.floor((np.arctan2(away[..., 1], away[..., 0]) / (2 * np.pi) + 0.5) * _SECTORS).astype(int) % _SECTORS
    hit = np.zeros((len(x), _SECTORS), bool)
    hit[np.nonzero(near)[0], sector[near]] = True
    return Circles(middle + centre * scale[:, None], radius * scale, typical * scale, hit.mean(axis=1), near.sum(axis=1) / number)


def _linear(x, weight):
    """Kåsa: |q|² = 2 c·q + (r² − |c|²), by least squares; round the middle where that lies far off."""
    rows = np.concatenate([x, np.ones((*x.shape[:2], 1))], axis=2)
    square = np.einsum("nki,nkj,nk->nij", rows, rows, weight) + 1e-6 * np.eye(3)
    solved = np.linalg.solve(square, np.einsum("nki,nk,nk->ni", rows, (x**2).sum(axis=2), weight)[..., None])[..., 0]
    centre = solved[:, :2] / 2
    radius = np.sqrt(np.maximum(solved[:, 2] + (centre**2).sum(axis=1), 1e-6))
    far = (np.linalg.norm(centre, axis=1) > 5.0) | (radius > 5.0)
    return np.where(far[:, None], 0.0, centre), np.where(far, 1.0, radius)


def _typical(error, there):
    """1.48 × the median of what is there, however many."""
    held = np.sort(np.where(there, np.abs(error), np.inf), axis=1)
    return 1.4826 * held[np.arange(len(held)), np.maximum(there.sum(axis=1) - 1, 0) // 2]
