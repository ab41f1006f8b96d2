"""Which bark does the wood wear?"""

from functools import lru_cache

import numpy as np

from sketchtree.errors import OptionError
from sketchtree.geometry.mesh import Material

_NAMES = ("oak", "beech", "birch", "willow", "poplar", "apple", "spruce", "pine", "palm")


def bark_names() -> tuple[str, ...]:
    """Names of all barks."""
    return _NAMES


@lru_cache
def bark_material(name: str, pixels: int = 512) -> Material:
    """The bark called `name`, as a material called `wood_<name>`."""
    if name not in _NAMES:
        raise OptionError(f"There is no bark called `{name}`.", remedy=f"Choose one of: {', '.join(_NAMES)}.")
    color = np.full((64, 64, 3), (116, 96, 78), np.uint8)
    return Material(f"wood_{name}", base_color_texture=color)
