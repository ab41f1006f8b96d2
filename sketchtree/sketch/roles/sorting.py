"""What is each stroke: branch, crown, obstacle, ground, shadow, leaves, hatching, root, or the paper itself?

Names win: what a layer, a class or an id says is not questioned. The rest is decided by shape and place, in this
order, each rule on what the ones before it left: the paper, ground lines, shadows, crowns, what is drawn inside a crown, leaves.
All others are wood: their lines are what is joined to a tree. A rule needs several cues; a stroke that shows only one
stays a branch.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float

from sketchtree.sketch.graph import Cut, Role
from sketchtree.sketch.joining.lines import Line
from sketchtree.sketch.roles.crown import has_area, outline
from sketchtree.sketch.roles.crowns import find_crowns
from sketchtree.sketch.roles.found import role_warnings
from sketchtree.sketch.roles.ground import grass, ground_lines
from sketchtree.sketch.roles.hatching import hatching
from sketchtree.sketch.roles.implied import carried_on, implied_stems, merged
from sketchtree.sketch.roles.ink import find_ink, read_ink
from sketchtree.sketch.roles.leaves import leaf_shapes, marks_inside
from sketchtree.sketch.roles.page import cuts_of, frames
from sketchtree.sketch.roles.remarks import root_warnings, side_warnings
from sketchtree.sketch.roles.rim import pieces_of_rims
from sketchtree.sketch.roles.roots import Rooted, roots_apart
from sketchtree.sketch.roles.shadow import shadows
from sketchtree.sketch.roles.table import Part, Table, named_table
from sketchtree.sketch.roles.trunk_edges import trunks_of_edges
from sketchtree.sketch.roles.wood import wood_lines
from sketchtree.sketch.strokes import Sketch


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


def sort_strokes(sketch: Sketch) -> Sorted:
    """What every stroke of the sketch is. Neither order nor direction of the strokes matters."""
    if not sketch.strokes:
        return Sorted([], [], (), False, (), (), (), (), (), ())
    table = named_table(sketch)
    table.take(frames(table.m, table.free))
    find_ink(table)
    table.take(ground_lines(table.m, table.free, table.wood))
    ground = [table.m.strokes[row].points for row in table.rows("ground")]
    table.take(grass(table.m, table.free, ground, table.wood))
    table.take(shadows(table.m, table.free, table.wood))
    read_ink(table)
    find_crowns(table, ground)
    _find_leaves(table)
    wood = wood_lines(table.m, np.flatnonzero(table.wood).tolist(), table.legs, table.pieces, table.outlines)
    table.add_rims(wood)
    stout = [Line(row, sketch.strokes[row].id, middle, np.full(2, width)) for row, middle, width in table.stubs]
    rooted = roots_apart([*wood.lines, *stout], ground, table.named_roots, table.outlines) if ground or table.named_roots else Rooted([*wood.lines, *stout], [])
    trunks = trunks_of_edges(rooted.above, table.outlines)
    lines, sides = trunks.lines, [*wood.sides, *trunks.sides]
    table.add_bark([*wood.bark, *trunks.bark], [*lines, *rooted.below])
    stem_warnings = []
    if not lines and table.outlines:
        lines, stem_warnings = implied_stems(table.outlines, ground, *_owner(table))
    elif table.outlines:
        lines, stem_warnings = carried_on(lines, merged(table.outlines), *_owner(table))
    rooted = Rooted(lines, rooted.below, rooted.found) if rooted.below else roots_apart(lines, ground, table.named_roots, table.outlines)
    cuts, cut_warnings = cuts_of([*rooted.above, *rooted.below], sketch.page)
    sides_told = [*side_warnings(wood.sides, "limb"), *side_warnings(trunks.sides, "trunk")]
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
        warnings=(*role_warnings(roles), *sides_told, *stem_warnings, *root_warnings(rooted), *cut_warnings),
    )


def _parts(sketch: Sketch, holes: list[tuple[int, int]], sides: list[tuple[Line, Line]]) -> tuple[Part, ...]:
    """The strokes that drew a limb together with another."""
    of_sides = [Part(other.id, middle.id, "the other side of a limb drawn as an outline") for middle, other in sides]
    return (*of_sides, *(Part(sketch.strokes[hole].id, sketch.strokes[outer].id, "a hole in that painted shape") for hole, outer in holes))


def _owner(table: Table) -> tuple[int, str]:
    """(row, id) of the stroke that an implied stem is put down to: the first that drew a crown, in the order of their ids."""
    rows = table.rows("crown")
    row = min(rows, key=lambda k: table.m.strokes[k].id)
    return row, table.m.strokes[row].id


def _find_leaves(table: Table) -> None:
    """Leaves, and marks inside the crowns."""
    rows = np.flatnonzero(table.wood)
    if len(rows) < 2 and not table.outlines:
        return
    if len(rows) == 0:
        return
    height = float(max(table.m.high[rows, 1].max() - table.m.low[rows, 1].min(), 0.0))
    if table.outlines:
        table.take(marks_inside(table.m, table.free, table.crown_area(0.02 * height), table.wood, height))
        table.take(pieces_of_rims(table.m, table.free, table.wood, table.outlines))
    table.take(hatching(table.m, table.free, table.wood, height))
    leaves = leaf_shapes(table.m, table.free, height)
    if len(leaves) < table.wood.sum() or table.stubs:
        table.take(leaves)
