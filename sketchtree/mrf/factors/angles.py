"""The angle between two directions, with a gradient where they coincide.

    a = atan2(|u × v|, u · v),   |·| = √(x² + 1e-12),   |u × v| = ½ |u − v| |u + v| for unit vectors
"""

import jax.numpy as jnp
from jaxtyping import Array, Float


def angle(u: Float[Array, "*pair 3"], v: Float[Array, "*pair 3"]) -> Float[Array, "*pair"]:
    """Radians, 0 to π; u and v are unit vectors."""
    cross = 0.25 * jnp.sum((u - v) ** 2, axis=-1) * jnp.sum((u + v) ** 2, axis=-1)
    return jnp.arctan2(jnp.sqrt(cross + 1e-12), jnp.sum(u * v, axis=-1))
