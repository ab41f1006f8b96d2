"""OBJ with its `.mtl` and its textures beside it, all named after it. Metres, y up.

What OBJ has no word for, MTL's physically based extension says as Blender writes and reads it: `Pr` and `map_Pr` roughness,
`norm` a tangent-space normal map, and `map_Bump` the same once more, since Blender knows a normal map by that word only. The tint of
each leaf has no place in it: the mean of all is in the texture.
"""

import dataclasses
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from sketchtree.export.images import COLOR, NORMAL, encode, ending
from sketchtree.geometry.mesh import Material, Mesh


def obj_files(path: Path, meshes: Sequence[Mesh]) -> dict[Path, bytes]:
    """The textures, the materials, and the mesh that names them, by their paths."""
    materials = {mesh.material.name: _mean_tinted(mesh.material, meshes) for mesh in meshes}
    files: dict[Path, bytes] = {}
    library = path.with_suffix(".mtl")
    blocks = [_material(path, material, files) for material in materials.values()]
    return files | {library: "\n".join(blocks).encode(), path: _geometry(library.name, meshes)}


def _mean_tinted(material: Material, meshes: Sequence[Mesh]) -> Material:
    """The material with the mean tint of the meshes that wear it in its texture, or in its colour where it has none."""
    tints = [mesh.color[:, :3] for mesh in meshes if mesh.material is material and mesh.color is not None]
    if not tints:
        return material
    mean = np.concatenate(tints).mean(axis=0)
    image = material.base_color_texture
    if image is None:
        return dataclasses.replace(material, base_color=(*(np.array(material.base_color[:3]) * mean).tolist(), material.base_color[3]))
    tinted = image.copy()
    tinted[..., :3] = np.round(image[..., :3] * np.clip(mean, 0.0, 1.0) ** (1 / 2.2))  # a factor of light, on sRGB bytes
    return dataclasses.replace(material, base_color_texture=tinted)


def _geometry(library: str, meshes: Sequence[Mesh]) -> bytes:
    lines, offset = ["# metres, y up", f"mtllib {library}"], 1
    for mesh in meshes:
        lines += [f"o {mesh.name}", f"usemtl {mesh.material.name}"]
        lines += ["v %.7g %.7g %.7g" % row for row in zip(*mesh.position.T.tolist(), strict=True)]
        lines += ["vt %.6g %.6g" % (u, 1.0 - v) for u, v in mesh.uv.tolist()]
        lines += ["vn %.5g %.5g %.5g" % row for row in zip(*mesh.normal.T.tolist(), strict=True)]
        corners = (mesh.triangle + offset).tolist()
        lines += ["f %d/%d/%d %d/%d/%d %d/%d/%d" % (a, a, a, b, b, b, c, c, c) for a, b, c in corners]
        offset += len(mesh.position)
    return ("\n".join(lines) + "\n").encode()


def _material(path: Path, material: Material, files: dict[Path, bytes]) -> str:
    """Its lines; its textures are added to `files`."""
    red, green, blue, alpha = material.base_color
    lines = [f"newmtl {material.name}", f"Kd {red:.4g} {green:.4g} {blue:.4g}", f"d {alpha:.4g}"]
    lines += ["Ks 0 0 0", f"Pr {material.roughness:.4g}", "illum 1"]
    albedo = material.base_color_texture
    pictures = [("map_Kd", "diffuse", albedo, COLOR)]
    if albedo is not None and material.alpha_cutoff is not None:
        pictures.append(("map_d", "alpha", albedo[..., 3], None))
    pictures += [("norm", "normal", material.normal_texture, NORMAL), ("map_Pr", "rough", material.roughness_texture, COLOR)]
    for word, part, image, quality in pictures:
        if image is not None:
            data, media = encode(image, quality)
            name = f"{path.stem}_{material.name}_{part}{ending(media)}"
            files[path.with_name(name)] = data
            lines += [f"{word} {name}", *([f"map_Bump {name}"] if word == "norm" else [])]
    return "\n".join(lines) + "\n"
