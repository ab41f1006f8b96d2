"""PLY and STL: one mesh without materials. PLY carries the mean colour of each material, times the tint, at its vertices. Metres, y up."""

from collections.abc import Sequence

import numpy as np

from sketchtree.geometry.mesh import Mesh


def plain_bytes(meshes: Sequence[Mesh], kind: str) -> bytes:
    """All meshes in one, as `ply` or `stl` (binary)."""
    return _merged(meshes).export(file_type=kind)


def _merged(meshes: Sequence[Mesh]):
    """All meshes as one of trimesh's, coloured by vertex."""
    import trimesh

    count = np.r_[0, np.cumsum([len(mesh.position) for mesh in meshes])]
    return trimesh.Trimesh(
        np.concatenate([mesh.position for mesh in meshes]),
        np.concatenate([mesh.triangle + first for mesh, first in zip(meshes, count, strict=False)]),
        vertex_normals=np.concatenate([mesh.normal for mesh in meshes]),
        vertex_colors=np.concatenate([_vertex_colors(mesh) for mesh in meshes]),
        process=False,
    )


def _vertex_colors(mesh: Mesh):
    """Mean colour of the texture (of its opaque part) times the tint, sRGB bytes."""
    color = np.array(mesh.material.base_color)
    image = mesh.material.base_color_texture
    if image is not None:
        pixels = image.reshape(-1, image.shape[2]).astype(float) / 255.0
        weight = pixels[:, 3] if pixels.shape[1] == 4 else np.ones(len(pixels))
        color[:3] *= np.average(pixels[:, :3] ** 2.2, axis=0, weights=np.maximum(weight, 1e-6))
    tint = np.ones((len(mesh.position), 4)) if mesh.color is None else mesh.color
    linear = np.clip(color * tint, 0.0, 1.0)
    return np.round(np.c_[linear[:, :3] ** (1 / 2.2), linear[:, 3]] * 255.0).astype(np.uint8)
