"""How would a careless hand have drawn this tree? Strokes that wobble, fall short, run over, and are drawn the wrong way.

An exact drawing (`drawing.draw`) gives every stroke's line and the line and place that it grows from. Then, with
H the drawn height, ℓ = 5 % H and j the jitter in % of H:

    wobble     every line is moved by its own smooth noise, x and y alike Gaussian of standard deviation j % H, with
               correlation exp(−d² / 2ℓ²) between points d apart along it
    junction   `moored` (the default): the whole stroke then moves so that it starts where its parent was really drawn, as a
               person's does who looks at the page: the noise of its parent at the junction less its own noise there is
               carried along it in full. `adrift`: it stays where its own noise has put it, gaps of √2 j % H and more
    gap        `short` (the default): it is begun U(0, 1.5 %) H late along its way, as by a person who stops short of the
               line that it comes from. `aside`: its start is moved off by as much in any direction, fading out over ℓ
    overshoot  one stroke in five starts U(0.3, 2 %) H before its junction instead, straight on backward
    retraced   one in ten is gone over again, 0.2 % H off: either there and back in one stroke, back over 30-100 % of it,
               or the whole of it as a second stroke of its own
    reversed   one in two is drawn from its tip
    order      shuffled

`slips` scales the gap and the shares of overshot and retraced strokes: 0 is a careful hand. No pressure, no width, no time. `Wobbly` keeps the truth beside the strokes.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int
from scipy.ndimage import gaussian_filter1d

from benchmarks.drawing import Case
from sketchtree.axes import NULL
from sketchtree.sketch.graph import SketchGraph
from sketchtree.sketch.strokes import Sketch, Stroke

STEP = 0.006  # of H, between drawn points
CORRELATION = 0.05  # ℓ, of H
GAP = 0.015  # of H, the widest gap at a start
OVERSHOOT, OVERSHOT = (0.003, 0.02), 0.2  # of H; share of strokes
RETRACED, OFF = 0.1, 0.002  # share of strokes; of H
REVERSED = 0.5  # share of strokes


@dataclass(frozen=True, eq=False)
class Wobbly:
    """A wobbly drawing and what it shows. Strokes of the truth are numbered 0 (the trunk), 1, …"""

    name: str
    sketch: Sketch
    line: tuple[Float[np.ndarray, "point 2"], ...]  # of every true stroke as drawn: foot first, no retracing, no overshoot
    parent: Int[np.ndarray, " stroke"]  # NULL: the trunk
    s: Float[np.ndarray, " stroke"]  # where it grows from, length along the parent's drawn line
    node: tuple[Float[np.ndarray, " node"], ...]  # of every stroke: lengths along its line of its true nodes, 0 left out
    ids: tuple[tuple[str, ...], ...]  # of every true stroke: the strokes of the sketch that draw it
    height: float  # H

    @property
    def segment_count(self) -> int:
        """How many true segments there are."""
        return sum(len(node) for node in self.node)


def wobbly(case: Case, jitter: float, *, moored: bool = True, short: bool = True, slips: float = 1.0, rng: np.random.Generator) -> Wobbly:
    """`case` drawn by a careless hand; `jitter` is j, % of H."""
    graph = case.graph
    height = float(np.ptp(np.concatenate([graph.xy, graph.curve_points])[:, 1]))
    lines: list[np.ndarray] = []
    nodes, seats = [], np.zeros(len(graph.limb_id))
    exacts, noises, whole, cut, overshot = [], [], [], [], []  # of every stroke; `whole`: before it is begun late
    for limb, above in enumerate(graph.limb_parent.tolist()):
        exact, node = _finely(graph, limb, STEP * height)
        exacts.append(exact)
        noise = _noise(len(exact), jitter / 100 * height, rng)
        if above != NULL:
            at = int(np.argmin(np.hypot(*(exacts[above] - exact[0]).T)))
            if moored:
                noise = noise + noises[above][at] - noise[0]
            seats[limb] = _lengths(whole[above])[at]
        noises.append(noise)
        past = above != NULL and rng.uniform() < slips * OVERSHOT
        gap = 0.0 if above == NULL or (past and short) else slips * rng.uniform(0, GAP * height)
        drawn, late = _late(exact + noise, gap) if short else (exact + noise + _aside(len(exact), gap, rng), 0.0)
        seats[limb] = max(seats[limb] - cut[above], 0.0) if above != NULL else 0.0
        whole.append(exact + noise if short else drawn)
        lines.append(drawn)
        overshot.append(past)
        cut.append(late)
        nodes.append(np.maximum(_lengths(exact + noise if short else drawn)[node[1:]] - late, 0.0))
    strokes, ids = [], []
    for limb, line in enumerate(lines):
        own = [Stroke(f"s{limb}{'abc'[k]}", points) for k, points in enumerate(_as_drawn(line, overshot[limb], height, slips, rng))]
        strokes += own
        ids.append(tuple(stroke.id for stroke in own))
    shuffled = tuple(strokes[k] for k in rng.permutation(len(strokes)))
    return Wobbly(case.name, Sketch(shuffled, name=case.name), tuple(lines), graph.limb_parent, seats, tuple(nodes), tuple(ids), height)


def _finely(graph: SketchGraph, limb: int, step: float) -> tuple[Float[np.ndarray, "point 2"], Int[np.ndarray, " node"]]:
    """(the exact line of a limb, its junction first, with points `step` apart; which of them are nodes)."""
    rows = np.flatnonzero((graph.limb == limb) & ~graph.is_base)
    curves = [graph.curve(row) for row in rows]
    points = np.concatenate([curves[0][:1], *(curve[1:] for curve in curves)])
    node = np.cumsum([0] + [len(curve) - 1 for curve in curves])
    along = _lengths(points)
    count = np.maximum(1, np.round(np.diff(along[node]) / step).astype(int))
    index = np.r_[0, np.cumsum(count)]
    s = np.interp(np.arange(index[-1] + 1), index, along[node])
    return np.stack([np.interp(s, along, points[:, axis]) for axis in (0, 1)], 1), index


def _lengths(points) -> Float[np.ndarray, " point"]:
    return np.r_[0.0, np.cumsum(np.hypot(*np.diff(points, axis=0).T))]


def _noise(count: int, size: float, rng) -> Float[np.ndarray, "point 2"]:
    """Smooth noise of standard deviation `size` along a line of `count` points STEP apart."""
    sigma = CORRELATION / STEP / np.sqrt(2)
    pad = int(5 * sigma)
    white = gaussian_filter1d(rng.normal(size=(count + 2 * pad, 2)), sigma, axis=0)[pad : pad + count]
    return size * white * np.sqrt(2 * np.sqrt(np.pi) * sigma)


def _late(line: Float[np.ndarray, "point 2"], gap: float) -> tuple[Float[np.ndarray, "point 2"], float]:
    """(the line without its first `gap`, or half of it where it is shorter than that; how much was left out)."""
    along = _lengths(line)
    gap = min(gap, 0.5 * along[-1])
    first = [np.interp(gap, along, line[:, axis]) for axis in (0, 1)]
    return np.vstack([first, line[along > gap]]), gap


def _aside(count: int, gap: float, rng) -> Float[np.ndarray, "point 2"]:
    """How far the points of a line are moved whose start is off by `gap`."""
    angle = rng.uniform(0, 2 * np.pi)
    fade = np.clip(1 - np.arange(count) * STEP / CORRELATION, 0, 1)
    return fade[:, None] * gap * np.array([np.cos(angle), np.sin(angle)])


def _as_drawn(line, overshot: bool, height: float, slips: float, rng) -> list[Float[np.ndarray, "point 2"]]:
    """The stroke(s) that draw a line."""
    points = line
    if overshot:
        back = line[0] - line[min(4, len(line) - 1)]
        past = line[0] + back / np.hypot(*back) * rng.uniform(*OVERSHOOT) * height
        points = np.vstack([past, line])
    again = rng.uniform() < slips * RETRACED
    strokes = [points]
    if again:
        second = line + _noise(len(line), OFF * height, rng)
        if rng.uniform() < 0.5:
            back = max(2, int(rng.uniform(0.3, 1.0) * len(line)))
            strokes = [np.vstack([points, second[::-1][1:back]])]
        else:
            strokes = [points, second]
    return [stroke[::-1] if rng.uniform() < REVERSED else stroke for stroke in strokes]
