"""Barks that come off in flakes, bands and strips: plane, cherry, cypress, cedar, horse chestnut, larch."""

import numpy as np

from sketchtree.geometry.bark.noise import blurred, clouds, dashes, furrows, mixed, ramp, scales, warped
from sketchtree.geometry.bark.relief import Relief


def plane(pixels: int) -> Relief:
    """A map of flakes: grey-olive where they hold, cream and pale green where they have just fallen."""
    row_sway, column_sway = (0.022 * clouds(pixels, seed, 0.018, 0.024, 1.5) for seed in (171, 172))
    ages = [ramp(warped(clouds(pixels, seed, 0.030, 0.045, 1.7), column_sway, row_sway), low, low + 0.12) for seed, low in ((173, -0.75), (174, 0.10), (175, 0.55))]
    color = np.broadcast_to(np.array([0.755, 0.725, 0.60]), (pixels, pixels, 3))
    for age, flake in zip(ages, ((0.635, 0.615, 0.505), (0.545, 0.525, 0.45), (0.46, 0.44, 0.39)), strict=True):
        color = mixed(age, color, flake)
    rims = sum(4.0 * age * (1.0 - age) for age in ages)
    dots = dashes(pixels, 176, 130, (0.004, 0.010), (0.003, 0.005))
    height = 0.30 * sum(ages) + 0.03 * clouds(pixels, 177, 0.008, 0.008, 1.3)
    color = color * (1.0 - 0.14 * np.clip(rims, 0, 1) - 0.25 * dots + 0.03 * clouds(pixels, 178, 0.03, 0.04, 1.3))[..., None]
    return Relief(0.0035 * blurred(height, 0.0015), color, 0.70 + 0.06 * sum(ages))


def cherry(pixels: int) -> Relief:
    """Glossy red-brown skin in level bands, with rows of corky lenticels; it peels round the stem."""
    sway = 0.010 * clouds(pixels, 181, 0.12, 0.05)
    bands = warped(clouds(pixels, 182, 0.35, 0.022, 1.8), 0 * sway, sway)
    lenticels = warped(np.maximum(dashes(pixels, 183, 90, (0.05, 0.16), (0.006, 0.013)), dashes(pixels, 184, 130, (0.015, 0.05), (0.004, 0.008))), 0 * sway, sway)
    peeled = ramp(bands + 0.35 * clouds(pixels, 185, 0.06, 0.015, 1.4), 0.7, 0.95)
    color = mixed(ramp(bands, -1.6, 1.4), (0.315, 0.215, 0.185), (0.455, 0.345, 0.305))
    color = mixed(0.75 * peeled, color, (0.54, 0.47, 0.43))
    color = mixed(0.85 * ramp(lenticels, 0.10, 0.5), color, (0.50, 0.385, 0.30))
    color = color * (1.0 + 0.05 * clouds(pixels, 186, 0.010, 0.004, 1.3))[..., None]
    height = 0.15 * bands + 0.35 * peeled + 0.8 * blurred(lenticels, 0.0012)
    return Relief(0.0032 * height, color, 0.46 + 0.30 * np.maximum(peeled, ramp(lenticels, 0.1, 0.6)))


def cypress(pixels: int) -> Relief:
    """Thin fibrous strips that run up the stem, a little spiralled, grey over red-brown: cypress and juniper."""
    sway = 0.030 * clouds(pixels, 191, 0.10, 0.22)
    strips = furrows(warped(clouds(pixels, 192, 0.0095, 0.28, 1.8), sway, 0 * sway), 0.38)
    fibre = warped(clouds(pixels, 193, 0.003, 0.12, 1.4), sway, 0 * sway)
    shed = ramp(warped(clouds(pixels, 194, 0.018, 0.22, 1.6), sway, 0 * sway), 0.7, 1.1)
    height = strips * (1.0 - 0.4 * shed) + 0.08 * fibre
    color = mixed(ramp(height, 0.0, 0.95), (0.245, 0.165, 0.125), (0.535, 0.475, 0.42))
    color = mixed(0.65 * shed * strips, color, (0.52, 0.34, 0.245))
    color *= (1.0 + 0.07 * fibre + 0.04 * clouds(pixels, 195, 0.14, 0.2))[..., None]
    return Relief(0.006 * height, color, 0.92 - 0.05 * strips)


def cedar(pixels: int) -> Relief:
    """Dark grey-brown plates, small and square, in vertical rows between shallow cracks."""
    border, value, place = scales(pixels, 201, 150, 1.55, 0.15)
    plate = ramp(border + 0.05 * clouds(pixels, 206, 0.01, 0.014, 1.3), 0.0, 0.24)
    upright = furrows(clouds(pixels, 204, 0.030, 0.25, 1.9), 0.22)
    grain = clouds(pixels, 205, 0.004, 0.012, 1.2)
    height = plate * (0.62 + 0.30 * upright + 0.10 * (value - 0.5)) + 0.05 * grain
    color = mixed(ramp(height, 0.05, 0.85), (0.185, 0.15, 0.125), (0.455, 0.405, 0.36))
    color *= (0.90 + 0.20 * value + 0.06 * grain)[..., None]
    return Relief(0.009 * height, color, 0.92 - 0.05 * plate)


def larch(pixels: int) -> Relief:
    """Thick scaly ridges, grey outside and rose-red where scales broke off."""
    border, value, place = scales(pixels, 211, 90, 2.0, 0.17)
    plate = ramp(border + 0.05 * clouds(pixels, 216, 0.01, 0.02, 1.3), 0.02, 0.30)
    lift = np.clip(0.55 + 0.40 * place[..., 1], 0.0, 1.0)
    grain = clouds(pixels, 214, 0.005, 0.010, 1.2)
    broken = ramp(value + 0.12 * clouds(pixels, 215, 0.02, 0.03), 0.55, 0.75)
    height = plate * (0.55 + 0.45 * lift) * (1.0 - 0.35 * broken) + 0.05 * grain
    color = mixed(ramp(height, 0.05, 0.85), (0.22, 0.145, 0.12), (0.545, 0.475, 0.42))
    color = mixed(0.50 * plate * broken, color, (0.55, 0.39, 0.32))
    color *= (0.92 + 0.14 * value + 0.06 * grain)[..., None]
    return Relief(0.012 * height, color, 0.91 - 0.06 * plate)


def chestnut(pixels: int) -> Relief:
    """Horse chestnut: large scales that curl away at their edges, grey with a pinkish cast."""
    border, value, place = scales(pixels, 221, 62, 1.7, 0.19)
    scale = ramp(border + 0.05 * clouds(pixels, 226, 0.012, 0.02, 1.3), 0.0, 0.18)
    curl = np.clip(0.5 + 0.35 * place[..., 1] + 0.30 * place[..., 0], 0.0, 1.2)
    grain = clouds(pixels, 224, 0.006, 0.014, 1.3)
    height = scale * (0.35 + 0.60 * curl + 0.15 * (value - 0.5)) + 0.05 * grain
    color = mixed(ramp(height, 0.0, 0.85), (0.235, 0.195, 0.17), (0.50, 0.455, 0.415))
    color = mixed(0.30 * ramp(clouds(pixels, 225, 0.07, 0.10), 0.3, 2.0), color, (0.46, 0.47, 0.40))
    color *= (0.92 + 0.15 * value + 0.06 * grain)[..., None]
    return Relief(0.009 * height, color, 0.90 - 0.06 * scale)
