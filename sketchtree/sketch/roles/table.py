"""What is known of the strokes while they are being sorted? First by the names that the file gives them."""

from dataclasses import dataclass, field

import numpy as np
import shapely
from jaxtyping import Bool

from sketchtree.sketch.joining.lines import Line
from sketchtree.sketch.roles.crown import has_area, outline
from sketchtree.sketch.roles.found import Found
from sketchtree.sketch.roles.measures import Measures
from sketchtree.sketch.roles.named import role_in_names
from sketchtree.sketch.roles.wood import Wood
from sketchtree.sketch.strokes import Sketch, Stroke, StrokeKind


@dataclass(frozen=True)
class Part:
    """A stroke that is part of a limb which another drew, too."""

    stroke: str  # its id
    owner: str  # id of the other
    reason: str


@dataclass(eq=False)
class Table:
    """The strokes while they are being sorted."""

    m: Measures
    wood: Bool[np.ndarray, " stroke"]  # may be branches
    free: Bool[np.ndarray, " stroke"]  # may be anything: wood that no name calls so
    found: dict[int, Found] = field(default_factory=dict)
    outlines: list[np.ndarray] = field(default_factory=list)  # of crowns
    legs: dict[int, tuple[np.ndarray, ...]] = field(default_factory=dict)  # wood in strokes that drew a crown too
    pieces: list[tuple[int, Stroke]] = field(default_factory=list)  # of painted strokes that are wood only in part
    stubs: list[tuple[int, np.ndarray, float]] = field(default_factory=list)  # stout trunks: row, middle line, width
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
        self.take([Found(row, "hatching", "drawn between the two sides of a limb, or along one", (("branch", 0.6),)) for row in sorted(rows)])

    def add_rims(self, wood: Wood) -> None:
        """Strokes that ran along a crown's outline, in part or wholly."""
        for line in wood.rims:
            self.found.setdefault(line.row, Found(line.row, "crown", "it runs along the crown's outline", (("branch", 0.5),)))

    def rows(self, role: str) -> list[int]:
        """The strokes known to be this."""
        return sorted(row for row, one in self.found.items() if one.role == role)


NOTHING = "but it encloses nothing: left out"
"""How the reason ends for a crown or an obstacle without area."""


def named_table(sketch: Sketch) -> Table:
    """The strokes, those known by name taken."""
    strokes = sketch.strokes
    branch = np.array([s.kind == StrokeKind.BRANCH for s in strokes])
    labelled = np.array([s.labelled for s in strokes])
    table = Table(Measures.of(strokes), branch.copy(), branch & ~labelled)
    for row, stroke in enumerate(strokes):
        if not branch[row]:
            known = has_area(stroke)
            reason = f"named a{'n' if stroke.kind == StrokeKind.OBSTACLE else ''} {stroke.kind}" if stroke.labelled else f"drawn as a {stroke.kind}"
            table.take([Found(row, str(stroke.kind), reason if known else f"{reason}, {NOTHING}")])
            if known and stroke.kind == StrokeKind.CROWN:
                table.outlines.append(outline(stroke.points))
        elif (role := role_in_names(stroke)) == "root":
            table.named_roots.add(row)
            table.free[row] = False
        elif role and not stroke.labelled:
            table.take([Found(row, role, "named so")])
    return table
