"""What the page is told of how a drawing was read, and which template it is most like."""

from sketchtree.drawn_tree import DrawnTree
from sketchtree.studio import messages


def how_read(revision: int, drawn: DrawnTree) -> messages.Read:
    """Joints, and what strokes were taken for that are no branch."""
    roles = {role.stroke: role.role for role in drawn.graph.roles}
    marks = [
        messages.Mark(stroke=one.stroke, parent=one.parent, x=float(one.point[0]), y=float(-one.point[1]), doubtful=bool(one.doubtful), reason=one.reason)
        for one in drawn.graph.attachments
        if one.stroke not in roles
    ]
    return messages.Read(revision=revision, marks=marks, roles=roles, warnings=list(drawn.graph.warnings))


def how_like(revision: int, drawn: DrawnTree) -> messages.Matches:
    """The templates, best first; one line a template."""
    ranked: dict[str, messages.Match] = {}
    for one in drawn.matches:
        ranked.setdefault(one.name, messages.Match(name=one.name, score=float(one.score), view_deg=float(one.view_deg)))
    return messages.Matches(revision=revision, used=drawn.exemplar.name if drawn.exemplar else None, ranked=list(ranked.values()))
