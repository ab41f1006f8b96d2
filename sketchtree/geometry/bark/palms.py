"""Stems of palms and dragon trees: coconut, fan palm, dragon tree. The date palm's is `smooth.palm`."""

import numpy as np

from sketchtree.geometry.bark.noise import blurred, clouds, dashes, furrows, mixed, ramp
from sketchtree.geometry.bark.relief import Relief


def coconut(pixels: int) -> Relief:
    """Grey and nearly smooth, ringed by the scars of fallen fronds, with short upright cracks."""
    row = (np.mgrid[:pixels, :pixels][0] + 0.5) / pixels
    row = row + 0.012 * clouds(pixels, 231, 0.20, 0.03)
    ring = np.abs((7.0 * row) % 1.0 - 0.5) * 2.0  # 1 at a scar
    step = (7.0 * row) % 1.0
    scar = ramp(ring, 0.80, 0.97)
    crack = (1.0 - furrows(clouds(pixels, 232, 0.020, 0.035, 1.7), 0.12)) * ramp(clouds(pixels, 233, 0.06, 0.06), 0.0, 1.0)
    grain = clouds(pixels, 234, 0.004, 0.010, 1.2)
    color = mixed(ramp(step, 0.0, 1.0), (0.52, 0.48, 0.42), (0.60, 0.565, 0.50))
    color = mixed(0.65 * scar, color, (0.36, 0.32, 0.27))
    color = mixed(0.55 * crack, color, (0.27, 0.235, 0.20))
    color *= (1.0 + 0.05 * grain + 0.05 * clouds(pixels, 235, 0.08, 0.03))[..., None]
    return Relief(0.005 * blurred(0.5 * scar - 0.35 * crack + 0.04 * grain, 0.001), color, 0.86 - 0.04 * (1 - scar))


def fan_palm(pixels: int) -> Relief:
    """Wrapped in brown fibres that cross, with the stubs of old leaf stalks."""
    fibre = [furrows(_slanted(clouds(pixels, seed, 0.0035, 0.13, 1.5), slope), 0.6) for seed, slope in ((241, 1), (242, -1), (243, 0))]
    matted = np.maximum(0.9 * fibre[0], fibre[1]) * (0.6 + 0.4 * fibre[2])
    row, column = (np.mgrid[:pixels, :pixels] + 0.5) / pixels
    row, column = (place + 0.012 * clouds(pixels, seed, 0.05, 0.05) for place, seed in ((row, 244), (column, 245)))
    tier = np.floor(4.0 * row)
    stub = ramp(1.0 - np.hypot(((4.0 * column + 0.5 * tier) % 1.0 - 0.5) / 0.26, (4.0 * row % 1.0 - 0.45) / 0.13) + 0.10 * matted, 0.0, 0.5)
    color = mixed(ramp(matted, 0.2, 1.0), (0.20, 0.145, 0.105), (0.46, 0.36, 0.265))
    color = mixed(0.55 * stub, color, (0.43, 0.355, 0.27))
    color = color * (1.0 + 0.05 * clouds(pixels, 246, 0.10, 0.12))[..., None]
    return Relief(0.006 * matted * (1.0 - stub) + 0.012 * stub, color, 0.94 - 0.04 * stub)


def dragon_tree(pixels: int) -> Relief:
    """Silver grey, with level scars of leaves and a fine net of cracks, like hide."""
    scars = dashes(pixels, 251, 240, (0.06, 0.15), (0.004, 0.008))
    net = furrows(clouds(pixels, 252, 0.014, 0.012, 1.7), 0.20)
    skin = clouds(pixels, 253, 0.04, 0.03, 1.4)
    color = mixed(ramp(skin, -1.8, 1.8), (0.50, 0.475, 0.43), (0.62, 0.60, 0.555))
    color = mixed(0.55 * scars, color, (0.34, 0.30, 0.26))
    color = mixed(0.45 * (1.0 - net), color, (0.33, 0.29, 0.25))
    color = color * (1.0 + 0.04 * clouds(pixels, 254, 0.005, 0.005, 1.2))[..., None]
    return Relief(0.0035 * (0.5 * net + 0.1 * skin - 0.5 * scars), color, 0.82 + 0.05 * (1.0 - net))


def _slanted(noise, slope: int):
    """The tile sheared so that it climbs `slope` tiles across; it still repeats."""
    size = len(noise)
    row = (np.arange(size)[:, None] + slope * np.arange(size)[None]) % size
    return noise[row, np.arange(size)[None]]
