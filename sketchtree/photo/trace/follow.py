"""What grows off the strokes? A circle is moved along every stroke, and on from every branch it finds, breadth first (§2, Figure 3).

At each place wood crosses the circle in clusters. Those in sight of its centre are gone to, but for the one it came from, those that lie on a stroke, and those where another walk
has been. Ours: a cluster wider than the limb it would grow from is no branch but leaves or a wall; where a limb is thicker than the circle, the circle grows to see past it,
and what lies within a limb's thickness of its stroke is that limb.
"""

import math
from dataclasses import dataclass, field

import numpy as np
import shapely
from jaxtyping import Float
from scipy.spatial import cKDTree

from sketchtree.axes import NULL
from sketchtree.photo.trace.circle import SIGHT, clusters_on_all
from sketchtree.photo.trace.wood_likeness import WoodLikeness

_BACK = np.cos(np.radians(40.0))  # a cluster within 40° of the way back is where the circle came from
_BEEN = 0.45  # of the circle's radius: nearer to a place that is known already is no new one
_WIDER = 2.5  # times its parent's thickness: no branch is as wide
_WIDEST = 1.1  # the same of a limb under a stroke, whose thickness is known better
_ASIDE = 0.35  # of the circle's radius: what is nearer to a stroke is the limb under it
_WITHIN = 1.25  # the same of that limb's half width: its own edge, or moss on it
_LEAST = 0.25  # of the circle's radius: half a limb counts as that at least
_PAST = 1.5  # of the limb's half width: the circle that sees past it
_TEXTURE = 8  # clusters on one circle: more of them are leaves or grass
_MOST_ARMS = 512  # clusters on one circle, at most
_DEEPEST = 6  # branchings away from a stroke
_DOWN = 3.0  # circles' radii that the foot of a branch may lie below the place it was seen from
_FARTHER = 0.15  # radians that each circle's radius further down must gain
_SHORT = 1.3  # of the circle's radius: a branch found no longer than that is a bump


@dataclass(eq=False)
class Walk:
    """Places found so far; a growing table, parents first."""

    parent: list[int] = field(default_factory=list)
    xy: list = field(default_factory=list)
    half: list[float] = field(default_factory=list)  # half the limb's thickness, pixels
    stroke: list[int] = field(default_factory=list)
    drawn: list[bool] = field(default_factory=list)
    depth: list[int] = field(default_factory=list)  # branchings away from a stroke

    def add(self, parent: int, xy, half: float, stroke: int, drawn: bool, depth: int) -> int:
        """A place more; returns its row."""
        for column, value in zip((self.parent, self.xy, self.half, self.stroke, self.drawn, self.depth), (parent, xy, half, stroke, drawn, depth), strict=True):
            column.append(value)
        return len(self.parent) - 1


def follow(
    likeness: WoodLikeness, walk: Walk, radius: float, *, on_strokes: Float[np.ndarray, "point 2"], within: shapely.Geometry, most: int = 2_000, strict: bool = False
) -> Walk:
    """Add to the places on strokes all that can be reached from them over wood. `on_strokes`: points along all strokes, a pixel or so apart; `within`: where branches may be
    found; at most `most` places."""
    drawn = np.flatnonzero(walk.drawn)
    strokes, half = cKDTree(on_strokes), np.array(walk.half)[drawn]
    within_wood = _WITHIN * half[cKDTree(np.array(walk.xy)[drawn]).query(on_strokes)[1]]  # of each point on a stroke: what is nearer is the same limb
    shapely.prepare(within)
    known = np.zeros((max(most, len(walk.parent)) + _MOST_ARMS, 2))
    known[: len(walk.parent)] = walk.xy
    bearing: set[int] = set()  # places that something found grows from
    level = list(range(len(walk.parent)))
    while level and len(walk.parent) < most:
        found = []
        for row, onward in zip(level, _onward(likeness, walk, level, radius, strokes, within_wood, strict), strict=True):
            for place, half in onward if len(walk.parent) < most else ():
                near = np.hypot(*(known[: len(walk.parent)] - place).T) < _BEEN * radius
                near[row] = False
                depth = walk.depth[row] + (walk.drawn[row] or row in bearing)
                if near.any() or depth > _DEEPEST or not shapely.contains_xy(within, *place):
                    continue
                known[len(walk.parent)] = place
                found.append(walk.add(row, place, half, walk.stroke[row], False, depth))
                bearing.add(row)
        level = found
    return walk


def _onward(
    likeness: WoodLikeness, walk: Walk, rows: list[int], radius: float, strokes: cKDTree, within_wood: Float[np.ndarray, " point"], strict: bool
) -> list[list[tuple[np.ndarray, float]]]:
    """(place, half width) of every cluster that leads somewhere new, for each of some places."""
    reach = [max(radius, _PAST * walk.half[row]) for row in rows]
    circles = clusters_on_all(likeness, [walk.xy[row] for row in rows], reach, strict=strict)
    away, point = strokes.query(np.concatenate([found.centre for found in circles]))
    ends = np.cumsum([len(found.width) for found in circles])[:-1]
    onward: list[list[tuple[np.ndarray, float]]] = []
    for row, far, found, aside, beside in zip(rows, reach, circles, np.split(away, ends), np.split(within_wood[point], ends), strict=True):
        widest = (_WIDEST if walk.drawn[row] else _WIDER) * 2 * max(walk.half[row], _LEAST * radius)
        new = found.seen & (found.width <= widest) & (aside >= np.maximum(np.maximum(_ASIDE * far, found.width / 2), beside))
        if walk.parent[row] != NULL and not walk.drawn[row]:
            back = walk.xy[walk.parent[row]] - walk.xy[row]
            new &= (found.centre - walk.xy[row]) @ back <= _BACK * far * np.hypot(*back)
        if not strict and len(found.width) > _TEXTURE:
            new[:] = False
        onward.append([(found.centre[k], max(float(found.width[k]) / 2, 0.5)) for k in np.flatnonzero(new)])
    return onward


def without_bumps(walk: Walk, radius: float) -> Walk:
    """Without found branches so short that they are bumps of the bark or leaves."""
    parent, xy = np.array(walk.parent), np.array(walk.xy)
    reach = np.zeros(len(parent))  # of what hangs on each place, pixels
    for row in range(len(parent) - 1, 0, -1):
        if parent[row] != NULL:
            reach[parent[row]] = max(reach[parent[row]], reach[row] + np.hypot(*(xy[row] - xy[parent[row]])))
    own = np.array([0.0 if parent[k] == NULL else np.hypot(*(xy[k] - xy[parent[k]])) for k in range(len(parent))])
    drawn = np.array(walk.drawn)
    side = ~drawn & (parent != NULL)
    begins = side & drawn[np.maximum(parent, 0)]
    bump = np.zeros(len(parent), bool)
    for row in range(len(parent)):
        bump[row] = (side[row] and bump[parent[row]]) or (begins[row] and own[row] + reach[row] < _SHORT * radius)
    place = np.cumsum(~bump) - 1
    kept = np.flatnonzero(~bump)
    thin = Walk()
    for row in kept:
        thin.add(int(place[parent[row]]) if parent[row] != NULL else NULL, walk.xy[row], walk.half[row], walk.stroke[row], walk.drawn[row], walk.depth[row])
    return thin


def reseated(walk: Walk, likeness: WoodLikeness, radius: float) -> Walk:
    """Every branch found on a stroke moved down that stroke to where it leaves it most smoothly: of the places in sight over wood within `_DOWN` circles, the one from which it
    turns least (ours; a circle meets a steep branch only when it is past its foot)."""
    parent, xy = list(walk.parent), np.array(walk.xy)
    drawn = np.array(walk.drawn)
    first_child = {up: row for row, up in reversed(list(enumerate(parent))) if up != NULL and not drawn[row]}
    for row in np.flatnonzero(~drawn):
        if not drawn[parent[row]]:
            continue
        onward, above = xy[first_child[row]] - xy[row] if row in first_child else None, parent[row]
        parent[row] = smoothest_foot(xy, parent, drawn, above, xy[row], onward, radius, _DOWN * radius, lambda spot: _in_sight(likeness, xy[spot], xy[row]))
    return Walk(parent, walk.xy, walk.half, walk.stroke, walk.drawn, walk.depth)


def smoothest_foot(xy, parent, drawn, above: int, place, onward, radius: float, reach: float, allowed=lambda spot: True) -> int:
    """The place on a stroke, `above` or one down to `reach` pixels below it, from which a branch to `place` that goes on as `onward` (None: ends) turns least."""
    best, least = above, np.inf
    spot, gone = above, 0.0
    while spot != NULL and gone <= reach and drawn[spot]:
        up = parent[spot]
        before = xy[spot] - xy[up] if up != NULL else None
        turn = sum(angle(a, b) for a, b in ((before, place - xy[spot]), (place - xy[spot], onward)) if a is not None and b is not None) + _FARTHER * gone / radius
        if turn < least and (spot == above or allowed(spot)):
            best, least = spot, turn
        gone += np.hypot(*(xy[spot] - xy[up])) if up != NULL else 0.0
        spot = up
    return int(best)


def _in_sight(likeness: WoodLikeness, a, b) -> bool:
    """Whether there is wood most of the way between two places."""
    share = np.linspace(0.0, 1.0, max(int(np.hypot(*(b - a))), 2))[:, None]
    return bool(likeness.is_wood(a + share * (b - a)).mean() >= SIGHT)


def angle(a, b) -> float:
    """Angle between two directions, radians."""
    (ax, ay), (bx, by) = a, b
    return abs(math.atan2(ax * by - ay * bx, ax * bx + ay * by))
