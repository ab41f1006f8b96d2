"""What a rule found: rows of strokes, what they are, and why. The warnings that tell the user."""

from collections.abc import Iterable
from dataclasses import dataclass

from sketchtree.sketch.graph import Role

NAMED = 5  # strokes named in a warning
_TAKEN_FOR = {
    "crown": None,  # said by the picture
    "obstacle": None,
    "ground": "the ground",
    "shadow": "a shadow",
    "leaves": "leaves",
    "hatching": "hatching or bark",
    "speckle": "specks",
    "paper": "the paper",
    "dot": None,  # said by the cleaning
}


@dataclass(frozen=True)
class Found:
    """One stroke that is no branch, or only in part."""

    row: int  # of the stroke
    role: str  # as in `Role`
    reason: str
    alternatives: tuple[tuple[str, float], ...] = ()  # what else it may be, and how much dearer that would be, 0 alike to 1

    def named(self, stroke_id: str) -> Role:
        """The line of the report."""
        return Role(stroke_id, self.role, self.reason, self.alternatives)


def role_warnings(roles: Iterable[Role]) -> list[str]:
    """One warning a role: which strokes are left out of the tree for it."""
    ids: dict[str, list[str]] = {}
    for role in roles:
        if _TAKEN_FOR.get(role.role) and role.stroke not in ids.setdefault(role.role, []):
            ids[role.role].append(role.stroke)
    return [_sentence(strokes, _TAKEN_FOR[role]) for role, strokes in ids.items() if strokes]


def _sentence(ids: list[str], what: str) -> str:
    if len(ids) == 1:
        return f"Stroke {ids[0]} was taken for {what} and left out of the tree."
    if len(ids) <= NAMED:
        return f"Strokes {', '.join(ids)} were taken for {what} and left out of the tree."
    return f"{len(ids)} strokes ({', '.join(ids[:NAMED])}, …) were taken for {what} and left out of the tree."
