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
    if len(leaves) == 0:
        return np.zeros(0)
    low = leaves.position.min(axis=0)
    edge = max(float(np.ptp(leaves.position, axis=0).max()), 1e-6) / _CUBES
    cube = np.minimum(((leaves.position - low) / edge).astype(int), _CUBES - 1)
    flat = np.ravel_multi_index(cube.T, (_CUBES,) * 3)
    dense = np.bincount(flat, _SHAPE * leaves.size**2, _CUBES**3).reshape((_CUBES,) * 3) * (_ACROSS / edge**2)
    light = _SKY * np.exp(-_before(dense[:, ::-1], 1)[:, ::-1])
    for axis in (0, 2):
        light += _SIDE * (np.exp(-_before(dense, axis)) + np.exp(-np.flip(_before(np.flip(dense, axis), axis), axis)))
    return light.ravel()[flat]


def _before(dense, axis: int):
    """What lies before each cube along an axis, and half of the cube itself but for its first leaf."""
    return np.cumsum(dense, axis=axis) - dense
