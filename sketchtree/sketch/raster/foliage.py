"""Which lines are leaves or hatching rather than wood? Scribbles, loops, blades, and rows of short parallel strokes.

    curl       turning of a line over its length, radians per H. Limbs bend, scribbles and loops whirl: curl ≥ CURL
    blade      a short line that is widest well away from its foot: the ink of a leaf
    texture    length of such lines per area, smoothed over SPREAD; foliage is where it is at least DENSE and PART of all lines there

Limbs that leaves had cut are joined again; what then lies in foliage and is no long, nearly straight line is left out with it. Foliage high in the drawing is a crown: its outline,
or the hull of its clumps. Short lines of one direction side by side, both ends free and away from longer lines, are hatching.
"""

import dataclasses
from collections import Counter
from dataclasses import dataclass

import numpy as np
import shapely
from jaxtyping import Bool, Float
from scipy.ndimage import binary_closing, binary_fill_holes, binary_propagation, gaussian_filter, gaussian_filter1d
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components
from scipy.spatial import ConvexHull, cKDTree
from skimage.measure import find_contours

from sketchtree.sketch.raster.ends import bridged
from sketchtree.sketch.raster.lines_of import Traced

CURL = 30.0  # radians per H
WHIRL = 1.6  # radians: a line that turns less in all is no scribble
STILL = 0.003  # of H, at least the line's width: what is smoothed away before turning is measured
RING = 0.3  # of H: length of a closed line, below which it is a leaf
BLADE = 1.6  # times as wide as at its foot
BLADE_LONG = (2.0, 9.0)  # of its greatest width: length of a blade
FILLED = 0.2  # of the way from its foot's width to its greatest: a blade's middle width at least
STEM = 0.2  # of a blade's length: its foot
GRID = 128  # cells along H
MARGIN = 8  # cells around the drawing
SPREAD = 0.022  # of H
DENSE = 6.0  # H of line in an area of H²
PART = (0.4, 0.2)  # of all the length there: leafy lines at least, and pieces of them around; among twigs some line always whirls
FEWEST = 10  # lines that whirl or are blades: fewer are no foliage
LIMB = (0.1, 14.0)  # of H, radians per H: a line so long and no curlier is wood wherever it lies
BIT = 0.15  # of H: a line no longer, half as curly, carries foliage on that is there already
BENT = 0.3  # radians that such a piece turns at least
SCRAP = 0.06  # of H: a line in foliage no longer, on no longer line but leaves, is a piece of one
RUN = 0.6  # radians: a line that goes on for as long as a LIMB without turning more is one, whatever its end does
WITHIN = 0.6  # share of a line that lies in foliage, if it is foliage
CROWN = 0.03  # of H²: least area of a crown
HIGH = 0.6  # of the drawing's height: a crown reaches above it
FULL = 0.55  # least share of its hull that a crown fills, the clumps of one together
CLUMPS = 0.05  # of H: clumps nearer to each other are one

HATCH = 0.14  # of H: longer lines are no hatching
ROW = 5  # lines in a patch of hatching
SIDE = 0.45  # of their length: distance between lines of hatching
PARALLEL = np.radians(18)
AWAY = (0.3, 3.0)  # of its length, plus pens: hatching keeps that far from longer lines


@dataclass(frozen=True, eq=False)
class Foliage:
    """The lines that are wood, and what the others are. Pixels of the ink, (x, y), y DOWN."""

    wood: list[Traced]
    leaves: int  # how many lines were left out as foliage
    hatching: int
    crowns: list[Float[np.ndarray, "point 2"]]


def without_foliage(lines: list[Traced], pen: float) -> Foliage:
    """Tell foliage and hatching from wood."""
    if len(lines) < ROW:
        return Foliage(lines, 0, 0, [])
    points = np.concatenate([line.points for line in lines])
    low, height = points.min(0), float(np.ptp(points, axis=0).max())
    is_hatch = _hatching(lines, height, pen)
    rest = [line for line, hatch in zip(lines, is_hatch, strict=True) if not hatch]
    leafy = np.array([_is_leafy(line, height) for line in rest], bool)
    if leafy.sum() < FEWEST:
        return Foliage(rest, 0, int(is_hatch.sum()), [])
    cell = height / GRID
    region = _region(rest, leafy, low, points.max(0), cell)
    if not region.any():
        return Foliage(rest, 0, int(is_hatch.sum()), [])
    leafy &= np.array([_within(line, region, low, cell) >= 0.5 * WITHIN for line in rest])
    left = [line for line, leaf in zip(rest, leafy, strict=True) if not leaf]
    is_scrap = _scraps(left, SCRAP * height) & np.array([_within(line, region, low, cell) > 0 for line in left], bool)
    left = bridged(_freed([line for line, scrap in zip(left, is_scrap, strict=True) if not scrap]), pen)
    wood = [line for line in left if _is_limb(line, height) or _within(line, region, low, cell) < WITHIN]
    if not wood:
        return Foliage(rest, 0, int(is_hatch.sum()), [])
    return Foliage(wood, len(rest) - len(wood), int(is_hatch.sum()), _crowns(region, low, cell))


def _scraps(lines: list[Traced], longest: float) -> Bool[np.ndarray, " line"]:
    """Which short lines ended on something, and not on a longer line that is left."""
    long = [line.length > longest for line in lines]
    held = {node for line, is_long in zip(lines, long, strict=True) if is_long for node in (*line.passes, *line.joints)} - {-1}
    return np.array([not is_long and line.joints != (-1, -1) and held.isdisjoint(line.joints) for line, is_long in zip(lines, long, strict=True)], bool)


def _freed(lines: list[Traced]) -> list[Traced]:
    """The lines with those ends free where nothing else is left."""
    here = Counter(node for line in lines for node in {*line.passes, *line.joints})
    return [dataclasses.replace(line, joints=tuple(node if here[node] > 1 else -1 for node in line.joints)) for line in lines]


def _is_limb(line: Traced, height: float) -> bool:
    return line.length >= LIMB[0] * height and turning(line, height) * height <= LIMB[1] * line.length


def _is_leafy(line: Traced, height: float) -> bool:
    """Whether a line whirls, is a small ring or a blade."""
    length = line.length
    if line.closed:
        return length <= RING * height
    turn = turning(line, height)
    if turn >= WHIRL and turn * height >= CURL * length and length <= 4 * RING * height:
        return straight_run(line, height) < LIMB[0] * height
    return _is_blade(line, length)


def _is_bit(line: Traced, height: float) -> bool:
    """Whether a line may be a piece of a scribble that others cut."""
    turn = turning(line, height)
    return line.length <= BIT * height and turn >= BENT and turn * height >= 0.5 * CURL * line.length


def _steps(line: Traced, height: float) -> Float[np.ndarray, "step 2"]:
    """The way along a line in short steps, smoothed over as much: the pixels' own unrest is no turning."""
    still = max(float(np.median(line.width)), STILL * height, 2.0)
    smooth = gaussian_filter1d(line.points, still, axis=0, mode="nearest")
    points = smooth[:: round(still)]
    return np.diff(np.vstack([points, smooth[-1:]]), axis=0)


def _turns(step: Float[np.ndarray, "step 2"]) -> Float[np.ndarray, " turn"]:
    return np.abs(np.arctan2(step[:-1, 0] * step[1:, 1] - step[:-1, 1] * step[1:, 0], (step[:-1] * step[1:]).sum(1)))


def turning(line: Traced, height: float) -> float:
    """How much a line turns in all, radians."""
    return float(_turns(_steps(line, height)).sum())


def straight_run(line: Traced, height: float) -> float:
    """The longest piece of a line that turns by no more than RUN in all."""
    step = _steps(line, height)
    turned = np.r_[0.0, np.cumsum(_turns(step))]
    length = np.r_[0.0, np.cumsum(np.hypot(*step.T))]
    last = np.searchsorted(turned, turned + RUN, side="right")
    return float((length[last] - length[:-1]).max())


def _is_blade(line: Traced, length: float) -> bool:
    """Whether a line with a free end is wide over most of its length, but not at its foot."""
    free = [side for side in (0, 1) if line.joints[side] < 0]
    if len(free) != 1:
        return False
    width = line.width if free == [1] else line.width[::-1]
    foot = float(np.median(width[: max(2, int(STEM * len(width)))]))
    widest = float(np.quantile(width[len(width) // 4 :], 0.9))
    most = float(np.median(width)) >= foot + FILLED * (widest - foot)  # else it is a twig with a leaf at its end
    return most and widest >= BLADE * foot and BLADE_LONG[0] * widest <= length <= BLADE_LONG[1] * widest


def _region(lines: list[Traced], leafy: Bool[np.ndarray, " line"], low, high, cell: float) -> Bool[np.ndarray, "row col"]:
    """Where leafy lines lie densely, and what goes on from there in pieces of scribbles; MARGIN cells and more around."""
    shape = tuple(np.ceil((high - low) / cell).astype(int)[::-1] + 1 + 2 * MARGIN)
    bits = leafy | np.array([_is_bit(line, cell * GRID) for line in lines])
    every, sure, likely = (_texture([lines[k] for k in np.flatnonzero(some)], shape, low, cell) for some in (np.ones(len(lines), bool), leafy, bits))
    core, around = ((part >= DENSE) & (part >= share * every) for part, share in zip((sure, likely), PART, strict=True))
    return binary_propagation(core, mask=core | around)


def _texture(lines: list[Traced], shape: tuple[int, int], low, cell: float) -> Float[np.ndarray, "row col"]:
    """Length of lines per area, H in H²."""
    texture = np.zeros(shape)
    for line in lines:
        at = _cells(line, low, cell)
        np.add.at(texture, (at[:, 1], at[:, 0]), line.length / len(at))
    return gaussian_filter(texture / cell**2 * (cell * GRID), SPREAD * GRID)


def _cells(line: Traced, low, cell: float):
    return np.floor((line.points - low) / cell).astype(int) + MARGIN


def _within(line: Traced, region, low, cell: float) -> float:
    """Share of a line that lies in a region."""
    at = _cells(line, low, cell)
    return float(region[at[:, 1], at[:, 0]].mean())


def _crowns(region, low, cell: float) -> list[Float[np.ndarray, "point 2"]]:
    """Outline of the foliage if it is large and high enough."""
    reach = max(1, round(CLUMPS * GRID))
    disc = np.hypot(*np.mgrid[-reach : reach + 1, -reach : reach + 1]) <= reach
    joined = binary_fill_holes(binary_closing(np.pad(region, reach), disc)[reach:-reach, reach:-reach])
    rows = np.flatnonzero(joined.any(1))
    span = joined.shape[0] - 2 * MARGIN
    if joined.sum() < CROWN * GRID**2 or (rows[0] - MARGIN) > (1 - HIGH) * span:
        return []
    soft = gaussian_filter(np.pad(joined, 2).astype(float), 1.0)
    outlines = [line[:-1, ::-1] - 2 for line in find_contours(soft, 0.5)]
    large = [line for line in outlines if shapely.Polygon(line).area >= 0.1 * joined.sum()]
    every = np.concatenate(outlines)
    hull = ConvexHull(every)
    if joined.sum() < FULL * hull.volume:
        return []
    if len(large) != 1:
        large = [every[hull.vertices]]
    return [(line + 0.5 - MARGIN) * cell + low for line in large]


def _hatching(lines: list[Traced], height: float, pen: float) -> Bool[np.ndarray, " line"]:
    """Mask of the short lines that lie in rows side by side, away from longer ones."""
    length = np.array([line.length for line in lines])
    ends = np.array([line.points[[0, -1]] for line in lines])
    chord = ends[:, 1] - ends[:, 0]
    straight = np.hypot(*chord.T) >= 0.9 * length
    free = np.array([line.joints == (-1, -1) and not line.closed for line in lines])
    short = np.flatnonzero(free & straight & (length <= HATCH * height) & (length >= 2 * pen))
    found = np.zeros(len(lines), bool)
    if len(short) < ROW:
        return found
    middle, heading = ends[short].mean(1), np.arctan2(chord[short, 1], chord[short, 0])
    pairs = cKDTree(middle).query_pairs(float(HATCH * height), output_type="ndarray")
    if len(pairs) == 0:
        return found
    a, b = pairs.T
    turn = np.abs((heading[a] - heading[b] + np.pi / 2) % np.pi - np.pi / 2)
    apart = middle[b] - middle[a]
    like = np.minimum(length[short][a], length[short][b])
    along = np.abs(apart[:, 0] * np.cos(heading[a]) + apart[:, 1] * np.sin(heading[a]))
    beside = (turn <= PARALLEL) & (np.hypot(*apart.T) ** 2 - along**2 <= (SIDE * like) ** 2) & (along <= 0.5 * like)
    beside &= np.maximum(length[short][a], length[short][b]) <= 2.5 * like
    labels = _groups(len(short), a[beside], b[beside])
    large = np.bincount(labels)[labels] >= ROW
    far = _away(lines, length, ends, short, pen)
    share = np.bincount(labels, weights=far) / np.bincount(labels)
    found[short[large & (share[labels] >= 0.7)]] = True
    return found


def _groups(count: int, a, b):
    return connected_components(coo_array((np.ones(len(a)), (a, b)), (count, count)), directed=False)[1]


def _away(lines, length, ends, short, pen: float) -> Bool[np.ndarray, " short"]:
    """Which short lines keep away, by both ends, from lines more than twice as long."""
    long = np.flatnonzero(length >= 2 * np.median(length[short]))
    if len(long) == 0:
        return np.ones(len(short), bool)
    tree = shapely.STRtree([shapely.LineString(lines[k].points) for k in long])
    far = np.ones(len(short), bool)
    for side in (0, 1):
        _, distance = tree.query_nearest(shapely.points(ends[short, side]), return_distance=True, all_matches=False)
        far &= distance > AWAY[0] * length[short] + AWAY[1] * pen
    return far
