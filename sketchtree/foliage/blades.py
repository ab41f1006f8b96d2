"""How is each broad leaf drawn? One function a species, in blade coordinates (joint at 0, tip at 1)."""

from sketchtree.foliage.outline import closed, pointed, rounded, serrate, smooth, wavy
from sketchtree.foliage.painting import Painting, paint_blade
from sketchtree.foliage.venation import branching, midrib, parallel, pinnate, reaching


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


def beech() -> Painting:
    """Fagus sylvatica: oval with a wavy, hairy edge and straight side veins that end in its waves."""
    half = smooth([(0, 0), (0.10, 0.035), (0.22, 0.14), (0.31, 0.32), (0.325, 0.48), (0.27, 0.68), (0.16, 0.86), (0.06, 0.955), (0, 1)])
    outline = closed(wavy(half, 7, 0.010), wavy(half * [0.97, 1], 7, -0.010))
    veins = [midrib(0.14, 0.015)] + pinnate(outline, 8, first=0.05, last=0.80, angle=50.0, bend=10.0, width=0.009)
    return paint_blade(outline, veins, petiole=0.14, reticulation=0.8, seed=2)


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


def birch() -> Painting:
    """Betula pendula: a rhomb drawn out to a point, doubly toothed."""
    half = smooth([(0, 0), (0.10, 0.012), (0.25, 0.09), (0.365, 0.24), (0.355, 0.33), (0.235, 0.54), (0.105, 0.77), (0.035, 0.91), (0, 1)])
    outline = closed(serrate(half, 13, 0.034, double=0.35), serrate(half * [0.97, 1], 13, 0.034, double=0.35, phase=0.4))
    veins = [midrib(0.34, 0.014)] + pinnate(outline, 6, first=0.05, last=0.74, angle=50.0, bend=14.0, width=0.0085)
    return paint_blade(outline, veins, petiole=0.34, seed=4)


def willow() -> Painting:
    """Salix babylonica: a narrow lance, finely toothed, often a little sickle-shaped."""
    half = smooth([(0, 0), (0.026, 0.03), (0.060, 0.14), (0.079, 0.32), (0.075, 0.5), (0.054, 0.72), (0.023, 0.89), (0, 1)])
    outline = closed(serrate(half, 42, 0.0035), serrate(half * [0.95, 1], 42, 0.0035, phase=0.5))
    veins = [midrib(0.07, 0.011)] + pinnate(outline, 16, first=0.05, last=0.85, angle=46.0, bend=26.0, width=0.0032)
    return paint_blade(outline, veins, petiole=0.07, reticulation=0.5, seed=5)


def poplar() -> Painting:
    """Populus nigra 'Italica': a broad delta with a clear rim, on a long flattened petiole."""
    half = smooth([(0, 0), (0.14, -0.005), (0.32, 0.06), (0.455, 0.19), (0.455, 0.29), (0.305, 0.49), (0.135, 0.73), (0.045, 0.89), (0, 1)])
    outline = closed(serrate(half, 17, 0.018), serrate(half * [0.97, 1], 17, 0.018, phase=0.5))
    veins = [midrib(0.55, 0.017)] + pinnate(outline, 5, first=0.02, last=0.66, angle=56.0, bend=24.0, width=0.011)
    return paint_blade(outline, veins, petiole=0.55, seed=6)


def apple() -> Painting:
    """Malus domestica: elliptic with a short point, bluntly toothed, the halves tilted up."""
    half = smooth([(0, 0), (0.11, 0.03), (0.22, 0.14), (0.295, 0.34), (0.295, 0.52), (0.225, 0.74), (0.11, 0.90), (0.04, 0.965), (0, 1)])
    outline = closed(serrate(half, 20, 0.018, double=0.25), serrate(half * [0.96, 1], 20, 0.018, double=0.25, phase=0.3))
    veins = [midrib(0.30, 0.017)] + pinnate(outline, 6, first=0.06, last=0.76, angle=52.0, bend=28.0, width=0.009)
    return paint_blade(outline, veins, petiole=0.30, seed=7)


def hazel() -> Painting:
    """Corylus avellana: nearly round with a heart-shaped foot and a sudden point, doubly toothed."""
    half = smooth([(0, 0), (0.07, -0.045), (0.20, -0.04), (0.345, 0.09), (0.42, 0.30), (0.43, 0.50), (0.36, 0.70), (0.19, 0.875), (0.055, 0.935), (0, 1)])
    outline = closed(serrate(half, 15, 0.034, double=0.4), serrate(half * [0.97, 1], 15, 0.034, double=0.4, phase=0.5))
    veins = [midrib(0.16, 0.017)] + pinnate(outline, 7, first=0.03, last=0.76, angle=52.0, bend=10.0, width=0.0105)
    return paint_blade(outline, veins, petiole=0.16, reticulation=1.3, seed=8)


def palm_leaflet() -> Painting:
    """Phoenix dactylifera: one leaflet of the frond, a stiff grooved blade with parallel veins."""
    half = smooth([(0, 0), (0.018, 0.01), (0.030, 0.08), (0.036, 0.25), (0.034, 0.5), (0.025, 0.75), (0.010, 0.93), (0, 1)])
    outline = closed(half)
    return paint_blade(outline, [midrib(0.0, 0.009)] + parallel(9, 0.036), petiole=0.0, reticulation=0.15, seed=9)
