"""Where do the nodes of a factor graph lie over the sketch? Variables on their segments, factors between what they look at.

    variable     the middle of its segment, unless it would hide another
    label        the joint where the reader joined two strokes; it stays there
    factor       the centroid of its variables, a crown factor beyond its tip; then pushed apart until no two hide each other
"""

from typing import NamedTuple

import numpy as np
from jaxtyping import Float, Int
from scipy.spatial import cKDTree

from sketchtree.axes import NULL
from sketchtree.mrf.blocks import Block
from sketchtree.mrf.factor_graph import FactorGraph
from sketchtree.overlay.marks import Placing

LARGEST, SMALLEST, CROWDED = 7.5, 2.6, 88.0  # pixels: radius of a node at most and at least; times √(number of nodes) in between
BESIDE = {"limb_length": (0.0, 1.0), "solid_angle": (0.3, -1.0), "segment_length": (-0.3, -1.0), "stem": (0.0, 1.0), "crown": (1.0, 0.0)}
"""Where a factor stands that would lie on its variable: along the segment, across it."""
ROUNDS = 150
ASKEW = np.array([[0.94, 0.34], [-0.34, 0.94]])  # pushes are turned a little, so that a node held between two slips past them


class Nodes(NamedTuple):
    """Positions in pixels."""

    radius: float
    variable: Float[np.ndarray, "segment 2"]  # at bases: the base
    label: Float[np.ndarray, "segment 2"]  # where a segment starts
    factor: dict[str, Float[np.ndarray, "factor 2"]]  # kind → one place a factor


def placed(graph: FactorGraph, shown: dict[str, Block], place: Placing, keep_clear: Float[np.ndarray, "point 2"]) -> Nodes:
    """All nodes of the blocks that are shown; factors stay away from the points to `keep_clear`."""
    start = np.where(graph.is_base[:, None], graph.xy, graph.xy[graph.parent])
    variable, tip, joint = place((start + graph.xy) / 2), place(graph.xy), place(start)
    count = int((~graph.is_base).sum()) + sum(map(len, shown.values()))
    radius = float(np.clip(CROWDED / np.sqrt(count), SMALLEST, LARGEST))
    variable[~graph.is_base] = pushed_apart(variable[~graph.is_base], np.zeros((0, 2)), 2.2 * radius)
    along = graph.direction * (1, -1)
    wanted = [np.zeros((0, 2))]
    for kind, block in shown.items():
        wanted.append(_wanted(kind, block.rows, tip if kind == "crown" else variable, along, radius))
    fixed = np.concatenate([variable, tip[graph.is_base], joint[graph.is_joined], keep_clear])
    found = pushed_apart(np.concatenate(wanted), fixed, 2.55 * radius)
    ends = np.cumsum([len(block) for block in shown.values()])
    return Nodes(radius, variable, joint, dict(zip(shown, np.split(found, ends[:-1]), strict=True)) if shown else {})


def _wanted(kind: str, rows: Int[np.ndarray, "factor arity"], at, along, radius: float):
    looks = (rows != NULL)[..., None]
    centroid = (at[rows] * looks).sum(1) / np.maximum(looks.sum(1), 1)
    first = along[rows[:, 0]]
    ahead, aside = BESIDE.get(kind, (0.0, 0.0))
    across = np.stack([first[:, 1], -first[:, 0]], 1)
    return centroid + 3.2 * radius * (ahead * first + aside * across)


def pushed_apart(
    wanted: Float[np.ndarray, "point 2"], fixed: Float[np.ndarray, "fixed 2"], apart: float, rounds: int = ROUNDS
) -> Float[np.ndarray, "point 2"]:
    """Places near the wanted ones, at least about `apart` from each other and from what is fixed, as far as the rounds get."""
    moving = len(wanted)
    turn = 2.399963 * np.arange(moving)  # the golden angle: no two that coincide are pushed the same way
    points = np.concatenate([wanted + 1e-3 * apart * np.stack([np.cos(turn), np.sin(turn)], 1), fixed])
    for k in range(rounds):
        pair = cKDTree(points).query_pairs(apart, output_type="ndarray")
        pair = pair[(pair < moving).any(axis=1)]
        if not len(pair):
            break
        between = points[pair[:, 0]] - points[pair[:, 1]]
        distance = np.maximum(np.hypot(*between.T), 1e-6)
        both = (pair < moving).all(axis=1)
        between = between @ ASKEW
        push = (between / distance[:, None]) * ((apart * 1.01 - distance) * np.where(both, 0.5, 1.0) * 0.7)[:, None]
        np.add.at(points, pair[:, 0], np.where(pair[:, :1] < moving, push, 0.0))
        np.add.at(points, pair[:, 1], np.where(pair[:, 1:] < moving, -push, 0.0))
        if k < rounds // 2:
            points[:moving] += 0.02 * (wanted - points[:moving])
    return points[:moving]
