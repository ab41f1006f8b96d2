"""What do the marks of a drawn factor graph mean? Their colours and shapes, and the column that explains them."""

import numpy as np
from jaxtyping import Float

from sketchtree.mrf.blocks import EQUATION, Block
from sketchtree.mrf.explain import Explanation
from sketchtree.mrf.factor_graph import FactorGraph
from sketchtree.overlay.scene import Disc, Path, Words

COLOUR = {
    "solid_angle": "#7f7f7f", "lateral": "#009e73", "apical": "#cc5fa0", "stem": "#8c564b", "limb_length": "#5b3fa0",
    "segment_length": "#17a2b8", "siblings": "#d7261e", "competition": "#b8960b", "extent": "#222222", "crown": "#7a9a10",
}  # fmt: skip
OWN = ("#1b4f72", "#a04000", "#4d5656")  # kinds of a user's own, of which only the pull is known
BEHIND, FRONT, INK, PALE = "#2b6cb0", "#e8820c", "#222222", "#555555"
WIDTH, LINE = 440.0, 24.0  # pixels: the column, from one line to the next


def legend(
    graph: FactorGraph, wanted: tuple[str, ...], every: dict[str, Block], *, depth, pull: Explanation | None, shares: bool, left: float, top: float
) -> list[Path | Disc | Words]:
    """The column whose upper left corner is (left, top): nodes, then kinds with count and equation, then the pull."""
    middle, text, right = left + 9.0, left + 30.0, left + WIDTH - 56.0
    y = top + 14.0
    marks: list[Path | Disc | Words] = [Words(left, y, "Factor graph", 20.0, INK, bold=True)]
    y += LINE + 8
    for shapes, words in _nodes(graph, depth, shares):
        marks += [*(shape(middle, y - 5) for shape in shapes), Words(text, y, words, 15.0, INK)]
        y += LINE
    marks.append(Words(right, y + 4, "factors", 13.0, PALE, "end"))
    y += LINE + 4
    for kind in wanted:
        count = str(len(every[kind]) if kind in every else 0) if kind in EQUATION else "one's own"
        marks += [square((middle, y - 5), 6.5, colour_of(kind, wanted)), Words(text, y, kind, 15.0, INK, bold=True)]
        marks.append(Words(right, y, count, 15.0, PALE, "end"))
        marks += [Words(text, y + 20, EQUATION[kind], 14.0, PALE)] if kind in EQUATION else []
        y += 2 * LINE + 2
    if pull:
        marks += [*arrow(np.array([left + 20, y - 14]), 16.0, INK), Words(text, y, "pulls the limb towards the viewer", 15.0, INK)]
        said = f"away from him; the longest: {hardest_pull(pull, wanted):.2g} nats/rad"
        marks += [*arrow(np.array([left + 4, y + LINE]), -16.0, INK), Words(text, y + LINE + 2, said, 15.0, INK)]
    return marks


def _nodes(graph: FactorGraph, depth, shares: bool) -> list[tuple[list, str]]:
    """(what to draw around a middle, what it means) of every kind of node that is there."""
    depths = _plural(int((~graph.is_base).sum()), "depth") + ", one a segment"
    if depth is None:
        keys: list = [([lambda x, y: Disc(x, y, 7.0, "#ffffff", INK, 1.4)], depths)]
    else:
        pair = [lambda x, y: Disc(x - 6, y, 7.0, BEHIND, INK, 1.4), lambda x, y: Disc(x + 6, y, 7.0, FRONT, INK, 1.4)]
        keys = [(pair, f"{depths}: behind, in front of the page")]
    if graph.is_joined.any():
        keys.append(([lambda x, y: square((x, y), 6.3, "#ffffff", turned=True)], _plural(int(graph.is_joined.sum()), "label") + ", apical or lateral"))
    if shares:
        rings = [lambda x, y: Disc(x, y, 8.0, "#ffffff", INK, 1.8), lambda x, y: Disc(x, y, 5.0, "#ffffff", INK, 1.0)]
        keys.append((rings, "Θ, shared by all factors of a kind"))
    return keys


def hardest_pull(pull: Explanation, wanted: tuple[str, ...]) -> float:
    """The largest pull of these kinds at a limb, nats per radian."""
    return max((float(np.abs(pull.pull[kind]).max(initial=0.0)) for kind in wanted if kind in pull.pull), default=0.0)


def colour_of(kind: str, wanted: tuple[str, ...]) -> str:
    """The colour of a kind among those that are wanted."""
    own = [name for name in wanted if name not in COLOUR]
    return COLOUR[kind] if kind in COLOUR else OWN[own.index(kind) % len(OWN)]


def square(at, half: float, fill: str, *, turned: bool = False) -> Path:
    """A square around a point; `turned`, on its corner."""
    corner = np.array([[0, -1.3], [1.3, 0], [0, 1.3], [-1.3, 0]] if turned else [[-1, -1], [1, -1], [1, 1], [-1, 1]])
    return Path(np.asarray(at) + half * corner, INK if turned else "#ffffff", 1.2, closed=True, fill=fill, fill_opacity=1.0)


def arrow(foot: Float[np.ndarray, " 2"], length: float, colour: str) -> list[Path]:
    """Down to the left, or up to the right where the length is negative."""
    toward = np.sign(length) * np.array([-1.0, 1.0]) / np.sqrt(2)
    across, head = np.array([toward[1], -toward[0]]), foot + abs(length) * toward
    point = np.array([head + 6.0 * toward, head - 3.0 * toward + 5.0 * across, head - 3.0 * toward - 5.0 * across])
    return [Path(np.array([foot, head]), colour, 2.6), Path(point, None, closed=True, fill=colour, fill_opacity=1.0)]


def _plural(count: int, thing: str) -> str:
    return f"{count} {thing}{'' if count == 1 else 's'}"
