"""What is the user told of strokes that became a limb together, and of roots?"""

from sketchtree.sketch.joining.lines import Line
from sketchtree.sketch.roles.found import NAMED
from sketchtree.sketch.roles.roots import Rooted


def root_warnings(rooted: Rooted) -> list[str]:
    names = list(dict.fromkeys(line.id for line in rooted.below))
    if not rooted.found:
        return []
    named = f"{', '.join(names[:NAMED])}{', …' if len(names) > NAMED else ''}"
    return [f"What runs on below the ground was taken for roots (stroke{'s' if len(names) > 1 else ''} {named})."]


def side_warnings(sides: list[tuple[Line, Line]], what: str) -> list[str]:
    pairs = [f"{middle.id} and {other.id}" for middle, other in sides]
    if len(pairs) > 2:
        return [f"{len(pairs)} pairs of strokes ({', '.join(pairs[:3])}{', …' if len(pairs) > 3 else ''}) were taken for the two sides of one {what} each."]
    return [f"Strokes {pair} were taken for the two sides of one {what}." for pair in pairs]
