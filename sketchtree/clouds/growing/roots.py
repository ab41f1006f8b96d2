"""Where does a plant stand, and how thick is it there?

Feet are some of the points each (`clouds.standing` finds them). A root is the middle of its foot at the foot's lowest point; the radius there is, unless it was measured better,
that of a circle through the points just above.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int

from sketchtree.clouds.tracing.circles import circles

_FROM, _TO, _ASIDE = 0.01, 0.05, 0.06  # of the height: points so far above the foot, and so near its axis, tell the stem's thickness
_ENOUGH = 400  # points
_UNKNOWN = 0.008  # of the height


@dataclass(frozen=True, eq=False)
class Roots:
    """One row a stem."""

    place: Float[np.ndarray, "root 3"]
    radius: Float[np.ndarray, " root"]


def roots_of(xyz: Float[np.ndarray, "point 3"], feet: list[Int[np.ndarray, " start"]], radius: Float[np.ndarray, " root"] | None = None) -> Roots:
    """The roots on feet, each of which is some of the points. `radius`: as measured, in the cloud's units."""
    place = np.array([[xyz[foot, 0].mean(), xyz[foot, 1].min(), xyz[foot, 2].mean()] for foot in feet])
    return Roots(place, _radius(xyz, place) if radius is None else np.asarray(radius, float))


def _radius(xyz, place):
    height = float(np.ptp(xyz[:, 1]))
    found = []
    for root in place:
        up, aside = xyz[:, 1] - root[1], np.linalg.norm((xyz - root)[:, [0, 2]], axis=1)
        low = xyz[(up > _FROM * height) & (up < _TO * height) & (aside < _ASIDE * height)][:, [0, 2]]
        low = low[:: max(1, len(low) // _ENOUGH)]
        if len(low) < 6:
            found.append(_UNKNOWN * height)
            continue
        circle = circles(low[None], np.ones((1, len(low)), bool))
        sure = circle.seen[0] >= 0.3 and circle.near[0] >= 0.5 and circle.radius[0] < _ASIDE * height
        found.append(float(circle.radius[0]) if sure else float(np.median(np.linalg.norm(low - np.median(low, axis=0), axis=1))))
    return np.maximum(found, 1e-3 * height)
