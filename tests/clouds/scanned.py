"""A tree of three limbs whose axes and thickness are known, and the points that a scanner sees of its bark."""

import numpy as np

TRUNK = np.array([[0.0, 0.0, 0.0], [0.05, 2.0, 0.0], [0.0, 4.0, 0.1]])
LEFT = np.array([[0.05, 2.0, 0.0], [-0.8, 3.0, 0.3], [-1.4, 3.6, 0.2]])
RIGHT = np.array([[0.0, 3.0, 0.05], [0.7, 3.5, -0.4], [1.0, 4.1, -0.6]])
LIMBS = ((TRUNK, 0.12, 0.05), (LEFT, 0.05, 0.02), (RIGHT, 0.04, 0.015))
LENGTH = sum(np.linalg.norm(np.diff(line, axis=0), axis=1).sum() for line, _, _ in LIMBS)


def bark(spacing: float = 0.015, noise: float = 0.0, seen_from=None, seed: int = 0) -> np.ndarray:
    """Points on the bark, so far from one another, moved by chance; `seen_from`: a direction, whose far side is left out."""
    chance, found = np.random.default_rng(seed), []
    for line, thick, thin in LIMBS:
        along = np.r_[0.0, np.cumsum(np.linalg.norm(np.diff(line, axis=0), axis=1))]
        for s in np.arange(0.0, along[-1], spacing):
            here, ahead = (np.array([np.interp(min(t, along[-1]), along, line[:, k]) for k in range(3)]) for t in (s, s + 0.05))
            way = ahead - here if np.linalg.norm(ahead - here) > 1e-9 else line[-1] - line[-2]
            way = way / np.linalg.norm(way)
            side = np.cross(way, [0.3, 0.1, 0.9])
            side /= np.linalg.norm(side)
            radius = thick + (thin - thick) * s / along[-1]
            turn = chance.uniform(0, 2 * np.pi) + np.arange(0, 2 * np.pi, spacing / radius)
            out = np.cos(turn)[:, None] * side + np.sin(turn)[:, None] * np.cross(way, side)
            out = out if seen_from is None else out[out @ np.asarray(seen_from) > 0.0]
            found.append(here + radius * out)
    points = np.concatenate(found)
    return points + chance.normal(0, 1, points.shape) * noise


def feet(points: np.ndarray) -> list[np.ndarray]:
    """The lowest points."""
    return [np.flatnonzero(points[:, 1] < points[:, 1].min() + 0.03)]
