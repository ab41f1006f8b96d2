"""Which bark does the wood wear?

Barks are drawn by code: a relief (`furrowed`, `ribbed`, `scaly`, `peeling`, `smooth`, `palms`) gives colour, normals and roughness of one
tile that repeats without a seam and stands for half a metre of stem. A tree that was seen, in a photo for one, may ask for a bark of another colour: the same relief, its colours
shifted in linear light until their mean is that one.
"""

from dataclasses import replace
from functools import lru_cache

import numpy as np

from sketchtree.errors import OptionError
from sketchtree.geometry.bark import furrowed, palms, peeling, ribbed, scaly, smooth
from sketchtree.geometry.bark.relief import Relief, albedo, normal_map, roughness_map
from sketchtree.geometry.bark.young import YOUNG, rachis, young
from sketchtree.geometry.mesh import Material

_BARKS = {
    "oak": furrowed.oak,
    "beech": smooth.beech,
    "birch": smooth.birch,
    "willow": furrowed.willow,
    "poplar": furrowed.poplar,
    "apple": scaly.apple,
    "spruce": scaly.spruce,
    "pine": scaly.pine,
    "palm": smooth.palm,
    "ash": ribbed.ash,
    "lime": ribbed.lime,
    "elm": ribbed.elm,
    "maple": ribbed.maple,
    "plane": peeling.plane,
    "cherry": peeling.cherry,
    "chestnut": peeling.chestnut,
    "cypress": peeling.cypress,
    "cedar": peeling.cedar,
    "larch": peeling.larch,
    "coconut": palms.coconut,
    "fan_palm": palms.fan_palm,
    "dragon_tree": palms.dragon_tree,
    "dead": ribbed.dead,
}

Colour = tuple[float, float, float]
"""Linear red, green and blue, 0-1."""

_TWIGS = 0.5  # of the bark's shift, in powers, that young twigs share


def bark_names() -> tuple[str, ...]:
    """Names of all barks."""
    return tuple(_BARKS)


def bark_material(name: str, pixels: int = 512, colour: Colour | None = None) -> Material:
    """The bark called `name`, as a material called `wood_<name>`; kept, so that it is drawn once. `colour`: its mean, if that is not its own; the material's name then ends in it.

    `pixels` is the side of its textures (64-4096). Raises `OptionError` for an unknown name.
    """
    if name not in _BARKS:
        raise OptionError(f"There is no bark called `{name}`.", remedy=f"Choose one of: {', '.join(_BARKS)}.")
    if not 64 <= pixels <= 4096:
        raise OptionError(f"`pixels` is {pixels}, outside 64 to 4096.", remedy="Choose a size in that range, such as 512.")
    return _bark(name, pixels, colour)


def twig_material(name: str, pixels: int = 256, colour: Colour | None = None) -> Material:
    """The smooth skin of young twigs under the bark called `name`, as a material called `wood_<name>_young`; `colour` is that of the bark, if that is not its own."""
    if name not in YOUNG:
        raise OptionError(f"There is no bark called `{name}`.", remedy=f"Choose one of: {', '.join(_BARKS)}.")
    return _twig(name, pixels, colour)


@lru_cache(maxsize=32)
def bark_colour(name: str) -> Colour:
    """The mean colour of a bark, linear. Raises `OptionError` for an unknown name."""
    return tuple(_linear(bark_material(name).base_color_texture).mean(axis=(0, 1)).tolist())


@lru_cache(maxsize=4)
def rachis_material(pixels: int = 256) -> Material:
    """The skin of a palm frond's midrib, as a material called `wood_rachis`."""
    return _material("wood_rachis", rachis(pixels))


def _material(name: str, relief: Relief) -> Material:
    textures = {
        "base_color_texture": albedo(relief),
        "normal_texture": normal_map(relief),
        "roughness_texture": roughness_map(relief),
    }
    for texture in textures.values():
        texture.flags.writeable = False
    return Material(name, roughness=1.0, **textures)


@lru_cache(maxsize=32)
def _bark(name: str, pixels: int, colour: Colour | None) -> Material:
    if colour is None:
        return _material(f"wood_{name}", _BARKS[name](pixels))
    return _shifted(_bark(name, pixels, None), np.array(colour) / bark_colour(name), colour)


@lru_cache(maxsize=32)
def _twig(name: str, pixels: int, colour: Colour | None) -> Material:
    if colour is None:
        return _material(f"wood_{name}_young", young(pixels, YOUNG[name]))
    return _shifted(_twig(name, pixels, None), (np.array(colour) / bark_colour(name)) ** _TWIGS, colour)


def _shifted(own: Material, by: np.ndarray, colour: Colour) -> Material:
    """The same in other colours; its name tells which, so that files with two such trees keep both."""
    texture = _encoded(np.clip(_linear(own.base_color_texture) * by, 0.0, 1.0))
    texture.flags.writeable = False
    told = "".join(f"{byte:02x}" for byte in _encoded(np.clip(np.array(colour), 0.0, 1.0)))
    return replace(own, name=f"{own.name}_{told}", base_color_texture=texture)


def _linear(byte) -> np.ndarray:
    """sRGB, 0-255 → linear, 0-1."""
    value = np.arange(256) / 255.0
    return np.where(value <= 0.04045, value / 12.92, ((value + 0.055) / 1.055) ** 2.4)[byte]


def _encoded(value) -> np.ndarray:
    """Linear, 0-1 → sRGB, 0-255."""
    return np.rint(255.0 * np.where(value <= 0.0031308, 12.92 * value, 1.055 * value ** (1 / 2.4) - 0.055)).astype(np.uint8)
