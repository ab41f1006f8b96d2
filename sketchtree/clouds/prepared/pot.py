"""Does the plant stand in a pot, or on a lump of ground that is no plane? Up to where, then?

The lower part of the height is cut into layers, a fiftieth each. How wide one is: how far its points typically lie from their middle. The rule, in full:

    pot    the widest layer below two fifths of the height that is solid, with points in half the cells of its disc (bark is a ring: nobody sees into a trunk), and compact, ending at one
           edge rather than thinning out, as leaves do
    stem   from three layers on, one above another, that are no more than a quarter as wide and stand over the pot: it ends below them
    foot   nothing as narrow as that under the pot, within its disc: a tier of branches has the trunk below it

A trunk that flares or stands on buttresses is hollow in every layer; many stems are as wide above as below. A plant whose leaves come down to the rim shows no stem: there the pot stays.
"""

import numpy as np
from jaxtyping import Float

_LAYERS, _LOW = 50, 20  # of the height; those that are looked at
_NARROWER, _STEM = 0.25, 3  # times as wide as the pot; layers
_DISC, _EDGE = 80, 95  # per cent of a layer's points
_CELLS, _SOLID = 8, 0.5  # along the disc's radius; share of them that have points
_COMPACT = 1.25  # the edge is no farther out, in radii of the disc
_FEWEST = 5  # points of a layer


def pot(xyz: Float[np.ndarray, "point 3"], above: Float[np.ndarray, " point"]) -> float | None:
    """How high above the ground, or the lowest point, the pot ends and the stem begins, metres; None where there is no pot."""
    height = float(np.percentile(above, 99.9))
    if height <= 0:
        return None
    layer = np.floor(above / height * _LAYERS)
    plans = [xyz[layer == k][:, [0, 2]] for k in range(_LOW + _STEM)]
    middle = [np.median(plan, axis=0) if len(plan) else np.zeros(2) for plan in plans]
    wide = np.array([np.median(np.linalg.norm(plan - at, axis=1)) if len(plan) >= _FEWEST else np.inf for plan, at in zip(plans, middle, strict=True)])
    solid = [k for k in range(_LOW) if np.isfinite(wide[k]) and _is_solid(plans[k] - middle[k])]
    for k in sorted(solid, key=lambda k: -wide[k]):
        narrow, reach = _NARROWER * wide[k], float(np.percentile(np.linalg.norm(plans[k] - middle[k], axis=1), _DISC))
        stem = (wide <= narrow) & np.array([np.linalg.norm(at - middle[k]) <= reach for at in middle])
        begins = [j for j in range(k + 1, _LOW + 1) if stem[j : j + _STEM].all()]
        if begins and not any(_narrow_within(plan, middle[k], reach, narrow) for plan in plans[:k]):
            return begins[0] * height / _LAYERS
    return None


def _is_solid(away) -> bool:
    """Whether points, from their middle, fill a disc with an edge."""
    far = np.linalg.norm(away, axis=1)
    reach, edge = np.percentile(far, [_DISC, _EDGE])
    if reach <= 0 or edge > _COMPACT * reach:
        return False
    filled = np.unique(np.floor(away[far <= reach] / reach * _CELLS), axis=0)
    return len(filled) >= _SOLID * np.pi * _CELLS**2


def _narrow_within(plan, middle, reach: float, narrow: float) -> bool:
    """Whether a layer's points within a disc are those of a stem."""
    inside = plan[np.linalg.norm(plan - middle, axis=1) <= reach]
    return len(inside) >= _FEWEST and float(np.median(np.linalg.norm(inside - np.median(inside, axis=0), axis=1))) <= narrow
