"""The angle between two directions, with a gradient where they coincide; and short sums.

    a = atan2(|u × v|, u · v),   |·| = √(x² + 1e-12),   |u × v| = ½ |u − v| |u + v| for unit vectors

Vectors are kept as three columns, and short sums are written out: a compiled reduction over a short axis costs
five to ten times as much.
"""

from typing import NamedTuple

import jax.numpy as jnp
from jaxtyping import Array, Float


class Vectors(NamedTuple):
    """One vector a row."""

    x: Float[Array, " *row"]
    y: Float[Array, " *row"]
    z: Float[Array, " *row"]

    def at(self, rows) -> "Vectors":
        """Those of some rows."""
        return Vectors(*(column[rows] for column in self))


def angle(u: Vectors, v: Vectors) -> Float[Array, " *row"]:
    """Radians, 0 to π; u and v are unit vectors."""
    less, more = (Vectors(*(a + sign * b for a, b in zip(u, v, strict=True))) for sign in (-1, 1))
    cross = 0.25 * dot(less, less) * dot(more, more)
    return jnp.arctan2(jnp.sqrt(cross + 1e-12), dot(u, v))


def dot(u: Vectors, v: Vectors) -> Float[Array, " *row"]:
    """u · v."""
    return u.x * v.x + u.y * v.y + u.z * v.z


def total(rows: Float[Array, "few *row"]) -> Float[Array, " *row"]:
    """Σ over the first axis."""
    return sum((rows[k] for k in range(1, len(rows))), start=rows[0])
