"""Which bark does the wood wear?

Barks are drawn by code: a relief (`furrowed`, `ribbed`, `scaly`, `peeling`, `smooth`, `palms`) gives colour, normals and roughness of one
tile that repeats without a seam and stands for half a metre of stem.
"""

from functools import lru_cache

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


def bark_names() -> tuple[str, ...]:
    """Names of all barks."""
    return tuple(_BARKS)


@lru_cache(maxsize=32)
def bark_material(name: str, pixels: int = 512) -> Material:
    """The bark called `name`, as a material called `wood_<name>`; kept, so that it is drawn once.

    `pixels` is the side of its textures (64-4096). Raises `OptionError` for an unknown name.
    """
    if name not in _BARKS:
        raise OptionError(f"There is no bark called `{name}`.", remedy=f"Choose one of: {', '.join(_BARKS)}.")
    if not 64 <= pixels <= 4096:
        raise OptionError(f"`pixels` is {pixels}, outside 64 to 4096.", remedy="Choose a size in that range, such as 512.")
    return _material(f"wood_{name}", _BARKS[name](pixels))


@lru_cache(maxsize=32)
def twig_material(name: str, pixels: int = 256) -> Material:
    """The smooth skin of young twigs under the bark called `name`, as a material called `wood_<name>_young`."""
    if name not in YOUNG:
        raise OptionError(f"There is no bark called `{name}`.", remedy=f"Choose one of: {', '.join(_BARKS)}.")
    return _material(f"wood_{name}_young", young(pixels, YOUNG[name]))


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
