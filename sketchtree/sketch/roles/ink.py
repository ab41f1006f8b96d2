"""Is a painted path the ink of an outline drawing? Then what it encloses is the drawing: trunk, crown, shadow.

Programs that trace or flatten a pen drawing write all its lines as one painted path, whose holes are the areas between them.
Such a path covers little of what it encloses. Its areas are read as if each were painted: those that stand on the
ground are wood; those that wood surrounds are gaps between limbs; all others, with the lines between them, are crowns.
"""

from dataclasses import dataclass

import numpy as np
import shapely
from jaxtyping import Float

from sketchtree.sketch.roles.found import Found
from sketchtree.sketch.roles.masses import border
from sketchtree.sketch.roles.measures import Measures
from sketchtree.sketch.roles.silhouette import with_holes
from sketchtree.sketch.roles.table import Part, Table

COVERS = 0.35  # greatest part of what it encloses that ink covers
LARGE = 0.5  # least size of an ink drawing, of the whole
STANDS = 0.12  # of the drawing's height: wood comes this near to the foot
GAP = 0.8  # least part of a gap that lies in the hull of the wood
TOUCH = 1.2  # of the pen's width: areas on both sides of a line become one crown when widened by it
CROWN = 0.15  # least size of a crown, of the drawing's


@dataclass(frozen=True, eq=False)
class Areas:
    """What the areas of an ink drawing are; rows of strokes."""

    wood: list[int]
    crown: list[int]
    gaps: list[int]
    outlines: list[Float[np.ndarray, "point 2"]]  # of the crowns


def is_ink(m: Measures, outer: int, holes: list[int]) -> bool:
    """Whether this painted shape, with its holes, is the lines of a drawing rather than its areas."""
    size = float((m.drawing[1] - m.drawing[0]).max())
    return bool(holes and m.size[outer] >= LARGE * size and m.area[outer] - m.area[holes].sum() <= COVERS * m.area[outer])


def areas(m: Measures, outer: int, holes: list[int], known: set[int]) -> Areas:
    """What the areas inside the ink are. `known`: rows that are something else already, a shadow say."""
    pen = 2 * (m.area[outer] - m.area[holes].sum()) / (m.length[outer] + m.length[holes].sum())
    free = [row for row in holes if row not in known]
    foot = min((m.low[row, 1] for row in free), default=0.0)
    height = float(m.drawing[1][1] - m.drawing[0][1])
    wood = [row for row in free if m.low[row, 1] <= foot + STANDS * height]
    polygons = {row: shapely.make_valid(shapely.Polygon(m.strokes[row].points)) for row in free}
    hull = shapely.convex_hull(shapely.union_all([polygons[row] for row in wood]))
    rest = [row for row in free if row not in wood]
    gaps = [row for row in rest if polygons[row].intersection(hull).area >= GAP * polygons[row].area]
    crown = [row for row in rest if row not in gaps]
    whole = shapely.union_all([polygons[row].buffer(TOUCH * pen) for row in crown]).buffer(-0.7 * TOUCH * pen)
    size = float((m.drawing[1] - m.drawing[0]).max())
    pieces = [p for p in shapely.get_parts(whole) if p.geom_type == "Polygon" and max(np.subtract(p.bounds[2:], p.bounds[:2])) >= CROWN * size]
    return Areas(wood, crown, gaps, [border(piece) for piece in sorted(pieces, key=lambda p: p.bounds)])


def find_ink(table: Table) -> None:
    """Painted paths that are the lines of a drawing: what they enclose is looked at in their place."""
    rows = np.flatnonzero(table.free & table.m.filled)
    if len(rows) < 2:
        return
    for outer, holes in with_holes([table.m.strokes[row] for row in rows]):
        row, inner = int(rows[outer]), [int(rows[hole]) for hole in holes]
        if is_ink(table.m, row, inner):
            table.inks.append((row, inner))
            table.wood[row] = table.free[row] = False


def read_ink(table: Table) -> None:
    """The areas between the lines of an ink drawing: wood, crown, or gaps."""
    for row, holes in table.inks:
        found = areas(table.m, row, holes, set(table.found))
        table.outlines += found.outlines
        table.take([Found(k, "crown", "an area of the crown in an outline drawing") for k in found.crown])
        table.take([Found(k, "paper", "a gap between the limbs of an outline drawing") for k in found.gaps])
        if found.wood:
            owner = min(table.m.strokes[k].id for k in found.wood)
            table.parts.append(Part(table.m.strokes[row].id, owner, "the ink around that limb"))
        else:
            table.take([Found(row, "crown", "the ink around a crown")])
