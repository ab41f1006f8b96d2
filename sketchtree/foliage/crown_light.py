"""How much light reaches each leaf inside the crown?

The leaves' area is put into cubes; light comes from above and from four sides and is absorbed on its way (Beer-Lambert):

    I = Σ_d w_d exp(−κ Σ A / a²)        sum over the cubes between the leaf and direction d

    A   leaf area in a cube    a   its edge    κ   0.5: how much of a leaf's area stands in the way, leaves facing all ways
    w   ⅗ from above, ⅒ from each side
"""

import numpy as np
from jaxtyping import Float

from sketchtree.foliage.leaves import Leaves

_CUBES = 20  # along the crown's longest side
_ACROSS = 0.5  # κ
_SHAPE = 0.4  # area of a leaf over the square of its length
_SKY, _SIDE = 0.6, 0.1


def crown_light(leaves: Leaves) -> Float[np.ndarray, " leaf"]:
    """Share of the open sky's light at every leaf, 0-1: 1 on the outside of a crown."""
    return light_at(leaves.position, leaves.position, leaves.size)


def light_at(
    place: Float[np.ndarray, "place 3"], position: Float[np.ndarray, "leaf 3"], size: Float[np.ndarray, " leaf"] | float
) -> Float[np.ndarray, " place"]:
    """The same at any place: what leaves of a `size` (metres) at their positions let through. Outside their box it is what the nearest cube of it has."""
    if len(place) == 0 or len(position) == 0:
        return np.ones(len(place))
    low = position.min(axis=0)
    edge = max(float(np.ptp(position, axis=0).max()), 1e-6) / _CUBES
    of_leaf, of_place = (np.ravel_multi_index(np.clip((at - low) // edge, 0, _CUBES - 1).astype(int).T, (_CUBES,) * 3) for at in (position, place))
    area = np.broadcast_to(_SHAPE * np.square(size), len(position))
    dense = np.bincount(of_leaf, area, _CUBES**3).reshape((_CUBES,) * 3) * (_ACROSS / edge**2)
    light = _SKY * np.exp(-_before(dense[:, ::-1], 1)[:, ::-1])
    for axis in (0, 2):
        light += _SIDE * (np.exp(-_before(dense, axis)) + np.exp(-np.flip(_before(np.flip(dense, axis), axis), axis)))
    return light.ravel()[of_place]


def _before(dense, axis: int):
    """What lies before each cube along an axis, and half of the cube itself but for its first leaf."""
    return np.cumsum(dense, axis=axis) - dense
