"""Which strokes are leaves, blossoms, or marks that say "foliage"? What is left out of the wood for it.

Small closed shapes count as leaves if there are several of them. A scribble turns again and again within a small
space. Arcs inside a crown, with neither end on a branch, are how people draw lobes of foliage.
"""

import numpy as np
import shapely
from jaxtyping import Bool

from sketchtree.sketch.roles.found import Found
from sketchtree.sketch.roles.measures import Measures

LEAF = 0.12  # of the drawing's height: a leaf is smaller
SEVERAL = 3  # leaves; two small loops may be anything
OPEN = 0.3  # widest opening of a leaf, of its size
PLUMP = 0.03  # least A / P² of a leaf: a loop of a line that went back over itself encloses less
SHORT = 4.5  # length over mean width, up to which a painted shape is a leaf and no brush stroke
TURNS = 4.5 * np.pi  # radians that a scribble turns at least
DENSE = 2.6  # least length of a scribble, of its size
MASS = 0.3  # of the drawing's height: a larger scribble may be the crown itself
BOWED = np.radians(50)  # a mark inside a crown that turns less is a twig
LOOSE = 0.02  # of the drawing's height: it keeps this far from every branch, at both ends


def leaf_shapes(m: Measures, free: Bool[np.ndarray, " stroke"], height: float) -> list[Found]:
    """The small closed shapes, where there are several."""
    loops = free & (m.size <= LEAF * height) & (m.opening <= OPEN * m.size) & (m.area >= PLUMP * np.maximum(m.length, 1e-300) ** 2)
    slender = m.filled & (_slenderness(m) > SHORT)
    rows = np.flatnonzero(loops & ~slender & (m.size > 0))
    if len(rows) < SEVERAL:
        return []
    return [Found(int(row), "leaves", "one of several small closed shapes", (("branch", 0.8),)) for row in rows]


def scribbles(m: Measures, free: Bool[np.ndarray, " stroke"]) -> np.ndarray:
    """Rows of the strokes that turn again and again within a small space."""
    wild = np.flatnonzero(free & ~m.filled & (m.length >= DENSE * m.size) & (np.diff(m.first_point) > 8) & (m.turning >= 0.5 * TURNS))
    if len(wild) == 0:
        return wild
    step = np.diff(m.resampled(wild, 64), axis=1)
    a, b = step[:, :-1], step[:, 1:]
    turning = np.abs(np.arctan2(a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0], (a * b).sum(-1))).sum(1)
    return wild[turning >= TURNS]


def marks_inside(m: Measures, free: Bool[np.ndarray, " stroke"], crown, wood: Bool[np.ndarray, " stroke"], height: float) -> list[Found]:
    """The arcs inside the crown (an area) that touch no branch."""
    rows = np.flatnonzero(free & (m.turning >= BOWED) & ~m.filled & (m.size <= 0.7 * height))
    if crown is None or len(rows) == 0:
        return []
    lines = m.shapes(rows)
    rows = rows[shapely.length(shapely.intersection(lines, crown)) >= 0.9 * shapely.length(lines)]
    others = wood & ~m.filled
    others[rows] = False
    branches = shapely.union_all(m.shapes(np.flatnonzero(others)))
    ends = shapely.distance(shapely.points([m.first[rows], m.last[rows]]), branches)
    loose = ~(ends <= LOOSE * height).any(0)
    return [Found(int(row), "leaves", "an arc inside the crown that touches no branch", (("branch", 0.5),)) for row in rows[loose]]


def _slenderness(m: Measures):
    """Length over mean width, of the rectangle of the same area and perimeter."""
    around = np.maximum(m.length, 1e-300)
    half = 0.25 * around
    root = np.sqrt(np.maximum(half**2 - m.area, 0.0))
    return (half + root) / np.maximum(half - root, 1e-9 * around)
