"""Traced limbs as a drawing: the same sketch and the same segment tree that strokes on paper would give, so that all that follows is the same.

A limb is a chain of joints: where one forks, the child on the same stroke carries it on, else the one that bends least. Its id is its stroke's; a limb found in the photo takes the name of
the limb it grows from and its number on that. Nodes stand at forks, tips and where it turns by 30° (`simplify`); the joints between are its segments' curves. Pixels, y UP.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int

from sketchtree.axes import NULL
from sketchtree.limb_ids import stroke_limb_id
from sketchtree.photo.marked import Marked
from sketchtree.photo.photo import turned_over
from sketchtree.photo.trace.simplify import telling
from sketchtree.photo.trace.trace import carried_on
from sketchtree.photo.trace.traced import Traced
from sketchtree.sketch.graph import Attachment, SketchGraph
from sketchtree.sketch.strokes import Sketch, Stroke, StrokeKind


@dataclass(frozen=True, eq=False)
class _Limb:
    """One chain of joints, from its first joint on."""

    name: str
    rows: Int[np.ndarray, " joint"]  # of the traced table, its foot left out
    foot: int  # joint it grows from; NULL for a trunk, whose base is its first row
    drawn: bool  # its first joint lies on a stroke


def as_drawing(trees: Sequence[tuple[Traced, Marked]], name: str, outlines: Sequence[tuple[Float[np.ndarray, "point 2"], ...]] | None = None) -> tuple[Sketch, SketchGraph]:
    """(the limbs of all trees as strokes, their segment tree). `outlines`: the crowns' outlines of each tree in pixels, y down; None: the strokes round them."""
    outlines = [(marked.crown,) for _, marked in trees] if outlines is None else outlines
    limbs = [_limbs(traced, marked, f"tree{k + 1}-" if len(trees) > 1 else "") for k, (traced, marked) in enumerate(trees)]
    strokes = [_stroke(limb, traced) for (traced, _), own in zip(trees, limbs, strict=True) for limb in own]
    crowns = tuple(turned_over(line) for own in outlines for line in own)
    ids = tuple(stroke.id for stroke in strokes) + tuple(f"crown{k + 1}" for k in range(len(crowns)))
    drawn = [*strokes, *(Stroke(id=ids[len(strokes) + k], points=line, kind=StrokeKind.CROWN, labelled=True, closed=True) for k, line in enumerate(crowns))]
    warnings = tuple(warning for traced, _ in trees for warning in traced.warnings)
    sketch = Sketch(tuple(drawn), name=name, units="px", warnings=warnings)
    return sketch, _graph([traced for traced, _ in trees], limbs, ids, crowns, warnings)


def _limbs(traced: Traced, marked: Marked, prefix: str) -> list[_Limb]:
    """The limbs of one tree, each after the one it grows from."""
    drawn = np.ones(len(traced), bool) if traced.drawn is None else traced.drawn
    carries = carried_on(traced.parent, traced.xy, traced.radius, traced.stroke, drawn)
    limb_of = np.full(len(traced), NULL)
    limbs, numbers, used = [], {}, set()
    for row in range(len(traced)):
        up = traced.parent[row]
        if up != NULL and carries[up] == row:
            continue
        rows = [row]
        while carries[rows[-1]] != NULL:
            rows.append(int(carries[rows[-1]]))
        parent = limb_of[up] if up != NULL else NULL
        name = marked.names[traced.stroke[row]] if drawn[row] and marked.names else f"stroke{traced.stroke[row] + 1}"
        if not drawn[row] or name in used:
            numbers[parent] = numbers.get(parent, 0) + 1
            name = f"{limbs[parent].name.removeprefix(prefix)}.{numbers[parent]}"
        used.add(name)
        limb_of[rows] = len(limbs)
        limbs.append(_Limb(prefix + name, np.array(rows), int(up), bool(drawn[row])))
    return limbs


def _stroke(limb: _Limb, traced: Traced) -> Stroke:
    """A limb as the line that a pen as wide as the limb would have drawn."""
    rows = limb.rows if limb.foot == NULL else np.r_[limb.foot, limb.rows]
    width = float(2 * np.median(traced.radius[limb.rows]))
    return Stroke(id=limb.name, points=turned_over(traced.xy[rows]), labelled=True, width=width, wood=True)


def _graph(trees: Sequence[Traced], limbs: Sequence[Sequence[_Limb]], ids, crowns, warnings) -> SketchGraph:
    """The segment tree of all trees, one after the other."""
    columns: dict[str, list] = {name: [] for name in ("parent", "xy", "limb", "stroke", "tree", "width", "curve", "count")}
    attachments, limb, rows = [], 0, 0
    for number, (traced, own) in enumerate(zip(trees, limbs, strict=True)):
        place = _add(columns, traced, own, number, limb, rows)
        attachments += _attachments(traced, own)
        limb, rows = limb + len(own), rows + place
    curve = [turned_over(points) for points in columns["curve"] if len(points)]
    return SketchGraph(
        parent=np.array(columns["parent"], np.int64),
        xy=turned_over(np.array(columns["xy"])),
        limb=np.array(columns["limb"]),
        stroke=np.array(columns["stroke"]),
        tree=np.array(columns["tree"]),
        width=np.array(columns["width"]),
        joined=np.zeros(len(columns["parent"]), bool),
        curve_points=np.concatenate(curve) if curve else np.zeros((0, 2)),
        curve_start=np.concatenate([[0], np.cumsum(columns["count"])]),
        limb_id=np.array([stroke_limb_id(one.name) for own in limbs for one in own]),
        stroke_ids=ids,
        width_is_wood=True,
        crown=crowns,
        attachments=tuple(attachments),
        warnings=warnings,
    )


def _add(columns: dict[str, list], traced: Traced, limbs: Sequence[_Limb], tree: int, first_limb: int, first_row: int) -> int:
    """Append the rows of one tree; returns how many. Nodes where the table branches or turns, the joints between as curves."""
    keep = telling(traced.parent, traced.xy)
    row_of, count = np.full(len(traced), NULL), 0
    for number, limb in enumerate(limbs):
        before, inner = limb.foot, []
        for row in limb.rows:
            if not keep[row]:
                inner.append(traced.xy[row])
                continue
            row_of[row] = first_row + count
            count += 1
            columns["parent"].append(NULL if before == NULL else row_of[before])
            columns["curve"].append(np.array(inner).reshape(-1, 2))
            columns["count"].append(len(inner))
            for name, value in (("xy", traced.xy[row]), ("limb", first_limb + number), ("stroke", first_limb + number), ("tree", tree), ("width", 2 * traced.radius[row])):
                columns[name].append(value)
            before, inner = row, []
    return count


def _attachments(traced: Traced, limbs: Sequence[_Limb]) -> list[Attachment]:
    """How every limb came to hang where it hangs, for the report."""
    owner = {int(row): limb.name for limb in limbs for row in limb.rows}
    found = []
    for limb in limbs:
        at = limb.rows[0] if limb.foot == NULL else limb.foot
        x, y = turned_over(traced.xy[at][None])[0].tolist()
        reason = "a stroke" if limb.drawn else "found in the photo by following the wood from a stroke"
        found.append(Attachment(limb.name, owner.get(limb.foot), (x, y), 0.0, 0.0, (), reason))
    return found
