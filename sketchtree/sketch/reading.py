"""What tree do the strokes make? From a sketch to its rooted segment graph, one step after the other.

    strokes → what each is → clean lines → what each grows from → limbs → nodes and segments
"""

import numpy as np
from jaxtyping import Int

from sketchtree.errors import OptionError, SketchError
from sketchtree.limb_ids import stroke_limb_id
from sketchtree.sketch.graph import Attachment, Role, SketchGraph
from sketchtree.sketch.joining.attach import attach
from sketchtree.sketch.joining.attachments import describe
from sketchtree.sketch.joining.cleaning import clean
from sketchtree.sketch.joining.joints import Limb, limbs_of
from sketchtree.sketch.joining.lines import Line, extent
from sketchtree.sketch.joining.segments import columns
from sketchtree.sketch.roles.sorting import Part, Sorted, sort_strokes
from sketchtree.sketch.strokes import Sketch


def sketch_graph(sketch: Sketch, *, crown: str = "auto") -> SketchGraph:
    """The rooted segment tree(s) that a sketch shows, in the sketch's units, y up.

    `crown` "auto": outlines known by label or by shape bound the tree; "off": they are left out.
    The graph depends neither on the order of the strokes nor on the direction in which each was drawn.
    Raises SketchError when there is nothing to make a tree of.
    """
    if crown not in ("auto", "off"):
        raise OptionError(f"crown={crown!r}; 'auto' or 'off' was expected.", remedy="Leave it out for 'auto'.")
    parts = sort_strokes(sketch)
    _check(sketch, parts)
    cleaned = clean(parts.lines)
    height = extent(cleaned.lines)
    hanging = attach(cleaned.lines)
    limbs = limbs_of(cleaned.lines, hanging)
    table, rows = columns(limbs, height)
    ids = tuple(stroke.id for stroke in sketch.strokes)
    attachments, doubts = describe(cleaned, hanging, limbs, rows, table["xy"], ids, height)
    attachments = (*attachments, *(_as_part(sketch, part, attachments) for part in parts.parts))
    roles = _with_dots(sketch, parts.roles, attachments)
    joined = {a.stroke for a in attachments}
    return SketchGraph(
        **table,
        width_is_wood=parts.measured and bool(np.isfinite(table["width"]).any()),
        limb_id=_limb_ids(limbs, cleaned.lines),
        stroke_ids=ids,
        crown=parts.crowns if crown == "auto" else (),
        obstacles=parts.obstacles,
        attachments=_in_order(ids, (*attachments, *(_apart(sketch, role) for role in roles if role.stroke not in joined))),
        roles=roles,
        ground=parts.ground,
        cuts=parts.cuts,
        warnings=(*sketch.warnings, *parts.warnings, *doubts),
    )


def _check(sketch: Sketch, parts: Sorted) -> None:
    """Raise where there is no line to grow a tree from."""
    if parts.lines:
        return
    kinds = sorted({role.role for role in parts.roles})
    what = f": only {' and '.join(kinds)}" if kinds else ": only dots or round shapes" if sketch.strokes else ""
    raise SketchError(f"{sketch.name} has no branch strokes{what}.", remedy="Draw at least a trunk, as a line.")


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
