"""How would a person have drawn this tree? A skeleton → one flat drawing whose depth is known.

The tree is turned to an azimuth, the trunk and the conspicuous limbs of the first orders are kept, projected
along z, wobbled like a hand and simplified to nearly straight segments. The nodes lie on the drawn
line exactly; the depth that goes with each is the tree's own.
"""

from dataclasses import dataclass

import numpy as np
import shapely
from jaxtyping import Float
from scipy.ndimage import gaussian_filter1d

from sketchtree.axes import NULL
from sketchtree.limb_ids import stroke_limb_id
from sketchtree.skeleton import TreeSkeleton
from sketchtree.sketch.graph import SketchGraph
from sketchtree.traverse import limb_chains

HEIGHT = 800.0  # sketch units that the whole tree is high
STRAIGHT = 0.012  # farthest that a drawn line may lie from its segment, H
SHORTEST = 0.03  # shortest limb that anybody draws, H
MERGE = 0.004  # junctions closer than this on one limb are one, H


@dataclass(frozen=True, eq=False)
class Case:
    """A drawing and the truth behind it."""

    name: str
    family: str
    graph: SketchGraph  # the exact graph: what perfect reading would give
    depth: Float[np.ndarray, " segment"]  # true z, sketch units, 0 at the base
    radius: Float[np.ndarray, " segment"]  # at the tip, sketch units
    height: float  # H, sketch units
    svg: str | None = None  # the drawing as a file, where there is one

    @property
    def position(self) -> Float[np.ndarray, "segment 3"]:
        """The true tips, sketch units."""
        return np.c_[self.graph.xy, self.depth]


@dataclass(frozen=True)
class Hand:
    """How a person draws."""

    azimuth: float  # radians that the tree is turned before it is seen
    strokes: int  # how many strokes at most, 1 or more
    orders: int = 3  # how many branching orders, 1 or more
    main: float = 0.6  # share of the strokes that first-order limbs may take, 0-1 (all where `orders` is 2)
    jitter: float = 0.003  # standard deviation of the hand's wobble, H
    crown: bool = False  # draws the crown's outline too


def random_hand(rng: np.random.Generator) -> Hand:
    """Any side, 2-3 orders, 8-60 strokes, a steady or a shaky hand, a crown now and then."""
    return Hand(
        azimuth=rng.uniform(0, 2 * np.pi),
        strokes=int(np.round(np.exp(rng.uniform(np.log(8), np.log(60))))),
        orders=int(rng.choice([2, 3, 3])),
        main=rng.uniform(0.35, 0.75),
        jitter=float(rng.choice([0.0, 0.003, 0.006])),
        crown=bool(rng.uniform() < 1 / 3),
    )


def draw(tree: TreeSkeleton, hand: Hand, *, name: str, family: str, rng: np.random.Generator) -> Case:
    """Draws `tree` (y up) as `hand` would, all its stems. Strokes are numbered s0 (the trunk), s1, …"""
    tip = _turned(tree.tip - tree.tip[0], hand.azimuth) * (HEIGHT / np.ptp(tree.tip[:, 1]))
    radius = tree.radius * (HEIGHT / np.ptp(tree.tip[:, 1]))
    chains = [_with_junction(tree.parent, rows) for rows in limb_chains(tree.parent, tree.limb)]
    kept = _conspicuous(tree, tip, chains, hand, rng)
    strokes = _stroke_rows(tree, tip, [chains[k] for k in kept])
    lines = _wobbled(strokes, tip, radius, hand.jitter * HEIGHT, rng)
    return _case(lines, name, family, _crown(tip) if hand.crown else ())


def _turned(points, azimuth):
    c, s = np.cos(azimuth), np.sin(azimuth)
    return points @ np.array([[c, 0, -s], [0, 1, 0], [s, 0, c]])


def _with_junction(parent, rows):
    """The rows of one limb, the row that it grows from put before them."""
    return rows if parent[rows[0]] == NULL else np.r_[parent[rows[0]], rows]


def _conspicuous(tree, tip, chains, hand, rng):
    """Which limbs are drawn: long ones are likelier, and none without the limb that carries it."""
    length = np.array([np.linalg.norm(np.diff(tip[rows], axis=0), axis=1).sum() for rows in chains])
    seen = np.array([np.linalg.norm(np.diff(tip[rows, :2], axis=0), axis=1).sum() for rows in chains])
    order = np.array([tree.order[rows[-1]] for rows in chains])
    owner = _owner(chains, tree.parent)
    stems = [k for k, rows in enumerate(chains) if tree.parent[rows[0]] == NULL]
    carrier = np.array([owner[int(rows[0])] for rows in chains])
    wanted = 1.5 * np.log(length + 1e-9) + rng.gumbel(size=len(chains))
    wanted[(order >= hand.orders) | (seen < SHORTEST * HEIGHT)] = -np.inf
    wanted[stems] = -np.inf
    kept, mains = list(stems), hand.strokes if hand.orders == 2 else int(np.ceil(hand.main * hand.strokes))
    while len(kept) < hand.strokes:
        ready = np.isin(carrier, kept) & ((order > 1) | (np.sum(order[kept] == 1) < mains))
        best = int(np.argmax(np.where(ready, wanted, -np.inf)))
        if not (ready[best] and np.isfinite(wanted[best])):
            break
        kept.append(best)
        wanted[best] = -np.inf
    return sorted(kept, key=lambda k: (order[k], k))


def _owner(chains, parent):
    """{row: the limb that it belongs to}; a junction belongs to the limb that carries it."""
    return {int(row): k for k, rows in enumerate(chains) for row in (rows if parent[rows[0]] == NULL else rows[1:])}


@dataclass
class _Line:
    """One stroke while it is drawn: fine points, which of them are nodes, where it starts."""

    point: np.ndarray  # (point, 3): drawn x, y and true z
    radius: np.ndarray
    node: np.ndarray  # indices of the points that are nodes, first and last included
    carrier: int  # stroke it grows from, NULL for the trunk
    at: int  # index among the carrier's points


def _stroke_rows(tree, tip, chains):
    """[(rows, carrier stroke, row of the carrier)], junctions that nearly touch on one limb merged."""
    owner = _owner(chains, tree.parent)
    strokes, used = [], {}
    for k, rows in enumerate(chains):
        if tree.parent[rows[0]] == NULL:
            strokes.append((rows, NULL, NULL))
            continue
        host, carrier = int(rows[0]), owner[int(rows[0])]
        apart = {other: np.linalg.norm(tip[other, :2] - tip[host, :2]) for other in used.get(carrier, ())}
        near = [other for other, gap in apart.items() if gap < MERGE * HEIGHT]
        host = near[0] if near else host
        used.setdefault(carrier, []).append(host)
        strokes.append((np.r_[host, rows[1:]], carrier, host))
    return strokes


def _wobbled(strokes, tip, radius, jitter, rng):
    """Fine drawn lines: the tree's own, with a smooth wobble that leaves each start on its carrier."""
    junctions = [{row for _, carrier, row in strokes if carrier == k} for k in range(len(strokes))]
    lines, drawn_at = [], []
    for (rows, carrier, host), own in zip(strokes, junctions, strict=True):
        point, thick, index = _finely(tip[rows], radius[rows], 0.012 * HEIGHT)
        wobble = gaussian_filter1d(rng.normal(size=(len(point) + 16, 2)), 4.0, axis=0)[8:-8]
        wobble *= jitter / 0.27 * np.minimum(1, np.arange(len(point)) / 6)[:, None]  # .27: sd after the filter
        shift = np.zeros(2) if carrier == NULL else lines[carrier].point[drawn_at[carrier][host], :2] - point[0, :2]
        fade = 1.0 if carrier == NULL else np.linspace(1, 0.5, len(point))[:, None]
        point[:, :2] += wobble + shift * fade
        where = {int(row): int(i) for row, i in zip(rows, index, strict=True)}
        drawn_at.append(where)
        stops = sorted({0, len(point) - 1} | {where[row] for row in own})
        node = np.unique(np.concatenate([_simplified(point[:, :2], a, b) for a, b in zip(stops[:-1], stops[1:])]))
        at = NULL if carrier == NULL else drawn_at[carrier][host]
        lines.append(_Line(point, thick, node, carrier, at))
    return lines


def _finely(point, radius, step):
    """The polyline with points at least every `step`, and where its own points now stand."""
    count = np.maximum(1, np.ceil(np.linalg.norm(np.diff(point, axis=0), axis=1) / step)).astype(int)
    index = np.r_[0, np.cumsum(count)]
    at = np.arange(index[-1] + 1)
    fine = np.stack([np.interp(at, index, column) for column in point.T], axis=1)
    return fine, np.interp(at, index, radius), index


def _simplified(line, a, b):
    """Indices a … b that a person would call the bends (Ramer 1972, Douglas & Peucker 1973)."""
    if b - a < 2:
        return np.array([a, b])
    chord = line[b] - line[a]
    offset = line[a + 1 : b] - line[a]
    size = np.hypot(*chord)
    away = np.abs(offset @ [-chord[1], chord[0]]) / size if size > 1e-9 else np.linalg.norm(offset, axis=1)
    worst = int(np.argmax(away))
    if away[worst] <= STRAIGHT * HEIGHT:
        return np.array([a, b])
    middle = a + 1 + worst
    return np.concatenate([_simplified(line, a, middle), _simplified(line, middle, b)])


def _crown(tip):
    """The outline of the whole tree's upper part, as a closed curve."""
    upper = tip[tip[:, 1] > 0.15 * tip[:, 1].max(), :2]
    outline = shapely.MultiPoint(upper).convex_hull.buffer(0.02 * HEIGHT)
    return (np.array(outline.exterior.coords)[:-1],)


def _case(lines, name, family, crown):
    """The graph of the drawn lines: one row a node, one limb a stroke."""
    parent, tip, radius, limb, between = [], [], [], [], []
    row_of = []
    for k, line in enumerate(lines):
        rows = {}
        if line.carrier == NULL:
            start, nodes = NULL, line.node
            previous_point = None
        else:
            start, nodes = row_of[line.carrier][line.at], line.node[1:]
            rows[int(line.node[0])] = start
            previous_point = int(line.node[0])
        for node in nodes:
            rows[int(node)] = len(parent)
            parent.append(start)
            tip.append(line.point[node])
            radius.append(line.radius[node])
            limb.append(k)
            inner = slice(0, 0) if previous_point is None else slice(previous_point + 1, node)
            between.append(line.point[inner, :2])
            start, previous_point = len(parent) - 1, int(node)
        row_of.append(rows)
    columns = (np.array(column) for column in (parent, tip, limb, radius))
    return make_case(name, family, *columns, HEIGHT, between, crown)


def make_case(name, family, parent, tip, limb, radius, height, between=None, crown=(), svg=None) -> Case:
    """A case from columns; `between` are the drawn points (point, 2) inside each segment.

    The truth's depth counts from its base."""
    n = len(parent)
    between = [np.zeros((0, 2))] * n if between is None else between
    ids = tuple(f"s{k}" for k in range(int(limb.max()) + 1))
    graph = SketchGraph(
        parent=parent,
        xy=tip[:, :2],
        limb=limb,
        stroke=limb,
        tree=np.zeros(n, int),
        width=np.full(n, np.nan),
        joined=np.zeros(n, bool),
        curve_points=np.concatenate(between).reshape(-1, 2),
        curve_start=np.r_[0, np.cumsum([len(points) for points in between])],
        limb_id=np.array([stroke_limb_id(i) for i in ids]),
        stroke_ids=ids,
        crown=tuple(crown),
    )
    return Case(name, family, graph, tip[:, 2] - tip[0, 2], np.maximum(radius, 1e-6 * height), float(height), svg)


def svg_of(case: Case) -> str:
    """The drawing as an SVG file (y down), one path a stroke."""
    graph, margin = case.graph, 0.04 * case.height
    points = np.concatenate([graph.xy, graph.curve_points, *graph.crown]) * [1, -1]
    low, size = points.min(0) - margin, np.ptp(points, axis=0) + 2 * margin
    head = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="{low[0]:.2f} {low[1]:.2f} {size[0]:.2f} {size[1]:.2f}">'
    group = '<g id="branches" fill="none" stroke="#333" stroke-linecap="round">'
    paths = [_path(f"s{k}", _drawn_line(graph, k)) for k in range(len(graph.limb_id))]
    crown = [_path("crown", outline, close=" Z") for outline in graph.crown]
    crown = ['<g id="crown" fill="none" stroke="#7a7">', *crown, "</g>"] if crown else []
    return "\n".join([head, group, *paths, "</g>", *crown, "</svg>", ""])


def _drawn_line(graph, limb):
    """All drawn points of one limb, its junction first."""
    rows = np.flatnonzero((graph.limb == limb) & ~graph.is_base)
    return np.concatenate([graph.curve(row)[1 if i else 0 :] for i, row in enumerate(rows)])


def _path(name, points, close=""):
    steps = " L ".join(f"{x:.3f},{-y:.3f}" for x, y in points)
    return f'<path id="{name}" d="M {steps}{close}"/>'
