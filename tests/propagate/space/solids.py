"""Meshes for the tests of obstacles, and where segments meet them, triangle by triangle."""

import numpy as np
import trimesh


def box(low, high) -> trimesh.Trimesh:
    """A closed box between two corners."""
    low, high = np.array(low, float), np.array(high, float)
    found = trimesh.creation.box(high - low)
    found.apply_translation((low + high) / 2)
    return found


def ball(centre, radius, finer=3) -> trimesh.Trimesh:
    """A closed sphere."""
    found = trimesh.creation.icosphere(finer, radius)
    found.apply_translation(centre)
    return found


def wall(x, half=9.0, top=14.0) -> trimesh.Trimesh:
    """An open sheet of two triangles at `x`."""
    return trimesh.Trimesh([[x, -1, -half], [x, -1, half], [x, top, half], [x, top, -half]], [[0, 1, 2], [0, 2, 3]])


def open_below(mesh: trimesh.Trimesh) -> trimesh.Trimesh:
    """The same without the faces that look down."""
    return trimesh.Trimesh(mesh.vertices, mesh.faces[mesh.face_normals[:, 1] > -0.9])


def meets(start, end, mesh) -> np.ndarray:
    """Which segments meet a triangle of the mesh (Möller & Trumbore 1997, one triangle after the other; those apart from the mesh's box meet none)."""
    low, high = mesh.bounds + [[-1e-6], [1e-6]]
    near = ((np.maximum(start, end) >= low) & (np.minimum(start, end) <= high)).all(axis=1)
    start, way, found = start[near], (end - start)[near], np.zeros(near.sum(), bool)
    for a, b, c in np.asarray(mesh.triangles):
        p = np.cross(way, c - a)
        det = p @ (b - a)
        scale = np.divide(1.0, det, out=np.zeros(len(det)), where=np.abs(det) > 1e-14)
        u = scale * np.einsum("si,si->s", start - a, p)
        q = np.cross(start - a, b - a)
        v, t = scale * np.einsum("si,si->s", way, q), scale * (q @ (c - a))
        found |= (scale != 0) & (u >= 0) & (v >= 0) & (u + v <= 1) & (t >= 0) & (t <= 1)
    met = np.zeros(len(near), bool)
    met[near] = found
    return met
