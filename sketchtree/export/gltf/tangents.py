"""Which way does the texture run on the surface?

For a triangle with edges e1, e2 and texture steps (u1, v1), (u2, v2), Lengyel 2001:

    t = (e1 v2 − e2 v1) / (u1 v2 − u2 v1)        the direction in which u grows
    b = (e2 u1 − e1 u2) / (u1 v2 − u2 v1)        … v grows (down the image in glTF)

Summed over the triangles of each vertex and made perpendicular to its normal. The fourth number is the handedness w
of glTF: the image's upward direction −b is w (n × t).
"""

import numpy as np
from jaxtyping import Float

from sketchtree.geometry.mesh import Mesh


def tangents(mesh: Mesh) -> Float[np.ndarray, "vertex 4"]:
    """Unit tangent and handedness of every vertex, as glTF's TANGENT."""
    corner = mesh.position[mesh.triangle]
    step = mesh.uv[mesh.triangle]
    e1, e2 = corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0]
    (u1, v1), (u2, v2) = (step[:, 1] - step[:, 0]).T, (step[:, 2] - step[:, 0]).T
    sign = np.sign(u1 * v2 - u2 * v1)[:, None]
    along_u = _summed(mesh, sign * (e1 * v2[:, None] - e2 * v1[:, None]))
    along_v = _summed(mesh, sign * (e2 * u1[:, None] - e1 * u2[:, None]))
    flat = along_u - np.sum(along_u * mesh.normal, axis=1, keepdims=True) * mesh.normal
    length = np.linalg.norm(flat, axis=1, keepdims=True)
    good = length[:, 0] > 1e-12
    flat = np.where(good[:, None], flat / np.where(length > 0, length, 1.0), _any_perpendicular(mesh.normal))
    up = np.sum(np.cross(mesh.normal, flat) * -along_v, axis=1)
    return np.concatenate([flat, np.where(up < 0, -1.0, 1.0)[:, None]], axis=1)


def _summed(mesh: Mesh, per_triangle):
    """Sum over the triangles at each vertex, every triangle's vector made of unit length."""
    size = np.linalg.norm(per_triangle, axis=1, keepdims=True)
    unit = per_triangle / np.where(size > 0, size, 1.0)
    vertex = mesh.triangle.ravel()
    columns = [np.bincount(vertex, np.repeat(unit[:, axis], 3), minlength=len(mesh.position)) for axis in range(3)]
    return np.stack(columns, axis=1)


def _any_perpendicular(normal):
    axis = np.eye(3)[np.argmin(np.abs(normal), axis=1)]
    side = np.cross(normal, axis)
    return side / np.maximum(np.linalg.norm(side, axis=1, keepdims=True), 1e-12)
