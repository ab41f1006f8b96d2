"""Which lines are roots? What runs on below the ground from the foot of a stem.

Below a drawn ground line everything that hangs together with a stem's foot is root, and lines that pass through are cut there.
Without one, roots are what starts at the foot of the tallest line, runs downward to both sides, and what goes on from that,
as long as it is less deep than the tree is tall and the tree has more than one line above. Names win.
"""

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
import shapely
from jaxtyping import Float
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from sketchtree.sketch.joining.lines import Line, corners, ends_of
from sketchtree.sketch.roles.ground import level_at

DEPTH, WHOLLY = 0.05, 0.02  # of H: what goes less deep below the ground is the foot of a stem; the same of a line that starts there
TOUCH = 0.04  # of H: roots hang together over gaps up to this
FOOT = 0.06  # of H: a root starts this near to the foot of a stem
BASE = 0.2  # of H: … or between two feet that are no farther apart: the sides of one trunk
FALLS = 0.3  # least fall of a root, of the distance between its ends
KEEPS = 0.02  # of H: a root rises no more than this over the foot
TALL = 0.3  # of H: least rise of the line whose foot it is
DEEPEST = 0.7  # of the tree's height above the foot
FEWEST = 2  # roots from one foot, to both sides


@dataclass(frozen=True, eq=False)
class Rooted:
    """Lines above and below the ground."""

    above: list[Line]
    below: list[Line]
    found: bool = False  # by shape: the report should say so


def roots_apart(
    lines: list[Line], ground: list[Float[np.ndarray, "point 2"]], named: set[int], crowns: list[Float[np.ndarray, "point 2"]] | None = None
) -> Rooted:
    """The lines of the wood, roots apart. `named`: rows of the strokes whose names say that they are roots;
    `crowns`: outlines, for the tree's height."""
    above, below = [line for line in lines if line.row not in named], [line for line in lines if line.row in named]
    if not above:
        return Rooted(lines, [])
    if below:
        return Rooted(above, below)
    height = _height([line.points for line in above] + list(crowns or []))
    if ground:
        return _under_lines(above, ground, height)
    return _from_a_foot(above, height)


def _under_lines(lines: list[Line], ground: list, height: float) -> Rooted:
    """Lines cut at the ground; what lies below it and hangs together with a stem's foot is root."""
    parts = [_cut_at(line, ground, height) for line in lines]
    under = [(k, part) for k, (_, low) in enumerate(parts) for part in low]
    if not under:
        return Rooted(lines, [])
    feet = [point for over, _ in parts for part in over for point in part.points[[0, -1]]]
    feet = np.array(feet).reshape(-1, 2)
    feet = feet[np.abs(feet[:, 1] - level_at(ground, feet[:, 0])) <= TOUCH * height]
    held = _hanging_on([part for _, part in under], _with_bases(feet, height), height)
    rooted = {k for (k, _), yes in zip(under, held, strict=True) if yes}
    above = [part for k, line in enumerate(lines) for part in (parts[k][0] if k in rooted else [line])]
    below = [part for (k, part) in under if k in rooted]
    return Rooted(above, below, found=True) if above and below else Rooted(lines, [])


def _with_bases(feet: Float[np.ndarray, "foot 2"], height: float) -> Float[np.ndarray, "foot 2"]:
    """The feet, and the middles between neighbours that may be the two sides of one trunk."""
    feet = feet[np.argsort(feet[:, 0], kind="stable")]
    near = np.hypot(*np.diff(feet, axis=0).T) <= BASE * height
    return np.concatenate([feet, 0.5 * (feet[1:] + feet[:-1])[near]])


def _cut_at(line: Line, ground: list, height: float) -> tuple[list[Line], list[Line]]:
    """(parts of a line above the ground, parts that go deep below it)."""
    s = np.union1d(line.along, np.linspace(0.0, line.length, 65))
    points = line.at(s)
    depth = level_at(ground, points[:, 0]) - points[:, 1]
    runs = np.r_[0, np.flatnonzero(np.diff(depth > 0)) + 1]
    deep = np.maximum.reduceat(depth, runs) > (DEPTH if depth.min() < -WHOLLY * height else WHOLLY) * height
    low = np.repeat(deep, np.diff(np.r_[runs, len(s)]))
    turns = np.flatnonzero(np.diff(low))
    crossing = s[turns] + (s[turns + 1] - s[turns]) * depth[turns] / (depth[turns] - depth[turns + 1])
    bounds = [0.0, *crossing.tolist(), line.length]
    pieces = [line.cut(a, b) for a, b in pairwise(bounds)] if len(crossing) else [line]
    over, under = pieces[bool(low[0]) :: 2], pieces[not low[0] :: 2]
    return [piece for piece in over if len(pieces) == 1 or piece.length > DEPTH * height], under


def _hanging_on(parts: list[Line], feet: Float[np.ndarray, "foot 2"], height: float) -> np.ndarray:
    """Which of these lines are joined to a foot, over others of them and over small gaps."""
    shapes = np.array([part.shape for part in parts], object)
    tree = shapely.STRtree(shapes)
    a, b = tree.query(shapes, predicate="dwithin", distance=TOUCH * height)
    group = connected_components(coo_array((np.ones(len(a)), (a, b)), (len(parts),) * 2), directed=False)[1]
    if len(feet) == 0:
        return np.zeros(len(parts), bool)
    near = tree.query(shapely.points(feet), predicate="dwithin", distance=FOOT * height)[1]
    return np.isin(group, group[near])


def _from_a_foot(lines: list[Line], height: float) -> Rooted:
    """Without a ground line: what runs downward from the foot of the tallest line."""
    ends = ends_of(lines)
    rise = np.abs(ends[1::2, 1] - ends[::2, 1])
    stem = int(np.argmax(rise))
    foot = min(lines[stem].points[[0, -1]].tolist(), key=lambda point: point[1])
    if rise[stem] < TALL * height:
        return Rooted(lines, [])
    low = corners(lines)[1][:, 1] <= foot[1] + KEEPS * height
    low[stem] = False
    first = [k for k in np.flatnonzero(low) if _falls_from(lines[k], foot, height)]
    sides = {np.sign(lines[k].points[:, 0].mean() - foot[0]) for k in first}
    if len(first) < FEWEST or not {-1.0, 1.0} <= sides or np.sum(~low) < 2:
        return Rooted(lines, [])
    rows = np.flatnonzero(low)
    rows = rows[_hanging_on([lines[k] for k in rows], np.array([foot]), height)]
    depth = foot[1] - min(lines[k].points[:, 1].min() for k in rows)
    if depth > DEEPEST * (max(line.points[:, 1].max() for line in lines) - foot[1]):
        return Rooted(lines, [])
    return Rooted([line for k, line in enumerate(lines) if k not in rows], [lines[k] for k in rows], found=True)


def _falls_from(line: Line, foot: list[float], height: float) -> bool:
    """Whether a line starts at the foot and runs downward from there."""
    first, last = line.points[[0, -1]] if line.points[0, 1] >= line.points[-1, 1] else line.points[[-1, 0]]
    falls = first[1] - last[1] >= FALLS * np.hypot(*(first - last))
    return bool(falls and np.hypot(*(first - foot)) <= FOOT * height)


def _height(lines: list[Float[np.ndarray, "point 2"]]) -> float:
    return float(np.ptp(np.concatenate(lines), axis=0).max())
