"""Which way does a child turn, as its parent sees it? Local frames and rotation angles.

Chen et al. 2008, §4 and Eq. 1. With y along the parent,

    v_c = s R_p R_y(ϕ) R_x(φ) ŷ |v_p|          R_c = R_p R_y(ϕ) R_x(φ)

    s     scale         |v_c| / |v_p|
    φ     divergence    angle between v_c and v_p, 0 to π
    ϕ     orientation   where round the parent, −π to π; any value where φ = 0 (0 is returned)
    R_p   local → world rotation of the parent; the root's is the least rotation from ŷ to the trunk

so that the child's direction in its parent's frame is (sin φ sin ϕ, cos φ, sin φ cos ϕ).
"""

import numpy as np
from jaxtyping import Float

_STRAIGHT = 1e-9  # radians; below it a child has no orientation


def turn_then_tilt(
    turn: Float[np.ndarray, "*pair"], tilt: Float[np.ndarray, "*pair"]
) -> Float[np.ndarray, "*pair 3 3"]:
    """R_y(turn) R_x(tilt)."""
    a, b, c, d = np.cos(turn), np.sin(turn), np.cos(tilt), np.sin(tilt)
    zero = np.zeros_like(a * c)
    rows = [[a + zero, b * d, b * c], [zero, c + zero, -d + zero], [-b + zero, a * d, a * c]]
    return np.stack([np.stack(row, -1) for row in rows], -2)


def least_rotation(unit: Float[np.ndarray, "*pair 3"]) -> Float[np.ndarray, "*pair 3 3"]:
    """The rotation from ŷ to each unit direction through the least angle (about z for −ŷ)."""
    x, y, z = np.moveaxis(unit, -1, 0)
    down = y < -1 + 1e-12
    k = 1 / np.where(down, 1.0, 1 + y)
    rows = [[1 - k * x * x, x, -k * x * z], [-x, y, -z], [-k * x * z, z, 1 - k * z * z]]
    upright = np.stack([np.stack(row, -1) for row in rows], -2)
    return np.where(down[..., None, None], np.diag([-1.0, -1.0, 1.0]), upright)


def local_angles(
    frame: Float[np.ndarray, "*pair 3 3"], vector: Float[np.ndarray, "*pair 3"]
) -> tuple[Float[np.ndarray, "*pair"], Float[np.ndarray, "*pair"]]:
    """(φ, ϕ) of world vectors in their parents' frames."""
    x, y, z = np.moveaxis(np.einsum("...wl,...w->...l", frame, vector), -1, 0)
    tilt = np.arctan2(np.hypot(x, z), y)
    return tilt, np.where(tilt > _STRAIGHT, np.arctan2(x, z), 0.0)


def child_vector(
    frame: Float[np.ndarray, "*pair 3 3"],
    parent_length: Float[np.ndarray, "*pair"],
    scale: Float[np.ndarray, "*pair"],
    tilt: Float[np.ndarray, "*pair"],
    turn: Float[np.ndarray, "*pair"],
) -> Float[np.ndarray, "*pair 3"]:
    """v_c of Eq. 1 in the world."""
    return (scale * parent_length)[..., None] * (frame @ turn_then_tilt(turn, tilt))[..., 1]


def wrap(angle: Float[np.ndarray, "*pair"]) -> Float[np.ndarray, "*pair"]:
    """The same angle in [−π, π)."""
    return (angle + np.pi) % (2 * np.pi) - np.pi
