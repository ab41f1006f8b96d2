"""Which bark does the wood wear?

Barks are drawn by code: a relief (`bark_furrowed`, `bark_ribbed`, `bark_scaly`, `bark_peeling`, `bark_smooth`, `bark_palms`) gives colour, normals and roughness of one
tile that repeats without a seam and stands for half a metre of stem.
"""

from functools import lru_cache

from sketchtree.errors import OptionError
from sketchtree.geometry import bark_furrowed, bark_palms, bark_peeling, bark_ribbed, bark_scaly, bark_smooth
from sketchtree.geometry.bark_relief import Relief, albedo, normal_map, roughness_map
from sketchtree.geometry.bark_young import YOUNG, rachis, young
from sketchtree.geometry.mesh import Material

_BARKS = {
    "oak": bark_furrowed.oak,
    "beech": bark_smooth.beech,
    "birch": bark_smooth.birch,
    "willow": bark_furrowed.willow,
    "poplar": bark_furrowed.poplar,
    "apple": bark_scaly.apple,
    "spruce": bark_scaly.spruce,
    "pine": bark_scaly.pine,
    "palm": bark_smooth.palm,
    "ash": bark_ribbed.ash,
    "lime": bark_ribbed.lime,
    "elm": bark_ribbed.elm,
    "maple": bark_ribbed.maple,
    "plane": bark_peeling.plane,
    "cherry": bark_peeling.cherry,
    "chestnut": bark_peeling.chestnut,
    "cypress": bark_peeling.cypress,
    "cedar": bark_peeling.cedar,
    "larch": bark_peeling.larch,
    "coconut": bark_palms.coconut,
    "fan_palm": bark_palms.fan_palm,
    "dragon_tree": bark_palms.dragon_tree,
    "dead": bark_ribbed.dead,
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
