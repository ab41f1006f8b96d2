"""What is doubtful in a reading? Attachments whose next best parent costs little more, and what strokes were taken for.

Strokes that were taken for the same thing and may be the same other thing are one doubt.
"""

from dataclasses import dataclass

from sketchtree.sketch.graph import Attachment, SketchGraph

NAMED = 3  # strokes named in a line


@dataclass(frozen=True)
class Doubt:
    """One numbered doubt."""

    attachments: tuple[Attachment, ...]  # one; or those of all strokes with one role
    role: str | None  # what they were taken for; None: it is an attachment that is doubtful
    other: str  # the next best parent, or what else they may be
    extra: float  # how much more that costs

    @property
    def words(self) -> str:
        """The doubt as a sentence of the legend."""
        first = self.attachments[0]
        if self.role is None:
            return f"{first.stroke}: from {first.parent or 'the ground'}, or {self.other} ({self.extra:+.1f})"
        names = ", ".join(a.stroke for a in self.attachments[:NAMED]) + (", …" if len(self.attachments) > NAMED else "")
        return f"{names}: taken for {self.role}, may be {self.other}"


def doubts(graph: SketchGraph) -> list[Doubt]:
    """The doubts, attachments first, the most doubtful first."""
    roles = {role.stroke: role.role for role in graph.roles}
    hung, taken = [], {}
    for a in graph.attachments:
        if not a.doubtful:
            continue
        other, cost = min(a.alternatives, key=lambda pair: pair[1])
        if a.stroke in roles and other not in graph.stroke_ids:
            taken.setdefault((roles[a.stroke], other), []).append((cost - a.cost, a))
        else:
            hung.append(Doubt((a,), None, other, cost - a.cost))
    alike = [Doubt(tuple(a for _, a in found), role, other, min(extra for extra, _ in found)) for (role, other), found in taken.items()]
    return sorted(hung, key=lambda doubt: doubt.extra) + sorted(alike, key=lambda doubt: doubt.extra)
