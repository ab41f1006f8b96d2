"""Which lines does a skeleton hold, and where do they meet? Its pixels as a graph of nodes and edges.

Pixels are neighbours if they share a side, or a corner without a common neighbour on either side of it; so a plain
line has two neighbours everywhere. Pixels with one neighbour are ends, with three or more are joints, and the pixels
between are an edge. Joints that touch each other are one. A spur, an edge with a free end, is only the
border's roughness unless it reaches out of the ink around its joint by SPUR of its half width and the pen's width. Where a limb
ends bluntly its middle line forks into the two corners: a fork that reaches out by less than CORNER goes.
"""

from dataclasses import dataclass, field

import numpy as np
from jaxtyping import Bool, Float, Int

SPUR = (0.5, 0.4)  # least reach of a side line out of the ink: half widths of the joint, plus pens
CORNER = 1.8  # half widths of the limb
TOUCH = (2.3, 0.6)  # pixels, half widths of the ink there: joints no farther apart are one

_AROUND = np.array([(-1, 0), (0, 1), (1, 0), (0, -1), (-1, 1), (1, 1), (1, -1), (-1, -1)])


@dataclass(eq=False)
class Edge:
    """One line between two nodes; `points` run from node `a` to node `b`, both included. Pixels, (x, y), y DOWN."""

    a: int
    b: int
    points: Float[np.ndarray, "point 2"]
    half: Float[np.ndarray, " point"]  # half the width of the ink

    @property
    def length(self) -> float:
        """Length, pixels."""
        return float(np.hypot(*np.diff(self.points, axis=0).T).sum())

    def leaving(self, node: int) -> tuple[Float[np.ndarray, "point 2"], Float[np.ndarray, " point"]]:
        """(points, half widths) in the direction away from one of its nodes."""
        return (self.points, self.half) if node == self.a else (self.points[::-1], self.half[::-1])

    def other(self, node: int) -> int:
        """The node at the other end."""
        return self.b if node == self.a else self.a


@dataclass(eq=False)
class Web:
    """Nodes and the edges between them."""

    edges: dict[int, Edge] = field(default_factory=dict)
    at: dict[int, list[int]] = field(default_factory=dict)  # node → its edges, a loop twice
    place: dict[int, Float[np.ndarray, " 2"]] = field(default_factory=dict)  # node → point
    half: dict[int, float] = field(default_factory=dict)  # node → half width of the ink there
    made: int = 0  # edges made so far

    def add(self, edge: Edge) -> int:
        """A new edge; its number."""
        self.made += 1
        self.edges[self.made] = edge
        self.at.setdefault(edge.a, []).append(self.made)
        self.at.setdefault(edge.b, []).append(self.made)
        return self.made

    def drop(self, key: int) -> Edge:
        """Take an edge away."""
        edge = self.edges.pop(key)
        self.at[edge.a].remove(key)
        self.at[edge.b].remove(key)
        return edge

    def degree(self, node: int) -> int:
        """How many edges end in a node."""
        return len(self.at[node])


def trace(skeleton: Bool[np.ndarray, "row col"], half: Float[np.ndarray, "row col"], pen: float) -> Web:
    """The graph of a skeleton, joints merged, spurs pruned, no node left on a plain line. `pen`: width of its line, pixels."""
    web = _web(skeleton, half)
    _merge_joints(web)
    _prune(web, pen)
    _cut_corners(web)
    return web


def _web(skeleton: Bool[np.ndarray, "row col"], half: Float[np.ndarray, "row col"]) -> Web:
    """The graph as it stands."""
    rows, cols = np.nonzero(skeleton)
    points = np.stack([cols + 0.5, rows + 0.5], 1)
    widths = half[rows, cols].astype(float)
    near = _neighbours(skeleton, rows, cols)
    degree = (near >= 0).sum(1)
    web = Web()
    is_node = degree != 2
    beside: list[list[int]] = [[n for n in line if n >= 0] for line in near.tolist()]
    node_here = is_node.tolist()
    seen = [False] * len(rows)

    def follow(start: int) -> None:
        for first in beside[start]:
            if seen[first] and not node_here[first]:
                continue
            if node_here[first] and first < start:
                continue
            way, before, here = [start], start, first
            while not node_here[here]:
                seen[here] = True
                way.append(here)
                onward = beside[here][0] if beside[here][0] != before else beside[here][1]
                before, here = here, onward
            way.append(here)
            web.add(Edge(start, here, points[way], widths[way]))

    for start in np.flatnonzero(is_node).tolist():
        web.at.setdefault(start, [])
        follow(start)
    for start in np.flatnonzero(~is_node).tolist():  # closed loops without a joint
        if not seen[start]:
            node_here[start] = True
            follow(start)
    for node in web.at:
        web.place[node], web.half[node] = points[node], float(widths[node])
    return web


def _neighbours(skeleton: Bool[np.ndarray, "row col"], rows, cols) -> Int[np.ndarray, "pixel 8"]:
    """Rows (in scan order) of every pixel's neighbours, -1 where there is none."""
    index = np.full((skeleton.shape[0] + 2, skeleton.shape[1] + 2), -1, np.int64)
    index[rows + 1, cols + 1] = np.arange(len(rows))
    near = np.stack([index[rows + 1 + dy, cols + 1 + dx] for dy, dx in _AROUND], 1)
    for corner, (one, two) in enumerate([(0, 1), (1, 2), (2, 3), (3, 0)], start=4):
        near[(near[:, one] >= 0) | (near[:, two] >= 0), corner] = -1
    return near


def _merge_joints(web: Web) -> None:
    """Joints that touch each other become one, at their mean place."""
    group: dict[int, int] = {}

    def find(node: int) -> int:
        while group.get(node, node) != node:
            node = group[node]
        return node

    is_joint = {node for node in web.at if web.degree(node) > 2}
    for key, edge in list(web.edges.items()):
        if edge.a != edge.b and edge.a in is_joint and edge.b in is_joint and edge.length <= _touch(web, edge):
            web.drop(key)
            one, two = sorted((find(edge.a), find(edge.b)))
            group[two] = one
    members: dict[int, list[int]] = {}
    for node in group:
        members.setdefault(find(node), []).append(node)
    for head, nodes in members.items():
        _fuse(web, head, sorted({head, *nodes}))


def _touch(web: Web, edge: Edge) -> float:
    return max(TOUCH[0], TOUCH[1] * min(web.half[edge.a], web.half[edge.b]))


def _fuse(web: Web, head: int, nodes: list[int]) -> None:
    place = np.mean([web.place[node] for node in nodes], axis=0)
    for node in nodes:
        for key in list(dict.fromkeys(web.at[node])):
            edge = web.edges[key]
            if edge.a == node:
                edge.a, edge.points, edge.half = head, np.vstack([place, edge.points]), np.r_[web.half[node], edge.half]
            if edge.b == node:
                edge.b, edge.points, edge.half = head, np.vstack([edge.points, place]), np.r_[edge.half, web.half[node]]
        if node != head:
            web.at[head] += web.at.pop(node)
    web.place[head] = place
    web.half[head] = max(web.half[node] for node in nodes)
    for node in nodes:
        if node != head:
            del web.place[node], web.half[node]
    for key in [k for k in set(web.at[head]) if web.edges[k].a == web.edges[k].b and web.edges[k].length <= 4 * TOUCH[0]]:
        web.drop(key)


def _prune(web: Web, pen: float) -> None:
    """Drop spurs, the shortest of each joint first, until there are none."""
    waiting = sorted(web.at)
    while waiting:
        again: set[int] = set()
        for node in waiting:
            if node not in web.at or web.degree(node) < 3:
                continue
            spurs = [(reach, key) for key in web.at[node] if (reach := _reach(web, node, key)) < SPUR[0] * web.half[node] + SPUR[1] * pen]
            if spurs:
                end = web.drop(min(spurs)[1]).other(node)
                del web.at[end], web.place[end], web.half[end]
                again.add(node)
                if web.degree(node) == 2:
                    again |= _dissolve(web, node)
        waiting = sorted(again)
    for node in list(web.at):
        if node in web.at and web.degree(node) == 2:
            _dissolve(web, node)


def _cut_corners(web: Web) -> None:
    """Take away both lines of a fork into the corners of a blunt end."""
    for node in sorted(web.at):
        if node not in web.at or web.degree(node) != 3 or len(set(web.at[node])) < 3:
            continue
        limb = max(web.at[node], key=lambda key: web.edges[key].length)
        corners = [key for key in web.at[node] if key != limb]
        if web.edges[limb].length > 2 * web.half[node] and all(_reach(web, node, key) < CORNER * web.half[node] for key in corners):
            for key in corners:
                end = web.drop(key).other(node)
                del web.at[end], web.place[end], web.half[end]


def _reach(web: Web, node: int, key: int) -> float:
    """How far a line with a free end reaches out of the ink around its joint; ∞ for other lines."""
    edge = web.edges[key]
    end = edge.other(node)
    if end == node or web.degree(end) != 1:
        return np.inf
    return edge.length + float(edge.leaving(node)[1][-1]) - web.half[node]


def _dissolve(web: Web, node: int) -> set[int]:
    """Make the two edges at a node one; the nodes at its ends. A loop keeps its node."""
    first, second = web.at[node]
    if first == second:
        return set()
    one, two = web.drop(first), web.drop(second)
    del web.at[node], web.place[node], web.half[node]
    a, b = one.other(node), two.other(node)
    (p, hp), (q, hq) = one.leaving(node), two.leaving(node)
    web.add(Edge(a, b, np.vstack([p[::-1], q[1:]]), np.r_[hp[::-1], hq[1:]]))
    return {a, b}
