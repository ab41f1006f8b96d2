"""Which textures does a leaf model have in a season, and which factor does each leaf put on them?

A leaf in the shade of the others is darker than one in the sun, and keeps more of its green:

    factor = C(tint) / texture · (D + (1 − D) light)        D: `_DEEP`, light: 0-1 (`crown_light`)

Leaves that were seen in a photo have the colours they were seen in, on a pale texture; the photo's light is in those already.

The light that a leaf lets through has passed its pigments once more: its colour is the blade's, deeper (`_DEEPER`), and brought to an
even brightness; veins and stems let little through. Undersides are drawn as the upper sides are: glTF has one material for both
faces, a second would double the triangles. Models whose undersides show from afar (olive) have them in their range of colours.
"""

from functools import lru_cache

import numpy as np
from jaxtyping import Float, UInt8

from sketchtree.foliage.flowers.worn import flower_painting, with_meshes
from sketchtree.foliage.leaves import Leaves
from sketchtree.foliage.models import leaf_model, leaf_painting
from sketchtree.foliage.painting import Painting, albedo, normal_map
from sketchtree.foliage.seasons import Palette, linear
from sketchtree.geometry.mesh import Material

_DEEP = np.array([0.70, 0.80, 0.74])  # of a leaf's colour, in the deepest shade
_DEEPER, _BRIGHT = 1.35, 0.55  # exponent of the blade's colour; brightest channel of what passes
SEEN = "seen"
"""What stands for the season of leaves that have the colours of a photo."""

_PALE = Palette("#ececec", "#ececec", "#f6f6f6", "#d8d8d8")
_CUT = 0.4  # alpha below it is cut away: at 0.5 a birch lost half its silhouette to the averages of smaller textures, seen as a whole (0.4: -4 to +17 %)
_VEIN, _STEM = 0.55, 0.12  # of the light, pass veins and stems


@lru_cache(maxsize=128)
def leaf_material(name: str, season: str = "summer") -> Material:
    """The textures of a leaf model in a season, of a flower's mesh if it has one; the material is called `leaf_<name>`. Raises OptionError."""
    leaf_model(name)
    painting = flower_painting(name) if name in with_meshes() else leaf_painting(name)
    return painted_material(f"leaf_{name}", painting, name, season)


@lru_cache(maxsize=16)
def card_material(name: str, season: str = "summer") -> Material:
    """The same of its card: what flowers wear of which there are too many for meshes."""
    return painted_material(f"leaf_{name}_cards", leaf_painting(name), name, season) if name in with_meshes() else leaf_material(name, season)


def painted_material(title: str, painting: Painting, name: str, season: str) -> Material:
    """A drawing in the colours of the leaf model `name`."""
    model, palette = leaf_model(name), palette_of(name, season)
    return Material(
        name=title,
        base_color_texture=albedo(painting, palette.texture_blade, linear(palette.vein), linear(palette.stem)),
        normal_texture=normal_map(painting),
        roughness=model.roughness,
        alpha_cutoff=_CUT,
        double_sided=True,
        translucency=model.translucency,
        translucency_texture=_passed(painting, palette),
    )


def palette_of(name: str, season: str) -> Palette:
    """A model's colours in a season; what is still there in winter has those of autumn."""
    return _PALE if season == SEEN else leaf_model(name).palettes[{"bare": "autumn"}.get(season, season)]


def colours_of(leaves: Leaves, season: str) -> str:
    """What names the textures of some leaves: the season, or `SEEN` where they have the colours of a photo."""
    return season if leaves.seen is None else SEEN


def leaf_factor(leaves: Leaves, season: str, light: Float[np.ndarray, " leaf"]) -> Float[np.ndarray, "leaf 4"]:
    """The linear factor of every leaf's colour, and 1."""
    if leaves.seen is not None:
        factor = np.clip(leaves.seen / _PALE.texture_blade, 0.0, 1.0)
    else:
        factor = palette_of(leaves.model, season).factor(leaves.tint)
        if not leaf_model(leaves.model).flower:
            factor = factor * (_DEEP + (1 - _DEEP) * light[:, None])
    return np.column_stack([factor, np.ones(len(factor))])


def _passed(painting: Painting, palette: Palette) -> UInt8[np.ndarray, "row column 3"]:
    """The colour of the light that passes through, sRGB."""
    deep = palette.texture_blade**_DEEPER
    blade = deep * (_BRIGHT / deep.max())
    return albedo(painting, blade, _VEIN * blade, _STEM * linear(palette.stem))[..., :3].copy()
