"""Which dots are a dotted curve? Rows of round spots at even distances, linked to one line.

A dot is a spot of ink no longer than ROUND of its breadth. Dots that touch each other or the tip of a limb still stand out
where the ink is worn away by some part of their half width: they count if dots of their size stand free elsewhere.
From every dot the row goes on to the dot ahead for which

    gap · (1 + 2 θ)      gap to it, of the row's spacing s;  θ turn of the row there, radians

is least, over gaps of up to REACH s: where the tip of a limb takes a dot's place. A row of fewer than FEWEST dots is none, nor
is one of uneven gaps or one that turns about: dust lies like that.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Float
from scipy.ndimage import center_of_mass, find_objects, label
from scipy.spatial import cKDTree

FEWEST = 8  # dots in a row
ROUND = 1.8  # longest side of a dot's box, of its shortest
FULL = 0.55  # least part of its box that a dot fills
ALIKE = 1.6  # a dot is at most so many times as wide as the middle one, or narrower
LARGEST = 0.05  # of the picture's larger side
WEAR = (0.35, 0.5, 0.65, 0.8)  # of a dot's half width: how far touching dots are worn away
REACH = 3.6  # spacings
SHARP = np.radians(60)  # greatest turn of a row from dot to dot
GAPS = (0.55, 1.6)  # of the row's middle gap: three in four of its gaps are no smaller, no larger
SMOOTH = np.radians(22)  # greatest middle turn of a row
FREE = 0.35  # least share of a row's dots that stand free
NEARLY = 0.3  # of the row's length: a row with a smaller opening goes round something


@dataclass(frozen=True, eq=False)
class Dotted:
    """A dotted curve. Pixels of the mask, (x, y), y DOWN."""

    points: Float[np.ndarray, "dot 2"]
    width: float  # of its dots
    closed: bool  # goes round, but for at most NEARLY of its length


def dotted_curves(mask: Bool[np.ndarray, "row col"], half: Float[np.ndarray, "row col"]) -> tuple[list[Dotted], Bool[np.ndarray, "row col"]]:
    """(dotted curves, the ink without their dots). `half` is the distance to the paper at every pixel."""
    free, width = _spots(mask, LARGEST * max(mask.shape))
    if len(free) < FEWEST:
        return [], mask
    middle = float(np.median(width))
    near = (width <= ALIKE * middle) & (width >= middle / ALIKE)
    free, width = free[near], width[near]
    if len(free) < FEWEST:
        return [], mask
    dots, is_free = _with_touching(free, 0.5 * middle, half)
    rows = _rows(dots)
    rows = [row for row in rows if len(row[0]) >= FEWEST and is_free[row[0]].mean() >= FREE and _is_even(dots[row[0]])]
    curves = [Dotted(dots[row], middle, ring) for row, ring in rows]
    if not curves:
        return [], mask
    left = _without(mask, np.concatenate([c.points for c in curves]), 0.75 * middle)
    return curves, left


def _spots(mask: Bool[np.ndarray, "row col"], largest: float) -> tuple[Float[np.ndarray, "dot 2"], Float[np.ndarray, " dot"]]:
    """(centres, widths) of the round spots of a mask."""
    labels, count = label(mask, np.ones((3, 3)))
    area = np.bincount(labels.ravel(), minlength=count + 1)[1:]
    boxes = find_objects(labels)
    side = np.array([(box[0].stop - box[0].start, box[1].stop - box[1].start) for box in boxes], float).reshape(-1, 2)
    long, short = side.max(1, initial=0), side.min(1, initial=np.inf)
    spot = (long <= largest) & (long <= ROUND * short + 1) & (area >= FULL * side.prod(1)) & (area >= 4)
    chosen = np.flatnonzero(spot)
    if len(chosen) == 0:
        return np.zeros((0, 2)), np.zeros(0)
    centres = np.array(center_of_mass(mask, labels, chosen + 1)).reshape(-1, 2)[:, ::-1] + 0.5
    return centres, np.sqrt(4 * area[chosen] / np.pi)


def _with_touching(free: Float[np.ndarray, "dot 2"], radius: float, half: Float[np.ndarray, "row col"]):
    """(all dots, whether each stands free): those that stand out of other ink once it is worn away as well."""
    dots, is_free = [free], [np.ones(len(free), bool)]
    taken = cKDTree(free)
    for wear in WEAR:
        spots, width = _spots(half > wear * radius, 3 * radius)
        if len(spots) == 0:
            continue
        whole = width + 2 * wear * radius
        fits = (whole <= 2 * radius * ALIKE) & (whole >= 2 * radius / ALIKE)
        fits &= taken.query(spots)[0] > radius
        if fits.any():
            dots.append(spots[fits])
            is_free.append(np.zeros(fits.sum(), bool))
            taken = cKDTree(np.concatenate(dots))
    return np.concatenate(dots), np.concatenate(is_free)


def _rows(dots: Float[np.ndarray, "dot 2"]) -> list[tuple[np.ndarray, bool]]:
    """(dots in order, whether they go round) of every row, the longest first."""
    tree = cKDTree(dots)
    away, near = tree.query(dots, k=3)
    spacing = float(np.median(away[:, 1]))
    used = np.zeros(len(dots), bool)
    found = []
    for start in np.lexsort((dots[:, 0], dots[:, 1], -_evenness(dots, away, near))).tolist():
        if used[start] or away[start, 2] > 2 * spacing:
            continue
        row = [int(near[start, 1]), start, int(near[start, 2])]
        if used[row].any() or _turn(dots[row]) > SHARP:
            continue
        used[row] = True
        row = _onward(_onward(row, dots, tree, spacing, used)[::-1], dots, tree, spacing, used)
        length = float(np.hypot(*np.diff(dots[row], axis=0).T).sum())
        opening = float(np.hypot(*(dots[row[0]] - dots[row[-1]])))
        found.append((np.array(row), opening <= NEARLY * length))
    return sorted(found, key=lambda item: (-len(item[0]), dots[item[0][0]].tolist()))


def _evenness(dots, away, near) -> Float[np.ndarray, " dot"]:
    """How squarely every dot lies between its two neighbours, 0 to 1."""
    a, b = dots[near[:, 1]] - dots, dots[near[:, 2]] - dots
    return np.round(-(a * b).sum(1) / np.maximum(away[:, 1] * away[:, 2], 1e-9), 6)


def _is_even(row: Float[np.ndarray, "dot 2"]) -> bool:
    """Whether the dots of a row follow each other evenly, on a smooth curve."""
    step = np.diff(row, axis=0)
    gap = np.hypot(*step.T) / np.median(np.hypot(*step.T))
    turn = np.abs(np.arctan2(step[:-1, 0] * step[1:, 1] - step[:-1, 1] * step[1:, 0], (step[:-1] * step[1:]).sum(1)))
    return bool(np.mean((gap >= GAPS[0]) & (gap <= GAPS[1])) >= 0.75 and np.median(turn) <= SMOOTH)


def _turn(three: Float[np.ndarray, "3 2"]) -> float:
    a, b = three[1] - three[0], three[2] - three[1]
    return float(np.abs(np.arctan2(a[0] * b[1] - a[1] * b[0], (a * b).sum())))


def _onward(row: list[int], dots, tree: cKDTree, spacing: float, used) -> list[int]:
    """The row continued at its end as far as it goes."""
    while True:
        best, cost = -1, np.inf
        for k in sorted(tree.query_ball_point(dots[row[-1]], REACH * spacing)):
            if used[k]:
                continue
            turn = _turn(dots[[row[-2], row[-1], k]])
            price = float(np.hypot(*(dots[k] - dots[row[-1]]))) * (1 + 2 * turn)
            if turn <= SHARP and price < cost:
                best, cost = k, price
        if best < 0:
            return row
        row.append(best)
        used[best] = True


def _without(mask: Bool[np.ndarray, "row col"], centres, radius: float) -> Bool[np.ndarray, "row col"]:
    """The mask without the discs of the dots."""
    left = mask.copy()
    r = int(np.ceil(radius))
    dy, dx = np.mgrid[-r : r + 1, -r : r + 1]
    inside = dx**2 + dy**2 <= radius**2
    for x, y in np.floor(centres).astype(int):
        rows, cols = np.clip(y + dy[inside], 0, mask.shape[0] - 1), np.clip(x + dx[inside], 0, mask.shape[1] - 1)
        left[rows, cols] = False
    return left
