"""Where does the plane seen at a pixel of one photo appear in another?

Guo et al. 2018, Eq. 1:   H_i→j = K_j (R_j R_i⁻¹ − R_j (C_j − C_i) nᵀ / v) K_i⁻¹

    n   normal of the plane, in camera i
    X   the point of the plane that the pixel shows, in camera i
    v   as printed −nᵀX; the minus before it then moves the picture the wrong way (with X' = R_j (R_i⁻¹ X + C_i − C_j)), so v = nᵀX here

Inverse depth is affine over the picture of a plane: ρ(x, y) = nᵀ K_i⁻¹ (x, y, 1)ᵀ / v. So a slanted plane is kept as (ρ, ∂ρ/∂x, ∂ρ/∂y) at its pixel, and Eq. 1
becomes

    H (x, y, 1)ᵀ = A (x, y, 1)ᵀ + b ρ(x, y)        A = K_j R_j R_i⁻¹ K_i⁻¹        b = K_j R_j (C_i − C_j)

which is what the compiled loops use.
"""

import numpy as np
from jaxtyping import Float

from sketchtree.multiview.cameras import Camera


def homography(from_camera: Camera, to_camera: Camera, point: Float[np.ndarray, " 3"], normal: Float[np.ndarray, " 3"]) -> Float[np.ndarray, "3 3"]:
    """Eq. 1; `point` and `normal` of the plane in the first camera's frame."""
    turn = to_camera.rotation @ from_camera.rotation.T
    shift = to_camera.rotation @ (to_camera.centre - from_camera.centre)
    return to_camera.matrix @ (turn - np.outer(shift, normal) / (normal @ point)) @ np.linalg.inv(from_camera.matrix)


def transfer(from_camera: Camera, to_camera: Camera) -> Float[np.ndarray, "3 4"]:
    """[A | b]: (x, y, 1, ρ) → a pixel of the other picture, homogeneous; its third number is the depth there over the depth here."""
    a = to_camera.matrix @ to_camera.rotation @ from_camera.rotation.T @ np.linalg.inv(from_camera.matrix)
    b = to_camera.matrix @ to_camera.rotation @ (from_camera.centre - to_camera.centre)
    return np.column_stack([a, b])


def plane_of(camera: Camera, pixel: Float[np.ndarray, " 2"], point: Float[np.ndarray, " 3"], normal: Float[np.ndarray, " 3"]) -> Float[np.ndarray, " 3"]:
    """(ρ, ∂ρ/∂x, ∂ρ/∂y) at a pixel, of a plane in the camera's frame."""
    row = np.linalg.inv(camera.matrix).T @ normal / (normal @ point)
    return np.array([row @ [pixel[0], pixel[1], 1.0], row[0], row[1]])


def normals_of(camera: Camera, pixel: Float[np.ndarray, "pixel 2"], plane: Float[np.ndarray, "pixel 3"]) -> Float[np.ndarray, "pixel 3"]:
    """Unit normals in the world, towards the camera, of planes kept as (ρ, ∂ρ/∂x, ∂ρ/∂y)."""
    plane = np.asarray(plane, np.float64)
    row = np.column_stack([plane[:, 1], plane[:, 2], plane[:, 0] - (plane[:, 1:] * pixel).sum(axis=1)])
    away = row @ camera.matrix @ camera.rotation
    return -away / np.maximum(np.linalg.norm(away, axis=1), 1e-300)[:, None]
