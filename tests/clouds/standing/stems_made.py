"""Points on the bark of a stem whose thickness is known, as a scanner sees it."""

import numpy as np


def stem(
    diameter: float = 0.3,
    height: float = 1.6,
    *,
    seen: float = 1.0,
    noise: float = 0.004,
    flare: float = 0.0,
    lean: float = 0.0,
    taper: float = 0.02,
    strays: float = 0.0,
    count: int = 1500,
    seed: int = 0,
) -> np.ndarray:
    """`seen`: share of the bark; `flare`: how much thicker the foot is; `lean`: radians; `taper`: metres of diameter lost per metre; `strays`: how far points trail behind the edges."""
    chance = np.random.default_rng(seed)
    y, turn = chance.uniform(0, height, count), chance.uniform(-np.pi * seen, np.pi * seen, count)
    radius = (diameter - taper * y + flare * diameter * np.exp(-y / 0.12)) / 2 + chance.normal(size=count) * noise
    points = np.c_[radius * np.cos(turn), y, radius * np.sin(turn)]
    trailing = (np.pi * seen - np.abs(turn) < 0.3) & (chance.uniform(size=count) < 0.5)
    points[trailing, 0] -= chance.exponential(strays + 1e-12, trailing.sum())
    c, s = np.cos(lean), np.sin(lean)
    return np.c_[c * points[:, 0] + s * points[:, 1], c * points[:, 1] - s * points[:, 0], points[:, 2]]
