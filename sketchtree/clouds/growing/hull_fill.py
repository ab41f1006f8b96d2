"""Where would wood be that nobody saw?

Guo et al. 2018, §6.1 and Figure 8: leaves hide the inside of a dense crown. Points are laid into the convex hull of the crown, at random but nowhere near one another (a Poisson-disk
sample), and growth is guided by them too. Here they lie only where no point of the cloud is near.

The sample is a largest set of random places that all keep their distance, found in rounds: of places too near one another the one of the highest draw stays.
"""

import numpy as np
from jaxtyping import Array, Float, Key
from scipy.spatial import ConvexHull, Delaunay, QhullError, cKDTree

from sketchtree.errors import SketchError
from sketchtree.keys import numpy_generator

_TRIES = 12.0  # places drawn for each that there is room for
_MOST = 400_000  # places drawn
_ROOM = 1.35  # a full sample holds about so many a cube of the distance
_CROWN = 0.35  # of its widest: where the crown begins
_SLICES = 50
HOLLOW = 0.02
"""Where less of the points lies in the inner eighth of the hull, the inside was not seen: evenly spread points would put 0.125 there, a bare tree far more."""


def crown_of(xyz: Float[np.ndarray, "point 3"]) -> Float[np.ndarray, "kept 3"]:
    """The points above where the plant first grows wide."""
    height = xyz[:, 1] - xyz[:, 1].min()
    level = np.minimum((height / max(float(height.max()), 1e-12) * _SLICES).astype(int), _SLICES - 1)
    wide = np.zeros(_SLICES)
    for k in np.unique(level):
        there = xyz[level == k][:, [0, 2]]
        wide[k] = np.quantile(np.linalg.norm(there - np.median(there, axis=0), axis=1), 0.9)
    return xyz[level >= np.flatnonzero(wide >= _CROWN * wide.max())[0]]


def unseen_inside(xyz: Float[np.ndarray, "point 3"]) -> bool:
    """Whether the crown's inside has hardly a point. False where points enclose nothing."""
    crown = crown_of(xyz)
    try:
        hull = _hull(crown)
    except SketchError:
        return False
    middle = hull.points.mean(axis=0)
    return float((hull.find_simplex(middle + 2.0 * (crown - middle)) >= 0).mean()) < HOLLOW


def hull_fill(
    crown: Float[np.ndarray, "point 3"], distance: float, *, key: Key[Array, ""], clear: float = 0.0
) -> Float[np.ndarray, "place 3"]:
    """Places in the convex hull of points, no two nearer than `distance`, none nearer than `clear` to a point. Raises SketchError for points that enclose nothing."""
    hull, rng = _hull(crown), numpy_generator(key)
    low, high = crown.min(axis=0), crown.max(axis=0)
    wanted = _TRIES * _ROOM * np.prod(high - low) / distance**3
    place = rng.uniform(low, high, (int(np.clip(wanted, 64, _MOST)), 3))
    place = place[hull.find_simplex(place) >= 0]
    if clear > 0.0 and len(place):
        near, _ = cKDTree(crown).query(place, distance_upper_bound=clear)
        place = place[~np.isfinite(near)]
    return place[_apart(place, distance)]  # draws are in random order already: an earlier one is a higher one


def _apart(place, distance: float):
    """Rows, in order, that keep their distance: a maximal set."""
    pair = cKDTree(place).query_pairs(distance, output_type="ndarray") if len(place) else np.zeros((0, 2), np.int64)
    state = np.zeros(len(place), np.int8)  # 0 open, 1 stays, -1 falls
    while len(pair):
        beaten = np.zeros(len(place), bool)
        beaten[pair[:, 1]] = True  # pairs are (earlier, later)
        state[(state == 0) & ~beaten] = 1
        state[pair[state[pair[:, 0]] == 1, 1]] = -1
        pair = pair[(state[pair] == 0).all(axis=1)]
    return np.flatnonzero(state >= 0)


def _hull(xyz) -> Delaunay:
    """The convex hull, cut into tetrahedra, so that it tells what lies inside."""
    try:
        return Delaunay(xyz[ConvexHull(xyz).vertices])
    except (QhullError, ValueError) as error:
        raise SketchError("The crown's points enclose no space.", remedy="Give a cloud of a whole crown, or grow without filling its inside.") from error
