"""Pictures of materials, by the key that a frame names them with, and thumbnails of what there is to choose from."""

import io
from functools import lru_cache

import numpy as np

from sketchtree.foliage.leaf_materials import SEEN, card_material, leaf_material
from sketchtree.foliage.models import leaf_names, plain_names
from sketchtree.geometry.bark import bark_material, bark_names, rachis_material, twig_material
from sketchtree.geometry.mesh import Material

SEASONS = ("spring", "summer", "autumn", "bare")
_MAPS = {"color": "base_color_texture", "normal": "normal_texture", "roughness": "roughness_texture", "translucency": "translucency_texture"}
_THUMBNAIL = 96  # pixels


class Textures:
    """Those of materials that were shown, and of all that can be named."""

    def __init__(self) -> None:
        self._known: dict[str, Material] = {}

    def remember(self, materials: dict[str, Material]) -> None:
        """These are shown now."""
        self._known.update(materials)

    def png(self, key: str, kind: str) -> bytes | None:
        """A map of a material; None: there is no such."""
        material = self._known.get(key) or _named(key)
        picture = getattr(material, _MAPS[kind], None) if kind in _MAPS and material is not None else None
        return None if picture is None else encoded(picture)


def unnamed(materials: dict[str, Material]) -> dict[tuple[str, str], bytes]:
    """The maps of those materials that no name tells how to make (a bark in the colour of a photo), by key and map: they go with the tree that wears them."""
    found = {}
    for key, material in materials.items():
        if _named(key) is None:
            pictures = {kind: getattr(material, name) for kind, name in _MAPS.items()}
            found |= {(key, kind): encoded(picture) for kind, picture in pictures.items() if picture is not None}
    return found


@lru_cache(maxsize=64)
def _named(key: str) -> Material | None:
    """The material that a key names, made anew."""
    every = {material.name: material for material in (rachis_material(),)}
    for bark in bark_names():
        for make in (bark_material, twig_material):
            if key in (f"wood_{bark}", f"wood_{bark}_young") or not every:
                material = make(bark)
                every[material.name] = material
    if key in every:
        return every[key]
    name, _, season = key.rpartition(".")
    for leaf in (*leaf_names(), *plain_names()):
        if season in (*SEASONS, SEEN) and name in (f"leaf_{leaf}", leaf):
            return leaf_material(leaf, season)
        if season in (*SEASONS, SEEN) and name == f"leaf_{leaf}_cards":
            return card_material(leaf, season)
    return None


def encoded(picture) -> bytes:
    """A PNG, quickly."""
    from PIL import Image

    out = io.BytesIO()
    Image.fromarray(np.ascontiguousarray(picture)).save(out, "PNG", compress_level=1)
    return out.getvalue()


@lru_cache(maxsize=256)
def thumbnail(what: str, name: str, templates) -> bytes | None:
    """A small picture: of a template, a leaf or a bark; None where there is none of that name."""
    if what == "template" and name in templates.names:
        return _ink(templates.exemplar(name).thumbnail)
    if what == "leaf" and name in leaf_names():
        return _small(leaf_material(name, "summer").base_color_texture)
    if what == "bark" and name in bark_names():
        return _small(bark_material(name, 128).base_color_texture)
    return None


def _ink(paper) -> bytes:
    """Dark lines on nothing."""
    alpha = 255 - np.asarray(paper)
    return encoded(np.stack([np.full_like(alpha, 40), alpha], axis=-1))


def _small(picture) -> bytes:
    from PIL import Image

    image = Image.fromarray(np.ascontiguousarray(picture))
    if image.mode == "RGBA":
        image = image.crop(image.getchannel("A").getbbox() or (0, 0, *image.size))
    image.thumbnail((_THUMBNAIL, _THUMBNAIL))
    return encoded(np.asarray(image))
