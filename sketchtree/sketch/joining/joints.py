"""Which lines make one limb, and where exactly do limbs meet?

Every line is turned foot first. An overshoot at its foot is cut where it crosses its parent, a gap is
bridged to the parent's nearest point. A line that starts at the foot of another
is its sibling. Where lines start at the tip of another, the one that bends least carries that limb on (Chen §7 takes
the smallest angle for the apical child).
"""

from dataclasses import dataclass, field

import numpy as np
import shapely
from jaxtyping import Float, Int

from sketchtree.axes import NULL
from sketchtree.sketch.joining.attach import Hanging
from sketchtree.sketch.joining.candidates import foot_reach
from sketchtree.sketch.joining.evidence import REACH
from sketchtree.sketch.joining.lines import Line, angle_between, extent

SLACK = 0.012  # of H: a wider gap between a foot and its junction is bridged, a narrower one closed
OVERSHOOT = 0.025  # of H: how far past its parent a foot may have been drawn
CROSSES = np.radians(25)  # lines that meet at less run side by side
RISING = 0.2  # cosine with the vertical above which a line that starts at a foot on the ground is a stem
STRAIGHT_ON = np.radians(75)  # a line that leaves a tip at more is a lateral there


@dataclass(eq=False)
class Limb:
    """One branch: lines end to end. `parent` NULL for a stem."""

    lines: list[int]
    points: Float[np.ndarray, "point 2"]
    width: Float[np.ndarray, " point"]
    row: Int[np.ndarray, " point"]  # stroke that drew each point
    parent: int = NULL
    s: float = 0.0  # where it sits, length along the parent limb
    slack: float = 0.0  # its first points are dropped rather than bridged to where it sits, if no farther than this
    joins: list[float] = field(default_factory=list)  # lengths at which the next line begins

    def __post_init__(self):
        self.along = np.r_[0.0, np.cumsum(np.hypot(*np.diff(self.points, axis=0).T))]

    def line_at(self, s: float) -> int:
        """The line of this limb that drew length `s` (the earlier one at a join)."""
        return self.lines[int(np.searchsorted(self.joins, s - 1e-9 * self.along[-1]))]


def limbs_of(lines: list[Line], hanging: Hanging) -> list[Limb]:
    """The limbs, parents before children; lengths along a limb are from its foot."""
    height = extent(lines)
    oriented = [line.reversed() if end else line for line, end in zip(lines, hanging.end, strict=True)]
    parent, s = hanging.parent.copy(), hanging.s.copy()
    oriented, s = _meet(oriented, parent, s, height)
    order = _parents_first(parent)
    _siblings(oriented, parent, s, order, height)
    order = _parents_first(parent)
    heir = _heirs(oriented, parent, s, height)
    return _assemble(oriented, parent, s, order, heir, height)


def _meet(lines: list[Line], parent, s, height: float) -> tuple[list[Line], Float[np.ndarray, " line"]]:
    """Cut overshoots and find the meeting points. Lengths on a line whose foot was cut count from the cut."""
    met, place, cut = list(lines), s.copy(), np.zeros(len(lines))
    for k in _crossed(lines, parent, height):
        line, shape = lines[k], lines[parent[k]].shape
        crossing = _last_crossing(line, shape, height)
        if crossing is not None:
            cut[k] = crossing
            met[k] = line.cut(crossing, line.length)
            place[k] = shape.project(shapely.Point(line.at(crossing)))
    inner = parent != NULL
    place[inner] = np.maximum(place[inner] - cut[parent[inner]], 0.0)
    return met, place


def _crossed(lines: list[Line], parent, height: float) -> list[int]:
    """The lines that meet their parent within an overshoot of their foot."""
    child = np.flatnonzero(parent != NULL)
    if len(child) == 0:
        return []
    feet = []
    for line in (lines[k] for k in child):
        reach = min(OVERSHOOT * height, 0.3 * line.length)
        count = int(np.searchsorted(line.along, reach, side="right"))
        feet.append(np.concatenate([line.points[:count], line.at(np.array([reach]))]))
    index = np.repeat(np.arange(len(feet)), [len(points) for points in feet])
    shapes = np.array([line.shape for line in lines], object)
    near = shapely.dwithin(shapely.linestrings(np.concatenate(feet), indices=index), shapes[parent[child]], 1e-9 * height)
    return child[near].tolist()


def _last_crossing(line: Line, shape: shapely.LineString, height: float) -> float | None:
    """The length at which an overshot foot crosses its parent for the last time, at an angle that is no accident."""
    reach = min(OVERSHOOT * height, 0.3 * line.length)
    crossings = shapely.get_coordinates(line.cut(0.0, reach).shape.intersection(shape))
    found = None
    for point in crossings:
        s, there = (float(curve.project(shapely.Point(point))) for curve in (line.shape, shape))
        near = 0.5 * reach
        parent = np.subtract(*(np.array(shape.interpolate(t).coords[0]) for t in (there + near, max(there - near, 0.0))))
        angle = angle_between(line.direction(s, near), parent)
        if min(angle, np.pi - angle) > CROSSES and s > (found or 0.0):
            found = s
    return found


def _siblings(lines: list[Line], parent, s, order: list[int], height: float) -> None:
    """Hang what starts at the foot of a line onto that line's parent; in place."""
    for k in order:
        above = parent[k]
        if above == NULL or s[k] > foot_reach(lines[above], height):
            continue
        if parent[above] != NULL:
            parent[k], s[k] = parent[above], s[above]
        elif lines[k].direction(0.0, REACH * height)[1] > RISING:
            parent[k] = NULL  # a second stem from the same foot
        else:
            s[k] = 0.0


def _heirs(lines: list[Line], parent, s, height: float) -> list[int]:
    """For every line the one that carries it on from its tip, else NULL. Moves children near a tip onto it."""
    heir, least = [NULL] * len(lines), [STRAIGHT_ON] * len(lines)
    for k, line in enumerate(lines):
        above = parent[k]
        if above == NULL or s[k] < lines[above].length - foot_reach(lines[above], height):
            continue
        s[k] = lines[above].length
        reach = REACH * height
        bend = float(angle_between(lines[above].direction(s[k], reach), line.direction(0.0, reach)))
        if bend < least[above] - 1e-9:
            heir[above], least[above] = k, bend
    return heir


def _assemble(lines: list[Line], parent, s, order: list[int], heir: list[int], height: float) -> list[Limb]:
    limb_of, offset = [NULL] * len(lines), np.zeros(len(lines))
    limbs: list[Limb] = []
    for first in order:
        if parent[first] != NULL and heir[parent[first]] == first:
            continue
        chain = [first]
        while heir[chain[-1]] != NULL:
            chain.append(heir[chain[-1]])
        above = parent[first]
        limb = _chain(lines, chain, offset, height)
        if above != NULL:
            limb.parent, limb.s = limb_of[above], float(offset[above] + s[first])
            limb.slack = max(SLACK * height, foot_reach(lines[above], height))
        for k in chain:
            limb_of[k] = len(limbs)
        limbs.append(limb)
    return limbs


def _chain(lines: list[Line], chain: list[int], offset, height: float) -> Limb:
    """Lines end to end as one limb; writes the length at which each begins to `offset`."""
    line = lines[chain[0]]
    points, width, row, joins = line.points, line.width, np.full(len(line.points), line.row), []
    length = line.length
    for k, before in zip(chain[1:], (lines[j] for j in chain), strict=False):
        offset[k] = length
        joins.append(length)
        slack = max(SLACK * height, foot_reach(before, height))
        start = beyond(lines[k].points, lines[k].along, points[-1], slack)
        points = np.concatenate([points, lines[k].points[start:]])
        width = np.concatenate([width, lines[k].width[start:]])
        row = np.concatenate([row, np.full(len(lines[k].points) - start, lines[k].row)])
        length = float(np.hypot(*np.diff(points, axis=0).T).sum())
    return Limb(list(chain), points, width, row, joins=joins)


def beyond(points, along, junction, slack: float) -> int:
    """The first point to keep when a line is made to start at `junction`: all, if the gap is wider than `slack`."""
    gap = float(np.hypot(*(points[0] - junction)))
    if gap > slack:
        return 0
    return int(min(np.searchsorted(along, gap, side="right"), len(points) - 1))


def _parents_first(parent) -> list[int]:
    children: list[list[int]] = [[] for _ in parent]
    order = []
    for k, above in enumerate(parent.tolist()):
        (order if above == NULL else children[above]).append(k)
    for k in order:
        order.extend(children[k])
    return order
