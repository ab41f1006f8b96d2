"""Which sizes may textures have? Powers of two: of others Unreal makes no smaller ones, and leaves far away would flicker."""

from dataclasses import fields, replace
from functools import lru_cache

import numpy as np
from PIL import Image

from sketchtree.geometry.mesh import Material

_TEXTURES = tuple(field.name for field in fields(Material) if field.name.endswith("_texture"))


@lru_cache(maxsize=64)
def even_material(material: Material) -> Material:
    """The material with textures whose sides are the nearest powers of two; itself where they are already. Places in it stay the same."""
    changed = {name: even(getattr(material, name)) for name in _TEXTURES if getattr(material, name) is not None}
    return material if all(changed[name] is getattr(material, name) for name in changed) else replace(material, **changed)


def even(image):
    """The image (row column *channel, uint8) stretched to sides that are powers of two, each the nearest by ratio."""
    size = tuple(int(2 ** np.round(np.log2(side))) for side in image.shape[1::-1])
    if size == tuple(image.shape[1::-1]):
        return image
    return np.asarray(Image.fromarray(np.ascontiguousarray(image)).resize(size, Image.Resampling.BOX))
