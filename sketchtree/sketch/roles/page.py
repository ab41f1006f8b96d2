"""Is a stroke the paper itself, and where does the page's edge cut the tree?

A frame is a rectangle, drawn or painted, that has every other stroke inside it. The edge of the page cuts the tree where
a line runs out over it, or where several tips end on it as they head outward: one alone may just touch a page that was
trimmed to the drawing.
"""

import numpy as np
import shapely
from jaxtyping import Bool, Float

from sketchtree.sketch.graph import Cut
from sketchtree.sketch.joining.lines import Line, ends_of, unit
from sketchtree.sketch.roles.found import Found
from sketchtree.sketch.roles.measures import Measures

SQUARE = 0.985  # least share of its bounding box that a frame fills
AROUND = 0.7  # least share of the drawing's width or height that a frame spans
ON_EDGE = 0.006  # of the page's larger side: a tip this near to the edge ends on it
BEYOND = 0.002  # of the page's larger side: a tip farther out is cut for sure
OUTWARD = 0.5  # cosine between a tip and the edge's normal
SEVERAL = 2  # tips on one edge
EDGES = ("left", "bottom", "right", "top")
_NORMAL = np.array([[-1.0, 0.0], [0.0, -1.0], [1.0, 0.0], [0.0, 1.0]])


def frames(m: Measures, free: Bool[np.ndarray, " stroke"]) -> list[Found]:
    """The strokes that are the paper's edge or its fill."""
    if len(m) < 2:
        return []
    low, high = m.drawing
    side = m.high - m.low
    wide = (side >= AROUND * np.maximum(high - low, 1e-300)).all(1) & free & (m.closed | (m.opening <= 0.02 * m.size))
    found = []
    for row in np.flatnonzero(wide & (m.area >= SQUARE * side.prod(1))):
        others = np.arange(len(m)) != row
        if (m.low[others] >= m.low[row]).all() and (m.high[others] <= m.high[row]).all():
            found.append(Found(int(row), "paper", "a rectangle around the whole drawing"))
    return found if len(found) < len(m) else []


def cuts_of(lines: list[Line], page: tuple[float, float, float, float] | None) -> tuple[tuple[Cut, ...], list[str]]:
    """(where the page's edge cuts the lines, the warning that says so)."""
    if page is None or not lines:
        return (), []
    size = max(page[2] - page[0], page[3] - page[1])
    if not size > 0:
        return (), []
    tips = ends_of(lines)
    outside = np.stack([page[0] - tips[:, 0], page[1] - tips[:, 1], tips[:, 0] - page[2], tips[:, 1] - page[3]], 1)
    edge = outside.argmax(1)
    beyond = outside.max(1) > BEYOND * size
    touching = ~beyond & (outside.max(1) >= -ON_EDGE * size) & (edge != EDGES.index("bottom"))
    for k in np.flatnonzero(touching):
        touching[k] = _way(lines[k // 2], k % 2, 0.02 * size) @ _NORMAL[edge[k]] >= OUTWARD
    several = np.bincount(edge[touching], minlength=4) >= SEVERAL
    rows = np.flatnonzero(beyond | (touching & several[edge]))
    sheet = shapely.box(*page)
    cuts = tuple(Cut(lines[k // 2].id, _leaves(lines[k // 2], tips[k], sheet, beyond[k]), EDGES[edge[k]]) for k in rows)
    return cuts, [_sentence(cuts)] if cuts else []


def _way(line: Line, end: int, reach: float) -> Float[np.ndarray, " 2"]:
    """The direction in which a line ends at its first (0) or last (1) point."""
    s = max(line.length - reach, 0.5 * line.length) if end else min(reach, 0.5 * line.length)
    return unit(line.points[-1 if end else 0] - line.at(s))


def _leaves(line: Line, tip, sheet: shapely.Polygon, beyond: bool) -> tuple[float, float]:
    """Where a line crosses the page's edge on its way to this tip; the tip itself if it ends on the edge."""
    hits = shapely.get_coordinates(line.shape.intersection(sheet.boundary)) if beyond else np.zeros((0, 2))
    x, y = hits[np.argmin(np.hypot(*(hits - tip).T))] if len(hits) else tip
    return float(x), float(y)


def _sentence(cuts: tuple[Cut, ...]) -> str:
    edges = " and ".join(edge for edge in EDGES if any(cut.edge == edge for cut in cuts))
    places = "1 place" if len(cuts) == 1 else f"{len(cuts)} places"
    return f"The page's edge cuts the tree at {places} ({edges}): what grows on beyond it is not in the drawing."
