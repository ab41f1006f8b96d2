"""Which lines run down the middle of a painted shape? Trunks and limbs drawn as filled outlines.

The medial axis of the outline (Blum 1967), from the Voronoi diagram of points along it: ridges inside the
shape, each with its distance r to the outline. The longest way through it is a line of width 2r; then, again and again,
the longest side way, as long as it reaches well out of the disc it starts in (what is shorter is a corner or a bump of
the outline). At an end the axis forks into the corners: it is cut back to where r falls no faster than FORK and
drawn straight on to the outline. Where the foot of a trunk flares, the axis forks into short legs: they
are left out, and the trunk runs straight on to the ground between them.
"""

import dataclasses

import numpy as np
import shapely
from jaxtyping import Float, Int
from scipy.sparse import coo_array, csr_array
from scipy.sparse.csgraph import connected_components, dijkstra
from scipy.spatial import Voronoi

from sketchtree.sketch.joining.lines import Line, unit
from sketchtree.sketch.strokes import Stroke

SAMPLES = 800  # points along an outline
FORK = 0.35  # fall of r along the axis above which it runs into a corner
REACHES = 1.6  # a side way must be longer than this many r where it starts …
LEAST = 0.02  # … and than this of the shape's size
LEG = 2.5  # of the trunk's width: longer legs are no flare of its foot
SPREADS = 0.35  # least run to the side of a leg, of its length
COMPACT = 0.45  # 4πA/P² of a shape, above which it is a blob and no limb


def is_blob(stroke: Stroke) -> bool:
    """Whether a painted shape is round rather than long or branched."""
    shape = _polygon([stroke])
    return shape.is_empty or 4 * np.pi * shape.area / shape.length**2 > COMPACT


def with_holes(strokes: list[Stroke]) -> list[tuple[int, list[int]]]:
    """(outer, its holes) among painted shapes: a hole is another part of the same path, inside it."""
    paths: dict[str, list[int]] = {}
    for k, stroke in enumerate(strokes):
        stem, _, part = stroke.id.rpartition("-")
        paths.setdefault(stem if part.isdigit() and stem in paths else stroke.id, []).append(k)
    found = [(parts[0], []) for parts in paths.values() if len(parts) == 1]
    for parts in (parts for parts in paths.values() if len(parts) > 1):
        found += _nested([strokes[k] for k in parts], parts)
    return sorted(found)


def _nested(strokes: list[Stroke], rows: list[int]) -> list[tuple[int, list[int]]]:
    """The same for the parts of one path: a part inside a hole is a shape of its own again."""
    areas = np.array([_polygon([stroke]) for stroke in strokes], object)
    inner, outer = shapely.STRtree(areas).query(shapely.point_on_surface(areas), predicate="within")
    size = shapely.area(areas)
    around = size[outer] > size[inner]
    outer, inner = outer[around], inner[around]
    depth = np.bincount(inner, minlength=len(rows))
    holes: dict[int, list[int]] = {k: [] for k in np.flatnonzero(depth % 2 == 0).tolist()}
    for k in np.flatnonzero(depth % 2 == 1).tolist():
        holes[min((j for j in outer[inner == k].tolist() if j in holes), key=lambda j: size[j])].append(k)
    return [(rows[k], [rows[hole] for hole in sorted(inside)]) for k, inside in holes.items()]


def middle_lines(row: int, outer: Stroke, holes: list[Stroke]) -> list[Line]:
    """The limbs of one painted shape, the longest first; [] when it has no inside."""
    shape = _polygon([outer, *holes])
    if shape.is_empty or shape.area <= 0:
        return []
    size = float(np.ptp(outer.points, axis=0).max())
    points, radius, graph = _medial_axis(shape)
    if len(points) < 3:
        return []
    lines = [_line(row, outer.id, points[way], radius[way], shape, free, size) for way, free in _ways(points, radius, graph, size)]
    return unflared(lines, float(outer.points[:, 1].min()))


def _polygon(strokes: list[Stroke]) -> shapely.Polygon:
    """The largest piece of the area inside the first outline and outside the others."""
    rings = [shapely.make_valid(shapely.Polygon(s.points)) for s in strokes if len(s.points) > 2]
    if not rings:
        return shapely.Polygon()
    area = rings[0] if len(rings) == 1 else rings[0].difference(shapely.union_all(rings[1:]))
    pieces = [piece for piece in shapely.get_parts(area) if piece.geom_type == "Polygon"]
    pieces = pieces or [p for part in shapely.get_parts(area) for p in shapely.get_parts(part) if p.geom_type == "Polygon"]
    return max(pieces, key=lambda piece: piece.area, default=shapely.Polygon())


def _medial_axis(shape: shapely.Polygon) -> tuple[Float[np.ndarray, "node 2"], Float[np.ndarray, " node"], csr_array]:
    """(points of the axis, their distance to the outline, lengths of its edges as a symmetric graph)."""
    dense = shapely.segmentize(shape, shape.length / SAMPLES)
    border = np.unique(shapely.get_coordinates(dense), axis=0)
    diagram = Voronoi(border)
    ridges = np.array(diagram.ridge_vertices)
    ridges = ridges[(ridges >= 0).all(1)]
    inside = shapely.contains_xy(shape, diagram.vertices)
    ridges = ridges[inside[ridges].all(1)]
    used, ridges = np.unique(ridges, return_inverse=True)
    ridges = ridges.reshape(-1, 2)
    points = diagram.vertices[used]
    length = np.maximum(np.hypot(*(points[ridges[:, 0]] - points[ridges[:, 1]]).T), 1e-12 * shape.length)
    graph = coo_array((length, ridges.T), (len(points),) * 2).tocsr()
    graph = graph + graph.T
    _, piece = connected_components(graph, directed=False)
    kept = np.flatnonzero(piece == np.argmax(np.bincount(piece))) if len(points) else np.zeros(0, np.int64)
    radius = shapely.distance(shape.exterior, shapely.points(points[kept]))
    for hole in shape.interiors:
        radius = np.minimum(radius, shapely.distance(hole, shapely.points(points[kept])))
    return points[kept], radius, graph[kept][:, kept]


def _ways(points, radius, graph: csr_array, size: float) -> list[tuple[Int[np.ndarray, " step"], bool]]:
    """(nodes from foot to tip, whether the foot is free) of the longest way and of every side way worth having."""
    lowest = int(np.argmin(points[:, 1]))
    far = int(np.argmax(dijkstra(graph, indices=lowest)))
    foot = far if points[far, 1] < points[lowest, 1] else lowest
    taken = np.zeros(len(points), bool)
    found: list = []
    start = np.array([foot])
    while True:
        away, before, source = dijkstra(graph, indices=start, min_only=True, return_predecessors=True)
        reach = np.where(np.isfinite(away), away, 0.0) - (REACHES * radius[np.maximum(source, 0)] if found else 0.0)
        tip = int(np.argmax(reach))
        if found and reach[tip] < LEAST * size:
            return found
        way = [tip]
        while before[way[-1]] >= 0:
            way.append(int(before[way[-1]]))
        found.append((np.array(way[::-1]), not found))
        taken[way] = True
        start = np.flatnonzero(taken)


def _line(row: int, stroke_id: str, points, radius, shape: shapely.Polygon, free_foot: bool, size: float) -> Line:
    """A way along the axis as a line, its free ends drawn straight on to the outline."""
    low, high = (_corner_free(points, radius) if free_foot else 0), len(points) - _corner_free(points[::-1], radius[::-1])
    low = min(low, high - 2)
    points, radius = points[low:high], radius[low:high]
    line = _simple(Line(row, stroke_id, points, 2 * radius), 1e-3 * size)
    ends = [_to_outline(line, shape)] if len(line.points) > 1 else [None]
    points, width = line.points, line.width
    if ends[0] is not None:
        points, width = np.vstack([points, ends[0]]), np.r_[width, width[-1]]
    if free_foot and (foot := _to_outline(line.reversed(), shape)) is not None:
        points, width = np.vstack([foot, points]), np.r_[width[0], width]
    return dataclasses.replace(line, points=points, width=width)


def unflared(lines: list[Line], ground: float) -> list[Line]:
    """The lines of a shape, the trunk first, without the legs into which its foot flares."""
    trunk, *sides = lines
    legs, fork = [], 0.0
    for side in sides:
        s = float(shapely.line_locate_point(trunk.shape, shapely.Point(side.points[0])))
        reach = LEG * float(np.interp(s, trunk.along, trunk.width))
        if s <= reach and side.length <= reach and _is_leg(side.points[[-1, 0]]) and _is_leg(np.array([trunk.points[0], trunk.at(s)])):
            legs.append(side)
            fork = max(fork, s)
    feet = np.array([trunk.points[0, 0], *(leg.points[-1, 0] for leg in legs)])
    start = trunk.at(fork)
    if not legs or not feet.min() < start[0] < feet.max():
        return lines
    rest = trunk.cut(fork, trunk.length)
    foot = np.array([0.5 * (feet.min() + feet.max()), ground])
    trunk = dataclasses.replace(rest, points=np.vstack([foot, rest.points]), width=np.r_[rest.width[0], rest.width])
    return [trunk, *(side for side in sides if not any(side is leg for leg in legs))]


def _is_leg(way: Float[np.ndarray, "2 2"]) -> bool:
    """Whether a way from its foot to where it starts falls to one side."""
    foot, start = way
    return bool(foot[1] < start[1] and abs(foot[0] - start[0]) >= SPREADS * np.hypot(*(foot - start)))


def _corner_free(points, radius) -> int:
    """How many nodes at the start of a way lead out of a corner."""
    s = np.r_[0.0, np.cumsum(np.hypot(*np.diff(points, axis=0).T))]
    rise = radius - FORK * s  # falls once the axis has left the corner
    best = int(np.argmax(np.where(s <= 1.5 * radius.max(), rise, -np.inf)))
    return best if rise[best] > rise[0] else 0


def _to_outline(line: Line, shape: shapely.Polygon) -> Float[np.ndarray, " 2"] | None:
    """Where the line drawn straight on from its tip leaves the shape."""
    width = max(float(line.width[-1]), 1e-9)
    tip, onward = line.points[-1], unit(line.points[-1] - line.at(max(line.length - width, 0.0)))
    ray = shapely.LineString([tip, tip + onward * 2.0 * width])
    hits = shapely.get_coordinates(ray.intersection(shape.boundary))
    return hits[np.argmin(np.hypot(*(hits - tip).T))] if len(hits) else None


def _simple(line: Line, tolerance: float) -> Line:
    """The line without the points that do not bend it."""
    points = shapely.get_coordinates(shapely.simplify(shapely.LineString(line.points), tolerance))
    s = shapely.line_locate_point(shapely.LineString(line.points), shapely.points(points))
    return dataclasses.replace(line, points=points, width=np.interp(s, line.along, line.width))
