"""What if a picture is printed on the leaves, as it is seen from the front?

Tan et al. 2008, §4: "Leaves are textured according to their projected position on the input image." The camera is orthographic and looks along −z, so a corner of a leaf at (x, y, z) has
the picture's place

    u = (x − left) / width        v = (top − y) / height        at most half a pixel from the picture's edge

It is printed on leaves that are one whole card without holes (`rectangle`), at their finest: coarser levels have holes in their cards, and instances share one card, so both have
each leaf's mean colour (`Leaves.seen`).
"""

import zlib
from dataclasses import dataclass, replace

import numpy as np
from jaxtyping import Float, UInt8

from sketchtree.foliage.leaf_model import LeafModel
from sketchtree.geometry.mesh import Material, Mesh


@dataclass(frozen=True, eq=False)
class Print:
    """A picture, and where it hangs in the world."""

    picture: UInt8[np.ndarray, "row column 3"]  # sRGB, rows from the top
    left: float  # x of its left edge, metres
    top: float  # y of its upper edge, metres
    pixel: float  # metres a pixel

    def uv(self, position: Float[np.ndarray, "vertex 3"]) -> Float[np.ndarray, "vertex 2"]:
        """The place of each vertex in the picture."""
        rows, columns = self.picture.shape[:2]
        column = np.clip((position[:, 0] - self.left) / self.pixel, 0.5, columns - 0.5)
        row = np.clip((self.top - position[:, 1]) / self.pixel, 0.5, rows - 0.5)
        return np.column_stack([column / columns, row / rows])

    def material(self, model: LeafModel) -> Material:
        """The picture as a material, named by the model and what it shows."""
        name = f"leaf_{model.name}_{zlib.crc32(self.picture.tobytes()):08x}"
        passes = {"translucency": model.translucency, "translucency_texture": self.picture}
        return Material(name, base_color_texture=self.picture, roughness=model.roughness, double_sided=True, **passes)

    def on(self, mesh: Mesh, model: LeafModel) -> Mesh:
        """A mesh of leaves with the picture on it instead of what it had."""
        return replace(mesh, uv=self.uv(mesh.position), material=self.material(model), color=None)
