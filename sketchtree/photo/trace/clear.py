"""Which of the limbs that were found are plainly seen, and how thick are those (ours)?

Following wood by its colour leads into dark leaves, hedges and shadows as well. A limb stands out against both its sides: the weaker contrast across it (`edges`), the median along it, is at
least CLEAR of that across the strokes, whose limbs are there for certain (the quantile SURE of their places: some of them may run on under leaves). What is fainter goes, with all it bears.
"""

import numpy as np

from sketchtree.axes import NULL
from sketchtree.photo.photo import Photo
from sketchtree.photo.trace.edges import edges_at, tapered
from sketchtree.photo.trace.follow import Walk
from sketchtree.photo.trace.limbs import carried_on, found_limbs
from sketchtree.photo.trace.lines import evenly, lengths

NEAR_BY = 1.6  # circles' radii: how far from a limb its edges are looked for
CLEAR = 0.5
SURE = 0.75


def plainly_seen(walk: Walk, photo: Photo, radius: float) -> Walk:
    """The same without faint limbs, those found as thick as their edges say."""
    parent, xy, half, drawn = (np.array(column) for column in (walk.parent, walk.xy, walk.half, walk.drawn))
    carries = carried_on(parent, xy, half, np.array(walk.stroke), drawn)
    limbs = found_limbs(parent, carries, drawn)
    if not limbs:
        return walk
    step = 0.5 * radius
    lines = [xy[[parent[rows[0]], *rows]] for rows in limbs]
    found = [evenly(line, step) for line in lines]
    under = np.flatnonzero(drawn & (parent != NULL))
    way = xy[under] - xy[parent[under]]
    way /= np.maximum(np.hypot(way[:, 0], way[:, 1]), 1e-9)[:, None]
    place, along = (np.concatenate(part) for part in zip((xy[under], way), *found, strict=True))
    seen = edges_at(photo.rgb, place, along, reach=NEAR_BY * radius, step=step)
    ends = np.cumsum([len(under), *(len(spots) for spots, _ in found)])
    sure = np.quantile(seen.contrast[: len(under)], SURE) if len(under) else 0.0
    gone = np.zeros(len(parent), bool)
    for rows, line, (spots, _), first, last in zip(limbs, lines, found, ends[:-1], ends[1:], strict=True):
        first += len(spots) > 1  # its first place is within what it grows from
        gone[rows] = np.median(seen.contrast[first:last]) < CLEAR * sure
        half[rows] = np.interp(lengths(line)[1:], lengths(spots)[-(last - first) :], tapered(seen.half[first:last]))
    return _without(walk, half, gone)


def _without(walk: Walk, half, gone) -> Walk:
    """The places that stay: not gone, nor what grows from one that is."""
    kept, place = Walk(), {NULL: NULL}
    for row, up in enumerate(walk.parent):
        if not gone[row] and up in place:
            place[row] = kept.add(place[up], walk.xy[row], float(half[row]), walk.stroke[row], walk.drawn[row], walk.depth[row])
    return kept
