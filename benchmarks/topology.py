"""Does every stroke hang where it truly grows? Careless drawings of known trees, read and compared.

    python -m benchmarks.topology                       the curve over the jitter, for three hands
    python -m benchmarks.topology --drawings 20 --jitter 1 3
    python -m benchmarks.topology --record              write data/topology_record.json; the tests hold later versions to it

Trees: twelve grown ones (data/grown) and the measured ones, seen from any side, 2-3 orders, 10-60 strokes, drawn as
`shaky.wobbly` says. Every true segment is sought where a stranger to the reader would: on the read curves, by its place.

    segments   share of true segments whose parent is on the true stroke: from the middle of a segment the read way to the
               root stays on its stroke back to where the segment starts. The first segment of a stroke must go on
               to the parent's line near the true junction, and every attachment reported of its strokes that leads
               to another line of the truth must lead to that parent                                      the bar's figure
    strokes    share of true strokes of which that first segment is right (segments within a stroke are easy)
    reversed   share of strokes whose tip was taken for the foot
    joined     share of strokes wrongly taken to carry another on from its tip
    listed     share of strokes whose true parent is the one taken or one of the report's alternatives
    nearest    share of strokes with the right parent by a baseline: longest first, each to the nearest before it

Three hands (`shaky` says more): `short` stops short of the junction, `aside` starts off to any side of it, `adrift` does not look at
what it has drawn: every stroke wanders by itself.
"""

import argparse
import json
import zlib
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import shapely

from benchmarks.cases import DATA
from benchmarks.drawing import Hand, draw
from benchmarks.families import measured
from benchmarks.shaky import Wobbly, wobbly
from sketchtree.axes import NULL
from sketchtree.skeleton import TreeSkeleton
from sketchtree.sketch.graph import SketchGraph
from sketchtree.sketch.reading import sketch_graph
from sketchtree.sketch.strokes import Sketch

RECORD = DATA / "topology_record.json"
JITTER = (0.0, 1.0, 2.0, 3.0, 5.0)  # j, % of H
WAYS: dict[str, dict[str, bool]] = {"short": {}, "aside": {"short": False}, "adrift": {"moored": False}}
MARGIN = 0.03  # of H: how far beyond a junction the way to the root is looked at
NEAR = 0.01  # of H: nearer than this to a line is on it
STEP = 0.002  # of H, between points on the read curves
FIXED, FIXED_SEED = (("short", 1.0), ("short", 3.0), ("aside", 1.0)), 500  # what the tests hold
FIGURES = ("segments", "strokes", "listed", "reversed", "joined", "nearest")


def trees(folder: Path | None = None) -> Iterator[tuple[str, object]]:
    """(name, skeleton) of every grown tree of `data/grown` and every measured tree (of `folder`, by default those shipped).

    The grown ones are twelve exemplars as they once were, kept so that no change of a recipe can move the record."""
    for path in sorted((DATA / "grown").glob("*.npz")):
        with np.load(path) as columns:
            yield path.stem, TreeSkeleton.from_columns(**columns)
    for path in sorted((folder or DATA / "measured").glob("*.npz")):
        yield path.stem, measured(path)


def drawings(count: int, jitter: float, *, first_seed: int = 0, source=None, orders=(2, 3), **slack) -> list[Wobbly]:
    """`count` drawings, the trees taken in turn; the same exact drawings for every jitter. `slack`: options of `wobbly`."""
    source = list(trees() if source is None else source)
    made = []
    for k in range(count):
        name, tree = source[k % len(source)]
        turn = first_seed + k // len(source)
        rng = np.random.default_rng([turn, zlib.crc32(name.encode())])
        hand = Hand(
            azimuth=rng.uniform(0, 2 * np.pi),
            strokes=int(np.round(np.exp(rng.uniform(np.log(10), np.log(60))))),
            orders=int(rng.choice(orders)),
            main=rng.uniform(0.35, 0.75),
            jitter=0.0,
        )
        case = draw(tree, hand, name=f"{name}_{turn}", family=name, rng=rng)
        made.append(wobbly(case, jitter, rng=rng, **slack))
    return made


def score(drawn: Wobbly, graph: SketchGraph) -> dict[str, float]:
    """The figures of one read drawing."""
    reported = _reported(drawn, [(a.stroke, a.parent) for a in graph.attachments])
    walked = _walked(drawn, graph)
    inner = drawn.parent != NULL
    for walk, ok in zip(walked, reported, strict=True):
        walk[0] &= ok
    return {
        "segments": float(np.concatenate(walked).mean()),
        "strokes": float(np.array([walk[0] for walk in walked])[inner].mean()),
        "listed": float(_listed(drawn, graph)[inner].mean()),
        "reversed": float(_reversed(drawn, graph)[inner].mean()),
        "joined": float(_joined(drawn, graph)[inner].mean()),
        "nearest": float(_reported(drawn, nearest_first(drawn.sketch))[inner].mean()),
    }


def _owner(drawn: Wobbly) -> dict[str, int]:
    return {name: k for k, names in enumerate(drawn.ids) for name in names}


def _reported(drawn: Wobbly, pairs) -> np.ndarray:
    """Of every true stroke: do all (stroke, parent) of its strokes that lead elsewhere lead to its parent?"""
    owner = _owner(drawn)
    found: list[set[int]] = [set() for _ in drawn.ids]
    for name, parent in pairs:
        child, above = owner[name], NULL if parent is None else owner[parent]
        if child != above:
            found[child].add(above)
    return np.array([above == {int(true)} for above, true in zip(found, drawn.parent, strict=True)])


def _listed(drawn: Wobbly, graph: SketchGraph) -> np.ndarray:
    """Of every true stroke: is its parent the one taken, or among the alternatives?"""
    owner, found = _owner(drawn), np.zeros(len(drawn.line), bool)
    for a in graph.attachments:
        k = owner[a.stroke]
        named = {a.parent, *(name for name, _ in a.alternatives)}
        found[k] |= int(drawn.parent[k]) in {NULL if name is None else owner.get(name, NULL) for name in named}
    return found


def _walked(drawn: Wobbly, graph: SketchGraph) -> list[np.ndarray]:
    """Of every true stroke, of each of its segments: does the way to the root keep to it, the first's lead to the parent?"""
    point, above, away = _rootward(graph, STEP * drawn.height)
    tree = shapely.STRtree(shapely.points(point))
    lines = [shapely.LineString(line) for line in drawn.line]
    found = []
    for k, line in enumerate(lines):
        up = int(drawn.parent[k])
        gap = 0.0 if up == NULL else line.interpolate(0.0).distance(lines[up])
        beyond = 0.0 if up == NULL else gap + min(MARGIN * drawn.height, drawn.s[k])
        start = np.r_[0.0, drawn.node[k][:-1]]
        middle = 0.5 * (start + drawn.node[k])
        left = np.r_[middle[0] + beyond, (middle - start)[1:]]
        kept = np.r_[beyond + min(MARGIN * drawn.height, 0.5 * middle[0]), np.zeros(len(left) - 1)]
        here = tree.nearest(shapely.line_interpolate_point(line, middle))
        runs = shapely.distance(shapely.points(point[here]), line) <= NEAR * drawn.height
        while (going := (left > 0) & (above[here] != NULL)).any():
            left[going] -= away[here[going]]
            here[going] = above[here[going]]
            runs &= ~going | (left < kept) | (shapely.distance(shapely.points(point[here]), line) <= NEAR * drawn.height)
        off = np.abs(shapely.line_locate_point(line, shapely.points(point[here])) - start)
        runs[1:] &= (off <= np.minimum(MARGIN * drawn.height, middle - start))[1:]
        runs[0] &= _arrives(point[here[0]], k, drawn, lines, gap)
        found.append(runs)
    return found


def _arrives(point, k: int, drawn: Wobbly, lines, gap: float) -> bool:
    """Whether the way from stroke k's first segment ends where it should: on the parent near the junction, or at the foot of a stem."""
    at, up = shapely.Point(point), int(drawn.parent[k])
    if up == NULL:
        return bool(np.hypot(*(point - drawn.line[k][0])) <= MARGIN * drawn.height)
    near = at.distance(lines[up]) <= NEAR * drawn.height
    return bool(near and abs(lines[up].project(at) - drawn.s[k]) <= gap + 2 * MARGIN * drawn.height)


def _rootward(graph: SketchGraph, step: float):
    """(points along all read curves, index of the next one towards the root, how far that is)."""
    points, above, away, last = [], [], [], np.zeros(len(graph), int)
    for row in range(len(graph)):
        if graph.parent[row] == NULL:
            points.append(graph.xy[row])
            above.append(NULL)
            away.append(0.0)
        else:
            fine = shapely.get_coordinates(shapely.segmentize(shapely.LineString(graph.curve(row)), step))
            before = int(last[graph.parent[row]])
            for k in range(1, len(fine)):
                above.append(before if k == 1 else len(points) - 1)
                points.append(fine[k])
                away.append(float(np.hypot(*(fine[k] - fine[k - 1]))))
        last[row] = len(points) - 1
    return np.array(points), np.array(above), np.array(away)


def _reversed(drawn: Wobbly, graph: SketchGraph) -> np.ndarray:
    """Of every true stroke: does its (longest) stroke hang by the end that is its tip?"""
    owner, found = _owner(drawn), np.zeros(len(drawn.line), bool)
    for a in graph.attachments:
        k = owner[a.stroke]
        foot, tip = (np.hypot(*(drawn.line[k][end] - a.point)) for end in (0, -1))
        if a.parent is None or owner[a.parent] != k:
            found[k] = tip < foot
    return found


def _joined(drawn: Wobbly, graph: SketchGraph) -> np.ndarray:
    """Of every true stroke: does it wrongly carry another on from its tip?"""
    owner, found = _owner(drawn), np.zeros(len(drawn.line), bool)
    for a in graph.attachments:
        k = owner[a.stroke]
        if a.parent is None or owner[a.parent] == k or not a.reason.startswith("carries"):
            continue
        up = owner[a.parent]
        tip = _length(drawn.line[up]) - drawn.s[k] <= MARGIN * drawn.height
        found[k] |= not (up == drawn.parent[k] and tip)
    return found


def _length(line: np.ndarray) -> float:
    return float(np.hypot(*np.diff(line, axis=0).T).sum())


def nearest_first(sketch: Sketch) -> list[tuple[str, str | None]]:
    """(stroke, parent) by the baseline: the longest stroke first, each by its nearer end to the nearest before it."""
    strokes = sorted(sketch.strokes, key=lambda stroke: -_length(stroke.points))
    shapes = [shapely.LineString(stroke.points) for stroke in strokes]
    found: list[tuple[str, str | None]] = [(strokes[0].id, None)]
    for k, stroke in enumerate(strokes[1:], 1):
        gaps = shapely.distance(shapely.points(stroke.points[[0, -1]])[:, None], np.array(shapes[:k], object)[None]).min(0)
        found.append((stroke.id, strokes[int(np.argmin(gaps))].id))
    return found


def curve(count: int, jitters, ways=tuple(WAYS), *, first_seed: int = 0, source=None) -> dict[str, dict[str, dict[str, float]]]:
    """way → jitter → figure (the mean over drawings)."""
    source = list(trees() if source is None else source)
    table: dict = {}
    for way in ways:
        table[way] = {}
        for jitter in jitters:
            made = drawings(count, jitter, **WAYS[way], first_seed=first_seed, source=source)
            rows = [score(drawn, sketch_graph(drawn.sketch)) for drawn in made]
            table[way][f"{jitter:g}"] = {name: float(np.mean([row[name] for row in rows])) for name in FIGURES}
    return table


def fixed(source=None) -> dict[str, dict[str, float]]:
    """The figures of the small set that the tests hold: "hand jitter" → figure."""
    source = list(trees() if source is None else source)
    found = {}
    for hand, jitter in FIXED:
        rows = curve(2 * len(source), [jitter], [hand], first_seed=FIXED_SEED, source=source)[hand]
        found |= {f"{hand} {j}": figures for j, figures in rows.items()}
    return found


def printed(table) -> str:
    """The curve as text, percent."""
    lines = [f"{'':8s}{'j %H':>6s}" + "".join(f"{name:>10s}" for name in FIGURES)]
    for way, rows in table.items():
        lines += [f"{way:8s}{j:>6s}" + "".join(f"{100 * row[name]:10.2f}" for name in FIGURES) for j, row in rows.items()]
    return "\n".join(lines)


def main(arguments: list[str] | None = None) -> None:
    """The command line."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.topology", description=__doc__.splitlines()[0])
    parser.add_argument("--drawings", type=int, default=72, help="drawings for every jitter (default: 72)")
    parser.add_argument("--jitter", type=float, nargs="+", default=list(JITTER), help="% of the drawn height")
    parser.add_argument("--way", choices=WAYS, nargs="+", default=list(WAYS))
    parser.add_argument("--skeletons", type=Path, help="a folder of measured trees instead of those shipped")
    parser.add_argument("--seed", type=int, default=0, help="first seed of the drawings")
    parser.add_argument("--record", action="store_true", help="make these figures the record")
    options = parser.parse_args(arguments)
    table = curve(options.drawings, options.jitter, options.way, first_seed=options.seed, source=trees(options.skeletons))
    print(printed(table))
    if options.record:
        rounded = {way: {j: _rounded(row) for j, row in rows.items()} for way, rows in table.items()}
        small = {case: _rounded(row) for case, row in fixed().items()}
        RECORD.write_text(json.dumps({"drawings": options.drawings, "curve": rounded, "fixed": small}, indent=1) + "\n")


def _rounded(figures: dict[str, float]) -> dict[str, float]:
    return {name: round(figure, 4) for name, figure in figures.items()}


if __name__ == "__main__":
    main()
