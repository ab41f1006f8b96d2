"""Which lines go on through a joint? The straightest pairs of like width; the others end there.

    cost(e, f) = θ + WIDTH |log(w_e / w_f)|      θ angle by which the line would turn, radians; w widths

Directions are taken beyond the ink of the joint itself, whose middle line leans towards whatever meets there. Two lines
that cross at a slant share a short piece of their skeleton, a bridge between two joints: there the pairs are made
across the bridge if both lines go on straight over it.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float

from sketchtree.sketch.raster.tracing import Edge, Web

BEND = np.radians(36)  # greatest turn of a line that goes on through a joint
STRAIGHT = np.radians(28)  # the same over a bridge
APART = np.radians(8)  # least angle between two lines that cross
WIDTH = 0.5  # radians for a width e times as large
REACH = 9.0  # half widths beyond the joint's ink over which a direction is taken
SWOLLEN = 1.25  # of a line's half width: where it is wider, from the joint on, it is one ink with its neighbour
BRIDGE = (4.0, 3.0)  # half widths: a bridge is no longer than the first and the second / sin(angle of the crossing)
HUB = 6  # lines in one joint: they spread from there, as fronds do from a palm's head, unless all go STAR straight on
STAR = np.radians(15)
RING = 12.0  # half widths: a shorter loop is not drawn in one line

End = tuple[int, int]  # (edge, 0 at its node a or 1 at its node b)


@dataclass(frozen=True)
class Links:
    """Which ends of edges go on into which; a bridge is crossed by two lines."""

    onward: dict[End, End]
    bridges: dict[int, tuple[tuple[End, End], ...]]  # bridge → the pairs of ends that go over it


@dataclass(frozen=True)
class Arm:
    """How an edge leaves one of its joints, beyond the joint's ink."""

    x: float
    y: float
    dx: float  # unit direction, away from the joint
    dy: float
    half: float  # half the width of its line


def link(web: Web, pen: float) -> Links:
    """Pair the ends of the edges at every joint. `pen` is the width of a pen's line, pixels."""
    arms = {(key, side): arm(edge, side, pen, web.half[node]) for key, edge in web.edges.items() for side, node in enumerate((edge.a, edge.b))}
    bridges = _bridges(web, arms, pen)
    crossed = {node for key in bridges for node in (web.edges[key].a, web.edges[key].b)}
    onward: dict[End, End] = {}
    for node in sorted(web.at):
        if node not in crossed and web.degree(node) > 1:
            onward.update(_pairs(web, arms, node))
    for pairs in bridges.values():
        onward.update({a: b for pair in pairs for a, b in (pair, pair[::-1])})
    return Links(onward, bridges)


def crossings(web: Web, pen: float) -> Float[np.ndarray, "place 3"]:
    """(x, y, length of the shortest edge there) where two lines go on through each other: in a joint, or at either end of a bridge."""
    links = link(web, pen)
    found = []
    for node in (node for node in sorted(web.at) if web.degree(node) > 3):
        ends = _ends(web, node)
        if sum(end in links.onward for end in ends) > 3:
            found.append((*web.place[node], min(web.edges[key].length for key, _ in ends)))
    for key, pairs in links.bridges.items():
        shortest = min(web.edges[end[0]].length for pair in pairs for end in pair)
        found += [(*web.place[node], shortest) for node in (web.edges[key].a, web.edges[key].b)]
    return np.array(found, float).reshape(-1, 3)


def arm(edge: Edge, side: int, pen: float, skip: float) -> Arm:
    """The arm of an edge at its node a (0) or b (1), taken from `skip` pixels on."""
    points, half = (edge.points, edge.half) if side == 0 else (edge.points[::-1], edge.half[::-1])
    s = np.zeros(len(points))
    np.cumsum(np.hypot(*np.diff(points, axis=0).T), out=s[1:])
    width = float(half.mean())
    swollen = half > SWOLLEN * max(float(np.partition(half, len(half) // 2)[len(half) // 2]), 0.5 * pen)
    skip = min(max(skip, float(s[np.argmin(swollen)])), 0.4 * s[-1])
    far = min(skip + REACH * max(0.5 * pen, width), s[-1])
    x, y = np.interp([skip, far], s, points[:, 0]), np.interp([skip, far], s, points[:, 1])
    norm = max(float(np.hypot(x[1] - x[0], y[1] - y[0])), 1e-9)
    beside = half[(s >= skip) & (s <= far)]
    width = float(beside.mean()) if len(beside) else width
    return Arm(float(x[0]), float(y[0]), float(x[1] - x[0]) / norm, float(y[1] - y[0]) / norm, max(width, 0.5))


def _ends(web: Web, node: int) -> list[End]:
    found: list[End] = []
    for key in dict.fromkeys(web.at[node]):
        edge = web.edges[key]
        found += [(key, 0)] * (edge.a == node) + [(key, 1)] * (edge.b == node)
    return found


def _cost(one: Arm, two: Arm) -> tuple[float, float]:
    """(cost, angle) of a line that comes in by one arm and goes on by the other."""
    turn = _angle(-one.dx, -one.dy, two.dx, two.dy)
    return turn + WIDTH * abs(float(np.log(one.half / two.half))), turn


def _angle(ax: float, ay: float, bx: float, by: float) -> float:
    return abs(float(np.arctan2(ax * by - ay * bx, ax * bx + ay * by)))


def _pairs(web: Web, arms: dict[End, Arm], node: int) -> dict[End, End]:
    """The cheapest pairs of a joint, one after the other."""
    ends = _ends(web, node)
    costs = []
    for k, one in enumerate(ends):
        for two in ends[k + 1 :]:
            cost, turn = _cost(arms[one], arms[two])
            ring = one[0] == two[0] and web.edges[one[0]].length < RING * web.half[node]
            if turn <= BEND and not ring:
                costs.append((round(cost, 9), turn, one, two))
    onward: dict[End, End] = {}
    for _, turn, one, two in sorted(costs):
        if one not in onward and two not in onward and (len(ends) < HUB or turn <= STAR):
            onward[one], onward[two] = two, one
    return onward if len(ends) < HUB or len(onward) == len(ends) else {}


def _bridges(web: Web, arms: dict[End, Arm], pen: float) -> dict[int, tuple[tuple[End, End], ...]]:
    """The short edges over which two lines go straight on, the shortest first; no joint is at two of them."""
    found: dict[int, tuple[tuple[End, End], ...]] = {}
    used: set[int] = set()
    short = [(edge.length, key) for key, edge in web.edges.items() if edge.a != edge.b and web.degree(edge.a) == web.degree(edge.b) == 3]
    for length, key in sorted(short):
        edge = web.edges[key]
        half = max(0.5 * pen, min(web.half[edge.a], web.half[edge.b]))
        if length > _longest(APART) * half or {edge.a, edge.b} & used:
            continue
        pairs = _over(web, arms, key)
        if pairs and length <= _longest(_between(arms, pairs)) * half:
            found[key] = pairs
            used |= {edge.a, edge.b}
    return found


def _longest(angle: float) -> float:
    """Greatest length of a bridge that two lines share which cross at an angle, half widths."""
    return BRIDGE[0] + BRIDGE[1] / float(np.sin(np.clip(angle, APART, np.pi / 2)))


def _between(arms: dict[End, Arm], pairs: tuple[tuple[End, End], ...]) -> float:
    """The angle at which two lines cross, 0 to π/2."""
    one, two = (arms[pair[0]] for pair in pairs)
    angle = _angle(one.dx, one.dy, two.dx, two.dy)
    return min(angle, np.pi - angle)


def _over(web: Web, arms: dict[End, Arm], key: int) -> tuple[tuple[End, End], ...]:
    """The two pairs that cross a bridge, () where none do."""
    edge = web.edges[key]
    (a, b), (c, d) = ([end for end in _ends(web, node) if end[0] != key] for node in (edge.a, edge.b))
    if len({end[0] for end in (a, b, c, d)}) < 4:
        return ()
    best: tuple[float, tuple[tuple[End, End], ...]] = (np.inf, ())
    for pairs in (((a, c), (b, d)), ((a, d), (b, c))):
        both = [_straight(arms[one], arms[two]) for one, two in pairs]
        total = sum(cost for cost, _ in both)
        if max(turn for _, turn in both) <= STRAIGHT and total < best[0]:
            best = (total, pairs)
    if not best[1]:
        return ()
    return best[1] if _between(arms, best[1]) >= APART else ()


def _straight(one: Arm, two: Arm) -> tuple[float, float]:
    """(cost, greatest turn) of a line over a bridge: also of each half against the line between the two."""
    cost, turn = _cost(one, two)
    x, y = two.x - one.x, two.y - one.y
    first, second = _angle(-one.dx, -one.dy, x, y), _angle(x, y, two.dx, two.dy)
    return cost + first + second, max(turn, first, second)
