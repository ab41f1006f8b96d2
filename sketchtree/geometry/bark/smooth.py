"""Barks that stay whole: beech, birch, palm."""

import numpy as np

from sketchtree.geometry.bark.noise import blurred, clouds, dashes, mixed, ramp, warped
from sketchtree.geometry.bark.relief import Relief


def beech(pixels: int) -> Relief:
    """Smooth silver grey, faintly creased across, with patches of pale and of green lichen."""
    creases = clouds(pixels, 41, 0.07, 0.006, 1.6)
    skin = clouds(pixels, 42, 0.02, 0.02, 1.4)
    spots = ramp(clouds(pixels, 43, 0.045, 0.035, 1.3), 0.7, 2.0)
    moss = ramp(clouds(pixels, 44, 0.10, 0.16, 1.4), 0.9, 2.4)
    fine = clouds(pixels, 45, 0.004, 0.004, 1.0)
    height = 0.5 + 0.12 * creases + 0.10 * skin + 0.03 * fine
    color = np.array([0.57, 0.56, 0.525]) * (1.0 + 0.035 * creases + 0.05 * skin + 0.03 * fine)[..., None]
    color = mixed(0.55 * spots, color, (0.69, 0.69, 0.655))
    color = mixed(0.25 * moss, color, (0.40, 0.43, 0.31))
    marks = dashes(pixels, 46, 40, (0.01, 0.035), (0.002, 0.005))
    return Relief(0.0022 * (height - 0.2 * marks), mixed(0.35 * marks, color, (0.30, 0.29, 0.27)), 0.78 + 0.04 * skin)


def birch(pixels: int) -> Relief:
    """White paper with dark lenticels across it, peeling edges, and some black torn patches."""
    sway = 0.006 * clouds(pixels, 52, 0.10, 0.05)
    short = dashes(pixels, 51, 150, (0.02, 0.09), (0.003, 0.007))
    long = dashes(pixels, 53, 22, (0.12, 0.34), (0.003, 0.006))
    lenticels = warped(np.maximum(short, 0.85 * long), 0 * sway, sway)
    torn = clouds(pixels, 54, 0.055, 0.045, 1.5) + 0.35 * clouds(pixels, 55, 0.012, 0.03, 1.3)
    patch = ramp(torn, 1.75, 2.15)
    bands = clouds(pixels, 56, 0.25, 0.012, 1.8)
    color = mixed(ramp(bands, -1.5, 2.0), (0.845, 0.82, 0.775), (0.91, 0.90, 0.875))
    color = mixed(0.30 * ramp(clouds(pixels, 57, 0.12, 0.07), 0.4, 2.2), color, (0.80, 0.71, 0.60))
    color = mixed(0.90 * ramp(lenticels, 0.12, 0.6), color, (0.20, 0.175, 0.16))
    rough = clouds(pixels, 58, 0.010, 0.018, 1.3)
    color = mixed(patch, color, np.array([0.135, 0.12, 0.11]) * (1.0 + 0.25 * rough)[..., None])
    height = 0.5 + 0.05 * bands - 0.20 * lenticels + patch * (0.2 + 0.25 * rough)
    return Relief(0.004 * height, color, 0.66 + 0.25 * np.maximum(patch, 0.5 * lenticels))


def palm(pixels: int) -> Relief:
    """Leaf scars: low broad lozenges in spiral rows, each with a fibrous lip at its upper edge."""
    row, column = (np.mgrid[:pixels, :pixels] + 0.5) / pixels
    row = row + 0.010 * clouds(pixels, 61, 0.04, 0.04)
    column = column + 0.012 * clouds(pixels, 62, 0.04, 0.04)
    a, b = 3.0 * column + 4.0 * row, 3.0 * column - 4.0 * row  # two families of spiral rows
    to_border = np.minimum(0.5 - np.abs(a % 1.0 - 0.5), 0.5 - np.abs(b % 1.0 - 0.5))
    up = 0.5 * ((b - np.floor(b)) + 1.0 - (a - np.floor(a)))  # 0 at the foot of a lozenge, 1 at its top
    fibre = clouds(pixels, 63, 0.003, 0.05, 1.3)
    lip = ramp(to_border + 0.02 * clouds(pixels, 65, 0.01, 0.03, 1.3), -0.03, 0.10)
    height = lip * (0.35 + 0.65 * up) + 0.04 * fibre
    tone = np.floor(a) * 7.0 % 2.0 * 0.5 + np.floor(b) * 5.0 % 2.0 * 0.5  # scars differ a little
    color = mixed(ramp(height, 0.05, 0.9), (0.24, 0.19, 0.145), (0.55, 0.465, 0.365))
    color *= (1.0 + 0.10 * fibre + 0.05 * (tone - 0.5) + 0.05 * clouds(pixels, 64, 0.1, 0.1))[..., None]
    return Relief(0.012 * blurred(height, 0.002), color, 0.93 - 0.05 * lip)
