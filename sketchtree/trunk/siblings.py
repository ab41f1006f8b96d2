"""How deep does each limb stand, if siblings keep as far from each other as they can?

§II.3: a parent's k sub-branches are turned about its axis by Gaussian angles, "while their orthogonal projection in the input image remains unchanged":

    θ_i ~ N(2π (k − i) / k, σ_i),   0 ≤ i < k

    i    number of the sub-branch            θ_i   its azimuth about the parent's axis p, from the page's right-hand side towards the viewer

The paper does not say which sub-branch is which i. Numbered from below, the lower half of a tree would lean back and the upper one forward; we number them so that from one to the next along the parent i grows by about
k times the golden section's smaller part (the step nearest to 0.382 k that shares no divisor with k): all k angles are taken, and neighbours stand about a golden angle apart, as leaves on a shoot do.

A limb that sets out along d on the page, and z towards the viewer for every unit of it, has the azimuth atan2(c·w, c·u) with c = (d, z), u = (p_y, −p_x, 0) / |·| and w = u × p. As u lies in the page, only c·w holds z:

    z = ((d·u) tan θ − d·w) / w_z

The side on which a limb is drawn is known, cos θ has its sign: an angle that says the other side is mirrored, θ → π − θ, which keeps the side towards the viewer. A limb at θ near ±π/2 would leave the page without
bound: from `STEEPEST` / 2 on, z only tends to `STEEPEST`. z goes on with the length on the page; x and y are never touched. A limb that turns up on the page turns up in depth too, ours: where it is steeper than
where it set out, z goes on the less, by the ratio of the sines to the vertical, `LEAST_ON` at least.
"""

import math

import numpy as np
from jaxtyping import Array, Float, Int, Key

from sketchtree.axes import NULL
from sketchtree.keys import normal
from sketchtree.sketch.graph import SketchGraph

STEEPEST = 1.0
LEAST_ON = 0.35
_UPRIGHT = 0.1  # sine to the vertical: a limb that sets out steeper than that has no side that it could turn up from
GOLDEN = (3.0 - math.sqrt(5.0)) / 2.0
SPREAD = float(np.radians(20.0))  # σ


def sibling_angles(graph: SketchGraph, key: Key[Array, ""], spread: float = SPREAD) -> Float[np.ndarray, " limb"]:
    """θ of every limb, radians; NaN of a trunk. `spread`: σ."""
    rank, count = _ranks(graph)
    number = rank * np.array([golden_step(int(k)) for k in count]) % np.maximum(count, 1)
    mean = 2.0 * np.pi * (count - number) / np.maximum(count, 1)
    return np.where(graph.limb_parent == NULL, np.nan, mean + spread * normal(key, graph.limb_id, 0))


def golden_step(k: int) -> int:
    """The step nearest to 0.382 k that shares no divisor with k."""
    return min((step for step in range(1, max(k, 2)) if math.gcd(step, max(k, 1)) == 1), key=lambda step: abs(step - GOLDEN * k))


def sibling_depth(graph: SketchGraph, angle: Float[np.ndarray, " limb"]) -> Float[np.ndarray, " segment"]:
    """z of every node towards the viewer, sketch units."""
    slope, aside, depth = np.zeros(len(graph.limb_id)), np.ones(len(graph.limb_id)), np.zeros(len(graph))
    for row in range(len(graph)):
        up, limb = graph.parent[row], graph.limb[row]
        if up == NULL:
            continue
        if row == graph.limb_first[limb] and graph.limb_parent[limb] != NULL:
            host = graph.limb[up]
            aside[limb] = max(abs(float(_onward(graph, row)[0])), _UPRIGHT)
            slope[limb] = leaving(_onward(graph, row), np.append(_tangent(graph, up, host), slope[host]), float(angle[limb]))
        on = float(np.clip(abs(_onward(graph, row)[0]) / aside[limb], LEAST_ON, 1.0))
        depth[row] = depth[up] + on * slope[limb] * float(np.hypot(*np.diff(graph.curve(row), axis=0).T).sum())
    return depth


def leaving(d: Float[np.ndarray, " 2"], p: Float[np.ndarray, " 3"], theta: float) -> float:
    """z per unit of d, so that (d, z) has the azimuth θ about p as far as its drawn side and `STEEPEST` let it."""
    u = np.array([p[1], -p[0]]) / np.hypot(p[0], p[1])
    axis = p / np.linalg.norm(p)
    w = np.array([u[1] * axis[2], -u[0] * axis[2], u[0] * axis[1] - u[1] * axis[0]])
    aside = float(d @ u)
    tangent = np.sin(theta) / max(abs(np.cos(theta)), 1e-9) * (1.0 if aside >= 0 else -1.0)  # mirrored to the drawn side: |aside| tan of the angle out of the page
    z, half = (aside * tangent - float(d @ w[:2])) / w[2], STEEPEST / 2.0
    return float(z if abs(z) <= half else np.copysign(half + half * np.tanh((abs(z) - half) / half), z))


def _ranks(graph: SketchGraph) -> tuple[Int[np.ndarray, " limb"], Int[np.ndarray, " limb"]]:
    """(rank of every limb along its parent, how many that has)."""
    place = {int(limb): k for k, limb in enumerate(np.argsort(graph.limb_first))}  # parents' rows first: from below
    order = sorted(range(len(graph.limb_id)), key=lambda limb: (graph.parent[graph.limb_first[limb]], place[limb]))
    rank, count = np.zeros(len(order), np.int64), np.bincount(graph.limb_parent[graph.limb_parent != NULL], minlength=len(order))
    seen = np.zeros(len(order), np.int64)
    for limb in order:
        host = graph.limb_parent[limb]
        if host != NULL:
            rank[limb] = seen[host]
            seen[host] += 1
    return rank, np.where(graph.limb_parent == NULL, 0, count[graph.limb_parent])


def _onward(graph: SketchGraph, row: int) -> Float[np.ndarray, " 2"]:
    step = graph.xy[row] - graph.start[row]
    return step / max(float(np.hypot(*step)), 1e-9)


def _tangent(graph: SketchGraph, at: int, host: int) -> Float[np.ndarray, " 2"]:
    """The direction in which a limb runs through one of its nodes; through its base, in which it sets out."""
    return _onward(graph, int(graph.limb_first[host]) if graph.is_base[at] else at)
