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

BEND = np.radians(60)  # greatest turn of a line that goes on through a joint
STRAIGHT = np.radians(28)  # the same over a bridge
WIDTH = 0.5  # radians for a width e times as large
REACH = 5.0  # half widths beyond the joint's ink over which a direction is taken
BRIDGE = 7.0  # half widths: a bridge is no longer
RING = 12.0  # half widths: a shorter loop is not drawn in one line

End = tuple[int, int]  # (edge, 0 at its node a or 1 at its node b)


@dataclass(frozen=True)
class Links:
    """Which ends of edges go on into which; a bridge is crossed by two lines."""

    onward: dict[End, End]
    bridges: dict[int, tuple[tuple[End, End], ...]]  # bridge → the pairs of ends that go over it


def link(web: Web, pen: float) -> Links:
    """Pair the ends of the edges at every joint. `pen` is the width of a typical line, pixels."""
    bridges = _bridges(web, pen)
    crossed = {node for key in bridges for node in (web.edges[key].a, web.edges[key].b)}
    onward: dict[End, End] = {}
    for node in sorted(web.at):
        if node not in crossed:
            onward.update(_pairs(web, _ends(web, node), pen))
    for pairs in bridges.values():
        onward.update({a: b for pair in pairs for a, b in (pair, pair[::-1])})
    return Links(onward, bridges)


def heading(edge: Edge, side: int, pen: float, skip: float) -> Float[np.ndarray, " 2"]:
    """Unit direction in which an edge leaves its node, taken from `skip` pixels on."""
    points, half = (edge.points, edge.half) if side == 0 else (edge.points[::-1], edge.half[::-1])
    s = np.r_[0.0, np.cumsum(np.hypot(*np.diff(points, axis=0).T))]
    skip = min(skip, 0.4 * s[-1])
    reach = REACH * max(0.5 * pen, float(np.median(half)))
    far = min(skip + reach, s[-1])
    ends = [[np.interp(at, s, points[:, k]) for k in (0, 1)] for at in (skip, far)]
    step = np.subtract(ends[1], ends[0])
    return step / max(float(np.hypot(*step)), 1e-9)


def _ends(web: Web, node: int) -> list[End]:
    found: list[End] = []
    for key in dict.fromkeys(web.at[node]):
        edge = web.edges[key]
        found += [(key, 0)] * (edge.a == node) + [(key, 1)] * (edge.b == node)
    return found


def _width(web: Web, end: End) -> float:
    """Half width of an edge near one of its ends: the middle one of what lies outside the joint."""
    edge = web.edges[end[0]]
    half = edge.half if end[1] == 0 else edge.half[::-1]
    skip = int(web.half[edge.a if end[1] == 0 else edge.b])
    outside = half[min(skip, len(half) // 2) :][: max(8, 4 * skip)]
    return max(float(np.median(outside)), 0.5)


def _cost(web: Web, one: End, two: End, pen: float, skip: float) -> tuple[float, float]:
    """(cost, angle) of a line that comes in by one end and goes on by the other."""
    a, b = heading(web.edges[one[0]], one[1], pen, skip), heading(web.edges[two[0]], two[1], pen, skip)
    turn = float(np.arccos(np.clip(-np.dot(a, b), -1.0, 1.0)))
    return turn + WIDTH * abs(float(np.log(_width(web, one) / _width(web, two)))), turn


def _pairs(web: Web, ends: list[End], pen: float) -> dict[End, End]:
    """The cheapest pairs of a joint, one after the other."""
    node_half = {end: web.half[web.edges[end[0]].a if end[1] == 0 else web.edges[end[0]].b] for end in ends}
    costs = []
    for k, one in enumerate(ends):
        for two in ends[k + 1 :]:
            cost, turn = _cost(web, one, two, pen, node_half[one])
            ring = one[0] == two[0] and web.edges[one[0]].length < RING * node_half[one]
            if turn <= BEND and not ring:
                costs.append((cost, one, two))
    onward: dict[End, End] = {}
    for _, one, two in sorted(costs):
        if one not in onward and two not in onward:
            onward[one], onward[two] = two, one
    return onward


def _bridges(web: Web, pen: float) -> dict[int, tuple[tuple[End, End], ...]]:
    """The short edges over which two lines go straight on, the shortest first; no joint is at two of them."""
    found: dict[int, tuple[tuple[End, End], ...]] = {}
    used: set[int] = set()
    for key, edge in sorted(web.edges.items(), key=lambda item: (item[1].length, item[0])):
        half = max(0.5 * pen, min(web.half[edge.a], web.half[edge.b]))
        if edge.a == edge.b or edge.length > BRIDGE * half or {edge.a, edge.b} & used:
            continue
        pairs = _over(web, key, pen)
        if pairs:
            found[key] = pairs
            used |= {edge.a, edge.b}
    return found


def _over(web: Web, key: int, pen: float) -> tuple[tuple[End, End], ...]:
    """The two pairs that cross a bridge, () where none do."""
    edge = web.edges[key]
    sides = [[end for end in _ends(web, node) if end[0] != key] for node in (edge.a, edge.b)]
    if [len(side) for side in sides] != [2, 2] or len({end[0] for side in sides for end in side}) < 4:
        return ()
    (a, b), (c, d) = sides
    best: tuple[float, tuple[tuple[End, End], ...]] = (np.inf, ())
    for pairs in (((a, c), (b, d)), ((a, d), (b, c))):
        both = [_straight(web, *pair, pen) for pair in pairs]
        worst = max(turn for _, turn in both)
        if worst <= STRAIGHT and (total := sum(cost for cost, _ in both)) < best[0]:
            best = (total, pairs)
    if not best[1]:
        return ()
    through = [heading(web.edges[one[0]], one[1], pen, web.half[edge.a]) for one, _ in best[1]]
    return best[1] if np.dot(*through) < np.cos(np.radians(8)) else ()


def _straight(web: Web, one: End, two: End, pen: float) -> tuple[float, float]:
    """(cost, greatest turn) of a line over a bridge: also of each half against the line between the two."""
    e, f = web.edges[one[0]], web.edges[two[0]]
    skip = max(web.half[e.a if one[1] == 0 else e.b], web.half[f.a if two[1] == 0 else f.b])
    cost, turn = _cost(web, one, two, pen, skip)
    ends = [_beyond(e, one[1], skip), _beyond(f, two[1], skip)]
    chord = ends[1] - ends[0]
    chord = chord / max(float(np.hypot(*chord)), 1e-9)
    turns = np.dot(-heading(e, one[1], pen, skip), chord), np.dot(heading(f, two[1], pen, skip), chord)
    lean = np.arccos(np.clip(turns, -1.0, 1.0))
    return cost + float(lean.sum()), max(turn, float(lean.max()))


def _beyond(edge: Edge, side: int, skip: float) -> Float[np.ndarray, " 2"]:
    points = edge.points if side == 0 else edge.points[::-1]
    s = np.r_[0.0, np.cumsum(np.hypot(*np.diff(points, axis=0).T))]
    at = min(skip, 0.4 * s[-1])
    return np.array([np.interp(at, s, points[:, k]) for k in (0, 1)])
