"""How deep does each limb stand, if siblings keep as far from each other as they can?

§II.3: a parent's k sub-branches are turned about its axis by Gaussian angles, "while their orthogonal projection in the input image remains unchanged":

    θ_i ~ N(2π (k − i) / k, σ_i),   0 ≤ i < k

    i    number of the sub-branch            θ_i   its azimuth about the parent's axis p, from the page's right-hand side towards the viewer

The paper does not say which sub-branch is which i, nor from where angles count. So, ours: whatever order and first angle (of `PHASES`) make the crown round (`around`). All k angles are taken, an even turn apart.

A limb that sets out along d on the page, and z towards the viewer for every unit of it, has the azimuth atan2(c·w, c·u) with c = (d, z), u = (p_y, −p_x, 0) / |·| and w = u × p. As u lies in the page, only c·w holds z:

    z = ((d·u) tan θ − d·w) / w_z

The side on which a limb is drawn is known, cos θ has its sign: an angle that says the other side is mirrored, θ → π − θ, which keeps the side towards the viewer. A limb at θ near ±π/2 would leave the page without
bound: from `STEEPEST` / 2 on, z only tends to `STEEPEST`; and no limb leaves a round crown about the trunk, as wide as the tree is seen to be at that height (`Room`). Once more, ours: the trunk's limbs lean as much farther out, and to one side, as it
takes that the tips spread over depth as they do over width, and to no diagonal. z goes on with the length on the page; x and y are never touched. A limb that turns up on the page turns up in depth too, ours: where it is steeper than
where it set out, z goes on the less, by the ratio of the sines to the vertical, `LEAST_ON` at least.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Array, Float, Int, Key
from scipy.ndimage import gaussian_filter1d

from sketchtree.axes import NULL
from sketchtree.keys import normal
from sketchtree.sketch.graph import SketchGraph
from sketchtree.trunk.around import around, seen_about, siblings_of

STEEPEST = 1.5
LEAST_ON = 0.35
_UPRIGHT = 0.1  # sine to the vertical: a limb that sets out steeper than that has no side that it could turn up from
ENOUGH = 8  # tips, of which an evenness can be said
SHEAR, STRETCH = 0.7, 1.6  # at most, to even out
ROOMY, FLAT = 1.2, 0.4  # of the crown's half width at a height: its radius, and the depth there is at its very sides
_ROUNDS, _NEAR_BY = 3, 0.1
_LEVELS = 20
SPREAD = float(np.radians(20.0))  # σ


def sibling_angles(graph: SketchGraph, key: Key[Array, ""], spread: float = SPREAD) -> Float[np.ndarray, " limb"]:
    """θ of every limb, radians; NaN of a trunk. `spread`: σ."""
    mean = np.full(len(graph.limb_id), np.nan)
    older = np.zeros(2)
    for host, limbs in siblings_of(graph):
        mean[limbs], older = around(seen_about(graph, host, limbs), older)
    return mean + spread * normal(key, graph.limb_id, 0)


def sibling_depth(graph: SketchGraph, angle: Float[np.ndarray, " limb"]) -> Float[np.ndarray, " segment"]:
    """z of every node towards the viewer, sketch units."""
    room, lean = Room.of(graph), np.array([1.0, 0.0])
    depth = _depth(graph, angle, room, lean)
    for _ in range(_ROUNDS if room is not None else 0):
        lean = _evener(room.aside[room.ends], depth[room.ends], lean)
        depth = _depth(graph, angle, room, lean)
    return depth


def _depth(graph: SketchGraph, angle, room: "Room | None", lean) -> Float[np.ndarray, " segment"]:
    """The same; limbs of the trunk have their z stretched by `lean`'s first number, and by its second times what they go to the right."""
    slope, depth = np.zeros(len(graph.limb_id)), np.zeros(len(graph))
    for limb in np.argsort(graph.limb_first):
        rows, host = np.flatnonzero((graph.limb == limb) & (graph.parent != NULL)), graph.limb_parent[limb]
        if host == NULL or len(rows) == 0:
            continue
        first = int(rows[0])
        up, onward = int(graph.parent[first]), _onward(graph, first)
        aside = max(abs(float(onward[0])), _UPRIGHT)
        on = np.clip([abs(_onward(graph, row)[0]) / aside for row in rows], LEAST_ON, 1.0)
        run = np.cumsum(on * [np.hypot(*np.diff(graph.curve(row), axis=0).T).sum() for row in rows])
        slope[limb] = leaving(onward, np.append(_tangent(graph, up, host), slope[host]), float(angle[limb]))
        if graph.limb_parent[host] == NULL:
            slope[limb] = np.clip(lean[0] * slope[limb] + lean[1] * onward[0], -STEEPEST, STEEPEST)
        if room is not None:
            slope[limb] = room.within(slope[limb], float(depth[up]), run, rows)
        depth[rows] = depth[up] + slope[limb] * run
    return depth


def _evener(aside, depth, lean) -> Float[np.ndarray, " 2"]:
    """What makes the tips spread over depth as they do over width, and to no diagonal, after what was tried."""
    wide, both, deep = np.cov(np.stack([aside, depth]), bias=True)[[0, 0, 1], [0, 1, 1]]
    shear = lean[1] - both / max(wide, 1e-9)
    rest = max(deep - both**2 / max(wide, 1e-9), 1e-9)
    return np.array([np.clip(lean[0] * np.sqrt(wide / rest), 1.0 / STRETCH, STRETCH), np.clip(shear, -SHEAR, SHEAR)])


@dataclass(frozen=True, eq=False)
class Room:
    """How deep a round crown is where every node is seen."""

    aside: Float[np.ndarray, " segment"]  # to the right of the trunk, on the page
    deep: Float[np.ndarray, " segment"]  # to either side
    ends: Int[np.ndarray, " tip"]  # tips of limbs

    @classmethod
    def of(cls, graph: SketchGraph) -> "Room | None":
        """Round the trunk, as wide at each height as the farthest limb near by; None of a few limbs, or of several trunks."""
        ends = np.flatnonzero((np.bincount(graph.parent[graph.parent != NULL], minlength=len(graph)) == 0) & (graph.limb != 0))
        if len(ends) < ENOUGH or np.count_nonzero(graph.is_base) != 1:
            return None
        trunk, (x, y) = np.flatnonzero(graph.limb == 0), graph.xy.T
        trunk = trunk[np.argsort(y[trunk], kind="stable")]
        aside = x - np.interp(y, y[trunk], x[trunk])
        level = np.linspace(y.min(), y.max(), _LEVELS)
        near = np.abs(y - level[:, None]) <= _NEAR_BY * max(float(np.ptp(y)), 1e-9)
        half = ROOMY * np.interp(y, level, gaussian_filter1d(np.where(near, np.abs(aside), 0.0).max(axis=1), 1.0, mode="nearest"))
        return cls(aside, np.maximum(np.sqrt(np.maximum(half**2 - aside**2, 0.0)), FLAT * half), ends)

    def within(self, slope: float, foot: float, run: Float[np.ndarray, " row"], rows: Int[np.ndarray, " row"]) -> float:
        """The slope nearest to one given with which a limb from depth `foot` stays within the crown, as far as its foot lets it."""
        far = np.maximum(self.deep[rows], abs(foot))
        return float(np.clip(slope, np.max((-far - foot) / np.maximum(run, 1e-9)), np.min((far - foot) / np.maximum(run, 1e-9))))


def leaving(d: Float[np.ndarray, " 2"], p: Float[np.ndarray, " 3"], theta: float) -> float:
    """z per unit of d, so that (d, z) has the azimuth θ about p as far as its drawn side and `STEEPEST` let it."""
    u = np.array([p[1], -p[0]]) / np.hypot(p[0], p[1])
    axis = p / np.linalg.norm(p)
    w = np.array([u[1] * axis[2], -u[0] * axis[2], u[0] * axis[1] - u[1] * axis[0]])
    aside = float(d @ u)
    tangent = np.sin(theta) / max(abs(np.cos(theta)), 1e-9) * (1.0 if aside >= 0 else -1.0)  # mirrored to the drawn side: |aside| tan of the angle out of the page
    z, half = (aside * tangent - float(d @ w[:2])) / w[2], STEEPEST / 2.0
    return float(z if abs(z) <= half else np.copysign(half + half * np.tanh((abs(z) - half) / half), z))


def _onward(graph: SketchGraph, row: int) -> Float[np.ndarray, " 2"]:
    step = graph.xy[row] - graph.start[row]
    return step / max(float(np.hypot(*step)), 1e-9)


def _tangent(graph: SketchGraph, at: int, host: int) -> Float[np.ndarray, " 2"]:
    """The direction in which a limb runs through one of its nodes; through its base, in which it sets out."""
    return _onward(graph, int(graph.limb_first[host]) if graph.is_base[at] else at)
