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
from sketchtree.sketch.joining.bundle import Bundle
from sketchtree.sketch.joining.candidates import foot_reach
from sketchtree.sketch.joining.evidence import REACH
from sketchtree.sketch.joining.lines import Line, angle_between, unit

SLACK = 0.012  # of H: a wider gap between a foot and its junction is bridged, a narrower one closed
OVERSHOOT = 0.025  # of H: how far past its parent a foot may have been drawn
CROSSES = np.radians(25)  # lines that meet at less run side by side
SAME = 1e-9  # of H: nearer than this is the same point
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
    oriented = [line.reversed() if end else line for line, end in zip(lines, hanging.end, strict=True)]
    bundle = Bundle.of(oriented)
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
        limb = _chain(lines, chain, offset, reach, height)
        if above != NULL:
            limb.parent, limb.s = limb_of[above], float(offset[above] + s[first])
            limb.slack = max(SLACK * height, float(reach[above]))
        for k in chain:
            limb_of[k] = len(limbs)
        limbs.append(limb)
    return limbs


def _chain(lines: list[Line], chain: list[int], offset, reach, height: float) -> Limb:
    """Lines end to end as one limb; writes the length at which each begins to `offset`."""
    line = lines[chain[0]]
    points, width, row, joins = line.points, line.width, np.full(len(line.points), line.row), []
    length = line.length
    for k, before in zip(chain[1:], chain, strict=False):
        offset[k] = length
        joins.append(length)
        slack = max(SLACK * height, float(reach[before]))
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
