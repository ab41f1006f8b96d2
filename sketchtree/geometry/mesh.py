"""A textured triangle mesh, as every writer and the preview take it."""

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
from jaxtyping import Float, Int, Shaped, UInt8


@dataclass(frozen=True, eq=False)
class Material:
    """A physically based material (glTF's metallic-roughness model, metallic 0)."""

    name: str  # `wood…` or `leaf…`
    base_color_texture: UInt8[np.ndarray, "row column channel"] | None = None  # sRGB, 3 or 4 channels
    normal_texture: UInt8[np.ndarray, "row column 3"] | None = None  # tangent space, +y up (glTF)
    roughness_texture: UInt8[np.ndarray, "row column"] | None = None
    base_color: tuple[float, float, float, float] = (1.0, 1.0, 1.0, 1.0)  # linear factor
    roughness: float = 0.9
    alpha_cutoff: float | None = None  # None: opaque; else pixels with less alpha are cut away
    double_sided: bool = False
    translucency: float = 0.0  # share of the light that passes through and leaves on the other side, 0-1
    translucency_texture: UInt8[np.ndarray, "row column 3"] | None = None  # its colour, sRGB; placed as the base colour


@dataclass(frozen=True, eq=False)
class Mesh:
    """Triangles with one material. Metres, y up, counter-clockwise seen from outside."""

    name: str  # `wood…` or `leaf…`
    position: Float[np.ndarray, "vertex 3"]
    normal: Float[np.ndarray, "vertex 3"]  # unit
    uv: Float[np.ndarray, "vertex 2"]  # glTF: (0, 0) is the top left of the texture; repeats
    triangle: Int[np.ndarray, "triangle 3"]
    material: Material
    color: Float[np.ndarray, "vertex 4"] | None = None  # linear factor per vertex (tint)
    extra: Mapping[str, Shaped[np.ndarray, "vertex channel"]] = field(default_factory=dict)
    # further columns a vertex, by their glTF names: COLOR_1, TEXCOORD_1, JOINTS_0, WEIGHTS_0, or _NAME for one's own

    @property
    def triangle_count(self) -> int:
        """How many triangles it draws."""
        return len(self.triangle)

    def merged(self) -> "Mesh":
        """Itself: what `Instances.merged` is to one mesh at many places."""
        return self
