"""What a drawn bark is made of, and how it becomes textures."""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, UInt8

from sketchtree.geometry.bark.noise import blurred

TILE = 0.5  # metres, side of every bark's tile


@dataclass(frozen=True, eq=False)
class Relief:
    """One tile of bark, periodic on all sides; row 0 is the top."""

    height: Float[np.ndarray, "row column"]  # metres, outwards
    color: Float[np.ndarray, "row column 3"]  # sRGB, 0-1
    roughness: Float[np.ndarray, "row column"]  # 0-1


def albedo(relief: Relief) -> UInt8[np.ndarray, "row column 3"]:
    """Colours, darkened a little where the relief is lower than what surrounds it (light does not get there)."""
    depth = np.clip((blurred(relief.height, 0.02) - relief.height) / 0.008, 0.0, 1.0)
    return _bytes(relief.color * (1.0 - 0.35 * depth)[..., None])


def normal_map(relief: Relief, tile: float = TILE) -> UInt8[np.ndarray, "row column 3"]:
    """Tangent-space normals, x right, y up (glTF): (−∂h/∂x, −∂h/∂y, 1) made unit, as bytes."""
    pixel = tile / len(relief.height)
    right = (np.roll(relief.height, -1, axis=1) - np.roll(relief.height, 1, axis=1)) / (2.0 * pixel)
    up = (np.roll(relief.height, 1, axis=0) - np.roll(relief.height, -1, axis=0)) / (2.0 * pixel)
    normal = np.stack([-right, -up, np.ones_like(up)], axis=-1)
    normal /= np.linalg.norm(normal, axis=-1, keepdims=True)
    return _bytes(0.5 + 0.5 * normal)


def roughness_map(relief: Relief) -> UInt8[np.ndarray, "row column"]:
    """Roughness as bytes."""
    return _bytes(relief.roughness)


def _bytes(value) -> UInt8[np.ndarray, "..."]:
    return np.round(np.clip(value, 0.0, 1.0) * 255.0).astype(np.uint8)
