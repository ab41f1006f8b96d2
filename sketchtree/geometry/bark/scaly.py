"""Barks that break into plates and flakes: apple, spruce, pine."""

import numpy as np

from sketchtree.geometry.bark.noise import clouds, mixed, ramp, scales
from sketchtree.geometry.bark.relief import Relief


def apple(pixels: int) -> Relief:
    """Thin irregular flakes, grey-brown, lighter where one has fallen."""
    border, value, place = scales(pixels, 71, 240, 1.7, 0.16)
    flake = ramp(border + 0.05 * clouds(pixels, 76, 0.01, 0.02, 1.3), 0.0, 0.26)
    lift = np.clip(0.5 + 0.45 * place[..., 1] + 0.2 * place[..., 0], 0.0, 1.0)  # flakes peel off at their lower ends
    grain = clouds(pixels, 74, 0.006, 0.012, 1.3)
    fallen = ramp(value, 0.78, 0.82)
    height = flake * (0.45 + 0.45 * lift) * (1.0 - 0.55 * fallen) + 0.05 * grain
    color = mixed(ramp(height, 0.0, 0.75), (0.26, 0.215, 0.185), (0.50, 0.45, 0.40))
    color = mixed(0.5 * fallen * flake, color, (0.56, 0.43, 0.32))
    color = mixed(0.4 * ramp(clouds(pixels, 75, 0.06, 0.06), 0.6, 2.0), color, (0.50, 0.51, 0.43))
    color *= (0.90 + 0.20 * value + 0.06 * grain)[..., None]
    return Relief(0.006 * height, color, 0.90 - 0.06 * flake)


def spruce(pixels: int) -> Relief:
    """Small rounded scales that overlap, reddish brown."""
    border, value, place = scales(pixels, 81, 420, 1.25, 0.14)
    scale = ramp(border, 0.0, 0.30)
    lift = np.clip(0.55 + 0.6 * place[..., 1], 0.0, 1.0)
    grain = clouds(pixels, 84, 0.005, 0.006, 1.2)
    height = scale * (0.35 + 0.55 * lift) + 0.06 * grain
    color = mixed(ramp(height, 0.05, 0.85), (0.20, 0.135, 0.105), (0.55, 0.415, 0.335))
    color = mixed(0.35 * ramp(value, 0.6, 1.0), color, (0.50, 0.44, 0.39))
    color *= (0.88 + 0.22 * value + 0.07 * grain + 0.06 * clouds(pixels, 85, 0.12, 0.12))[..., None]
    return Relief(0.005 * height, color, 0.90 - 0.05 * scale)


def pine(pixels: int) -> Relief:
    """Tall plates between dark fissures, orange-brown, built of thin layers like a torn book."""
    border, value, _ = scales(pixels, 91, 44, 2.4, 0.15)
    plate = ramp(border + 0.04 * clouds(pixels, 96, 0.01, 0.02, 1.3), 0.02, 0.30)
    layers = clouds(pixels, 94, 0.022, 0.03, 1.5) + 0.6 * (value - 0.5)
    steps = np.floor(2.2 * layers) / 2.2 + 0.25 * ramp((2.2 * layers) % 1.0, 0.7, 1.0)
    grain = clouds(pixels, 95, 0.006, 0.010, 1.2)
    height = plate * (0.72 + 0.16 * np.clip(steps, -1.5, 1.5)) + 0.03 * grain
    color = mixed(plate, (0.21, 0.135, 0.10), (0.63, 0.43, 0.295))
    color = mixed(plate * ramp(steps, -0.2, 1.2) * 0.55, color, (0.55, 0.45, 0.38))
    color = mixed(plate * ramp(-steps, 0.1, 1.2) * 0.55, color, (0.56, 0.31, 0.18))
    color *= (0.92 + 0.16 * value + 0.05 * grain)[..., None]
    return Relief(0.013 * height, color, 0.90 - 0.08 * plate)
