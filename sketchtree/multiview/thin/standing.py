"""Where is wood already, whose is it, and which way does it run? What twigs that are followed must not run into."""

import numpy as np
from jaxtyping import Bool, Float, Int
from scipy.spatial import cKDTree

from sketchtree.skeleton import TreeSkeleton

APART = 2.0  # pixels: what is nearer to other wood is that wood
DOUBLE, SAME_WAY = 4.5, 0.85  # pixels, cosine: so near to wood that runs the same way, nothing runs by chance


class Standing:
    """Places along all wood, a pixel apart."""

    def __init__(self, tree: TreeSkeleton, pixel: float):
        """`pixel`: of the plant, metres."""
        share = [np.linspace(0.0, 1.0, max(2, int(np.ceil(long / pixel)) + 1))[1:] for long in tree.length]
        row = np.repeat(np.arange(len(tree)), [len(one) for one in share])
        self.pixel = pixel
        self.place: Float[np.ndarray, "place 3"] = tree.tip[row] - (1.0 - np.concatenate(share))[:, None] * tree.vector[row]
        self.owner: Int[np.ndarray, " place"] = tree.limb[row]
        self.axis: Float[np.ndarray, "place 3"] = unit(tree.vector[row])
        self._index = cKDTree(self.place)

    def more(self, place, owner, axis) -> None:
        """Wood that was found since."""
        self.place, self.owner, self.axis = np.concatenate([self.place, place]), np.append(self.owner, owner), np.concatenate([self.axis, axis])
        self._index = cKDTree(self.place)

    def distance(self, place: Float[np.ndarray, "*place 3"]) -> Float[np.ndarray, "*place"]:
        """To the nearest wood, metres."""
        return self._index.query(place)[0]

    def met(self, before: Float[np.ndarray, "twig 3"], place: Float[np.ndarray, "twig 3"], way: Float[np.ndarray, "twig 3"], own: Int[np.ndarray, "twig name"]) -> Bool[np.ndarray, " twig"]:
        """Which twigs, with their last step, are at wood of others and no farther from it than they were; or beside some that runs the same way. `own`: owners that are no others."""
        found = np.zeros(len(place), bool)
        for k, rows in enumerate(self._index.query_ball_point(place, DOUBLE * self.pixel)):
            rows = np.asarray(rows, int)
            rows = rows[~np.isin(self.owner[rows], own[k])]
            near = np.linalg.norm(self.place[rows] - place[k], axis=1) < APART * self.pixel
            rows = rows[near | (np.abs(self.axis[rows] @ way[k]) > SAME_WAY)]
            if len(rows):
                now, then = (np.linalg.norm(self.place[rows] - at, axis=1).min() for at in (place[k], before[k]))
                found[k] = now < then + 0.5 * np.linalg.norm(place[k] - before[k])
        return found


def unit(vector: Float[np.ndarray, "*row 3"]) -> Float[np.ndarray, "*row 3"]:
    """Vectors of length 1."""
    return vector / np.maximum(np.linalg.norm(vector, axis=-1, keepdims=True), 1e-12)


def beside(axis: Float[np.ndarray, "row 3"]) -> tuple[Float[np.ndarray, "row 3"], Float[np.ndarray, "row 3"]]:
    """Two directions square to each axis and to one another."""
    one = unit(np.cross(axis, np.where(np.abs(axis[:, 1:2]) < 0.9, [0.0, 1.0, 0.0], [1.0, 0.0, 0.0])))
    return one, np.cross(axis, one)
