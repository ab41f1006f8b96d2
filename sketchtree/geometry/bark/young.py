"""What covers wood that has no bark yet: young twigs, and the midribs of palm fronds."""

import numpy as np

from sketchtree.geometry.bark.noise import clouds, dashes, mixed, ramp
from sketchtree.geometry.bark.relief import Relief

YOUNG = {
    "oak": (0.47, 0.43, 0.35),
    "beech": (0.45, 0.38, 0.32),
    "birch": (0.37, 0.26, 0.21),
    "willow": (0.55, 0.49, 0.28),
    "poplar": (0.53, 0.47, 0.34),
    "apple": (0.43, 0.33, 0.28),
    "spruce": (0.56, 0.41, 0.28),
    "pine": (0.50, 0.40, 0.29),
    "palm": (0.46, 0.46, 0.29),
    "ash": (0.50, 0.48, 0.40),
    "lime": (0.46, 0.33, 0.27),
    "elm": (0.44, 0.36, 0.29),
    "maple": (0.47, 0.38, 0.29),
    "plane": (0.47, 0.43, 0.30),
    "cherry": (0.44, 0.34, 0.31),
    "chestnut": (0.46, 0.38, 0.31),
    "cypress": (0.45, 0.33, 0.24),
    "cedar": (0.50, 0.42, 0.33),
    "larch": (0.60, 0.50, 0.36),
    "coconut": (0.50, 0.48, 0.33),
    "fan_palm": (0.44, 0.45, 0.28),
    "dragon_tree": (0.52, 0.47, 0.36),
    "dead": (0.58, 0.56, 0.53),
}
"""Colour of one-year shoots under each bark, sRGB 0-1."""


def young(pixels: int, color: tuple[float, float, float]) -> Relief:
    """A smooth skin with a faint grain along the shoot, and pale lenticels."""
    grain = clouds(pixels, 101, 0.02, 0.15, 1.4)
    spots = dashes(pixels, 102, 60, (0.010, 0.022), (0.008, 0.014))
    skin = np.asarray(color) * (1.0 + 0.05 * grain + 0.05 * clouds(pixels, 103, 0.15, 0.2))[..., None]
    skin = mixed(0.35 * spots, skin, np.asarray(color) + 0.5 * (1.0 - np.asarray(color)))
    return Relief(0.0004 * grain + 0.0008 * spots, np.clip(skin, 0.0, 1.0), np.full((pixels, pixels), 0.72))


def rachis(pixels: int) -> Relief:
    """Green fibres, browner in streaks: the midrib of a palm's frond."""
    fibre = clouds(pixels, 111, 0.008, 0.4, 1.3)
    streak = ramp(clouds(pixels, 112, 0.04, 0.5), 0.2, 2.2)
    skin = mixed(0.55 * streak, (0.47, 0.53, 0.26), (0.53, 0.43, 0.26))
    skin *= (1.0 + 0.06 * fibre + 0.05 * clouds(pixels, 113, 0.2, 0.3))[..., None]
    return Relief(0.0008 * fibre, np.clip(skin, 0.0, 1.0), 0.62 + 0.15 * streak)
