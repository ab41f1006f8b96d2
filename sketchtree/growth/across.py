"""Directions across others: unit vectors, something perpendicular to them, and turning about them."""

import numpy as np
from jaxtyping import Float


def unit(vector: Float[np.ndarray, "row 3"]) -> Float[np.ndarray, "row 3"]:
    """The vectors, of unit length; one without length stays."""
    return vector / np.maximum(np.linalg.norm(vector, axis=1, keepdims=True), 1e-300)


def any_across(way: Float[np.ndarray, "row 3"]) -> Float[np.ndarray, "row 3"]:
    """A unit vector perpendicular to each; level, unless the way is nearly upright."""
    upright = np.abs(way[:, 1:2]) > 0.9
    return unit(np.cross(way, np.where(upright, [1.0, 0.0, 0.0], [0.0, 1.0, 0.0])))


def across(vector: Float[np.ndarray, "row 3"], way: Float[np.ndarray, "row 3"]) -> Float[np.ndarray, "row 3"]:
    """The part of each vector perpendicular to a unit vector, of unit length."""
    return unit(vector - np.sum(vector * way, axis=1, keepdims=True) * way)


def turned(axis: Float[np.ndarray, "row 3"], vector: Float[np.ndarray, "row 3"], angle: Float[np.ndarray, " row"]) -> Float[np.ndarray, "row 3"]:
    """Vectors perpendicular to unit axes, turned about them; radians."""
    return np.cos(angle)[:, None] * vector + np.sin(angle)[:, None] * np.cross(axis, vector)
