"""How does each limb run, from its bearer's axis to its end, without what noise and forks do to the medial axis?

The axis bends at every fork: a limb's circle touches its bearer's far side there, so the bearer is drawn aside, and the limb sets out squarely from its middle, whatever its angle. Ours, limb by limb, bearers first:

    foot     where the limb's own line, led back from where it leaves the fork's circle, comes nearest to its bearer's line (from `BELOW` to `ABOVE` radii of the circle beside the fork)
    end      led on to the contour (`ends`)
    between  smoothed over the whole limb, through its forks

so that a trunk runs straight past its limbs, and limbs leave it at the angle at which they are seen. A place on the line is as thick as the axis beside it.
"""

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
import shapely
from jaxtyping import Float, Int
from scipy.spatial import KDTree

from sketchtree.axes import NULL
from sketchtree.trunk.ends import Line, clear_of_end, clear_of_ground, led_out, smooth, telling
from sketchtree.trunk.limbs import limb_of
from sketchtree.trunk.rooted import Rooted

BELOW, ABOVE = 2.5, 1.0
_AHEAD, _LEAST_AHEAD = 2.0, 8.0  # own radii, and pixels, over which a limb's direction is measured
_STEP = 0.5  # pixels between places where a foot may be


@dataclass(eq=False)
class _Limb:
    line: Line
    radius: Float[np.ndarray, " point"]
    bearer: int = NULL
    foot: float = 0.0  # pixels along the bearer
    feet: list[float] = field(default_factory=list)  # of those that it bears, pixels along this one


def limb_lines(tree: Rooted, inside: Callable[[Line], np.ndarray], *, on_ground: bool) -> tuple[Line, Float[np.ndarray, " node"], Int[np.ndarray, " node"]]:
    """(places, radii, parents) of a tree whose limbs run smoothly; row 0 is the root. `inside`: which points lie within the contour; `on_ground`: lead the trunk down to it."""
    limb, _ = limb_of(tree.parent, tree.xy, tree.radius)
    found: list[_Limb] = []
    for number in range(int(limb.max()) + 1):
        rows = np.flatnonzero(limb == number)
        if number == 0:
            found.append(_trunk(tree, rows, inside, on_ground))
            continue
        fork = int(tree.parent[rows[0]])
        own = _limb(tree, rows, fork, found[limb[fork]], int(limb[fork]), inside)
        found[own.bearer].feet.append(own.foot)
        found.append(own)
    return _nodes(found)


def _trunk(tree: Rooted, rows, inside, on_ground: bool) -> _Limb:
    line, width = tree.xy[rows], tree.radius[rows]
    line, width = _ended(line, width, inside)
    if on_ground:
        turned, end = led_out(line[::-1], width[::-1], clear_of_ground(line[::-1], width[::-1]), inside)
        line, width = turned[::-1], np.r_[end, width[len(line) - len(turned) + 1 :]] if len(turned) <= len(line) else np.r_[end, width]
    return _smoothed(line, width)


def _limb(tree: Rooted, rows, fork: int, bearer: _Limb, number: int, inside) -> _Limb:
    line, width = tree.xy[rows], tree.radius[rows]
    away = np.hypot(*(line - tree.xy[fork]).T) >= tree.radius[fork]
    first = min(int(np.argmax(away)) if away.any() else len(line) - 1, len(line) - 1)
    line, width = _ended(line[first:], width[first:], inside)
    foot = _foot(line, width, tree.xy[fork], float(tree.radius[fork]), bearer.line)
    own = _smoothed(np.concatenate([_at(bearer.line, foot), line]), np.r_[width[0], width])
    own.bearer, own.foot = number, foot
    return own


def _ended(line, width, inside):
    """(line, widths) with a limb's last piece led on to the contour."""
    longer, end = led_out(line, width, clear_of_end(line, width), inside)
    return longer, np.r_[width[: len(longer) - 1], end]


def _foot(line, width, fork, room: float, bearer: Line) -> float:
    """Pixels along the bearer to where a limb's line meets it."""
    run = _run(bearer)
    beside = run[int(np.argmin(np.hypot(*(bearer - fork).T)))]
    far = np.flatnonzero(np.hypot(*(line - line[0]).T) >= max(_AHEAD * float(np.median(width)), _LEAST_AHEAD))
    ahead = line[far[0] if len(far) else -1] - line[0]
    length = float(np.hypot(*ahead))
    if length < 1e-9:
        return float(beside)
    at = np.arange(max(beside - BELOW * room, 0.0), min(beside + ABOVE * room, run[-1]) + 1e-9, _STEP)
    back = _at(bearer, at) - line[0]
    along = -(back @ (ahead / length))
    off = np.hypot(*(back + np.maximum(along, 0.0)[:, None] * ahead / length).T)
    return float(at[int(np.argmin(off))])


def _smoothed(line, width) -> _Limb:
    finer = smooth(line, float(np.median(width)))
    return _Limb(finer, np.asarray(width)[KDTree(line).query(finer)[1]])


def _run(line: Line) -> Float[np.ndarray, " point"]:
    return np.r_[0.0, np.cumsum(np.hypot(*np.diff(line, axis=0).T))]


def _at(line: Line, along) -> Line:
    run = _run(line)
    return np.column_stack([np.interp(np.atleast_1d(along), run, line[:, k]) for k in (0, 1)])


def _nodes(limbs: list[_Limb]) -> tuple[Line, Float[np.ndarray, " node"], Int[np.ndarray, " node"]]:
    """All limbs as one table with few nodes, a node at every foot."""
    xy, radius, parent = [limbs[0].line[0]], [float(limbs[0].radius[0])], [NULL]
    stands: list[dict[float, int]] = []
    for limb in limbs:
        before = 0 if limb.bearer == NULL else stands[limb.bearer][limb.foot]
        run, own = _run(limb.line), {}
        places = sorted({0.0, *limb.feet, float(run[-1])})
        own[0.0] = before
        for start, stop in zip(places[:-1], places[1:], strict=True):
            piece = np.concatenate([_at(limb.line, start), limb.line[(run > start) & (run < stop)], _at(limb.line, stop)])
            for point in telling(piece)[1:]:
                xy.append(point), parent.append(before)
                radius.append(float(np.interp(shapely.line_locate_point(shapely.LineString(limb.line), shapely.Point(point)), run, limb.radius)))
                before = len(xy) - 1
            own[stop] = before
        stands.append(own)
    return np.array(xy), np.array(radius), np.array(parent)
