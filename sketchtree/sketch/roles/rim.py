"""Which strokes, and which part of a painted limb, are really the rim of the crown? Ink around a crown often runs on into the trunk.

A line down the middle of a painted shape that runs along a crown's outline for a good while is the pen line around the crown;
it is cut off where it leaves it. A limb meets the outline at an angle, or only with its tip. A loose stroke that follows the outline
for all of its length is a piece of it.
"""

import numpy as np
import shapely
from jaxtyping import Bool, Float

from sketchtree.sketch.joining.lines import Line
from sketchtree.sketch.roles.found import Found
from sketchtree.sketch.roles.measures import Measures

PIECE = 0.03  # of the crown's size: a piece of the outline is at least as long
LOOSE = 0.02  # of the crown's size: it keeps this far from every branch, at both ends
NEAR = 0.045  # of the crown's size: on the outline
ALONG = np.cos(np.radians(35))  # and in its direction
LONG = 0.2  # of the crown's size: least length of rim
KEPT = 0.08  # of the crown's size: what is left of a line is dropped where it is shorter
STEPS = 96


def pieces_of_rims(
    m: Measures, free: Bool[np.ndarray, " stroke"], wood: Bool[np.ndarray, " stroke"], outlines: list[Float[np.ndarray, "point 2"]]
) -> list[Found]:
    """The loose strokes that follow an outline from end to end."""
    found = []
    for outline in outlines:
        size = float(np.ptp(outline, axis=0).max())
        ring = shapely.LinearRing(outline)
        rows = np.flatnonzero(free & ~m.filled & (m.length >= PIECE * size))
        near = shapely.distance(shapely.points(m.evenly[rows]), ring).max(1) <= NEAR * size
        rows = [row for row in rows[near].tolist() if _follows(m.evenly[row], ring) and row not in (one.row for one in found)]
        others = shapely.union_all(m.shapes(np.setdiff1d(np.flatnonzero(wood), rows)))
        apart = shapely.distance(shapely.points(np.stack([m.first[rows], m.last[rows]], 1)), others)
        loose = [row for row, ends in zip(rows, apart, strict=True) if others.is_empty or (ends > LOOSE * size).all()]
        found += [Found(row, "crown", "it runs along the crown's outline", (("branch", 0.5),)) for row in loose]
    return found


def _follows(points: Float[np.ndarray, "step 2"], ring: shapely.LinearRing) -> bool:
    """Whether a stroke covers as much of the outline as it is long."""
    at = shapely.line_locate_point(ring, shapely.points(points))
    steps = np.abs((np.diff(at) + 0.5 * ring.length) % ring.length - 0.5 * ring.length)
    return bool(steps.sum() >= ALONG * np.hypot(*np.diff(points, axis=0).T).sum())


def without_rims(lines: list[Line], outlines: list[Float[np.ndarray, "point 2"]]) -> tuple[list[Line], list[Line]]:
    """(the lines without what runs along an outline, the lines of which something was cut off)."""
    kept, cut = [], []
    for line in lines:
        rims = [_rim(line, points) for points in outlines]
        on_rim = np.any(rims, axis=0) if rims else np.zeros(STEPS, bool)
        size = max((float(np.ptp(points, axis=0).max()) for points in outlines), default=0.0)
        parts = _parts(line, on_rim, size)
        kept += parts
        if parts != [line]:
            cut.append(line)
    return kept, cut


def _rim(line: Line, outline: Float[np.ndarray, "point 2"]) -> Bool[np.ndarray, " step"]:
    """Which of STEPS even places along a line are on the outline and run along it."""
    size = float(np.ptp(outline, axis=0).max())
    ring = shapely.LinearRing(outline)
    s = np.linspace(0.0, line.length, STEPS)
    points = line.at(s)
    near = shapely.distance(shapely.points(points), ring) <= NEAR * size
    if not near.any():
        return near
    at = shapely.line_locate_point(ring, shapely.points(points))
    reach = 0.02 * size
    ahead, behind = (shapely.get_coordinates(shapely.line_interpolate_point(ring, (at + step) % ring.length)) for step in (reach, -reach))
    own = line.at(np.minimum(s + reach, line.length)) - line.at(np.maximum(s - reach, 0.0))
    way = ahead - behind
    cosine = np.abs((own * way).sum(1)) / np.maximum(np.hypot(*own.T) * np.hypot(*way.T), 1e-300)
    return _long_runs(near & (_smoothed(cosine) >= ALONG), LONG * size / max(line.length, 1e-300) * STEPS)


def _smoothed(value: Float[np.ndarray, " step"]) -> Float[np.ndarray, " step"]:
    return np.convolve(np.pad(value, 3, mode="edge"), np.full(7, 1 / 7), mode="valid")


def _long_runs(mask: Bool[np.ndarray, " step"], least: float) -> Bool[np.ndarray, " step"]:
    """The mask without runs shorter than `least` steps; gaps of a few steps are closed."""
    edges = np.flatnonzero(np.diff(np.r_[False, mask, False].astype(int)))
    runs: list[list[int]] = []
    for begin, end in zip(edges[::2].tolist(), edges[1::2].tolist(), strict=True):
        if runs and begin - runs[-1][1] <= 6:
            runs[-1][1] = end
        else:
            runs.append([begin, end])
    result = np.zeros(len(mask), bool)
    for begin, end in runs:
        result[begin:end] = end - begin >= least
    return result


def _parts(line: Line, on_rim: Bool[np.ndarray, " step"], size: float) -> list[Line]:
    """What is left of a line without its rims."""
    if not on_rim.any():
        return [line]
    edges = np.flatnonzero(np.diff(np.r_[True, on_rim, True].astype(int)))
    spans = edges.reshape(-1, 2) / (STEPS - 1) * line.length
    return [line.cut(low, min(high, line.length)) for low, high in spans.tolist() if min(high, line.length) - low >= KEPT * size]
