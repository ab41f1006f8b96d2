"""Barks with a net of ribs or long cracks: ash, lime, elm, maple, and dead wood."""

import numpy as np

from sketchtree.geometry.bark.noise import clouds, furrows, mixed, ramp, warped
from sketchtree.geometry.bark.relief import Relief


def ash(pixels: int) -> Relief:
    """A regular net: narrow interlacing ribs round upright lozenges, pale grey."""
    row, column = (np.mgrid[:pixels, :pixels] + 0.5) / pixels
    sway_x, sway_y = 0.030 * clouds(pixels, 121, 0.05, 0.12), 0.05 * clouds(pixels, 122, 0.08, 0.10)
    a, b = 7.0 * (column + sway_x) + 2.0 * (row + sway_y), 7.0 * (column + sway_x) - 2.0 * (row + sway_y)
    rib = np.maximum(*(np.exp(-((np.abs(f % 1.0 - 0.5) / 0.20) ** 2)) for f in (a, b)))
    torn = clouds(pixels, 123, 0.012, 0.03, 1.4)
    fine = furrows(warped(clouds(pixels, 124, 0.007, 0.05, 1.5), sway_x, 0 * sway_x), 0.4)
    height = ramp(rib + 0.10 * torn, 0.05, 0.95) * (0.80 + 0.20 * fine)
    color = mixed(ramp(height, 0.0, 0.9), (0.30, 0.275, 0.24), (0.585, 0.555, 0.50))
    color = mixed(0.30 * ramp(clouds(pixels, 125, 0.09, 0.10), 0.4, 2.0), color, (0.52, 0.53, 0.42))
    color *= (1.0 + 0.05 * torn + 0.04 * clouds(pixels, 126, 0.15, 0.2))[..., None]
    return Relief(0.011 * height, color, 0.92 - 0.06 * height)


def lime(pixels: int) -> Relief:
    """Shallow and even: long flat ribs side by side, dark grey, with narrow cracks between."""
    sway = 0.014 * clouds(pixels, 131, 0.06, 0.14)
    ribs = furrows(warped(clouds(pixels, 132, 0.011, 0.16, 1.8), sway, 0 * sway), 0.42)
    cross = furrows(clouds(pixels, 133, 0.03, 0.012, 1.5), 0.14)
    grain = clouds(pixels, 134, 0.004, 0.020, 1.2)
    height = ribs * (0.86 + 0.14 * cross) + 0.04 * grain
    color = mixed(ramp(height, 0.05, 0.9), (0.235, 0.205, 0.175), (0.505, 0.475, 0.425))
    color *= (1.0 + 0.05 * grain + 0.06 * clouds(pixels, 135, 0.12, 0.2))[..., None]
    return Relief(0.007 * height, color, 0.92 - 0.05 * ribs)


def elm(pixels: int) -> Relief:
    """Broad corky ridges that cross each other, in layers, with deep furrows; ash grey."""
    sway = 0.022 * clouds(pixels, 141, 0.09, 0.12)
    deep = furrows(warped(clouds(pixels, 142, 0.021, 0.085, 1.8), sway, 0 * sway), 0.60)
    flakes = clouds(pixels, 143, 0.016, 0.026, 1.5)
    steps = np.floor(2.0 * flakes) / 2.0 + 0.3 * ramp((2.0 * flakes) % 1.0, 0.6, 1.0)
    height = deep * (0.82 + 0.13 * np.clip(steps, -1.2, 1.2))
    color = mixed(ramp(height, 0.05, 0.85), (0.21, 0.185, 0.16), (0.53, 0.50, 0.455))
    color = mixed(0.35 * deep * ramp(-steps, 0.2, 1.2), color, (0.46, 0.39, 0.32))
    color *= (1.0 + 0.06 * clouds(pixels, 144, 0.005, 0.01, 1.2) + 0.05 * clouds(pixels, 145, 0.12, 0.15))[..., None]
    return Relief(0.015 * height, color, 0.93 - 0.05 * deep)


def maple(pixels: int) -> Relief:
    """Norway maple: shallow, close, interlacing ridges, not scaly, grey-brown."""
    sway = 0.012 * clouds(pixels, 151, 0.05, 0.08)
    net = furrows(warped(clouds(pixels, 152, 0.009, 0.055, 1.7), sway, 0 * sway), 0.50)
    grain = clouds(pixels, 153, 0.004, 0.010, 1.2)
    height = net + 0.05 * grain
    color = mixed(ramp(height, 0.0, 0.95), (0.245, 0.21, 0.18), (0.50, 0.46, 0.405))
    color = mixed(0.28 * ramp(clouds(pixels, 154, 0.07, 0.09), 0.5, 2.0), color, (0.50, 0.52, 0.43))
    color *= (1.0 + 0.05 * grain + 0.05 * clouds(pixels, 155, 0.14, 0.18))[..., None]
    return Relief(0.006 * height, color, 0.92 - 0.05 * net)


def dead(pixels: int) -> Relief:
    """Wood without its bark: silver grey, in long fibres, with drying cracks and a few holes of beetles."""
    sway = 0.010 * clouds(pixels, 161, 0.10, 0.25)
    fibre = warped(clouds(pixels, 162, 0.0035, 0.22, 1.5), sway, 0 * sway)
    bands = warped(clouds(pixels, 163, 0.018, 0.40, 1.7), sway, 0 * sway)
    crack = 1.0 - furrows(warped(clouds(pixels, 164, 0.016, 0.20, 1.9), sway, 0 * sway), 0.06)
    crack *= ramp(clouds(pixels, 165, 0.035, 0.12), -0.1, 0.7)
    holes = ramp(clouds(pixels, 166, 0.006, 0.007, 2.2), 2.9, 3.2)
    dark = np.clip(crack + holes, 0.0, 1.0)
    color = mixed(ramp(bands, -1.8, 1.8), (0.47, 0.45, 0.42), (0.66, 0.645, 0.615))
    color *= (1.0 + 0.09 * fibre)[..., None]
    color = mixed(0.80 * dark, color, (0.16, 0.14, 0.125))
    return Relief(0.003 * (0.25 * fibre + 0.3 * bands) - 0.006 * dark, color, 0.80 + 0.12 * dark)
