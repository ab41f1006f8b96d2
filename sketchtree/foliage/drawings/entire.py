"""Which blades have a smooth or wavy edge? One function a species, in blade coordinates (joint at 0, tip at 1)."""

from sketchtree.foliage.outline import closed, smooth, wavy
from sketchtree.foliage.painting import Painting, paint_blade
from sketchtree.foliage.venation import midrib, parallel, pinnate


def beech() -> Painting:
    """Fagus sylvatica: oval with a wavy, hairy edge and straight side veins that end in its waves."""
    half = smooth([(0, 0), (0.10, 0.035), (0.22, 0.14), (0.31, 0.32), (0.325, 0.48), (0.27, 0.68), (0.16, 0.86), (0.06, 0.955), (0, 1)])
    outline = closed(wavy(half, 7, 0.010), wavy(half * [0.97, 1], 7, -0.010))
    veins = [midrib(0.14, 0.015)] + pinnate(outline, 8, first=0.05, last=0.80, angle=50.0, bend=10.0, width=0.009)
    return paint_blade(outline, veins, petiole=0.14, reticulation=0.8, seed=2)


def palm_leaflet() -> Painting:
    """Phoenix dactylifera: one leaflet of the frond, a stiff grooved blade with parallel veins."""
    half = smooth([(0, 0), (0.018, 0.01), (0.030, 0.08), (0.036, 0.25), (0.034, 0.5), (0.025, 0.75), (0.010, 0.93), (0, 1)])
    outline = closed(half)
    return paint_blade(outline, [midrib(0.0, 0.009)] + parallel(9, 0.036), petiole=0.0, reticulation=0.15, seed=9)


def lilac() -> Painting:
    """Syringa vulgaris: a smooth heart that narrows evenly to its point, leathery, on a long petiole."""
    half = smooth([(0, 0), (0.09, -0.035), (0.22, -0.035), (0.345, 0.07), (0.39, 0.22), (0.36, 0.39), (0.26, 0.60), (0.13, 0.81), (0.045, 0.93), (0, 1)])
    outline = closed(half, half * [0.96, 1.0])
    veins = [midrib(0.28, 0.017)] + pinnate(outline, 6, first=0.0, last=0.74, angle=54.0, bend=34.0, width=0.009)
    return paint_blade(outline, veins, petiole=0.28, reticulation=0.6, seed=21)


def olive() -> Painting:
    """Olea europaea: a narrow stiff lance, its edge smooth, of its veins hardly more than the midrib to be seen."""
    half = smooth([(0, 0), (0.035, 0.04), (0.075, 0.16), (0.10, 0.38), (0.10, 0.58), (0.07, 0.80), (0.028, 0.94), (0, 1)])
    outline = closed(half, half * [0.95, 1.0])
    veins = [midrib(0.08, 0.016)] + pinnate(outline, 5, first=0.10, last=0.75, angle=34.0, bend=16.0, width=0.003)
    return paint_blade(outline, veins, petiole=0.08, reticulation=0.2, seed=22)


def sword() -> Painting:
    """Dracaena draco: a stiff blade without a petiole, broadest at its clasping foot, with parallel veins."""
    half = smooth([(0, 0), (0.036, 0.004), (0.034, 0.06), (0.031, 0.3), (0.028, 0.6), (0.018, 0.85), (0.006, 0.97), (0, 1)])
    return paint_blade(closed(half), [midrib(0.0, 0.006)] + parallel(11, 0.030), petiole=0.0, reticulation=0.1, seed=23)


def fan_segment() -> Painting:
    """Trachycarpus fortunei: one fold of the fan, a wedge that touches its neighbours up to the middle and is free beyond."""
    half = smooth([(0, 0), (0.006, 0.005), (0.020, 0.22), (0.041, 0.50), (0.043, 0.60), (0.031, 0.80), (0.012, 0.95), (0, 1)])
    return paint_blade(closed(half), [midrib(0.0, 0.012)] + parallel(7, 0.034), petiole=0.0, reticulation=0.15, seed=24)
