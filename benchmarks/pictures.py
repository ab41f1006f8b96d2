"""A drawing as a picture of it: inked and scanned, in pencil and photographed, or painted with a brush on a screen.

Strokes are drawn three times as large as asked and averaged down. A medium then adds what its paper, pen and camera
would: tone, uneven light, a shadow's edge, grain, blur, and the losses of JPEG.
"""

import io
from dataclasses import dataclass

import numpy as np
import shapely
from jaxtyping import Float
from PIL import Image, ImageDraw
from scipy.ndimage import gaussian_filter

from sketchtree.sketch.graph import SketchGraph
from sketchtree.sketch.strokes import Sketch, Stroke, StrokeKind

FINER = 3  # times as large as asked, before averaging
MARGIN = 0.06  # of the drawing's size, around it
NEAR = 0.01  # of H: a point this near to a line is on it
PASSES = 0.02  # of H: a way to the ground passes a point it comes as near to


@dataclass(frozen=True)
class Medium:
    """What a picture is drawn with, on and by."""

    name: str
    paper: float = 1.0  # lightness of the paper
    ink: float = 0.05  # lightness of a full line
    light: float = 0.0  # how much of the light is lost from one corner to the other
    shadow: float = 0.0  # how much of it is lost in a shadow that lies over a part of the page
    grain: float = 0.0  # standard deviation of the noise
    tooth: float = 0.0  # how much a line's darkness varies along the tooth of the paper, 0-1
    blur: float = 0.0  # sigma, pixels
    quality: int | None = None  # of JPEG; None for PNG
    alpha: bool = False  # ink on a transparent ground


MEDIA = (
    Medium("screen"),
    Medium("brush", alpha=True, ink=0.1),
    Medium("scan", paper=0.94, ink=0.15, grain=0.012, blur=0.7, quality=85),
    Medium("phone", paper=0.8, ink=0.2, light=0.35, shadow=0.35, grain=0.02, blur=1.0, quality=80),
    Medium("pencil", paper=0.82, ink=0.5, light=0.25, shadow=0.25, grain=0.025, tooth=0.5, blur=0.8, quality=80),
)


def drawn(sketch: Sketch, size: int, pen: float, *, taper: bool = False) -> tuple[Float[np.ndarray, "row col"], float, Float[np.ndarray, " 2"]]:
    """(cover 0-1, pixels a sketch unit, left and top edge in sketch units) of a drawing `size` pixels high or wide.

    `pen` is the width of its lines, pixels; with `taper` longer strokes are up to twice as wide.
    """
    points = np.concatenate([stroke.points for stroke in sketch.strokes])
    low, high = points.min(0), points.max(0)
    side = float((high - low).max())
    scale = size / (side * (1 + 2 * MARGIN))
    corner = np.array([low[0], high[1]]) + MARGIN * side * np.array([-1.0, 1.0])
    shape = np.ceil(((high - low) + 2 * MARGIN * side) * scale).astype(int)
    image = Image.new("L", (int(shape[0]) * FINER, int(shape[1]) * FINER))
    brush = ImageDraw.Draw(image)
    longest = max(float(shapely.LineString(s.points).length) for s in sketch.strokes if len(s.points) > 1)
    for stroke in sketch.strokes:
        at = (stroke.points - corner) * (scale, -scale) * FINER
        at = np.vstack([at, at[:1]]) if stroke.closed else at
        length = float(np.hypot(*np.diff(stroke.points, axis=0).T).sum())
        width = pen * FINER * (1 + (length / longest if taper and stroke.kind == StrokeKind.BRANCH else 0.0))
        brush.line([tuple(p) for p in at], fill=255, width=max(1, round(width)), joint="curve")
        for x, y in at[[0, -1]]:
            brush.ellipse([x - width / 2, y - width / 2, x + width / 2, y + width / 2], fill=255)
    return np.asarray(image.reduce(FINER), np.float32) / 255.0, scale, corner


def on_medium(cover: Float[np.ndarray, "row col"], medium: Medium, seed: int = 0) -> bytes:
    """The picture file of a drawing's cover."""
    rng = np.random.default_rng(seed)
    if medium.alpha:
        tone = np.full((*cover.shape, 2), round(255 * medium.ink), np.uint8)
        tone[..., 1] = np.round(255 * cover)
        return _encoded(Image.fromarray(tone), None)
    if medium.tooth:
        tooth = gaussian_filter(rng.normal(size=cover.shape), 1.2)
        cover = cover * np.clip(1 - medium.tooth * 0.5 * (1 + tooth / tooth.std()), 0.1, 1)
    g = medium.paper * (1 - cover * (1 - medium.ink / medium.paper))
    y, x = np.mgrid[: cover.shape[0], : cover.shape[1]] / max(cover.shape)
    g = g * (1 - medium.light * (x + y) / 2)
    if medium.shadow:
        g = g * (1 - medium.shadow / (1 + np.exp(-(x + 0.4 * y - 0.75) / 0.02)))
    if medium.blur:
        g = gaussian_filter(g, medium.blur)
    g = g + medium.grain * rng.normal(size=g.shape)
    return _encoded(Image.fromarray(np.clip(np.round(255 * g), 0, 255).astype(np.uint8)), medium.quality)


def _encoded(image: Image.Image, quality: int | None) -> bytes:
    out = io.BytesIO()
    image.save(out, "PNG") if quality is None else image.save(out, "JPEG", quality=quality)
    return out.getvalue()


@dataclass(frozen=True)
class Likeness:
    """How like the drawing what was read from its picture is."""

    found: float  # share of the drawn length that lies within NEAR of something read
    extra: float  # share of the read length that lies farther than NEAR from anything drawn
    whole: float  # share of the drawn length that the one best stroke for each drawn one covers: no limb in pieces
    pure: float  # share of the read length that lies along the one drawn stroke it fits best: no two limbs in one
    ways: float  # share of the limbs whose way to the ground passes their junction and goes on along their parent
    limbs: tuple[int, int]  # drawn, read
    crowns: tuple[int, int]  # drawn, read


def likeness(strokes: tuple[Sketch, Sketch], graphs: tuple[SketchGraph, SketchGraph], scale: float, corner) -> Likeness:
    """Compare a drawing with what was read from its picture, stroke for stroke and as graphs, the drawing first
    (`scale`, `corner` as `drawn` gave them)."""
    truth, read = graphs
    h = truth.height * scale
    true_curves = [_placed(_ring(stroke), scale, corner) for stroke in strokes[0].strokes]
    read_curves = [_ring(stroke) for stroke in strokes[1].strokes]
    found = _share_near(true_curves, read_curves, NEAR * h)
    extra = 1.0 - _share_near(read_curves, true_curves, NEAR * h)
    whole, pure = _share_of_best(true_curves, read_curves, NEAR * h), _share_of_best(read_curves, true_curves, NEAR * h)
    ways = _ways(truth, read, scale, corner, h)
    return Likeness(found, extra, whole, pure, ways, (len(truth.limb_id), len(read.limb_id)), (len(truth.crown), len(read.crown)))


def _ring(stroke: Stroke):
    return np.vstack([stroke.points, stroke.points[:1]]) if stroke.closed else stroke.points


def _placed(points, scale: float, corner):
    return (points - corner) * scale


def _share_near(curves, others, reach: float) -> float:
    lines = shapely.union_all([shapely.LineString(c) for c in others if len(c) > 1])
    total = near = 0.0
    for length, at in _along_each(curves):
        total += length
        near += length * float(np.mean(shapely.distance(at, lines) <= reach))
    return near / total


def _share_of_best(curves, others, reach: float) -> float:
    """Share of the curves' length that lies near one of the others, for each the one it keeps to longest."""
    lines = np.array([shapely.LineString(c) for c in others if len(c) > 1])
    tree = shapely.STRtree(lines)
    total = near = 0.0
    for length, at in _along_each(curves):
        total += length
        _, beside = tree.query(at, predicate="dwithin", distance=reach)
        near += length * float(np.bincount(beside, minlength=1).max()) / len(at)
    return near / total


def _along_each(curves):
    """(length, points a unit apart along it) of every curve."""
    for curve in curves:
        if len(curve) > 1:
            line = shapely.LineString(curve)
            n = max(2, int(line.length))
            yield line.length, shapely.line_interpolate_point(line, (np.arange(n) + 0.5) / n, normalized=True)


def _ways(truth: SketchGraph, read: SketchGraph, scale: float, corner, h: float) -> float:
    """From the middle of every limb down what was read: past its junction, and on along its parent."""
    rows = np.flatnonzero(~read.is_base)
    tree = shapely.STRtree([shapely.LineString(read.curve(k)) for k in rows])
    right = []
    for limb, first in enumerate(truth.limb_first):
        if truth.limb_parent[limb] < 0:
            continue
        way = _way(truth, first)
        junction, below = _placed(way[1], scale, corner), _placed(_along(way[1:], 0.04 * truth.height), scale, corner)
        chain = np.vstack([_placed(truth.curve(k), scale, corner) for k in np.flatnonzero(truth.limb == limb) if not truth.is_base[k]])
        middle = chain[len(chain) // 2]
        start = rows[tree.nearest(shapely.Point(middle))]
        down = shapely.LineString(np.vstack([read.curve(k)[::-1] for k in _rows_down(read, start)]))
        near = shapely.distance(down, shapely.points([middle, junction, below])) <= PASSES * h
        right.append(bool(near.all()))
    return float(np.mean(right)) if right else 1.0


def _rows_down(graph: SketchGraph, row: int) -> list[int]:
    rows = []
    while not graph.is_base[row]:
        rows.append(row)
        row = graph.parent[row]
    return rows


def _way(graph: SketchGraph, row: int):
    """Tip of the row, its foot, and on down to the ground."""
    rows = _rows_down(graph, row)
    return np.vstack([graph.xy[row], graph.start[row], *(graph.curve(k)[-2::-1] for k in rows[1:])])


def _along(points, length: float):
    s = np.r_[0.0, np.cumsum(np.hypot(*np.diff(points, axis=0).T))]
    at = min(length, s[-1])
    return np.array([np.interp(at, s, points[:, k]) for k in (0, 1)])
