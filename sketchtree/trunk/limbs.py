"""Which branch carries each limb on, and which ones grow from it? The trunk's graph as a drawing, so that all that is done to strokes can be done to it.

Where the axis forks, the limb goes on in the branch that is straightest for its thickness, of those that carry at least `CARRIES` of what the heaviest carries (a twig that happens to be straight carries no trunk on): the least of (bend in radians − r / r_widest), the bend measured over two radii of the fork's circle and 8 pixels at
least, r the median radius of what follows up to the next fork. A limb is as thick at its foot as where it leaves its parent. Limbs are called trunk, trunk.1, trunk.1.2 …: ids are of these names.
"""

import dataclasses

import numpy as np
from jaxtyping import Float, Int

from sketchtree.axes import NULL
from sketchtree.photo.as_graph import as_drawing
from sketchtree.photo.marked import Marked
from sketchtree.photo.trace.traced import Traced
from sketchtree.sketch.graph import SketchGraph
from sketchtree.sketch.strokes import Sketch
from sketchtree.trunk.borne import borne_radius, carried
from sketchtree.trunk.rooted import chains
from sketchtree.trunk.trunk_skeleton import TrunkSkeleton

CARRIES = 0.25
SIDE = 0.35  # of the bearer's radius: a limb so thick widens the circles along its fork
_LOOK, _LEAST_LOOK = 2.0, 8.0  # radii of the fork's circle; pixels


def trunk_drawing(skeleton: TrunkSkeleton, name: str = "trunk") -> tuple[Sketch, SketchGraph]:
    """(the limbs as strokes, their segment tree): pixels, y UP."""
    order = _parents_first(skeleton)
    number = np.argsort(order)
    parent = skeleton.parent[order]
    parent = np.where(parent == NULL, NULL, number[parent])
    xy, radius = skeleton.xy[order], skeleton.radius[order]
    limb, rank = limb_of(parent, xy, radius)
    count = int(limb.max()) + 1
    own = own_radius(parent, xy, radius, limb)
    thick = borne_radius(parent, xy, between_forks(parent, xy, radius, own, limb), limb)
    traced = Traced(parent, xy, thick, rank, limb, np.ones(len(parent), bool), skeleton.warnings)
    marked = Marked(np.zeros((0, 2)), (np.zeros((0, 2)),) * count, ("trunk",) * count)
    sketch, graph = as_drawing([(traced, marked)], name, outlines=[()])
    told = tuple(dataclasses.replace(one, reason="a branch of the matte's skeleton") for one in graph.attachments)
    return sketch, graph.replace(attachments=told)


def limb_of(parent: Int[np.ndarray, " node"], xy, radius) -> tuple[Int[np.ndarray, " node"], Int[np.ndarray, " node"]]:
    """(limb, branching order) of every node; limb 0 is the trunk."""
    limb, rank = np.zeros(len(parent), np.int64), np.zeros(len(parent), np.int64)
    wood = carried(parent, np.r_[0.0, np.hypot(*(xy[1:] - xy[parent[1:]]).T)])
    starting: dict[int, list[list[int]]] = {}
    for chain in chains(parent):
        starting.setdefault(chain[0], []).append(chain)
    before = {0: np.array([0.0, -1.0])}  # direction in which each fork is reached
    count = 1
    for fork in sorted(starting):
        apical = _straightest(starting[fork], before[fork], xy, radius, wood)
        for k, chain in enumerate(starting[fork]):
            own = k == apical
            limb[chain[1:]] = limb[fork] if own else count
            rank[chain[1:]] = rank[fork] + (not own)
            count += not own
            before[chain[-1]] = _direction(xy[chain[::-1]], -1.0, radius[chain[-1]])
    return limb, rank


def own_radius(parent: Int[np.ndarray, " node"], xy, radius, limb: Int[np.ndarray, " node"]) -> Float[np.ndarray, " node"]:
    """The radius of every node's own limb: what lies within the circle of the fork that it grows from is as thick as where it leaves that circle (there the distance to the contour is its parent's)."""
    thick = np.array(radius, np.float64)
    for first in np.flatnonzero((parent != NULL) & (limb != limb[parent])):
        rows, fork = np.flatnonzero(limb == limb[first]), parent[first]
        outside = np.hypot(*(xy[rows] - xy[fork]).T) >= radius[fork]
        inner = rows[: int(np.argmax(outside)) if outside.any() else len(rows)]
        thick[inner] = np.minimum(thick[inner], radius[rows[np.argmax(outside)]] if outside.any() else radius[rows].min())
    return thick


def between_forks(parent: Int[np.ndarray, " node"], xy, radius, own, limb: Int[np.ndarray, " node"]) -> Float[np.ndarray, " node"]:
    """The radius of every node where its limb is alone: along a fork, where the largest circle reaches into another limb, that between the places before and behind it. Of limbs of `SIDE` their bearer's radius and more;
    `own`: as `own_radius` says."""
    thick = np.array(own, np.float64)
    first = np.flatnonzero((parent != NULL) & (limb != limb[parent]))
    for bearer in np.unique(limb[parent[first]]):
        rows = np.flatnonzero(limb == bearer)
        line = xy[rows]
        run = np.r_[0.0, np.cumsum(np.hypot(*np.diff(line, axis=0).T))]
        alone = np.ones(len(rows), bool)
        for child in first[limb[parent[first]] == bearer]:
            foot, side = parent[child], np.flatnonzero(limb == limb[child])
            at = int(np.flatnonzero(rows == foot)[0]) if foot in rows else 0
            if own[child] < SIDE * own[foot]:
                continue
            apart = np.hypot(*(line[:, None] - xy[side][None]).transpose(2, 0, 1)).min(axis=1) > radius[rows] + own[child]
            beyond = np.flatnonzero(apart[at:])
            until = run[at + beyond[0]] if len(beyond) else run[-1]
            alone &= (run < run[at] - 0.5 * own[foot]) | (run >= until)
        if alone.any() and not alone.all():
            thick[rows] = np.minimum(own[rows], np.interp(run, run[alone], own[rows][alone]))
    return thick


def _straightest(own: list[list[int]], before, xy, radius, wood) -> int:
    heavy = [float(wood[chain[1]]) for chain in own]
    wide = [float(np.median(radius[chain[1:]])) for chain in own]
    onward = [_direction(xy[chain], 1.0, radius[chain[0]]) for chain in own]
    bend = [float(np.arccos(np.clip(before @ step, -1.0, 1.0))) for step in onward]
    return int(np.argmin([b - w / max(wide) if h >= CARRIES * max(heavy) else np.inf for b, w, h in zip(bend, wide, heavy, strict=True)]))


def _direction(line, sign: float, radius: float):
    """The unit direction from a line's first point to where it is a few radii away; turned round by sign −1."""
    away = np.hypot(*(line - line[0]).T)
    far = np.flatnonzero(away >= max(_LOOK * radius, _LEAST_LOOK))
    step = sign * (line[far[0] if len(far) else -1] - line[0])
    return step / max(float(np.hypot(*step)), 1e-9)


def _parents_first(skeleton: TrunkSkeleton) -> Int[np.ndarray, " node"]:
    """The nodes by their distance in edges from the root."""
    parent, depth = skeleton.parent, np.zeros(len(skeleton), np.int64)
    at = parent.copy()
    while (at != NULL).any():
        depth += at != NULL
        at = np.where(at == NULL, NULL, parent[at])
    return np.argsort(depth, kind="stable")
