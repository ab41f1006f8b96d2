"""Which blades are cut into lobes? One function a species, in blade coordinates (joint at 0, tip at 1)."""

from sketchtree.foliage.outline import closed, pointed, rounded
from sketchtree.foliage.painting import Painting, paint_blade
from sketchtree.foliage.venation import branching, midrib, pinnate, reaching


def oak() -> Painting:
    """Quercus robur: obovate with four to five round lobes a side, small ears at a very short petiole."""
    right = rounded([
        (0, 0), (0.075, -0.02), (0.085, 0.03), (0.045, 0.09), (0.095, 0.125), (0.195, 0.185), (0.205, 0.255), (0.105, 0.285),
        (0.105, 0.335), (0.255, 0.38), (0.275, 0.46), (0.135, 0.475), (0.14, 0.535), (0.31, 0.59), (0.335, 0.675), (0.175, 0.68),
        (0.175, 0.735), (0.31, 0.79), (0.30, 0.875), (0.145, 0.85), (0.14, 0.905), (0.175, 0.955), (0.10, 1.01), (0, 1.02),
    ], 0.034)  # fmt: skip
    left = rounded([
        (0, 0), (0.07, -0.025), (0.08, 0.02), (0.04, 0.07), (0.08, 0.095), (0.165, 0.145), (0.175, 0.21), (0.09, 0.235),
        (0.095, 0.285), (0.24, 0.33), (0.265, 0.41), (0.13, 0.425), (0.135, 0.485), (0.305, 0.53), (0.33, 0.62), (0.18, 0.63),
        (0.18, 0.685), (0.325, 0.74), (0.325, 0.825), (0.16, 0.815), (0.16, 0.875), (0.205, 0.935), (0.12, 1.0), (0, 1.02),
    ], 0.034)  # fmt: skip
    outline = closed(right, left)
    veins = [midrib(0.06, 0.017)]
    veins += reaching([(0.10, 0.155, 0.215), (0.24, 0.235, 0.405), (0.42, 0.285, 0.61), (0.60, 0.255, 0.815), (0.76, 0.13, 0.935)], 0.0095)
    veins += reaching([(0.17, 0.10, 0.29), (0.34, 0.14, 0.475), (0.52, 0.18, 0.68)], 0.005)
    return paint_blade(outline, veins, petiole=0.06, seed=1)


def maple() -> Painting:
    """Acer platanoides: five pointed lobes with a few long teeth and round bays, on a long petiole."""
    right = pointed([
        (0, 0), (0.09, -0.085), (0.24, -0.115), (0.44, -0.075), (0.41, 0.0), (0.53, 0.085), (0.40, 0.135), (0.355, 0.20),
        (0.50, 0.235), (0.655, 0.235), (0.575, 0.335), (0.68, 0.535), (0.515, 0.525), (0.455, 0.635), (0.335, 0.51), (0.205, 0.435),
        (0.195, 0.56), (0.305, 0.735), (0.17, 0.725), (0.125, 0.855), (0.06, 0.885), (0, 1),
    ], 0.07)  # fmt: skip
    left = pointed([
        (0, 0), (0.10, -0.09), (0.23, -0.11), (0.42, -0.085), (0.40, 0.0), (0.51, 0.075), (0.385, 0.13), (0.345, 0.205),
        (0.51, 0.255), (0.635, 0.265), (0.56, 0.355), (0.66, 0.555), (0.505, 0.535), (0.43, 0.65), (0.32, 0.515), (0.195, 0.445),
        (0.185, 0.57), (0.285, 0.715), (0.175, 0.735), (0.12, 0.86), (0.055, 0.89), (0, 1),
    ], 0.07)  # fmt: skip
    outline = closed(right, left)
    veins = [midrib(0.62, 0.015)]
    lobes = reaching([(0.0, 0.645, 0.51), (0.0, 0.49, 0.065)], 0.012, bow=-0.03)
    veins += lobes
    for lobe in lobes:
        veins += branching(outline, lobe, 3, angle=42.0, width=0.006)
    veins += pinnate(outline, 5, first=0.22, last=0.84, angle=42.0, bend=8.0, width=0.006)
    return paint_blade(outline, veins, petiole=0.62, seed=3)


def plane() -> Painting:
    """Platanus x hispanica: broad, five triangular lobes cut to less than half, each with a few large teeth."""
    right = pointed([
        (0, 0), (0.10, -0.115), (0.24, -0.13), (0.31, -0.075), (0.55, -0.085), (0.485, 0.03), (0.60, 0.10), (0.47, 0.16), (0.435, 0.225),
        (0.56, 0.26), (0.60, 0.335), (0.76, 0.47), (0.60, 0.475), (0.585, 0.57), (0.42, 0.505), (0.275, 0.50),
        (0.30, 0.63), (0.37, 0.72), (0.225, 0.725), (0.20, 0.84), (0.085, 0.85), (0, 1),
    ], 0.05)  # fmt: skip
    left = pointed([
        (0, 0), (0.09, -0.105), (0.26, -0.125), (0.33, -0.085), (0.53, -0.11), (0.495, 0.02), (0.59, 0.075), (0.455, 0.15), (0.42, 0.215),
        (0.575, 0.275), (0.62, 0.35), (0.74, 0.50), (0.59, 0.49), (0.555, 0.59), (0.41, 0.515), (0.265, 0.51),
        (0.285, 0.625), (0.35, 0.745), (0.215, 0.735), (0.185, 0.825), (0.075, 0.865), (0, 1),
    ], 0.05)  # fmt: skip
    outline = closed(right, left)
    veins = [midrib(0.42, 0.017)]
    lobes = reaching([(0.03, 0.72, 0.47), (0.0, 0.52, -0.06)], 0.014, bow=-0.04)
    veins += lobes
    for lobe in lobes:
        veins += branching(outline, lobe, 4, angle=40.0, width=0.007)
    veins += pinnate(outline, 5, first=0.25, last=0.84, angle=40.0, bend=8.0, width=0.007)
    return paint_blade(outline, veins, petiole=0.42, seed=31)


def hawthorn() -> Painting:
    """Crataegus monogyna: small, a wedge cut deeply into three to seven lobes that are toothed at their ends."""
    right = rounded([
        (0, 0), (0.035, 0.10), (0.11, 0.185), (0.25, 0.20), (0.335, 0.235), (0.325, 0.29), (0.29, 0.315), (0.175, 0.365),
        (0.22, 0.43), (0.355, 0.475), (0.385, 0.52), (0.355, 0.56), (0.36, 0.60), (0.275, 0.615), (0.165, 0.63),
        (0.19, 0.70), (0.265, 0.775), (0.255, 0.82), (0.20, 0.83), (0.20, 0.88), (0.13, 0.90), (0.10, 0.975), (0, 1),
    ], 0.02)  # fmt: skip
    left = rounded([
        (0, 0), (0.03, 0.09), (0.09, 0.15), (0.22, 0.155), (0.305, 0.185), (0.305, 0.235), (0.27, 0.27), (0.16, 0.32),
        (0.205, 0.385), (0.345, 0.44), (0.37, 0.485), (0.34, 0.525), (0.345, 0.565), (0.26, 0.585), (0.155, 0.60),
        (0.18, 0.67), (0.27, 0.745), (0.255, 0.79), (0.205, 0.805), (0.20, 0.86), (0.14, 0.88), (0.09, 0.96), (0, 1),
    ], 0.02)  # fmt: skip
    outline = closed(right, left)
    veins = [midrib(0.30, 0.017)]
    veins += reaching([(0.10, 0.275, 0.245), (0.28, 0.325, 0.52), (0.52, 0.20, 0.79)], 0.011)
    veins += pinnate(outline, 3, first=0.62, last=0.82, angle=36.0, bend=8.0, width=0.006)
    return paint_blade(outline, veins, petiole=0.30, seed=32)
