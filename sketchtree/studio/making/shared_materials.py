"""Which materials of an asset are one? A tree that came from another process has its own, and what grows on it here others of the same content: in one process all of them would be one object,
and a file has one entry for it."""

import hashlib
from dataclasses import fields, replace

import numpy as np

from sketchtree.asset import Asset, Level
from sketchtree.geometry.instances import Instances
from sketchtree.geometry.mesh import Material, Mesh


def with_shared_materials(asset: Asset) -> Asset:
    """The asset, in which materials of the same content are the first of them."""
    known: dict[str, Material] = {}

    def shared(part: Mesh | Instances) -> Mesh | Instances:
        if isinstance(part, Instances):
            mesh = shared(part.mesh)
            return part if mesh is part.mesh else replace(part, mesh=mesh)
        material = known.setdefault(_content(part.material), part.material)
        return part if material is part.material else replace(part, material=material)

    return replace(asset, levels=tuple(Level(tuple(map(shared, level.parts)), level.coverage) for level in asset.levels))


def _content(material: Material) -> str:
    told = hashlib.blake2b(digest_size=16)
    for field in fields(material):
        value = getattr(material, field.name)
        is_array = isinstance(value, np.ndarray)
        told.update(f"{field.name} {(value.shape, value.dtype.str) if is_array else value!r}".encode())
        if is_array:
            told.update(np.ascontiguousarray(value).tobytes())
    return told.hexdigest()
