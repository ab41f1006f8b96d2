"""Polylines in pixels: walked evenly."""

import numpy as np
from jaxtyping import Float


def lengths(points: Float[np.ndarray, "point 2"]) -> Float[np.ndarray, " point"]:
    """Length of a line up to each of its points, pixels."""
    return np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(points, axis=0).T))])


def evenly(points: Float[np.ndarray, "point 2"], step: float) -> tuple[Float[np.ndarray, "place 2"], Float[np.ndarray, "place 2"]]:
    """(places about `step` apart along a line, both ends among them; the line's unit direction at each)."""
    points = np.asarray(points, np.float64)
    along = lengths(points)
    kept = np.concatenate([[True], np.diff(along) > 0])
    points, along = points[kept], along[kept]
    if len(points) == 1:
        return points, np.array([[0.0, -1.0]])
    s = np.linspace(0.0, along[-1], max(int(np.ceil(along[-1] / step)), 1) + 1)
    place = np.stack([np.interp(s, along, points[:, 0]), np.interp(s, along, points[:, 1])], axis=1)
    part = np.clip(np.searchsorted(along, s, side="right") - 1, 0, len(points) - 2)
    chord = np.diff(points, axis=0)[part]
    return place, chord / np.hypot(chord[:, 0], chord[:, 1])[:, None]
