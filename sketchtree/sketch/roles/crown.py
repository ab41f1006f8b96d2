"""Which closed curves are crowns? Closed or nearly closed outlines, drawn or painted, around the branches' tips.

A stroke is an outline by its shape if its ends nearly meet and it is round rather than a thin loop (4πA/P² of its hull
times the part of the hull it fills ≥ ROUND; a painted one is bulky, 2A/P ≥ BULK of its size). It is a crown if it
reaches high and at least half of the other strokes' upper ends lie in it or near it. Large outlines that overlap such a
crown are tiers of it, as a fir has; small ones on it are ornaments. Several smaller ones are crowns
together: each on a limb of its own, all of them around half of the tips; of these some may be less closed than others.
"""

import numpy as np
import shapely
from jaxtyping import Bool, Float

from sketchtree.sketch.roles.brush import even_border, middles, slenderness
from sketchtree.sketch.roles.found import Found
from sketchtree.sketch.roles.measures import Measures
from sketchtree.sketch.strokes import Stroke

OPEN = 0.35  # widest opening of a nearly closed outline, of its larger side
ROUND = 0.2  # least 4πA/P² of the outline's convex hull, times its share of the hull's area
BULK = 0.14  # least 2A/P of a painted crown, of its larger side: trunks and limbs are thinner
LARGE = 0.3  # least size of a crown, of the drawing's
SHUT, SHUT_LARGE = 0.1, 0.2  # of its side, an opening that is as good as none; of the drawing's, the least size then
SMALL = 0.1  # the same where several are crowns together …
MOST = 12  # … no more than these: else they are leaves
HIGH = 0.6  # of the drawing's height: a crown reaches above it (a shadow on the ground does not)
NEAR = 0.1  # of the drawing's size: a tip this near to the outline counts as inside
TIER = 0.5  # of the crown's width: a tier is at least as wide
ALOFT = 0.1  # of the drawing's height: tiers and ornaments keep this far from its foot
WIDER, ALIKE = 0.6, 0.5  # widest opening of a lobe beside others that are closed, and how large it is at least, beside their middle size
UPRIGHT = 2.0  # height over width from which a slender painted shape may be a poplar's crown
ON_GROUND = 0.08  # of its size: a dome's ends are this near to the ground line
STANDS = 0.05  # of the drawing's height: a shape that comes this near to its foot stands on the ground
SLIM = 2.2  # length over mean width from which such a shape is a trunk's outline …
TRUNK = 0.6  # … or if it is no wider than this, of the widest outline, and no larger


def closed_crowns(
    m: Measures, free: Bool[np.ndarray, " stroke"], wood: Bool[np.ndarray, " stroke"], ground: list[np.ndarray] | None = None
) -> list[Found]:
    """The crowns among the strokes `free` to be one; `wood` are those whose tips they may hold. A dome whose
    both ends stand on a drawn `ground` line is closed by it."""
    low, high = m.drawing
    size = float((high - low).max())
    rows = _outlines(m, free, size, ground or [])
    if len(rows) == 0:
        return []
    regions = np.array([_region(m.strokes[row].points, NEAR * size) for row in rows], object)
    others = wood.copy()
    others[rows] = False
    tips = _upper_ends(m, others)
    level = low[1] + HIGH * (high[1] - low[1])
    inside = np.array([shapely.contains_xy(region, tips) for region in regions]).reshape(len(rows), len(tips))
    reaches = m.high[rows, 1] >= level
    if len(tips) == 0:
        return []
    large = m.size[rows] >= np.where(m.opening[rows] <= SHUT * m.size[rows], SHUT_LARGE, LARGE) * size
    alone = reaches & large & (inside.mean(1) >= 0.5)
    if alone.any():
        others_of_its_kind = reaches & inside[:, ~inside[alone].any(0)].any(1) & (m.size[rows] >= ALIKE * m.size[rows[alone]].max())
        alone |= others_of_its_kind
        found = _kept(m, rows, regions, alone, "a closed outline around most of the branches' tips")
        crowns = [one.row for one in found if one.role == "crown"]
        return [*found, *_on_crowns(m, rows[~alone], crowns), *_open_lobes(m, free, crowns, NEAR * size)]
    together = inside.any(1)
    enough = inside[together].any(0).mean() >= 0.5 and together.sum() <= MOST
    if enough and reaches[together].any() and (len(rows) > 1 or m.size[rows[0]] >= LARGE * size):
        found = _kept(m, rows, regions, together, "one of several closed outlines on the branches' tips")
        return [*found, *_open_lobes(m, free, [one.row for one in found if one.role == "crown"], NEAR * size)]
    return []


def outline(points: Float[np.ndarray, "point 2"]) -> Float[np.ndarray, "point 2"]:
    """A closed outline: the first point is not repeated at the end."""
    points = np.asarray(points)
    kept = np.r_[True, (np.diff(points, axis=0) != 0).any(1)]
    points = points[kept]
    return points[:-1] if len(points) > 1 and (points[0] == points[-1]).all() else points


def has_area(stroke: Stroke) -> bool:
    """Whether a labelled crown or obstacle encloses anything."""
    return len(outline(stroke.points)) >= 3 and shapely.convex_hull(shapely.MultiPoint(stroke.points)).area > 0


def _fronds(m: Measures, rows) -> Bool[np.ndarray, " row"]:
    """Painted outlines that are single strokes of a brush, not upright: several are the leaves of a palm, or limbs."""
    side = (m.high - m.low)[rows]
    painted = np.flatnonzero(m.filled[rows] & (side[:, 1] <= UPRIGHT * side[:, 0]))
    frond = np.zeros(len(rows), bool)
    if len(painted) > 1:
        single = middles(np.array([even_border(m.strokes[row].points) for row in rows[painted]])).single
        frond[painted] = single & (single.sum() > 1)
    return frond


def _on_crowns(m: Measures, rows, crowns: list[int]) -> list[Found]:
    """What the other outlines are that lie on a crown, well above the foot: large ones its tiers, small ones ornaments."""
    low, high = m.drawing
    height, width = float(high[1] - low[1]), float((m.high - m.low)[crowns, 0].max())
    area = shapely.union_all([_region(m.strokes[row].points, 0.0) for row in crowns])
    above = rows[m.low[rows, 1] >= low[1] + ALOFT * height].tolist()
    shapes = {row: _region(m.strokes[row].points, 0.0) for row in above}
    side = m.high - m.low
    wide = [row for row in above if side[row, 0] >= TIER * width and m.size[row] >= LARGE * float((high - low).max())]
    tiers: list[int] = []
    while touching := [row for row in wide if row not in tiers and shapes[row].intersects(area)]:
        tiers += touching
        area = area.union(shapely.union_all([shapes[row] for row in touching]))
    small = [row for row in above if side[row].max() < TIER * width and row not in tiers and shapes[row].intersects(area)]
    found = [Found(row, "crown", "a tier of the crown: it overlaps the outline beside it") for row in tiers]
    return found + [Found(row, "leaves", "a small closed shape on the crown", () if m.filled[row] else (("branch", 0.8),)) for row in small]


def _open_lobes(m: Measures, free, lobes: list[int], near: float) -> list[Found]:
    """Less closed outlines beside several lobes, as large as those and touching one of them."""
    if len(lobes) < 2:
        return []
    middle = float(np.median(m.size[lobes]))
    alike = free & (m.size >= ALIKE * middle) & (m.size <= middle / ALIKE) & (m.opening <= WIDER * m.size) & ~m.filled
    alike[lobes] = False
    rows = np.flatnonzero(alike & (m.low[:, 1] >= m.low[lobes, 1].min() - near) & (m.area > 0) & (np.diff(m.first_point) >= 4))
    areas = shapely.union_all([_region(m.strokes[row].points, near) for row in lobes])
    beside = [row for row in rows.tolist() if _roundness(m, np.array([row]))[0] >= ROUND and areas.intersects(shapely.LineString(m.strokes[row].points))]
    return [Found(row, "crown", "a lobe as large as the closed ones beside it", (("branch", 0.6),)) for row in beside]


def _roundness(m: Measures, rows) -> Float[np.ndarray, " row"]:
    """4πA/P² of the convex hull of each outline, times the part of it that the outline fills."""
    hull = shapely.convex_hull([shapely.MultiPoint(m.strokes[row].points) for row in rows])
    area = np.maximum(shapely.area(hull), 1e-300)
    return 4 * np.pi * area / shapely.length(hull) ** 2 * np.minimum(m.area[rows] / area, 1.0)


def _outlines(m: Measures, free, size: float, ground: list[np.ndarray]):
    """Rows of the strokes that are outlines by their shape."""
    nearly = (m.opening <= OPEN * m.size) | on_ground(m, ground)
    rows = np.flatnonzero(free & (m.size >= SMALL * size) & nearly & (np.diff(m.first_point) >= 4 - m.closed) & (m.area > 0))
    if len(rows) == 0:
        return rows
    around = shapely.length(shapely.convex_hull([shapely.MultiPoint(m.strokes[row].points) for row in rows]))
    bulky = 2 * m.area[rows] / np.maximum(m.length[rows], around) >= BULK * m.size[rows]
    side = m.high[rows] - m.low[rows]
    low, high = m.drawing
    stands = m.low[rows, 1] <= low[1] + STANDS * (high[1] - low[1])
    slim = slenderness(m.area[rows], m.around[rows]) >= SLIM
    stout = (side[:, 0] <= TRUNK * side[:, 0].max()) & (m.area[rows] <= TRUNK * m.area[rows].max())
    trunk = stands & (m.high[rows, 1] < high[1]) & ((slim & (side[:, 1] > side[:, 0])) | stout)
    rows = rows[(_roundness(m, rows) >= ROUND) & (bulky | ~m.filled[rows]) & ~trunk]
    return rows[~_fronds(m, rows)]


def on_ground(m: Measures, ground: list[np.ndarray]) -> Bool[np.ndarray, " stroke"]:
    """Strokes of which both ends stand on a drawn ground line."""
    if not ground:
        return np.zeros(len(m), bool)
    lines = shapely.union_all([shapely.LineString(points) for points in ground])
    return (shapely.distance(shapely.points([m.first, m.last]), lines) <= ON_GROUND * m.size).all(0)


def _region(points, near: float) -> shapely.Polygon:
    return shapely.make_valid(shapely.Polygon(points)).buffer(near)


def _upper_ends(m: Measures, rows: Bool[np.ndarray, " stroke"]) -> Float[np.ndarray, "tip 2"]:
    tips = np.where((m.first[:, 1] >= m.last[:, 1])[:, None], m.first, m.last)
    for row in np.flatnonzero(rows & m.closed):
        points = m.strokes[row].points
        tips[row] = points[np.argmax(points[:, 1])]
    return tips[rows]


def _kept(m: Measures, rows, regions, chosen, reason: str) -> list[Found]:
    """The chosen outlines as crowns; those that lie wholly within another as marks inside it."""
    found = []
    for k in np.flatnonzero(chosen):
        others = [j for j in np.flatnonzero(chosen) if m.area[rows[j]] > m.area[rows[k]]]
        inner = any(shapely.contains_xy(regions[j], m.strokes[rows[k]].points).mean() > 0.95 for j in others)
        found.append(Found(int(rows[k]), "leaves", "an outline inside the crown") if inner else Found(int(rows[k]), "crown", reason))
    return found
