"""How did every stroke come to hang where it hangs? The lines of the report, and the doubts worth a warning."""

import numpy as np
from jaxtyping import Int

from sketchtree.axes import NULL
from sketchtree.sketch.graph import Attachment
from sketchtree.sketch.joining.attach import FORBIDDEN, Hanging
from sketchtree.sketch.joining.cleaning import AGAIN_OVER, Cleaned
from sketchtree.sketch.joining.joints import Limb
from sketchtree.sketch.joining.lines import Line
from sketchtree.sketch.joining.segments import Rows

DOUBTFUL = 0.05  # of H: a foot farther from its parent is worth a warning


def describe(
    cleaned: Cleaned, hanging: Hanging, limbs: list[Limb], rows: Rows, xy: np.ndarray, stroke_ids: tuple[str, ...], height: float
) -> tuple[tuple[Attachment, ...], list[str]]:
    """(attachments in the order of the strokes, warnings)."""
    attachments = []
    foot = _foot_rows(len(cleaned.lines), limbs, rows)
    above = _owners(cleaned.lines, limbs)
    feet = np.array([line.points[-1 if end else 0] for line, end in zip(cleaned.lines, hanging.end.tolist(), strict=True)])
    off = feet - xy[foot]
    figures = zip(xy[foot].tolist(), np.hypot(off[:, 0], off[:, 1]).tolist(), (hanging.cost % FORBIDDEN).tolist(), strict=True)
    for k, (line, (place, gap, cost)) in enumerate(zip(cleaned.lines, figures, strict=True)):
        others = tuple((cleaned.lines[other].id, round(price, 4)) for other, price in hanging.alternatives[k])
        parent, reason = above[k]
        attachments.append(Attachment(line.id, parent, tuple(place), gap, round(cost, 4), others, _reason(reason, gap, height)))
    for line, owner, why in cleaned.merged:
        x, y = line.points[0].tolist()
        attachments.append(Attachment(line.id, stroke_ids[owner], (x, y), 0.0, 0.0, (), why))
    rank = {stroke_id: k for k, stroke_id in enumerate(stroke_ids)}
    attachments.sort(key=lambda a: rank[a.stroke])
    return tuple(attachments), _doubts(attachments, cleaned, height)


def _foot_rows(count: int, limbs: list[Limb], rows: Rows) -> Int[np.ndarray, " line"]:
    foot = np.full(count, NULL)
    for k, limb in enumerate(limbs):
        for line, s in zip(limb.lines, [0.0, *limb.joins], strict=True):
            foot[line] = rows.nearest(k, s)
    return foot


def _owners(lines: list[Line], limbs: list[Limb]) -> list[tuple[str | None, str]]:
    """For every line the id of the stroke it grows from after all joining, and what it is there."""
    found: list = [None] * len(lines)
    for limb in limbs:
        first, *later = limb.lines
        found[first] = (None, "stands on the ground")
        if limb.parent != NULL:
            found[first] = (lines[limbs[limb.parent].line_at(limb.s)].id, "a lateral")
        for before, line in zip(limb.lines, later, strict=False):
            found[line] = (lines[before].id, "carries that stroke on from its tip")
    return found


def _reason(reason: str, gap: float, height: float) -> str:
    if reason == "stands on the ground" or gap <= 1e-6 * height:
        return reason
    far = gap > DOUBTFUL * height
    return f"{reason}, {'far off: the most likely of its neighbours' if far else 'nearest and at a likely angle'}"


def _doubts(attachments: list[Attachment], cleaned: Cleaned, height: float) -> list[str]:
    far = [a for a in attachments if a.parent is not None and a.gap > DOUBTFUL * height]
    warnings = [
        f"Stroke {a.stroke} starts {100 * a.gap / height:.0f} % of the drawing's height away from "
        f"stroke {a.parent}, the likeliest it could grow from."
        for a in far[:5]
    ]
    if len(far) > 5:
        warnings.append(f"{len(far) - 5} more strokes start far from any other.")
    if cleaned.dots:
        warnings.append(f"{len(cleaned.dots)} dot(s) smaller than 0.5 % of the drawing were left out (strokes {named(cleaned.dots)}).")
    again = list(dict.fromkeys(line.id for line, _, why in cleaned.merged if why == AGAIN_OVER))
    if again:
        warnings.append(f"{len(again)} stroke(s) drawn over others were merged with them (strokes {named(again)}).")
    return warnings


def named(ids) -> str:
    """The first few of these ids."""
    return ", ".join(ids[:5]) + (", …" if len(ids) > 5 else "")
