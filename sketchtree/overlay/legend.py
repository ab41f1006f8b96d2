"""What do the colours of an overlay mean, and what was doubtful? The column beside the drawing."""

import textwrap
from collections import Counter

import numpy as np

from sketchtree.overlay.colours import DOUBT, DRAWN, ORDER, ORDER_NAME, OTHER_ROLE, ROLE, ROOT
from sketchtree.overlay.doubts import doubts
from sketchtree.overlay.scene import Disc, Path, Words
from sketchtree.sketch.graph import SketchGraph

LINE = 22.0  # pixels from one line to the next
LETTERS = 54  # in a line of text
NOTES = 0.6  # of what is left of the column, at most, for notes


def legend(name: str, graph: SketchGraph, left: float, top: float, bottom: float) -> tuple[list[Path | Disc | Words], int]:
    """(the marks of the column whose upper left corner is (left, top), how many doubts it lists); it ends above
    `bottom`, saying what it leaves out."""
    column = _Column(left, top + 22, bottom)
    column.text(name if len(name) <= 40 else name[:39] + "…", size=19.0, bold=True)
    column.text(counts(graph))
    column.space()
    for colour, text, dash in _keys(graph):
        column.line_key(colour, text, dash)
    column.disc_key(Disc(0, 0, 3.2, "#ffffff", "#333333", 1.3), "junction")
    column.disc_key(Disc(0, 0, 7.0, "#111111"), "where a stem meets the ground")
    column.line_key(DOUBT, "a foot that was moved to its junction", None)
    if doubts(graph):
        column.disc_key(Disc(0, 0, 8.5, None, DOUBT, 2.2), "a doubt; a broken line leads to the next best")
    column.list("Notes", list(graph.warnings), "warnings", bottom=column.y + NOTES * (bottom - column.y))
    lines = [f"{k}  {doubt.words}" for k, doubt in enumerate(doubts(graph), 1)]
    listed = column.list("Doubts: what it grows from, or may grow from", lines, "attachments", colour=DOUBT)
    return column.marks, listed


def counts(graph: SketchGraph) -> str:
    """What the reading holds, in one line."""
    trees, stems = int(graph.tree.max()) + 1, int(np.sum(graph.is_base))
    parts = [_plural(len(graph.stroke_ids), "stroke"), _plural(trees, "tree")]
    parts += [_plural(stems, "stem")] if stems > trees else []
    return ", ".join([*parts, _plural(len(graph.limb_id), "limb"), _plural(graph.segment_count, "segment"), _plural(len(doubts(graph)), "doubt")])


def _plural(count: int, thing: str) -> str:
    return f"{count} {thing}{'' if count == 1 else 's'}"


def _keys(graph: SketchGraph) -> list[tuple[str, str, float | None]]:
    above = graph.limb_order[~graph.root[graph.limb_first]]
    number = Counter(np.minimum(above, len(ORDER) - 1).tolist())
    keys: list = [(ORDER[k], f"{ORDER_NAME[k]}: {_plural(number[k], 'limb')}", None) for k in sorted(number)]
    below = int(np.sum(graph.root[graph.limb_first]))
    keys += [(ROOT, _plural(below, "root"), 6.0)] if below else []
    keys += [(ROLE["crown"], "crown", None)] if graph.crown else []
    keys += [(ROLE["obstacle"], "obstacle", None)] if graph.obstacles else []
    keys += [(ROLE["ground"], "ground line", None)] if graph.ground else []
    roles = Counter(role.role for role in graph.roles if role.role not in ("crown", "obstacle", "ground"))
    keys += [(ROLE.get(role, OTHER_ROLE), f"{role}: {_plural(count, 'stroke')}, left out", None) for role, count in sorted(roles.items())]
    return [*keys, (DRAWN, "a stroke as it was drawn", None)]


class _Column:
    """Lines of text from the top down; what does not fit is counted."""

    def __init__(self, left: float, top: float, bottom: float):
        self.left, self.y, self.bottom = left, top, bottom
        self.marks: list[Path | Disc | Words] = []

    def text(self, text: str, *, size: float = 15.0, bold: bool = False, colour: str = "#222222", indent: float = 0.0) -> None:
        for k, line in enumerate(textwrap.wrap(text, LETTERS - round(indent / 8)) or [""]):
            self.marks.append(Words(self.left + indent + (14.0 if k else 0.0), self.y, line, size, colour, bold=bold))
            self.y += LINE * max(1.0, size / 15.0)

    def space(self) -> None:
        self.y += LINE / 2

    def line_key(self, colour: str, text: str, dash: float | None) -> None:
        self.marks.append(Path(np.array([[self.left, self.y - 5], [self.left + 30, self.y - 5]]), colour, 4.0, dash=dash))
        self.text(text, indent=42.0)

    def disc_key(self, disc: Disc, text: str) -> None:
        self.marks.append(Disc(self.left + 15, self.y - 5, disc.radius, disc.fill, disc.colour, disc.width))
        self.text(text, indent=42.0)

    def list(self, title: str, lines: list[str], column: str, *, colour: str = "#222222", bottom: float = np.inf) -> int:
        """Lists the lines under a title, as many as fit above `bottom`, and says how many do not, and in which `column`
        of the report they are; returns how many do."""
        if not lines:
            return 0
        bottom = min(bottom, self.bottom)
        self.space()
        self.text(title, bold=True, colour=colour)
        for k, line in enumerate(lines):
            rows = len(textwrap.wrap(line, LETTERS))
            if self.y + LINE * (rows + (k + 1 < len(lines)) - 1) > bottom:
                self.text(f"and {len(lines) - k} more: see the report's {column}")
                return k
            self.text(line)
        return len(lines)
