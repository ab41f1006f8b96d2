"""What tree do the strokes make? From a sketch to its rooted segment graph, one step after the other.

    strokes → crown and obstacles apart → clean lines → what each grows from → limbs → nodes and segments
"""

import numpy as np
from jaxtyping import Float, Int

from sketchtree.errors import OptionError, SketchError
from sketchtree.keys import stroke_limb_id
from sketchtree.sketch.joining.attach import attach
from sketchtree.sketch.joining.attachments import describe
from sketchtree.sketch.joining.cleaning import as_line, clean
from sketchtree.sketch.roles.contour import contour, only_outline
from sketchtree.sketch.roles.crown import crown_strokes, has_area, outline
from sketchtree.sketch.graph import SketchGraph
from sketchtree.sketch.joining.joints import Limb, limbs_of
from sketchtree.sketch.joining.lines import Line, extent
from sketchtree.sketch.joining.segments import columns
from sketchtree.sketch.roles.silhouette import is_blob, middle_lines, with_holes
from sketchtree.sketch.strokes import Sketch, StrokeKind
from sketchtree.sketch.joining.widths import drawn_widths


def sketch_graph(sketch: Sketch, *, crown: str = "auto") -> SketchGraph:
    """The rooted segment tree(s) that a sketch shows, in the sketch's units, y up.

    `crown` "auto": outlines known by label or by shape bound the tree; "off": they are left out.
    The graph depends neither on the order of the strokes nor on the direction in which each was drawn.
    Raises SketchError when there is nothing to make a tree of.
    """
    if crown not in ("auto", "off"):
        raise OptionError(f"crown={crown!r}; 'auto' or 'off' was expected.", remedy="Leave it out for 'auto'.")
    parts = _sorted_strokes(sketch)
    branch = [sketch.strokes[k] for k in parts[StrokeKind.BRANCH]]
    around = None if parts[StrokeKind.CROWN] else contour(branch)
    if around is None and not parts[StrokeKind.CROWN] and only_outline(branch):
        raise SketchError(f"{sketch.name} has no branch strokes: only a crown.", remedy="Draw at least a trunk, as a line.")
    legs = {} if around is None else {parts[StrokeKind.BRANCH][k]: left for k, left in around.legs.items()}
    lines = _lines(sketch, parts[StrokeKind.BRANCH], legs)
    cleaned = clean(lines, under_crown=bool(parts[StrokeKind.CROWN]) or around is not None)
    height = extent(cleaned.lines)
    hanging = attach(cleaned.lines)
    limbs = limbs_of(cleaned.lines, hanging)
    table, rows = columns(limbs, height)
    ids = tuple(stroke.id for stroke in sketch.strokes)
    attachments, doubts = describe(cleaned, hanging, limbs, rows, table["xy"], ids, height)
    outlines = {kind: tuple(outline(sketch.strokes[k].points) for k in parts[kind]) for kind in StrokeKind}
    crowns = outlines[StrokeKind.CROWN] if around is None else (outline(around.outline),)
    return SketchGraph(
        **table,
        width_is_wood=_measured(sketch, lines, table["width"]),
        limb_id=_limb_ids(limbs, cleaned.lines),
        stroke_ids=ids,
        crown=crowns if crown == "auto" else (),
        obstacles=outlines[StrokeKind.OBSTACLE],
        attachments=attachments,
        warnings=(*sketch.warnings, *doubts),
    )


def _sorted_strokes(sketch: Sketch) -> dict[StrokeKind, list[int]]:
    """Rows of the strokes of each kind, crowns found by shape included."""
    parts = {kind: [k for k, s in enumerate(sketch.strokes) if s.kind == kind] for kind in StrokeKind}
    for kind in (StrokeKind.CROWN, StrokeKind.OBSTACLE):
        parts[kind] = [k for k in parts[kind] if has_area(sketch.strokes[k])]
    branch = parts[StrokeKind.BRANCH]
    if not parts[StrokeKind.CROWN]:
        parts[StrokeKind.CROWN] = [branch[k] for k in crown_strokes([sketch.strokes[k] for k in branch])]
        parts[StrokeKind.BRANCH] = [k for k in branch if k not in parts[StrokeKind.CROWN]]
    return parts


def _lines(sketch: Sketch, rows: list[int], legs: dict[int, tuple[np.ndarray, ...]]) -> list[Line]:
    """The lines that the branch strokes draw, those down the middle of painted shapes included; of a
    stroke that drew a crown only its `legs`."""
    drawn = [row for row in rows if not sketch.strokes[row].filled and row not in legs]
    strokes = [sketch.strokes[row] for row in drawn]
    widths = drawn_widths(strokes)
    lines = [as_line(row, stroke.id, stroke.points, width) for row, stroke, width in zip(drawn, strokes, widths, strict=True)]
    lines += [as_line(row, sketch.strokes[row].id, points, np.nan) for row, parts in legs.items() for points in parts]
    lines = [line for line in lines if line is not None]
    painted = [row for row in rows if sketch.strokes[row].filled]
    for outer, holes in with_holes([sketch.strokes[row] for row in painted]):
        shape = sketch.strokes[painted[outer]]
        if not is_blob(shape):
            lines += middle_lines(painted[outer], shape, [sketch.strokes[painted[hole]] for hole in holes])
    if not lines:
        raise SketchError(
            f"{sketch.name} has no branch strokes" + (": only dots or round shapes." if rows else "."),
            remedy="Draw at least a trunk, as a line.",
        )
    return lines


def _measured(sketch: Sketch, lines: list[Line], width: Float[np.ndarray, " segment"]) -> bool:
    """Whether the widths were measured between the edges of what was drawn, and no pen set them."""
    penned = any(np.isfinite(line.width).any() for line in lines if not sketch.strokes[line.row].filled)
    return bool(np.isfinite(width).any()) and not penned


def _limb_ids(limbs: list[Limb], lines: list[Line]) -> Int[np.ndarray, " limb"]:
    """Ids from the first stroke of every limb; a stroke that gave several limbs numbers them."""
    seen: dict[str, int] = {}
    ids = []
    for limb in limbs:
        name = lines[limb.lines[0]].id
        seen[name] = seen.get(name, 0) + 1
        ids.append(stroke_limb_id(name if seen[name] == 1 else f"{name}#{seen[name]}"))
    return np.array(ids, np.int64)
