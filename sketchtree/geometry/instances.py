"""One mesh at many places.

A vertex p of the mesh stands, at each place, at

    T + R (S p)        T: translation    R: rotation, a unit quaternion x y z w    S: scale along the axes
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int
from scipy.spatial.transform import Rotation

from sketchtree.geometry.mesh import Mesh


@dataclass(frozen=True, eq=False)
class Instances:
    """The mesh is drawn once a row, each time tinted by that row's colour. Its name is the mesh's."""

    mesh: Mesh
    translation: Float[np.ndarray, "instance 3"]  # metres
    rotation: Float[np.ndarray, "instance 4"]  # unit quaternion, x y z w
    scale: Float[np.ndarray, "instance 3"]
    color: Float[np.ndarray, "instance 4"] | None = None  # linear factor
    source: Int[np.ndarray, " instance"] | None = None  # row of the table they were made of, where there is one

    def __len__(self) -> int:
        return len(self.translation)

    @property
    def name(self) -> str:
        """`leaf…` or `wood…`."""
        return self.mesh.name

    @property
    def triangle_count(self) -> int:
        """How many triangles all of them draw."""
        return len(self) * len(self.mesh.triangle)

    def merged(self) -> Mesh:
        """All of them as one mesh, its vertices in the order of the rows."""
        one, count = self.mesh, len(self)
        turn = Rotation.from_quat(self.rotation).as_matrix() if count else np.zeros((0, 3, 3))
        position = self.translation[:, None] + np.einsum("iab,ivb->iva", turn, self.scale[:, None] * one.position)
        normal = np.einsum("iab,ivb->iva", turn, one.normal / self.scale[:, None])
        normal /= np.maximum(np.linalg.norm(normal, axis=2, keepdims=True), 1e-12)
        vertices = len(one.position)
        return Mesh(
            one.name,
            position.reshape(-1, 3),
            normal.reshape(-1, 3),
            np.tile(one.uv, (count, 1)),
            (one.triangle[None] + vertices * np.arange(count)[:, None, None]).reshape(-1, 3),
            one.material,
            _tinted(one.color, self.color, vertices, count),
            {name: np.tile(column, (count, 1)) for name, column in one.extra.items()},
        )


def _tinted(own, each, vertices: int, count: int):
    if own is None and each is None:
        return None
    own = np.ones((vertices, 4)) if own is None else own
    each = np.ones((count, 4)) if each is None else each
    return (each[:, None] * own[None]).reshape(-1, 4)
