"""The tree of `scanned`, in leaf: discs that look all ways, about the outer half of its limbs."""

import numpy as np
from scanned import LIMBS, bark

SIZE, REACH = 0.05, 0.4  # metres: radius of a leaf, and how far one is from a limb at most
OUTER = np.concatenate([line[-2] + np.linspace(0.4, 1.0, 8)[:, None] * (line[-1] - line[-2]) for line, _, _ in LIMBS])
COUNT = 80  # leaves about each of those places


def leaves(points: int = 4, seed: int = 1) -> np.ndarray:
    """So many points on each leaf."""
    chance, found = np.random.default_rng(seed), []
    for place in OUTER:
        away = chance.normal(size=(COUNT, 3))
        middle = place + REACH * away / np.linalg.norm(away, axis=1, keepdims=True) * chance.uniform(size=(COUNT, 1)) ** (1 / 3)
        one, other = chance.normal(size=(2, COUNT, 3))
        one /= np.linalg.norm(one, axis=1, keepdims=True)
        other -= np.einsum("ij,ij->i", one, other)[:, None] * one
        other /= np.linalg.norm(other, axis=1, keepdims=True)
        turn, out = chance.uniform(0, 2 * np.pi, (COUNT, points, 1)), SIZE * np.sqrt(chance.uniform(size=(COUNT, points, 1)))
        found.append((middle[:, None] + out * (np.cos(turn) * one[:, None] + np.sin(turn) * other[:, None])).reshape(-1, 3))
    return np.concatenate(found)


def in_leaf(spacing: float = 0.05, points: int = 4) -> tuple[np.ndarray, np.ndarray]:
    """(points, which of them are leaves)."""
    wood, leaf = bark(spacing, noise=0.002), leaves(points)
    return np.concatenate([wood, leaf]), np.arange(len(wood) + len(leaf)) >= len(wood)
