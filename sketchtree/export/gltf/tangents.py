"""Which way does the texture run on the surface?

For a triangle with edges e1, e2 and texture steps (u1, v1), (u2, v2), Lengyel 2001:

    t = (e1 v2 − e2 v1) / (u1 v2 − u2 v1)        the direction in which u grows
    b = (e2 u1 − e1 u2) / (u1 v2 − u2 v1)        … v grows (down the image in glTF)

Summed over the triangles of each vertex and made perpendicular to its normal. The fourth number is the handedness w
of glTF: the image's upward direction −b is w (n × t).
"""

import numpy as np
from jaxtyping import Float
from scipy.sparse import csc_array

from sketchtree.geometry.mesh import Mesh


def tangents(mesh: Mesh) -> Float[np.ndarray, "vertex 4"]:
    """Unit tangent and handedness of every vertex, as glTF's TANGENT."""
    normal = np.asarray(mesh.normal, float)
    along_u, along_v = _directions(mesh)
    flat = along_u - _dot(along_u, normal)[:, None] * normal
    length = np.sqrt(_dot(flat, flat))
    none = length <= 1e-12
    flat /= np.where(none, 1.0, length)[:, None]
    if none.any():
        flat[none] = _any_perpendicular(normal[none])
    up = -_dot(_cross(normal, flat), along_v)
    return np.column_stack([flat, np.where(up < 0, -1.0, 1.0)])


def _directions(mesh: Mesh):
    """Sums over the triangles at each vertex of the unit directions in which u and v grow."""
    a, b, c = mesh.triangle.T
    position, uv = np.asarray(mesh.position, float), np.asarray(mesh.uv, float)
    e1, e2 = position[b] - position[a], position[c] - position[a]
    (u1, v1), (u2, v2) = (uv[b] - uv[a]).T, (uv[c] - uv[a]).T
    sign = np.sign(u1 * v2 - u2 * v1)
    along = np.empty((len(a), 6))
    along[:, :3] = e1 * (sign * v2)[:, None] - e2 * (sign * v1)[:, None]
    along[:, 3:] = e2 * (sign * u1)[:, None] - e1 * (sign * u2)[:, None]
    for half in (along[:, :3], along[:, 3:]):
        size = np.sqrt(_dot(half, half))
        half /= np.where(size > 0, size, 1.0)[:, None]
    corners = np.ascontiguousarray(mesh.triangle).reshape(-1)
    at_vertex = csc_array((np.ones(len(corners)), corners, 3 * np.arange(len(a) + 1)), shape=(len(position), len(a)))
    total = at_vertex @ along
    return total[:, :3], total[:, 3:]


def _dot(a, b):
    return np.einsum("ij,ij->i", a, b)


def _cross(a, b):
    return np.column_stack([a[:, 1] * b[:, 2] - a[:, 2] * b[:, 1], a[:, 2] * b[:, 0] - a[:, 0] * b[:, 2], a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]])


def _any_perpendicular(normal):
    axis = np.eye(3)[np.argmin(np.abs(normal), axis=1)]
    side = _cross(normal, axis)
    return side / np.maximum(np.sqrt(_dot(side, side)), 1e-12)[:, None]
