"""Which strokes are leaves, blossoms, or marks that say "foliage"? What is left out of the wood for it.

Small closed shapes count as leaves if there are several of them. Arcs inside a crown, with neither end on a branch, are how
people draw lobes of foliage; so are several short dashes in a crown without limbs.
"""

import numpy as np
import shapely
import shapely.ops
from jaxtyping import Bool

from sketchtree.sketch.roles.brush import slenderness
from sketchtree.sketch.roles.found import Found
from sketchtree.sketch.roles.measures import Measures

LEAF = 0.12  # of the drawing's height: a leaf is smaller
SEVERAL = 3  # leaves; two small loops may be anything
OPEN = 0.3  # widest opening of a leaf, of its size
PLUMP = 0.03  # least A / P² of a leaf: a loop of a line that went back over itself encloses less
SHORT = 4.5  # length over mean width, up to which a painted shape is a leaf and no brush stroke
BOWED = np.radians(50)  # a mark inside a crown that turns less is a twig
DASH = 0.15  # of the crown's size: shorter marks inside it count as dashes of foliage …
DASHES = 3  # … if there are so many …
BARE = 0.6  # … and less wood than this inside it, of its size
LOOSE = 0.02  # of the drawing's height: it keeps this far from every branch, at both ends


def leaf_shapes(m: Measures, free: Bool[np.ndarray, " stroke"], height: float) -> list[Found]:
    """The small closed shapes, where there are several."""
    loops = free & (m.size <= LEAF * height) & (m.opening <= OPEN * m.size) & (m.area >= PLUMP * np.maximum(m.length, 1e-300) ** 2)
    slender = m.filled & (slenderness(m.area, m.around) > SHORT)
    rows = np.flatnonzero(loops & ~slender & (m.size > 0))
    if len(rows) < SEVERAL:
        return []
    return [Found(int(row), "leaves", "one of several small closed shapes", () if m.filled[row] else (("branch", 0.8),)) for row in rows]


def marks_inside(m: Measures, free: Bool[np.ndarray, " stroke"], crown, wood: Bool[np.ndarray, " stroke"], height: float) -> list[Found]:
    """The arcs and dashes inside the crown (an area) that touch no branch."""
    size = max(crown.bounds[2] - crown.bounds[0], crown.bounds[3] - crown.bounds[1])
    arcs = (m.turning >= BOWED) & (m.size <= 0.7 * height)
    rows = np.flatnonzero(free & ~m.filled & (arcs | (m.size <= DASH * size)) & (m.size > 0))
    if len(rows) == 0:
        return []
    lines = m.shapes(rows)
    rows = rows[shapely.length(shapely.intersection(lines, crown)) >= 0.9 * shapely.length(lines)]
    bowed = arcs[rows]
    loose = _loose(m, rows, bowed, wood & ~m.filled, LOOSE * height)
    found = [Found(int(row), "leaves", "an arc inside the crown that touches no branch", (("branch", 0.5),)) for row in rows[loose & bowed]]
    dashes = rows[loose & ~bowed]
    inner = np.flatnonzero(wood & ~_mask(len(m), rows[loose]))
    bare = shapely.length(shapely.intersection(m.shapes(inner), crown)).sum() <= BARE * size if len(inner) else True
    if bare and len(dashes) >= DASHES:
        found += [Found(int(row), "leaves", "a dash inside the crown that touches no branch", (("branch", 0.3),)) for row in dashes]
    return found


def _loose(m: Measures, rows, bowed, wood: Bool[np.ndarray, " stroke"], reach: float) -> Bool[np.ndarray, " row"]:
    """Which of these strokes touch no branch with either end. The bowed ones are branches only where they touch one
    themselves, and bear others only along their length: lobes of foliage touch end to end."""
    found, loose = np.zeros(len(rows), bool), np.ones(len(rows), bool)
    branches = m.shapes(np.flatnonzero(wood & ~_mask(len(m), rows[bowed])))
    while True:
        tree = shapely.STRtree(branches)
        ends = shapely.points(np.concatenate([m.first[rows], m.last[rows]]))
        end, other = tree.query(ends, predicate="dwithin", distance=reach)
        own = shapely.equals(branches[other], m.shapes(rows)[end % len(rows)])
        loose[end[~own] % len(rows)] = False
        new = bowed & ~loose & ~found
        if not new.any():
            return loose
        found |= new
        inner = [shapely.ops.substring(line, 2 * reach, line.length - 2 * reach) for line in m.shapes(rows[new]) if line.length > 5 * reach]
        branches = np.array(inner, object)


def _mask(count: int, rows) -> Bool[np.ndarray, " stroke"]:
    mask = np.zeros(count, bool)
    mask[rows] = True
    return mask
