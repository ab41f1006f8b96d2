"""Barks that tear into ridges as the stem swells: oak, willow, poplar."""

from sketchtree.geometry.bark.noise import blurred, clouds, dashes, furrows, mixed, ramp, warped
from sketchtree.geometry.bark.relief import Relief


def oak(pixels: int) -> Relief:
    """Deep furrows that part and meet; ridges cracked across, grey-brown, with pale weathered tops."""
    sway = 0.012 * clouds(pixels, 12, 0.08, 0.08)
    deep = furrows(warped(clouds(pixels, 11, 0.0145, 0.10, 1.9), sway, 0 * sway), 0.66)
    cracks = furrows(warped(clouds(pixels, 13, 0.03, 0.011, 1.5), 0 * sway, 0.6 * sway), 0.20)
    grain = clouds(pixels, 14, 0.004, 0.016, 1.2)
    height = deep * (0.80 + 0.20 * cracks) + 0.05 * grain * deep
    color = mixed(ramp(height, 0.05, 0.85), (0.225, 0.185, 0.15), (0.585, 0.53, 0.465))
    color = mixed(ramp(clouds(pixels, 15, 0.09, 0.12), 0.3, 2.0) * deep * 0.35, color, (0.45, 0.46, 0.38))
    color *= (1.0 + 0.06 * grain + 0.06 * clouds(pixels, 16, 0.12, 0.2))[..., None]
    return Relief(0.014 * height, color, 0.92 - 0.06 * deep)


def willow(pixels: int) -> Relief:
    """A net of long narrow ridges, lighter and browner than oak's."""
    sway = 0.02 * clouds(pixels, 22, 0.07, 0.10)
    net = furrows(warped(clouds(pixels, 21, 0.012, 0.075, 1.6), sway, 0 * sway), 0.55)
    fine = furrows(warped(clouds(pixels, 23, 0.006, 0.05, 1.5), sway, 0 * sway), 0.35)
    height = net * (0.78 + 0.22 * fine)
    color = mixed(ramp(height, 0.0, 0.95), (0.185, 0.15, 0.115), (0.52, 0.455, 0.365))
    color *= (1.0 + 0.05 * clouds(pixels, 24, 0.005, 0.03, 1.2) + 0.06 * clouds(pixels, 25, 0.15, 0.2))[..., None]
    return Relief(0.010 * height, color, 0.93 - 0.05 * net)


def poplar(pixels: int) -> Relief:
    """Pale grey-green and still half smooth, with shallow long fissures and dark lozenges in rows."""
    sway = 0.015 * clouds(pixels, 32, 0.08, 0.12)
    torn = warped(clouds(pixels, 31, 0.022, 0.20, 1.8), sway, 0 * sway)
    fissure = 1.0 - (1.0 - furrows(torn, 0.30)) * ramp(clouds(pixels, 33, 0.06, 0.15), -0.6, 0.6)
    marks = dashes(pixels, 34, 90, (0.012, 0.05), (0.006, 0.014)) * ramp(clouds(pixels, 35, 0.05, 0.05), -0.8, 0.4) * 0.8
    soft = clouds(pixels, 36, 0.03, 0.05, 1.6)
    height = 0.8 * fissure + 0.05 * soft - 0.15 * marks
    color = mixed(fissure, (0.20, 0.18, 0.15), (0.55, 0.54, 0.47))
    color = mixed(0.75 * marks, color, (0.19, 0.175, 0.15))
    color *= (1.0 + 0.05 * soft + 0.05 * clouds(pixels, 37, 0.006, 0.006, 1.1))[..., None]
    return Relief(0.006 * blurred(height, 0.0015), color, 0.88 - 0.08 * fissure)
