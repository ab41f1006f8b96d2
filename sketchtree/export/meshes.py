"""Meshes for programs that read no glTF: OBJ with materials and textures, PLY with colours, STL.

An OBJ stands beside its `.mtl` and its textures, all named after it. PLY and STL hold one mesh; PLY carries the mean
colour of each material (times the tint) at its vertices. Metres, y up.
"""

import os
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from sketchtree.errors import ExportError
from sketchtree.export.files import check_extension, check_writable, write_whole
from sketchtree.export.images import encode
from sketchtree.geometry.mesh import Material, Mesh


def write_meshes(path: str | os.PathLike, meshes: Sequence[Mesh]) -> None:
    """Write the meshes as the extension says: `.obj`, `.ply` or `.stl`. Each file is written whole or not at all.

    Raises `ExportError` for another extension, where the file can't be written, and for `.ply` or `.stl` of no triangle.
    """
    suffix = check_extension(path, (".obj", ".ply", ".stl"))
    path = check_writable(path)
    meshes = [mesh for mesh in meshes if len(mesh.triangle)]
    if not meshes and suffix != ".obj":
        raise ExportError(
            f"Can't write {path}: there is no triangle to write.", remedy="Build a tree that has at least one branch."
        )
    if suffix == ".obj":
        _write_obj(path, meshes)
    else:
        write_whole(path, _merged(meshes).export(file_type=suffix[1:]))


def _write_obj(path: Path, meshes: Sequence[Mesh]) -> None:
    """Textures first, then the materials, then the mesh that names them."""
    materials = {mesh.material.name: mesh.material for mesh in meshes}
    library = path.with_suffix(".mtl")
    blocks = [_mtl(path, material) for material in materials.values()]
    write_whole(library, "\n".join(blocks).encode())
    lines, offset = ["# metres, y up", f"mtllib {library.name}"], 1
    for mesh in meshes:
        lines += [f"o {mesh.name}", f"usemtl {mesh.material.name}"]
        lines += ["v %.7g %.7g %.7g" % row for row in zip(*mesh.position.T.tolist(), strict=True)]
        lines += ["vt %.6g %.6g" % (u, 1.0 - v) for u, v in mesh.uv.tolist()]
        lines += ["vn %.5g %.5g %.5g" % row for row in zip(*mesh.normal.T.tolist(), strict=True)]
        corners = (mesh.triangle + offset).tolist()
        lines += ["f %d/%d/%d %d/%d/%d %d/%d/%d" % (a, a, a, b, b, b, c, c, c) for a, b, c in corners]
        offset += len(mesh.position)
    write_whole(path, ("\n".join(lines) + "\n").encode())


def _mtl(path: Path, material: Material) -> str:
    """One material, its textures written beside the mesh."""
    red, green, blue, alpha = material.base_color
    lines = [f"newmtl {material.name}", f"Kd {red:.4g} {green:.4g} {blue:.4g}", f"d {alpha:.4g}"]
    lines += ["Ks 0 0 0", f"Pr {material.roughness:.4g}", "illum 1"]
    albedo = material.base_color_texture
    if albedo is not None:
        name = _texture(path, material.name, "albedo", albedo, photographic=True)
        lines.append(f"map_Kd {name}")
        if material.alpha_cutoff is not None:
            lines.append(f"map_d {_texture(path, material.name, 'alpha', albedo[..., 3])}")
    if material.normal_texture is not None:
        lines.append(f"norm {_texture(path, material.name, 'normal', material.normal_texture)}")
    if material.roughness_texture is not None:
        lines.append(f"map_Pr {_texture(path, material.name, 'roughness', material.roughness_texture)}")
    return "\n".join(lines) + "\n"


def _texture(path: Path, owner: str, part: str, image, *, photographic: bool = False) -> str:
    data, media = encode(image, photographic=photographic)
    name = f"{path.stem}_{owner}_{part}.{'jpg' if media == 'image/jpeg' else 'png'}"
    write_whole(path.with_name(name), data)
    return name


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
