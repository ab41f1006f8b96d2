"""A material in glTF's words: metallic-roughness, alpha cut away, light that passes through a leaf.

Translucency is KHR_materials_diffuse_transmission (ratified 2025): the share of the diffuse light that leaves on the
other side, and its colour. A reader that does not know it draws the leaf without.
"""

import numpy as np

from sketchtree.export.gltf.tables import Tables
from sketchtree.export.images import COLOR, NORMAL
from sketchtree.geometry.mesh import Material

TRANSMISSION = "KHR_materials_diffuse_transmission"


def material_number(tables: Tables, material: Material) -> int:
    """Its place in the table of materials."""
    key = ("material", id(material))
    if key not in tables.known:
        tables.materials.append(_entry(tables, material))
        tables.known[key] = len(tables.materials) - 1
    return tables.known[key]


def _entry(tables: Tables, material: Material) -> dict:
    entry = {"name": material.name, "pbrMetallicRoughness": _metallic_roughness(tables, material)}
    if material.normal_texture is not None:
        entry["normalTexture"] = {"index": tables.texture(material.normal_texture, f"{material.name}_normal", NORMAL)}
    if material.alpha_cutoff is not None:
        entry |= {"alphaMode": "MASK", "alphaCutoff": float(material.alpha_cutoff)}
    if material.double_sided:
        entry["doubleSided"] = True
    if material.translucency:
        entry["extensions"] = {tables.use(TRANSMISSION): _transmission(tables, material)}
    return entry


def _metallic_roughness(tables: Tables, material: Material) -> dict:
    said = {"baseColorFactor": list(map(float, material.base_color)), "metallicFactor": 0.0, "roughnessFactor": float(material.roughness)}
    if material.base_color_texture is not None:
        said["baseColorTexture"] = {"index": tables.texture(material.base_color_texture, f"{material.name}_albedo", COLOR)}
    if material.roughness_texture is not None:
        rough = material.roughness_texture
        packed = np.stack([np.full_like(rough, 255), rough, np.zeros_like(rough)], axis=-1)  # green: roughness, blue: metallic
        said |= {
            "roughnessFactor": 1.0,
            "metallicFactor": 1.0,
            "metallicRoughnessTexture": {"index": tables.texture(packed, f"{material.name}_roughness", COLOR)},
        }
    return said


def _transmission(tables: Tables, material: Material) -> dict:
    said = {"diffuseTransmissionFactor": float(material.translucency)}
    if material.translucency_texture is not None:
        said["diffuseTransmissionColorTexture"] = {"index": tables.texture(material.translucency_texture, f"{material.name}_translucency", COLOR)}
    return said
