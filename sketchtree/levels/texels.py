"""What colour has a texture at a place, seen from afar?

A pyramid of averages: level 0 is the texture itself in linear light, each level has half the pixels of the one before,
the mean of four. The level is the one whose texels are about as large as a pixel,

    l = ⌊log₂ (texels a pixel) + ½⌋
"""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from jaxtyping import Float, Int

from sketchtree.foliage.painting import to_linear
from sketchtree.geometry.mesh import Material


@dataclass(frozen=True, eq=False)
class Pyramid:
    """A texture and its averages, one after the other in one table; without a texture the table is empty."""

    texel: Float[np.ndarray, "texel 4"]  # linear red, green, blue, and alpha
    first: Int[np.ndarray, " level"]
    height: Int[np.ndarray, " level"]
    width: Int[np.ndarray, " level"]
    has_alpha: bool

    @classmethod
    def of(cls, material: Material) -> "Pyramid":
        """That of the material's colours."""
        image = material.base_color_texture
        return _none() if image is None else _pyramid(_Image(image))

    @property
    def any(self) -> bool:
        """There is a texture."""
        return len(self.texel) > 0

    def at(self, uv: Float[np.ndarray, "place 2"], pace: Float[np.ndarray, " place"]) -> Float[np.ndarray, "place 4"]:
        """The texels at places (0, 0 is the top left; repeating), where a pixel is `pace` textures wide."""
        texels = np.sqrt(float(self.height[0]) * float(self.width[0])) * pace
        level = np.clip(np.floor(np.log2(np.maximum(texels, 1e-12)) + 0.5), 0, len(self.first) - 1).astype(np.int64)
        wide, high = self.width[level], self.height[level]
        column = np.floor((uv[:, 0] % 1.0) * wide).astype(np.int64) % wide
        row = np.floor((uv[:, 1] % 1.0) * high).astype(np.int64) % high
        return self.texel[self.first[level] + row * wide + column]

    def alpha_at(self, uv: Float[np.ndarray, "place 2"]) -> Float[np.ndarray, " place"]:
        """Alpha of the texture itself."""
        wide, high = self.width[0], self.height[0]
        column = np.floor((uv[:, 0] % 1.0) * wide).astype(np.int64) % wide
        row = np.floor((uv[:, 1] % 1.0) * high).astype(np.int64) % high
        return self.texel[row * wide + column, 3]


class _Image:
    """A texture by its identity: textures are kept by their makers, and are looked at often."""

    def __init__(self, pixels):
        self.pixels = pixels

    def __hash__(self):
        return id(self.pixels)

    def __eq__(self, other):
        return self.pixels is other.pixels


def _none() -> Pyramid:
    nothing = np.zeros(0, np.int64)
    return Pyramid(np.zeros((0, 4)), nothing, nothing, nothing, False)


@lru_cache(maxsize=16)
def _pyramid(image: _Image) -> Pyramid:
    pixels = np.asarray(image.pixels)
    alpha = pixels[..., 3] / 255.0 if pixels.shape[2] == 4 else np.ones(pixels.shape[:2])
    level = np.dstack([to_linear(pixels[..., :3] / 255.0), alpha])
    levels = [level]
    while max(level.shape[:2]) > 1:
        level = _halved(level)
        levels.append(level)
    size = np.array([part.shape[0] * part.shape[1] for part in levels])
    shapes = np.array([part.shape[:2] for part in levels])
    table = np.concatenate([part.reshape(-1, 4) for part in levels])
    return Pyramid(table, np.cumsum(size) - size, shapes[:, 0], shapes[:, 1], pixels.shape[2] == 4)


def _halved(level):
    """The mean of each four texels; a last odd row or column counts as it is."""
    for axis in (0, 1):
        size = level.shape[axis]
        if size > 1:
            even, odd = (np.take(level, np.arange(k, size - size % 2, 2), axis=axis) for k in (0, 1))
            level = 0.5 * (even + odd)
    return level
