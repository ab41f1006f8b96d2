"""Which lines make one limb, and where exactly do limbs meet?

Every line is turned foot first. An overshoot at its foot is cut where it crosses its parent; from there, or from the
parent's nearest point, it is made to start: a narrow gap is closed, a wide one bridged. A line that starts at the foot of another
is its sibling. Where lines start at the tip of another, the one that bends least carries that limb on (Chen §7 takes
the smallest angle for the apical child).
"""

import math
from bisect import bisect_left
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
import shapely
from jaxtyping import Float, Int

from sketchtree.axes import NULL
from sketchtree.sketch.joining.attach import Hanging
from sketchtree.sketch.joining.bundle import Bundle
from sketchtree.sketch.joining.candidates import foot_reach
from sketchtree.sketch.joining.evidence import REACH
from sketchtree.sketch.joining.lines import Line, angle_between, lengths, unit

SLACK = 0.012  # of H: a wider gap between a foot and its junction is bridged, a narrower one closed
OVERSHOOT = 0.025  # of H: how far past its parent a foot may have been drawn
CROSSES = np.radians(25)  # lines that meet at less run side by side
SAME = 1e-9  # of H: nearer than this is the same point
RISING = 0.2  # cosine with the vertical above which a line that starts at a foot on the ground is a stem
STRAIGHT_ON = np.radians(75)  # a line that leaves a tip at more is a lateral there


@dataclass(eq=False)
class Limb:
    """One branch: lines end to end, from the point where it sits on its parent. `parent` NULL for a stem."""

    lines: list[int]
    points: Float[np.ndarray, "point 2"]
    width: Float[np.ndarray, " point"]
    row: Int[np.ndarray, " point"]  # stroke that drew each point
    parent: int = NULL
    s: float = 0.0  # where it sits, length along the parent limb
    joins: list[float] = field(default_factory=list)  # lengths at which the next line begins

    @cached_property
    def along(self) -> Float[np.ndarray, " point"]:
        """Length of the limb up to each point."""
        return lengths(self.points)

    def at(self, s: float) -> Float[np.ndarray, " 2"]:
        """The point at length `s`; beyond an end, the end."""
        k = min(max(int(self.along.searchsorted(s)), 1), len(self.along) - 1)
        low, high = float(self.along[k - 1]), float(self.along[k])
        t = min(max((s - low) / (high - low), 0.0), 1.0) if high > low else 0.0
        return self.points[k - 1] * (1 - t) + self.points[k] * t

    def line_at(self, s: float) -> int:
        """The line of this limb that drew length `s` (the earlier one at a join)."""
        return self.lines[bisect_left(self.joins, s - 1e-9 * self.along[-1])]


def limbs_of(lines: list[Line], hanging: Hanging) -> list[Limb]:
    """The limbs, parents before children; lengths along a limb are from its foot."""
    oriented = [line.reversed() if end else line for line, end in zip(lines, hanging.end, strict=True)]
    bundle = Bundle.of_points([line.points for line in oriented])
    height = bundle.height
    parent, s = hanging.parent.copy(), hanging.s.copy()
    cut, s = _meet(bundle, parent, s)
    for k in np.flatnonzero(cut).tolist():
        oriented[k] = oriented[k].cut(cut[k], oriented[k].length)
    reach = np.array([foot_reach(line, height) for line in oriented])
    rising = _onward(bundle, np.arange(len(bundle)), cut)[:, 1] > RISING
    _siblings(parent, s, _parents_first(parent), reach, rising)
    heir = _heirs(bundle, parent, s, cut, reach)
    return _assemble(oriented, parent, s, _parents_first(parent), heir, reach, height)


def _meet(bundle: Bundle, parent, s) -> tuple[Float[np.ndarray, " line"], Float[np.ndarray, " line"]]:
    """(how much to cut off each foot, the meeting points). Lengths on a line whose foot is cut count from the cut.

    An overshot foot is cut where it crosses its parent for the last time, at an angle that is no accident.
    """
    cut, place = np.zeros(len(bundle)), s.copy()
    child = np.flatnonzero(parent != NULL)
    stubs, reach = _stubs(bundle, child)
    near = shapely.dwithin(stubs, bundle.shapes[parent[child]], SAME * bundle.height) if len(child) else np.zeros(0, bool)
    child, reach = child[near], reach[near]
    crossing, index = shapely.get_coordinates(shapely.intersection(stubs[near], bundle.shapes[parent[child]]), return_index=True)
    child, reach, points = child[index], 0.5 * reach[index], shapely.points(crossing)
    here, there = (shapely.line_locate_point(bundle.shapes[line], points) for line in (child, parent[child]))
    angle = angle_between(bundle.direction(child, here, reach), bundle.direction(parent[child], there, reach))
    crosses = (np.minimum(angle, np.pi - angle) > CROSSES) & (here > 0)
    order = np.flatnonzero(crosses)[np.argsort(here[crosses], kind="stable")]
    cut[child[order]], place[child[order]] = here[order], there[order]
    inner = parent != NULL
    place[inner] = np.maximum(place[inner] - cut[parent[inner]], 0.0)
    return cut, place


def _stubs(bundle: Bundle, line) -> tuple[np.ndarray, Float[np.ndarray, " line"]]:
    """(the first piece of each line as far as an overshoot reaches, for shapely; how long it is)."""
    reach = np.minimum(OVERSHOOT * bundle.height, 0.3 * bundle.length[line])
    begin = bundle.first[line]
    count = np.searchsorted(bundle.run, bundle.begin[line] + reach, side="right") - begin
    each = np.repeat(np.arange(len(line)), count + 1)
    rank = np.arange(len(each)) - (np.cumsum(count + 1) - count - 1)[each]
    points = bundle.points[begin[each] + np.minimum(rank, count[each] - 1)]
    last = np.cumsum(count + 1) - 1
    points[last] = bundle.at(line, reach)
    return shapely.linestrings(points, indices=each), reach


def _siblings(parent, s, order: list[int], reach, rising) -> None:
    """Hang what starts at the foot of a line onto that line's parent; in place."""
    for k in order:
        above = parent[k]
        if above == NULL or s[k] > reach[above]:
            continue
        if parent[above] != NULL:
            parent[k], s[k] = parent[above], s[above]
        elif rising[k]:
            parent[k] = NULL  # a second stem from the same foot
        else:
            s[k] = 0.0


def _heirs(bundle: Bundle, parent, s, cut, reach) -> list[int]:
    """For every line the one that carries it on from its tip, else NULL. Moves children near a tip onto it."""
    heir, least = [NULL] * len(bundle), [STRAIGHT_ON] * len(bundle)
    length = bundle.length - cut
    child = np.flatnonzero(parent != NULL)
    child = child[s[child] >= (length - reach)[parent[child]]]
    s[child] = length[parent[child]]
    ahead = bundle.direction(parent[child], bundle.length[parent[child]], REACH * bundle.height)
    bend = angle_between(ahead, _onward(bundle, child, cut[child]))
    for k, angle in zip(child.tolist(), bend.tolist(), strict=True):
        if angle < least[parent[k]] - 1e-9:
            heir[parent[k]], least[parent[k]] = k, angle
    return heir


def _onward(bundle: Bundle, line, s) -> Float[np.ndarray, "line 2"]:
    """Direction of each line as it goes on from `s`."""
    return unit(bundle.at(line, s + REACH * bundle.height) - bundle.at(line, s))


def _assemble(lines: list[Line], parent, s, order: list[int], heir: list[int], reach, height: float) -> list[Limb]:
    limb_of, offset = [NULL] * len(lines), np.zeros(len(lines))
    limbs: list[Limb] = []
    for first in order:
        if parent[first] != NULL and heir[parent[first]] == first:
            continue
        chain = [first]
        while heir[chain[-1]] != NULL:
            chain.append(heir[chain[-1]])
        above = parent[first]
        if above == NULL:
            limb = _chain(lines, chain, offset, reach, height)
        else:
            seat, place = limb_of[above], max(float(offset[above] + s[first]), 0.0)
            limb = _chain(lines, chain, offset, reach, height, _started(lines[first], limbs[seat].at(place), max(SLACK * height, float(reach[above]))))
            limb.parent, limb.s = seat, place
        for k in chain:
            limb_of[k] = len(limbs)
        limbs.append(limb)
    return limbs


def _started(line: Line, junction, slack: float):
    """(points, widths) of a line made to start at its junction, and what lengths along it gain by that."""
    start = beyond(line.points, line.along, junction, slack)
    points, width = np.concatenate([junction[None], line.points[start:]]), np.concatenate([line.width[start : start + 1], line.width[start:]])
    return points, width, math.dist(line.points[start], junction) - float(line.along[start])


def _chain(lines: list[Line], chain: list[int], offset, reach, height: float, started=None) -> Limb:
    """Lines end to end as one limb, the first as `started` says; writes to `offset` what lengths along each gain."""
    line, joins = lines[chain[0]], []
    points, width, offset[chain[0]] = started or (line.points, line.width, 0.0)
    row = np.full(len(points), line.row)
    length = line.length + float(offset[chain[0]])
    for k, before in zip(chain[1:], chain, strict=False):
        joins.append(length)
        slack = max(SLACK * height, float(reach[before]))
        start = beyond(lines[k].points, lines[k].along, points[-1], slack)
        offset[k] = length + math.dist(lines[k].points[start], points[-1]) - float(lines[k].along[start])
        points = np.concatenate([points, lines[k].points[start:]])
        width = np.concatenate([width, lines[k].width[start:]])
        row = np.concatenate([row, np.full(len(lines[k].points) - start, lines[k].row)])
        length = float(np.hypot(*np.diff(points, axis=0).T).sum())
    return Limb(list(chain), points, width, row, joins=joins)


def beyond(points, along, junction, slack: float) -> int:
    """The first point to keep when a line is made to start at `junction`: all, if the gap is wider than `slack`."""
    gap = math.dist(points[0], junction)
    if gap > slack:
        return 0
    return min(int(along.searchsorted(gap, side="right")), len(points) - 1)


def _parents_first(parent) -> list[int]:
    children: list[list[int]] = [[] for _ in parent]
    order = []
    for k, above in enumerate(parent.tolist()):
        (order if above == NULL else children[above]).append(k)
    for k in order:
        order.extend(children[k])
    return order
