"""What is each stroke: branch, crown, obstacle, ground, shadow, leaves, hatching, root, or the paper itself?

Names win: what a layer, a class or an id says is not questioned. The rest is decided by shape and place, in this
order, each rule on what the ones before it left: the paper, ground lines, shadows, crowns, what is drawn inside a crown, leaves.
All others are wood: their lines are what is joined to a tree. A rule needs several cues; a stroke that shows only one
stays a branch.
"""

import dataclasses
from dataclasses import dataclass, field

import numpy as np
import shapely
from jaxtyping import Bool, Float

from sketchtree.sketch.graph import Cut, Role
from sketchtree.sketch.joining.lines import Line
from sketchtree.sketch.roles.arcs import crown_of_arcs
from sketchtree.sketch.roles.contour import contour, lone_outline
from sketchtree.sketch.roles.crown import closed_crowns, has_area, on_ground, outline
from sketchtree.sketch.roles.found import NAMED, Found, role_warnings
from sketchtree.sketch.roles.ground import grass, ground_lines
from sketchtree.sketch.roles.hatching import hatching
from sketchtree.sketch.roles.implied import carried_on, implied_stems
from sketchtree.sketch.roles.ink import areas, is_ink
from sketchtree.sketch.roles.leaves import leaf_shapes, marks_inside
from sketchtree.sketch.roles.masses import border, bulk_and_trunk
from sketchtree.sketch.roles.measures import Measures
from sketchtree.sketch.roles.named import role_in_names
from sketchtree.sketch.roles.page import cuts_of, frames
from sketchtree.sketch.roles.roots import Rooted, roots_apart
from sketchtree.sketch.roles.scribble import Scribble, meaning, scribbles
from sketchtree.sketch.roles.shadow import shadows
from sketchtree.sketch.roles.silhouette import with_holes
from sketchtree.sketch.roles.trunk_edges import trunks_of_edges
from sketchtree.sketch.roles.wood import Wood, wood_lines
from sketchtree.sketch.strokes import Sketch, Stroke, StrokeKind

PAINTED = 0.5  # of the drawing's size: a crown and trunk painted in one piece are larger


@dataclass(frozen=True)
class Part:
    """A stroke that is part of a limb which another drew, too."""

    stroke: str  # its id
    owner: str  # id of the other
    reason: str


@dataclass(frozen=True, eq=False)
class Sorted:
    """The strokes of a sketch by what they are; sketch units, y up."""

    lines: list[Line]  # of the wood above the ground
    roots: list[Line]  # of the wood below it
    parts: tuple[Part, ...]  # strokes that drew a limb together with another
    measured: bool  # the lines' widths are the limbs' own thickness; no pen set them
    crowns: tuple[Float[np.ndarray, "point 2"], ...]  # closed outlines, first point not repeated
    obstacles: tuple[Float[np.ndarray, "point 2"], ...]
    ground: tuple[Float[np.ndarray, "point 2"], ...]  # drawn ground lines
    roles: tuple[Role, ...]  # strokes that are no branch, or only in part, in the order of the file
    cuts: tuple[Cut, ...]  # where the page's edge cuts the wood
    warnings: tuple[str, ...]


@dataclass(eq=False)
class _Table:
    """The strokes while they are being sorted."""

    m: Measures
    wood: Bool[np.ndarray, " stroke"]  # may be branches
    free: Bool[np.ndarray, " stroke"]  # may be anything: wood that no name calls so
    found: dict[int, Found] = field(default_factory=dict)
    outlines: list[np.ndarray] = field(default_factory=list)  # of crowns
    legs: dict[int, tuple[np.ndarray, ...]] = field(default_factory=dict)  # wood in strokes that drew a crown too
    pieces: list[tuple[int, Stroke]] = field(default_factory=list)  # of painted strokes that are wood only in part
    inks: list[tuple[int, list[int]]] = field(default_factory=list)  # painted paths that are the lines of a drawing, their areas
    parts: list[Part] = field(default_factory=list)
    named_roots: set[int] = field(default_factory=set)

    def take(self, found: list[Found]) -> None:
        """These strokes are known now."""
        for one in found:
            self.found[one.row] = one
            self.wood[one.row] = self.free[one.row] = False

    def crown_area(self, margin: float = 0.0) -> shapely.Geometry | None:
        """The area of all crowns, this much wider; None where there is none."""
        if not self.outlines:
            return None
        return shapely.union_all([shapely.make_valid(shapely.Polygon(points)).buffer(margin) for points in self.outlines])

    def add_bark(self, bark: list[Line], lines: list[Line]) -> None:
        """Strokes of which nothing is left but lines between the sides of a limb."""
        rows = {line.row for line in bark} - {line.row for line in lines}
        self.take([Found(row, "hatching", "drawn between the two sides of a limb", (("branch", 0.6),)) for row in sorted(rows)])

    def add_rims(self, wood: Wood) -> None:
        """Strokes that ran along a crown's outline, in part or wholly."""
        for line in wood.rims:
            self.found.setdefault(line.row, Found(line.row, "crown", "it runs along the crown's outline", (("branch", 0.5),)))

    def rows(self, role: str) -> list[int]:
        """The strokes known to be this."""
        return sorted(row for row, one in self.found.items() if one.role == role)


def sort_strokes(sketch: Sketch) -> Sorted:
    """What every stroke of the sketch is. Neither order nor direction of the strokes matters."""
    if not sketch.strokes:
        return Sorted([], [], (), False, (), (), (), (), (), ())
    table = _named(sketch)
    table.take(frames(table.m, table.free))
    _find_ink(table)
    table.take(ground_lines(table.m, table.free, table.wood))
    ground = [table.m.strokes[row].points for row in table.rows("ground")]
    table.take(grass(table.m, table.free, ground, table.wood))
    table.take(shadows(table.m, table.free, table.wood))
    _read_ink(table)
    _find_crowns(table, ground)
    _find_leaves(table)
    wood = wood_lines(table.m, np.flatnonzero(table.wood).tolist(), table.legs, table.pieces, table.outlines)
    table.add_rims(wood)
    trunks = trunks_of_edges(wood.lines, table.outlines)
    lines, sides = trunks.lines, [*wood.sides, *trunks.sides]
    table.add_bark([*wood.bark, *trunks.bark], lines)
    stem_warnings = []
    if not lines and table.outlines:
        lines, stem_warnings = implied_stems(table.outlines, ground, *_owner(table))
    elif table.outlines:
        lines, stem_warnings = carried_on(lines, table.outlines, *_owner(table))
    rooted = roots_apart(lines, ground, table.named_roots)
    cuts, cut_warnings = cuts_of([*rooted.above, *rooted.below], sketch.page)
    roles = tuple(table.found[row].named(sketch.strokes[row].id) for row in sorted(table.found))
    return Sorted(
        lines=rooted.above,
        roots=rooted.below,
        parts=(*table.parts, *_parts(sketch, wood.holes, sides)),
        measured=wood.measured,
        crowns=tuple(table.outlines),
        obstacles=tuple(outline(sketch.strokes[row].points) for row in table.rows("obstacle") if has_area(sketch.strokes[row])),
        ground=tuple(ground),
        roles=roles,
        cuts=cuts,
        warnings=(*role_warnings(roles), *_side_warnings(wood.sides, "limb"), *_side_warnings(trunks.sides, "trunk"), *stem_warnings, *_root_warnings(rooted), *cut_warnings),
    )


def _parts(sketch: Sketch, holes: list[tuple[int, int]], sides: list[tuple[Line, Line]]) -> tuple[Part, ...]:
    """The strokes that drew a limb together with another."""
    of_sides = [Part(other.id, middle.id, "the other side of a limb drawn as an outline") for middle, other in sides]
    return (*of_sides, *(Part(sketch.strokes[hole].id, sketch.strokes[outer].id, "a hole in that painted shape") for hole, outer in holes))


def _root_warnings(rooted: Rooted) -> list[str]:
    names = list(dict.fromkeys(line.id for line in rooted.below))
    if not rooted.found:
        return []
    named = f"{', '.join(names[:NAMED])}{', …' if len(names) > NAMED else ''}"
    return [f"What runs on below the ground was taken for roots (stroke{'s' if len(names) > 1 else ''} {named})."]


def _side_warnings(sides: list[tuple[Line, Line]], what: str) -> list[str]:
    pairs = [f"{middle.id} and {other.id}" for middle, other in sides]
    if len(pairs) > 2:
        return [f"{len(pairs)} pairs of strokes ({', '.join(pairs[:3])}{', …' if len(pairs) > 3 else ''}) were taken for the two sides of one {what} each."]
    return [f"Strokes {pair} were taken for the two sides of one {what}." for pair in pairs]


def _named(sketch: Sketch) -> _Table:
    """The strokes, those known by name taken."""
    strokes = sketch.strokes
    branch = np.array([s.kind == StrokeKind.BRANCH for s in strokes])
    labelled = np.array([s.labelled for s in strokes])
    table = _Table(Measures.of(strokes), branch.copy(), branch & ~labelled)
    for row, stroke in enumerate(strokes):
        if not branch[row]:
            known = has_area(stroke)
            reason = f"named a{'n' if stroke.kind == StrokeKind.OBSTACLE else ''} {stroke.kind}" if stroke.labelled else f"drawn as a {stroke.kind}"
            table.take([Found(row, str(stroke.kind), reason if known else f"{reason}, but it encloses nothing: left out")])
            if known and stroke.kind == StrokeKind.CROWN:
                table.outlines.append(outline(stroke.points))
        elif (role := role_in_names(stroke)) == "root":
            table.named_roots.add(row)
            table.free[row] = False
        elif role and not stroke.labelled:
            table.take([Found(row, role, "named so")])
    return table


def _find_ink(table: _Table) -> None:
    """Painted paths that are the lines of a drawing: what they enclose is looked at in their place."""
    rows = np.flatnonzero(table.free & table.m.filled)
    if len(rows) < 2:
        return
    for outer, holes in with_holes([table.m.strokes[row] for row in rows]):
        row, inner = int(rows[outer]), [int(rows[hole]) for hole in holes]
        if is_ink(table.m, row, inner):
            table.inks.append((row, inner))
            table.wood[row] = table.free[row] = False


def _read_ink(table: _Table) -> None:
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


def _find_painted_trees(table: _Table) -> None:
    """Crowns painted in one with their trunk."""
    m = table.m
    size = float((m.drawing[1] - m.drawing[0]).max())
    large = table.free & m.filled & (m.size >= PAINTED * size) & (m.area >= 0.05 * m.size**2)
    for row in np.flatnonzero(large).tolist():
        area = shapely.make_valid(shapely.Polygon(m.strokes[row].points))
        crown, trunk = bulk_and_trunk(area) if area.geom_type == "Polygon" else (None, [])
        if crown is not None:
            table.outlines.append(border(crown))
            table.take([Found(row, "crown", "the bulky part of a tree painted in one piece")])
            table.pieces += [(row, dataclasses.replace(m.strokes[row], points=border(piece))) for piece in trunk]


def _find_crowns(table: _Table, ground: list[np.ndarray]) -> None:
    """The crowns by their shape, unless the file names one; and what the scribbles are."""
    m = table.m
    wild = scribbles(m, table.free)
    tame = table.wood.copy()
    tame[wild] = False
    if not table.outlines:
        closed = closed_crowns(m, table.free & tame, tame, ground)
        table.take(closed)
        tame[[one.row for one in closed]] = False
        table.outlines += [outline(m.strokes[one.row].points) for one in closed if one.role == "crown"]
    if not table.outlines:
        _find_painted_trees(table)
        tame &= table.wood
    if not table.outlines:
        _find_contour(table, np.flatnonzero(tame))
    if not table.outlines:
        _find_arcs(table, tame)
    if not table.outlines and (alone := lone_outline(_closed_by(ground, m, np.flatnonzero(tame)))) is not None:
        table.outlines.append(outline(alone))
        table.take([Found(int(row), "crown", "a closed outline without a trunk") for row in np.flatnonzero(tame)])
    for row in wild.tolist():
        _take_scribble(table, meaning(m, row, table.crown_area(), alone=not table.outlines and len(wild) == table.wood.sum()))


def _closed_by(ground: list[np.ndarray], m: Measures, rows) -> list[Stroke]:
    """These strokes, those with both ends on a ground line closed."""
    standing = on_ground(m, ground)
    return [dataclasses.replace(m.strokes[row], closed=True) if standing[row] else m.strokes[row] for row in rows]


def _find_contour(table: _Table, rows) -> None:
    """A crown that is one contour on its trunk."""
    around = contour([table.m.strokes[row] for row in rows])
    if around is None:
        return
    table.outlines.append(outline(around.outline))
    for k, legs in around.legs.items():
        row = int(rows[k])
        table.take([Found(row, "crown", "part of one contour around a crown on its trunk")])
        if legs:
            table.legs[row] = legs


def _find_arcs(table: _Table, tame: Bool[np.ndarray, " stroke"]) -> None:
    """A crown that several arcs draw."""
    arcs = crown_of_arcs(table.m, table.free & tame, tame)
    if arcs is not None:
        table.outlines.append(outline(arcs.outline))
        table.take([Found(int(row), "crown", "one of several arcs around the branches", (("branch", 0.5),)) for row in arcs.rows])


def _take_scribble(table: _Table, scribble: Scribble) -> None:
    if scribble.role == "crown":
        table.outlines.append(scribble.outline)
        table.take([Found(scribble.row, "crown", "a scribble of foliage")])
    elif scribble.role == "leaves":
        table.take([Found(scribble.row, "leaves", "a scribble of foliage", (("branch", 0.6),))])
    if scribble.middle:
        table.legs[scribble.row] = scribble.middle
        table.wood[scribble.row] = table.free[scribble.row] = False


def _owner(table: _Table) -> tuple[int, str]:
    """(row, id) of the stroke that an implied stem is put down to: the first that drew a crown, in the order of their ids."""
    rows = table.rows("crown")
    row = min(rows, key=lambda k: table.m.strokes[k].id)
    return row, table.m.strokes[row].id


def _find_leaves(table: _Table) -> None:
    """Leaves, and marks inside the crowns."""
    rows = np.flatnonzero(table.wood)
    if len(rows) < 2 and not table.outlines:
        return
    if len(rows) == 0:
        return
    height = float(max(table.m.high[rows, 1].max() - table.m.low[rows, 1].min(), 0.0))
    if table.outlines:
        table.take(marks_inside(table.m, table.free, table.crown_area(0.02 * height), table.wood, height))
    table.take(hatching(table.m, table.free, table.wood, height))
    leaves = leaf_shapes(table.m, table.free, height)
    if len(leaves) < table.wood.sum():
        table.take(leaves)
