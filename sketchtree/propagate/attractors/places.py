"""Where is wood already? Places along it, to be asked for the nearest, while more are added all the time.

A KD-tree can't take up more places; made anew at every branch it would cost more than all that is asked of it. So there are two: of the places that have long been there, and of the few
added since, which become one when the few are `_MANY`.
"""

import numpy as np
from jaxtyping import Float
from scipy.spatial import cKDTree

_MANY = 0.25  # of the places that have long been there; as many more become one tree with those


class Places:
    """Places along the wood."""

    def __init__(self):
        self._old, self._new = np.zeros((0, 3)), np.zeros((0, 3))
        self._trees: list[cKDTree] | None = []

    def add(self, place: Float[np.ndarray, "place 3"]) -> None:
        """These too."""
        self._new = np.concatenate([self._new, place])
        if len(self._new) > _MANY * len(self._old):
            self._old, self._new = np.concatenate([self._old, self._new]), np.zeros((0, 3))
            self._trees = [cKDTree(self._old)]
        else:
            self._trees = [*self._trees[:1], cKDTree(self._new)]

    def distance(self, point: Float[np.ndarray, "point 3"], most: float) -> Float[np.ndarray, " point"]:
        """From each point to the nearest place, metres; infinite where none is as near as `most`."""
        away = np.full(len(point), np.inf)
        for tree in self._trees:
            away = np.minimum(away, tree.query(point, distance_upper_bound=most)[0])
        return away
