"""Which blades have teeth? One function a species, in blade coordinates (joint at 0, tip at 1)."""

from sketchtree.foliage.outline import closed, serrate, smooth
from sketchtree.foliage.painting import Painting, paint_blade
from sketchtree.foliage.venation import midrib, pinnate


def birch() -> Painting:
    """Betula pendula: a rhomb drawn out to a point, doubly toothed."""
    half = smooth([(0, 0), (0.10, 0.012), (0.25, 0.09), (0.365, 0.24), (0.355, 0.33), (0.235, 0.54), (0.105, 0.77), (0.035, 0.91), (0, 1)])
    outline = closed(serrate(half, 13, 0.034, double=0.35), serrate(half * [0.97, 1], 13, 0.034, double=0.35, phase=0.4))
    veins = [midrib(0.34, 0.014)] + pinnate(outline, 6, first=0.05, last=0.74, angle=50.0, bend=14.0, width=0.0085)
    return paint_blade(outline, veins, petiole=0.34, seed=4)


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


def willow() -> Painting:
    """Salix babylonica: a narrow lance, finely toothed, often a little sickle-shaped."""
    half = smooth([(0, 0), (0.026, 0.03), (0.060, 0.14), (0.079, 0.32), (0.075, 0.5), (0.054, 0.72), (0.023, 0.89), (0, 1)])
    outline = closed(serrate(half, 42, 0.0035), serrate(half * [0.95, 1], 42, 0.0035, phase=0.5))
    veins = [midrib(0.07, 0.011)] + pinnate(outline, 16, first=0.05, last=0.85, angle=46.0, bend=26.0, width=0.0032)
    return paint_blade(outline, veins, petiole=0.07, reticulation=0.5, seed=5)


def lime() -> Painting:
    """Tilia cordata: a lopsided heart with a sudden point, finely and sharply toothed, on a long petiole."""
    right = smooth([(0, 0), (0.08, -0.075), (0.22, -0.085), (0.38, 0.03), (0.475, 0.22), (0.465, 0.42), (0.36, 0.64), (0.18, 0.83), (0.05, 0.925), (0, 1)])
    left = smooth([(0, 0), (0.07, -0.03), (0.20, -0.02), (0.35, 0.09), (0.43, 0.26), (0.425, 0.45), (0.335, 0.655), (0.165, 0.835), (0.045, 0.925), (0, 1)])
    outline = closed(serrate(right, 27, 0.017), serrate(left, 25, 0.017, phase=0.4))
    veins = [midrib(0.55, 0.015)] + pinnate(outline, 6, first=0.01, last=0.72, angle=54.0, bend=20.0, width=0.0095)
    return paint_blade(outline, veins, petiole=0.55, seed=11)


def elm() -> Painting:
    """Ulmus americana: oval with an oblique foot, one half starting lower, doubly toothed, with many straight side veins."""
    right = smooth([(0, 0), (0.07, -0.02), (0.17, 0.03), (0.265, 0.20), (0.295, 0.40), (0.26, 0.60), (0.165, 0.80), (0.06, 0.93), (0, 1)])
    left = smooth([(0, 0), (0.008, 0.045), (0.055, 0.075), (0.15, 0.16), (0.235, 0.32), (0.25, 0.48), (0.205, 0.68), (0.115, 0.85), (0.04, 0.945), (0, 1)])
    outline = closed(serrate(right, 17, 0.034, double=0.35), serrate(left, 16, 0.034, double=0.35, phase=0.4))
    veins = [midrib(0.08, 0.016)] + pinnate(outline, 14, first=0.07, last=0.86, angle=52.0, bend=8.0, width=0.0085)
    return paint_blade(outline, veins, petiole=0.08, reticulation=0.9, seed=12)


def alder() -> Painting:
    """Alnus glutinosa: round, widest above the middle, notched where others have a tip."""
    right = smooth([(0, 0), (0.09, 0.02), (0.23, 0.14), (0.36, 0.35), (0.435, 0.58), (0.41, 0.80), (0.28, 0.955), (0.13, 1.0), (0.035, 0.96), (0, 0.935)])
    left = smooth([(0, 0), (0.08, 0.025), (0.22, 0.15), (0.345, 0.36), (0.42, 0.59), (0.40, 0.80), (0.27, 0.96), (0.12, 1.005), (0.03, 0.96), (0, 0.935)])
    outline = closed(serrate(right, 19, 0.018, double=0.3), serrate(left, 19, 0.018, double=0.3, phase=0.5))
    veins = [midrib(0.26, 0.018)] + pinnate(outline, 6, first=0.07, last=0.76, angle=48.0, bend=6.0, width=0.0115)
    return paint_blade(outline, veins, petiole=0.26, seed=13)


def hornbeam() -> Painting:
    """Carpinus betulus: like a beech's leaf, but doubly toothed, creased along a dozen straight side veins."""
    half = smooth([(0, 0), (0.08, -0.01), (0.175, 0.06), (0.26, 0.24), (0.275, 0.44), (0.235, 0.64), (0.145, 0.83), (0.05, 0.945), (0, 1)])
    outline = closed(serrate(half, 15, 0.030, double=0.4), serrate(half * [0.96, 1], 15, 0.030, double=0.4, phase=0.5))
    veins = [midrib(0.13, 0.015)] + pinnate(outline, 12, first=0.03, last=0.84, angle=49.0, bend=5.0, width=0.011)
    return paint_blade(outline, veins, petiole=0.13, reticulation=0.7, seed=14)


def cherry() -> Painting:
    """Prunus avium: long oval, widest above the middle, drawn out to a point, toothed, on a long petiole with two glands."""
    half = smooth([(0, 0), (0.05, 0.025), (0.13, 0.14), (0.21, 0.34), (0.245, 0.54), (0.21, 0.72), (0.11, 0.87), (0.03, 0.945), (0, 1)])
    outline = closed(serrate(half, 24, 0.017, double=0.2), serrate(half * [0.96, 1], 24, 0.017, double=0.2, phase=0.4))
    veins = [midrib(0.30, 0.015)] + pinnate(outline, 9, first=0.06, last=0.84, angle=58.0, bend=30.0, width=0.0075)
    return paint_blade(outline, veins, petiole=0.30, reticulation=0.7, seed=15)
