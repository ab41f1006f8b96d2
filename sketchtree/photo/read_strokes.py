"""Which strokes mark which tree? A drawing over the photo, in any format that `sketch/` reads, as one `Marked` a tree (Tan et al. 2008, §2, "User interface").

- **Crowns** are the strokes that the file calls so (by kind, layer, class or id); if none is, those that close on themselves. Everything else runs along a limb.
- **Whose limb?** That of the crown most of it lies in; of none much, the nearest. Layers or ids named `tree 1`, `tree 2` … say so outright.
- **The trunk** is the stroke named so, else the one that reaches lowest (the first in the file, if that is hardly higher). It is turned to begin at its lower end, the others to
  begin at the end nearer to it.
- The page (an SVG's viewBox) is the photo. If it has another size of the same shape, strokes are scaled, and a warning says so. What lies outside is cut off.
"""

import os
import re

import numpy as np
import shapely
from jaxtyping import Float

from sketchtree.errors import SketchError
from sketchtree.photo.marked import Marked
from sketchtree.photo.page_over import page_over
from sketchtree.photo.photo import Photo, turned_over
from sketchtree.sketch.files.limits import MAX_MB, MAX_STROKES
from sketchtree.sketch.formats import read_sketch
from sketchtree.sketch.strokes import Sketch, Stroke, StrokeKind

_CLOSES = 0.12  # gap between a stroke's ends, of its length, up to which it closes on itself
_ROUND = 0.25  # area of what it surrounds, of its bounding rectangle's, from which it is a crown and no loop
_HARDLY = 0.05  # of the photo's height: the first stroke may end so much higher than the lowest, and be the trunk
_SLACK = 1.0  # pixels a stroke may lie outside unremarked
_LEAST = 16.0  # pixels² that a crown holds
_MOST = 20_000  # points of a stroke: a hand's has some thousands, and lines that cross themselves more often take minutes
_SHARE = 200  # places on a limb that are asked which crown they lie in
_TREE = re.compile(r"(?<![a-z])tree[\W_]*(\d+)(?!\d)|(?<![a-z])tree[\W_]+([a-z])(?![a-z])", re.IGNORECASE)
_TRUNK = re.compile(r"trunk|stem", re.IGNORECASE)


def read_strokes(path: str | os.PathLike, photo: Photo, *, max_strokes: int = MAX_STROKES, max_mb: float = MAX_MB) -> tuple[Marked, ...]:
    """The trees marked in a file. Raises SketchError, naming the stroke, for strokes that mark none."""
    return marked_trees(read_sketch(path, max_strokes=max_strokes, max_mb=max_mb), photo)


def marked_trees(sketch: Sketch, photo: Photo) -> tuple[Marked, ...]:
    """The trees that a drawing over the photo marks, in the order of their crowns."""
    scale, shift, warnings = _placed(sketch, photo)
    crowns, limbs = _sorted(sketch)
    for stroke in (*crowns, *limbs):
        if len(stroke.points) > _MOST:
            raise SketchError(f"it has {len(stroke.points):,} points; {_MOST:,} are the most.", stroke=stroke.id, remedy="Simplify the path, or draw it again.")
    box = shapely.box(0, 0, photo.width, photo.height)
    at = {stroke.id: turned_over(stroke.points) * scale + shift for stroke in (*crowns, *limbs)}
    outlines = [_outline(stroke, at[stroke.id], box, warnings) for stroke in crowns]
    lines = {stroke.id: _cut(stroke, at[stroke.id], box, warnings) for stroke in limbs}
    limbs = [stroke for stroke in limbs if lines[stroke.id] is not None]
    if not limbs:
        raise SketchError(f"{sketch.name} has no stroke along a limb inside the photo.", remedy="Draw one along the trunk, from its foot.")
    owner = [_owner(stroke, lines[stroke.id], crowns, outlines) for stroke in limbs]
    trees = []
    for k, (crown, outline) in enumerate(zip(crowns, outlines, strict=True)):
        own = [stroke for stroke, tree in zip(limbs, owner, strict=True) if tree == k]
        if not own:
            raise SketchError("no stroke runs along a limb of this tree.", stroke=crown.id, remedy="Draw one along its trunk, from its foot.")
        names, branches = _in_order(own, lines, photo.height)
        told = tuple(warnings) + tuple(sketch.warnings) if k == 0 else ()
        trees.append(Marked(np.array(outline.exterior.coords)[:-1], branches, names, crown.id, told))
    return tuple(trees)


def _placed(sketch: Sketch, photo: Photo) -> tuple[float, Float[np.ndarray, "2"], list[str]]:
    """(pixels a user unit, shift, warnings) from the sketch's page to the photo."""
    placed = page_over(sketch.page, photo.width, photo.height)
    if sketch.page is None:
        return *placed, []
    left, bottom, right, top = sketch.page
    width, height = right - left, top - bottom
    if placed is None:
        raise SketchError(
            f"{sketch.name} is drawn on a page of {width:g} × {height:g}, but {photo.name} has {photo.width} × {photo.height} pixels.",
            remedy="Draw the strokes over this photo, with its size as the page's.",
        )
    scale, shift = placed
    told = [] if abs(scale - 1) < 1e-6 else [f"{sketch.name} is drawn on a page of {width:g} × {height:g}; it was scaled to the photo's {photo.width} × {photo.height}."]
    return scale, shift, told


def _sorted(sketch: Sketch) -> tuple[list[Stroke], list[Stroke]]:
    """(crowns, the others)."""
    strokes = [stroke for stroke in sketch.strokes if stroke.kind in (StrokeKind.BRANCH, StrokeKind.CROWN)]
    crowns = [stroke for stroke in strokes if stroke.kind == StrokeKind.CROWN]
    if not crowns:
        crowns = [stroke for stroke in strokes if not stroke.labelled and _closes(stroke)]
    if not crowns:
        raise SketchError(f"{sketch.name} has no stroke round a crown.", remedy="Draw one round the tree's crown, in a layer named 'crown', or closed.")
    taken = {stroke.id for stroke in crowns}
    return crowns, [stroke for stroke in strokes if stroke.id not in taken]


def _closes(stroke: Stroke) -> bool:
    points = stroke.points
    if len(points) < 4:
        return False
    length = np.hypot(*np.diff(points, axis=0).T).sum()
    size = points.max(axis=0) - points.min(axis=0)
    area = abs(shapely.Polygon(points).area)
    return bool((stroke.closed or np.hypot(*(points[0] - points[-1])) <= _CLOSES * length) and area >= _ROUND * size.prod() > 0)


def _outline(stroke: Stroke, points, box, warnings: list[str]) -> shapely.Polygon:
    """The area that a crown's stroke surrounds, within the photo: loops and gaps of a careless hand belong to it."""
    if len(np.unique(points, axis=0)) < 3:
        raise SketchError(f"it has {len(np.unique(points, axis=0))} points, too few to surround a crown.", stroke=stroke.id, remedy="Draw it round the tree's crown.")
    ring = shapely.LineString([*points, points[0]])
    whole = shapely.unary_union(list(shapely.get_parts(shapely.polygonize([shapely.unary_union(ring)]))))
    if whole.area < _LEAST:
        raise SketchError("it surrounds no area.", stroke=stroke.id, remedy="Draw it round the tree's crown.")
    found = _largest(whole.intersection(box))
    if found is None or found.area < _LEAST:
        raise _outside(stroke)
    if not box.buffer(_SLACK).covers(whole):
        warnings.append(f"Stroke {stroke.id} leaves the photo; what is outside was cut off.")
    return found


def _largest(shape) -> shapely.Polygon | None:
    parts = [part for part in shapely.get_parts(shape) if isinstance(part, shapely.Polygon)]
    return max(parts, key=lambda part: part.area) if parts else None


def _cut(stroke: Stroke, points, box, warnings: list[str]) -> Float[np.ndarray, "point 2"] | None:
    """A stroke along a limb, within the photo; None if it lies outside."""
    if len(np.unique(points, axis=0)) < 2:
        warnings.append(f"Stroke {stroke.id} is a dot; it was left out.")
        return None
    if box.covers(shapely.LineString(points)):
        return points
    parts = [part for part in shapely.get_parts(shapely.LineString(points).intersection(box)) if part.length > 0]
    parts = [part for part in shapely.get_parts(shapely.line_merge(shapely.MultiLineString(parts), directed=True)) if part.length > 0] if parts else []
    if not parts:
        warnings.append(f"Stroke {stroke.id} lies outside the photo; it was left out.")
        return None
    if not box.buffer(_SLACK).covers(shapely.LineString(points)):
        warnings.append(f"Stroke {stroke.id} leaves the photo; what is outside was cut off.")
    return np.array(max(parts, key=lambda part: part.length).coords)


def _owner(stroke: Stroke, line, crowns: list[Stroke], outlines: list[shapely.Polygon]) -> int:
    """The number of the crown that a limb belongs to."""
    named = _tree_named(stroke)
    if named is not None:
        alike = [k for k, crown in enumerate(crowns) if _tree_named(crown) == named]
        if alike:
            return alike[0]
    path = shapely.LineString(line)
    places = shapely.get_coordinates(shapely.line_interpolate_point(path, np.linspace(0.0, 1.0, _SHARE), normalized=True))

    def far(k: int) -> tuple[float, float, float]:
        inside = float(shapely.contains_xy(outlines[k], places).mean())
        return (-round(inside, 1), path.distance(outlines[k]), abs(outlines[k].centroid.x - line[line[:, 1].argmax(), 0]))

    return min(range(len(crowns)), key=far)


def _tree_named(stroke: Stroke) -> str | None:
    """The tree that a layer's name or an id speaks of."""
    for name in (stroke.layer, stroke.id):
        found = _TREE.search(name or "")
        if found:
            return (found[1] or found[2]).lower()
    return None


def _in_order(own: list[Stroke], lines: dict, height: int) -> tuple[tuple[str, ...], tuple[Float[np.ndarray, "point 2"], ...]]:
    """(names, lines) of a tree's limbs, the trunk's first, each from its lower end."""
    named = [stroke for stroke in own if _TRUNK.search(stroke.id) or _TRUNK.search(stroke.layer or "")]
    depth = [lines[stroke.id][:, 1][[0, -1]].max() for stroke in own]
    lowest = own[0] if depth[0] >= max(depth) - _HARDLY * height else own[int(np.argmax(depth))]
    trunk = named[0] if len(named) == 1 else lowest
    first = lines[trunk.id]
    first = first if first[0, 1] >= first[-1, 1] else first[::-1]
    stem = shapely.LineString(first)
    others = [stroke for stroke in own if stroke is not trunk]
    turned = [_towards(lines[stroke.id], stem) for stroke in others]
    return tuple(stroke.id for stroke in (trunk, *others)), (np.ascontiguousarray(first), *turned)


def _towards(line, stem: shapely.LineString) -> Float[np.ndarray, "point 2"]:
    """A limb from the end that is nearer to the trunk; of two as near, from the lower."""
    one, other = (stem.distance(shapely.Point(line[end])) for end in (0, -1))
    backwards = other < one if abs(one - other) > 1e-9 else line[-1, 1] > line[0, 1]
    return np.ascontiguousarray(line[::-1]) if backwards else line


def _outside(stroke: Stroke) -> SketchError:
    return SketchError("it lies outside the photo.", stroke=stroke.id, remedy="Draw the strokes over the photo, with its size as the page's.")
