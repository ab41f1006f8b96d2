"""What is the factor graph of a drawing? Its variables and factors over the drawn lines.

    circle         a variable: the depth of a segment; blue behind the page, orange in front of it, where depths are given
    diamond        a label, apical or lateral, where the reader joined two strokes; elsewhere the strokes tell it
    square         a factor, in the colour of its kind; a thin line to each variable it looks at first (see `mrf.blocks`)
    Θ              what all factors of a kind share, at the margin; left out where it would hide the rest
    arrow          how hard a kind pulls a limb's tip: down to the left towards the viewer, up to the right away from him
"""

from collections.abc import Iterable
from pathlib import Path as File

import numpy as np
from jaxtyping import Float

from sketchtree.axes import NULL
from sketchtree.errors import OptionError
from sketchtree.export.files import check_extension, check_writable, write_whole
from sketchtree.mrf.blocks import EQUATION, Block, blocks
from sketchtree.mrf.explain import Explanation
from sketchtree.mrf.factor_graph import FactorGraph
from sketchtree.overlay.as_png import scene_png
from sketchtree.overlay.as_svg import scene_svg
from sketchtree.overlay.factor_layout import Nodes, placed
from sketchtree.overlay.factor_legend import BEHIND, COLOUR, FRONT, INK, WIDTH, arrow, colour_of, hardest_pull, legend, square
from sketchtree.overlay.lettering import lettered
from sketchtree.overlay.marks import Placing
from sketchtree.overlay.scene import Disc, Path, Scene, Words

USUAL = ("lateral", "apical", "limb_length", "siblings", "crown")
LONG_SIDE, LEAST_HEIGHT, MARGIN, THETA = 1000.0, 640.0, 56.0, 120.0  # pixels: the drawing, room around it, room for Θ
DRAWN = "#cfcfcf"
MOST_FOR_THETA = 30  # segments
FAINTEST = 0.04  # of the hardest pull: less is not shown


def draw_factor_graph(
    graph: FactorGraph,
    path: str | File,
    *,
    depth: Float[np.ndarray, " segment"] | None = None,
    kinds: Iterable[str] | None = None,
    pull: Explanation | None = None,
) -> File:
    """Draw the factor graph into a .svg or .png file; returns its path.

    `depth`: sketch units, as in `Fit.depth`. `kinds`: which kinds of factor (None: `USUAL`). `pull`: arrows for those kinds.
    Raises `OptionError` for an unknown kind or depths of another drawing, `ExportError` where the file can't be written.
    """
    suffix = check_extension(path, (".svg", ".png"))
    check_writable(path)
    scene = factor_scene(graph, depth=depth, kinds=kinds, pull=pull, drawn_letters=suffix == ".png")
    write_whole(path, scene_png(scene) if suffix == ".png" else scene_svg(scene).encode())
    return File(path)


def factor_scene(
    graph: FactorGraph,
    *,
    depth: Float[np.ndarray, " segment"] | None = None,
    kinds: Iterable[str] | None = None,
    pull: Explanation | None = None,
    drawn_letters: bool = False,
) -> Scene:
    """The picture. `drawn_letters`: formulas as lines, for a font without Greek."""
    wanted = _checked_kinds(kinds, pull)
    if depth is not None and np.shape(depth) != (len(graph),):
        raise OptionError(f"`depth` has the shape {np.shape(depth)}.", remedy=f"Give {len(graph)} depths, one a row of the graph, as in `Fit.depth`.")
    every = blocks(graph)
    shown = {kind: every[kind] for kind in every if kind in wanted}
    shares = any(block.theta for block in shown.values()) and int((~graph.is_base).sum()) <= MOST_FOR_THETA
    place, size = _page(graph, THETA if shares else 0.0)
    arrows = _arrows(graph, wanted, pull, place) if pull else []
    tails = np.concatenate([np.zeros((0, 2)), *(np.linspace(a.points[0], a.points[1], 4) for a in arrows if not a.closed)])
    nodes = placed(graph, shown, place, tails)
    marks = [
        *_lines(graph, place),
        *(_theta(shown, nodes, MARGIN) if shares else []),
        *_edges(graph, shown, nodes),
        *_variables(graph, nodes, depth),
        *_squares(shown, nodes),
        *arrows,
        *legend(graph, wanted, every, depth=depth, pull=pull, shares=shares, left=size[0] - WIDTH, top=MARGIN),
    ]
    if drawn_letters:
        marks = [mark for one in marks for mark in (lettered(one) if isinstance(one, Words) and one.anchor == "start" else [one])]
    return Scene(round(size[0]), round(size[1]), tuple(marks), "The factor graph of a drawing")


def _checked_kinds(kinds: Iterable[str] | None, pull: Explanation | None) -> tuple[str, ...]:
    known = [*EQUATION, *(kind for kind in (pull.pull if pull else ()) if kind not in EQUATION)]
    wanted = USUAL if kinds is None else (kinds,) if isinstance(kinds, str) else tuple(kinds)
    for kind in wanted:
        if kind not in known:
            raise OptionError(f"There is no kind of factor `{kind}`.", remedy=f"Use some of {', '.join(known)}.")
    return tuple(kind for kind in known if kind in wanted)


def _page(graph: FactorGraph, aside: float) -> tuple[Placing, tuple[float, float]]:
    """(from H = 1 to pixels, width and height of the picture)."""
    low, high = graph.xy.min(0), graph.xy.max(0)
    thin = np.maximum(0.3 * float((high - low).max()) - (high - low), 0.0) / 2
    low, high = low - thin, high + thin
    scale = LONG_SIDE / max(float((high - low).max()), 1e-9)
    width, height = (high - low) * scale
    tall = max(height, LEAST_HEIGHT)
    place = Placing(low, high, MARGIN + aside, MARGIN + (tall - height) / 2, scale)
    return place, (2 * MARGIN + aside + width + WIDTH, 2 * MARGIN + tall)


def _lines(graph: FactorGraph, place: Placing) -> list[Path | Disc]:
    rows = np.flatnonzero(~graph.is_base)
    ends = np.stack([place(graph.xy[graph.parent[rows]]), place(graph.xy[rows])], 1)
    width = np.clip(9.0 * 0.7 ** graph.order[rows], 3.0, 9.0)
    marks: list[Path | Disc] = [Path(line, DRAWN, float(w)) for line, w in zip(ends, width, strict=True)]
    return marks + [Disc(x, y, 6.0, "#888888") for x, y in place(graph.xy[graph.is_base]).tolist()]


def _edges(graph: FactorGraph, shown: dict[str, Block], nodes: Nodes) -> list[Path]:
    marks = []
    for kind, block in shown.items():
        for at, rows in zip(nodes.factor[kind], block.rows, strict=True):
            rows = rows[rows != NULL]
            marks += [Path(np.array([at, nodes.variable[row]]), COLOUR[kind], 1.3, 0.55) for row in rows[~graph.is_base[rows]]]
            if kind == "apical" and graph.is_joined[rows[0]]:
                marks.append(Path(np.array([at, nodes.label[rows[0]]]), INK, 1.3, 0.55))
    return marks


def _variables(graph: FactorGraph, nodes: Nodes, depth) -> list[Path | Disc]:
    segment = np.flatnonzero(~graph.is_base)
    fill = ["#ffffff"] * len(segment) if depth is None else depth_colours(np.asarray(depth, float)[segment])
    marks: list[Path | Disc] = [
        Disc(*nodes.variable[row].tolist(), nodes.radius, colour, INK, 1.4) for row, colour in zip(segment.tolist(), fill, strict=True)
    ]
    return marks + [square(nodes.label[row], 0.9 * nodes.radius, "#ffffff", turned=True) for row in np.flatnonzero(graph.is_joined)]


def depth_colours(depth: Float[np.ndarray, " segment"]) -> list[str]:
    """Blue behind the page, white in it, orange in front of it; full at the largest depth."""
    end = np.where(depth[:, None] < 0, *(np.array([int(c[k : k + 2], 16) for k in (1, 3, 5)]) for c in (BEHIND, FRONT)))
    share = np.sqrt(np.abs(depth) / max(float(np.abs(depth).max(initial=0.0)), 1e-12))[:, None]
    return ["#" + "".join(f"{int(v):02x}" for v in row) for row in np.round(255 + share * (end - 255))]


def _squares(shown: dict[str, Block], nodes: Nodes) -> list[Path]:
    return [square(at, 0.8 * nodes.radius, COLOUR[kind]) for kind in shown for at in nodes.factor[kind]]


def _theta(shown: dict[str, Block], nodes: Nodes, left: float) -> list[Path | Disc | Words]:
    """One node a kind that shares parameters, beside its factors."""
    kinds = sorted((kind for kind in shown if shown[kind].theta), key=lambda kind: nodes.factor[kind][:, 1].mean())
    height = np.array([nodes.factor[kind][:, 1].mean() for kind in kinds])
    for k in range(1, len(kinds)):
        height[k] = max(height[k], height[k - 1] + 64.0)
    marks: list[Path | Disc | Words] = []
    for kind, y in zip(kinds, height.tolist(), strict=True):
        marks += [Path(np.array([[left, y], at]), COLOUR[kind], 1.0, 0.22) for at in nodes.factor[kind]]
    for kind, y in zip(kinds, height.tolist(), strict=True):
        marks += [Disc(left, y, 12.0, "#ffffff", COLOUR[kind], 2.2), Disc(left, y, 8.0, "#ffffff", COLOUR[kind], 1.2)]
        marks.append(Words(left - 12, y + 30, f"Θ {', '.join(shown[kind].theta)}", 13.0, COLOUR[kind]))
    return marks


def _arrows(graph: FactorGraph, wanted, pull: Explanation, place: Placing) -> list[Path]:
    """At every limb's tip, one arrow a kind, beside each other."""
    pulling = [kind for kind in wanted if kind in pull.pull]
    hardest = hardest_pull(pull, wanted)
    tips, marks = place(graph.xy[graph.limb_tip]), []
    for slot, kind in enumerate(pulling):
        beside = 9.0 * (slot - (len(pulling) - 1) / 2) * np.array([1.0, 1.0]) / np.sqrt(2)
        for limb in np.flatnonzero(np.abs(pull.pull[kind]) > FAINTEST * hardest):
            force = float(pull.pull[kind][limb]) / hardest
            marks += arrow(tips[limb] + beside, np.sign(force) * (10.0 + 44.0 * abs(force)), colour_of(kind, wanted))
    return marks
