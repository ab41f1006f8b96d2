"""What does a stroke point at? Whoever stops short of a branch stops on the way to it.

Every line is continued straight backward from each end, for LOOK times the piece that gives its direction, and where that
ray meets another line is noted:

    aim        |p − x| / H    x the nearest place where the ray from end p meets line j; twice the ray's length if it does not
"""

import numpy as np
import shapely
from jaxtyping import Float, Int

from sketchtree.sketch.joining.bundle import Bundle

NEAR, FAR = 0.02, 0.05  # of H: pieces that give the direction
LOOK = {NEAR: 0.04, FAR: 0.06}  # of H: how far is looked ahead


def aims(bundle: Bundle, row: Int[np.ndarray, " arc"], parent: Int[np.ndarray, " arc"], gap: Float[np.ndarray, " arc"], piece: float):
    """`aim` of every arc from end `row` to line `parent`, `gap` away; `piece` is NEAR or FAR."""
    reach = LOOK[piece] * bundle.height
    found = np.full(len(row), 2 * LOOK[piece])
    close = np.flatnonzero(gap <= reach)
    if len(close) == 0:
        return found
    back = -bundle.leaving(np.minimum(piece * bundle.height, 0.5 * bundle.length))
    rays = shapely.linestrings(np.stack([bundle.ends, bundle.ends + back * reach], 1))
    shapes = bundle.shapes[parent[close]]
    met = shapely.intersects(rays[row[close]], shapes)
    close, shapes = close[met], shapes[met]
    places = shapely.intersection(rays[row[close]], shapes)
    found[close] = shapely.distance(bundle.end_shapes[row[close]], places) / bundle.height
    return found
