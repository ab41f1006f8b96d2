"""What tree do the strokes make? From a sketch to its rooted segment graph, one step after the other.

    strokes → copies apart → what each is → clean lines → what each grows from → limbs → nodes and segments
"""

import dataclasses
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from jaxtyping import Int

from sketchtree.axes import NULL
from sketchtree.errors import OptionError, SketchError
from sketchtree.limb_ids import stroke_limb_id
from sketchtree.sketch.copies import with_copies, without_copies
from sketchtree.sketch.graph import Attachment, Role, SketchGraph
from sketchtree.sketch.joining.attach import Hanging, attach
from sketchtree.sketch.joining.attachments import describe
from sketchtree.sketch.joining.cleaning import Cleaned, clean
from sketchtree.sketch.joining.joints import Limb, limbs_of
from sketchtree.sketch.joining.lines import Line, extent
from sketchtree.sketch.joining.segments import Rows, columns
from sketchtree.sketch.joining.underground import with_roots
from sketchtree.sketch.roles.sorting import Part, Sorted, sort_strokes
from sketchtree.sketch.roles.table import NOTHING
from sketchtree.sketch.strokes import Sketch

Progress = Callable[[float], None]  # told how much is done, 0 to 1


def sketch_graph(sketch: Sketch, *, crown: str = "auto", progress: Progress | None = None) -> SketchGraph:
    """The rooted segment tree(s) that a sketch shows, in the sketch's units, y up.

    `crown` "auto": outlines known by label or by shape bound the tree; "off": they are left out.
    The graph depends neither on the order of the strokes nor on the direction in which each was drawn.
    Raises SketchError when there is nothing to make a tree of.
    """
    if crown not in ("auto", "off"):
        raise OptionError(f"crown={crown!r}; 'auto' or 'off' was expected.", remedy="Leave it out for 'auto'.")
    drawn, copies = without_copies(sketch)
    graph = _graph(drawn, crown, progress)
    return with_copies(graph, sketch, copies) if copies else graph


def _graph(sketch: Sketch, crown: str, progress: Progress | None) -> SketchGraph:
    """The graph of a sketch without copies."""
    parts = sort_strokes(sketch)
    _check(sketch, parts)
    tree = _grown(parts.lines, _from(progress, 0.1, 0.9))
    table, lines, limbs = tree.table, tree.cleaned.lines, tree.limbs
    ids = tuple(stroke.id for stroke in sketch.strokes)
    attachments, doubts = _described(tree, ids)
    if parts.roots:
        roots = _grown([_turned(line) for line in parts.roots], None)
        table = with_roots(table, roots.table, len(limbs))
        attachments += _described_roots(roots, table, ids)
        lines, limbs = [*lines, *roots.cleaned.lines], [*limbs, *_renumbered(roots.limbs, len(lines))]
    attachments += tuple(_as_part(sketch, part, attachments) for part in parts.parts)
    roles = _with_dots(sketch, parts.roles, attachments)
    joined = {a.stroke for a in attachments}
    if progress:
        progress(1.0)
    return SketchGraph(
        **table,
        width_is_wood=parts.measured and bool(np.isfinite(table["width"]).any()),
        limb_id=_limb_ids(limbs, lines),
        stroke_ids=ids,
        crown=parts.crowns if crown == "auto" else (),
        obstacles=parts.obstacles,
        attachments=_in_order(ids, (*attachments, *(_apart(sketch, role) for role in roles if role.stroke not in joined))),
        roles=roles,
        ground=parts.ground,
        cuts=parts.cuts,
        warnings=(*sketch.warnings, *parts.warnings, *_left_out(parts.roles), *doubts),
    )


@dataclass(frozen=True, eq=False)
class _Grown:
    """Lines joined to a tree, and all that is known of how."""

    cleaned: Cleaned
    hanging: Hanging
    limbs: list[Limb]
    table: dict[str, np.ndarray]
    rows: Rows
    height: float


def _grown(lines: list[Line], progress: Progress | None) -> _Grown:
    """Clean lines, what each grows from, limbs, nodes and segments."""
    cleaned = clean(lines)
    height = extent(cleaned.lines)
    hanging = attach(cleaned.lines, progress)
    limbs = limbs_of(cleaned.lines, hanging)
    table, rows = columns(limbs, height)
    return _Grown(cleaned, hanging, limbs, table, rows, height)


def _described(tree: _Grown, ids: tuple[str, ...]) -> tuple[tuple[Attachment, ...], list[str]]:
    return describe(tree.cleaned, tree.hanging, tree.limbs, tree.rows, tree.table["xy"], ids, tree.height)


def _described_roots(roots: _Grown, table: dict[str, np.ndarray], ids: tuple[str, ...]) -> tuple[Attachment, ...]:
    """The lines of the report for roots, which were read upside down: those from a stem's foot hang on that stem."""
    bases = np.flatnonzero(table["parent"] == NULL)
    found = []
    for a in _described(roots, ids)[0]:
        point = np.array([a.point[0], -a.point[1]])
        if a.parent is not None:
            found.append(dataclasses.replace(a, point=tuple(point.tolist()), reason=f"a root; {a.reason}"))
            continue
        gaps = np.hypot(*(table["xy"][bases] - point).T)
        base = bases[np.argmin(gaps)]
        stem = ids[table["stroke"][base]]
        place = tuple(table["xy"][base].tolist())
        found.append(dataclasses.replace(a, parent=stem, point=place, gap=float(gaps.min()), reason="a root: it starts at the foot of that stem"))
    return tuple(found)


def _turned(line: Line) -> Line:
    """A line upside down."""
    return dataclasses.replace(line, points=line.points * (1.0, -1.0))


def _renumbered(limbs: list[Limb], offset: int) -> list[Limb]:
    """Limbs whose lines stand that much later in the list of lines."""
    return [dataclasses.replace(limb, lines=[k + offset for k in limb.lines]) for limb in limbs]


def _from(progress: Progress | None, low: float, high: float) -> Progress | None:
    """Progress of a step that takes from `low` to `high` of the whole."""
    return None if progress is None else lambda done: progress(low + (high - low) * done)


def _check(sketch: Sketch, parts: Sorted) -> None:
    """Raise where there is no line to grow a tree from."""
    if parts.lines:
        return
    kinds = sorted({role.role for role in parts.roles})
    what = f": only {' and '.join(kinds)}" if kinds else ": only dots or round shapes" if sketch.strokes else ""
    raise SketchError(f"{sketch.name} has no branch strokes{what}.", remedy="Draw at least a trunk, as a line.")


def _left_out(roles: tuple[Role, ...]) -> tuple[str, ...]:
    """A line for each crown or obstacle that encloses nothing."""
    empty = [role for role in roles if role.reason.endswith(NOTHING)]
    return tuple(f"Stroke {role.stroke} is {role.reason}. Draw it as a closed curve." for role in empty)


def _with_dots(sketch: Sketch, roles: tuple[Role, ...], attachments: tuple[Attachment, ...]) -> tuple[Role, ...]:
    """The roles, and "dot" for every stroke that neither they nor the tree know of."""
    known = {role.stroke for role in roles} | {a.stroke for a in attachments}
    dots = [Role(s.id, "dot", "too small to be a branch, or without any length") for s in sketch.strokes if s.id not in known]
    return (*roles, *dots)


def _as_part(sketch: Sketch, part: Part, attachments: tuple[Attachment, ...]) -> Attachment:
    """The line of the report for a stroke that drew a limb together with another: it hangs where that limb does."""
    owner = next((a.point for a in attachments if a.stroke == part.owner), None)
    x, y = owner or next(s for s in sketch.strokes if s.id == part.stroke).points[0].tolist()
    return Attachment(part.stroke, part.owner, (x, y), 0.0, 0.0, (), part.reason)


def _apart(sketch: Sketch, role: Role) -> Attachment:
    """The line of the report for a stroke that hangs on nothing."""
    stroke = next(s for s in sketch.strokes if s.id == role.stroke)
    x, y = stroke.points[0].tolist()
    return Attachment(role.stroke, None, (x, y), 0.0, 0.0, role.alternatives, f"taken for {_ARTICLE.get(role.role, role.role)}: {role.reason}")


_ARTICLE = {
    "crown": "a crown",
    "obstacle": "an obstacle",
    "ground": "the ground",
    "shadow": "a shadow",
    "speckle": "a speck",
    "paper": "the paper",
    "dot": "a dot",
}


def _in_order(ids: tuple[str, ...], attachments: tuple[Attachment, ...]) -> tuple[Attachment, ...]:
    rank = {stroke_id: k for k, stroke_id in enumerate(ids)}
    return tuple(sorted(attachments, key=lambda a: rank[a.stroke]))


def _limb_ids(limbs: list[Limb], lines: list[Line]) -> Int[np.ndarray, " limb"]:
    """Ids from the first stroke of every limb; a stroke that gave several limbs numbers them."""
    seen: dict[str, int] = {}
    ids = []
    for limb in limbs:
        name = lines[limb.lines[0]].id
        seen[name] = seen.get(name, 0) + 1
        ids.append(stroke_limb_id(name if seen[name] == 1 else f"{name}#{seen[name]}"))
    return np.array(ids, np.int64)
