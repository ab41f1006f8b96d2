"""What speaks for and against a stroke's growing from another? One row of figures for every arc.

An arc is an end p of line i and the nearest point q of line j. Lengths are parts of H, the height of the drawing; ε is
how exactly this hand starts its strokes; r is the foot of the likeliest stem.

    gap         |p − q|; within the half width of j a third of it counts; 0 where i crosses j within OVERSHOOT of p
    miss        |p − q|, within the half width of j a third of it, also where i crosses j: at an acute angle far less than `over`; the caller makes of it the slip, miss / ε, once it knows ε
    over        how far before that crossing i was begun
    rise        Δy / |i| from i's other end up to p: branches rise more often than they fall
    outward     (|tip − r| − |p − r|) / |i|: branches lead away from the stem's foot
    longer      log |i| / |j|
    size        log |j|: a longer line carries more
    carries     how many other ends have j for their nearest
    aim, aimed  how far ahead of p the line, continued straight backward, meets j (`aims`): going by its first 2 or 5 % of H
    beside      how far i has got from j after BESIDE of its length, over that length: small where they run side by side
    turn        angle between i leaving p and j going on from q, radians, over REACH
    sweep       the same over FAR
    at_tip      that turn, where q is at j's tip (fading out within TIP)
    foot        length along j from its foot to q
    tip         length along j from q to its tip
    place       foot / (foot + tip)
    thicker     log w_i / w_j of the drawn widths, where they say something
    thins       log of i's drawn width toward its other end over that toward p, where it has more of it there: limbs taper to their tips
    before      1 if i was begun before j was, where the strokes have times

`turn` to `place` depend on which end of j is its foot: column 0 if it is j's first point, 1 if its last.
"""

from dataclasses import dataclass

import numpy as np
import shapely
from jaxtyping import Float, Int

from sketchtree.sketch.joining.aims import FAR as FAR_BACK
from sketchtree.sketch.joining.aims import NEAR, aims
from sketchtree.sketch.joining.bundle import Bundle
from sketchtree.sketch.joining.lines import angle_between

REACH, FAR, BESIDE = 0.03, 0.09, 0.05  # of H
TIP = 0.02  # of H
OVERSHOOT = 0.025  # of H
PRECISE, COARSE = 0.0025, 0.03  # of H: bounds of ε


@dataclass(frozen=True, eq=False)
class Places:
    """Where every arc leads: line `child` by its `end` (0 first, 1 last point) to `parent` at length `s`."""

    child: Int[np.ndarray, " arc"]
    end: Int[np.ndarray, " arc"]
    parent: Int[np.ndarray, " arc"]
    s: Float[np.ndarray, " arc"]  # length along the parent as drawn
    gap: Float[np.ndarray, " arc"]  # distance, sketch units


def evidence(bundle: Bundle, arcs: Places, root: Float[np.ndarray, " 2"]) -> dict[str, Float[np.ndarray, "arc side"]]:
    """Every figure of every arc but the slip, one column, or two for those that depend on the parent's foot."""
    h, child, parent, length = bundle.height, arcs.child, arcs.parent, bundle.length
    row = 2 * child + arcs.end
    over = overshoots(bundle, arcs)
    inside = np.minimum(arcs.gap, 0.5 * np.nan_to_num(bundle.width[parent]))
    miss = arcs.gap - 0.65 * inside
    gap = np.where(over >= 0, 0.0, miss)
    foot, tip = bundle.ends[row], bundle.ends[row ^ 1]
    figures = {
        "gap": gap / h,
        "over": np.maximum(over, 0.0) / h,
        "miss": miss / h,
        "rise": (foot - tip)[:, 1] / length[child],
        "outward": (_away(tip, root) - _away(foot, root)) / length[child],
        "longer": np.log(length[child] / length[parent]),
        "size": np.log(length[parent] / h),
        "carries": _carries(bundle, arcs, row),
        "beside": _beside(bundle, arcs, row),
        "aim": aims(bundle, row, arcs.parent, arcs.gap, NEAR),
        "aimed": aims(bundle, row, arcs.parent, arcs.gap, FAR_BACK),
        "thicker": np.nan_to_num(np.log(bundle.width[child] / bundle.width[parent]), nan=-np.inf),
        "thins": np.maximum(bundle.thicker_away()[row], 0.0),
        "before": (bundle.time[child] < bundle.time[parent]).astype(float),
    }
    return {name: figure[:, None] for name, figure in figures.items()} | _turned(bundle, arcs, row)


def _away(points, root) -> Float[np.ndarray, " arc"]:
    return np.hypot(points[:, 0] - root[0], points[:, 1] - root[1])


def _turned(bundle: Bundle, arcs: Places, row) -> dict[str, Float[np.ndarray, "arc 2"]]:
    h, length = bundle.height, bundle.length[arcs.parent]
    foot = np.stack([arcs.s, length - arcs.s], 1)
    turn, sweep = (_angles(bundle, arcs, row, reach * h) for reach in (REACH, FAR))
    near = np.clip(1 - foot[:, ::-1] / (TIP * h), 0.0, 1.0)
    place = foot / length[:, None]
    return {"turn": turn, "sweep": sweep, "at_tip": turn * near, "foot": foot / h, "tip": foot[:, ::-1] / h, "place": place}


def _angles(bundle: Bundle, arcs: Places, row, reach: float) -> Float[np.ndarray, "arc 2"]:
    short = np.minimum(reach, 0.4 * bundle.length)
    forward = bundle.direction(arcs.parent, arcs.s, short[arcs.parent])
    angle = angle_between(bundle.leaving(short)[row], forward)
    return np.stack([angle, np.pi - angle], 1)


def _carries(bundle: Bundle, arcs: Places, row) -> Float[np.ndarray, " arc"]:
    nearest = np.full(2 * len(bundle), -1)
    order = np.lexsort((-arcs.parent, -arcs.gap))
    nearest[row[order]] = arcs.parent[order]
    count = np.bincount(nearest[nearest >= 0], minlength=len(bundle))
    return count[arcs.parent] - (nearest[row] == arcs.parent).astype(float)


def _beside(bundle: Bundle, arcs: Places, row) -> Float[np.ndarray, " arc"]:
    reach = np.minimum(BESIDE * bundle.height, 0.5 * bundle.length)
    point = bundle.at(np.repeat(np.arange(len(bundle)), 2), np.stack([reach, bundle.length - reach], 1).ravel())
    return shapely.distance(shapely.points(point)[row], bundle.shapes[arcs.parent]) / reach[arcs.child]


def overshoots(bundle: Bundle, arcs: Places) -> Float[np.ndarray, " arc"]:
    """How far before its crossing with the parent a child was begun, sketch units; -1 where its foot does not cross it."""
    over = np.full(len(arcs.child), -1.0)
    reach = np.minimum(OVERSHOOT * bundle.height, 0.3 * bundle.length)
    close = np.flatnonzero(arcs.gap <= reach[arcs.child])
    if len(close) == 0:
        return over
    feet, index = np.unique(2 * arcs.child[close] + arcs.end[close], return_inverse=True)
    stub, parent = _stubs(bundle, feet // 2, feet % 2, reach[feet // 2])[index], bundle.shapes[arcs.parent[close]]
    met = np.flatnonzero(shapely.intersects(stub, parent))
    crossing = shapely.intersection(stub[met], parent[met])
    over[close[met]] = shapely.hausdorff_distance(bundle.end_shapes[feet[index[met]]], crossing)
    return over


def _stubs(bundle: Bundle, line, end, reach) -> np.ndarray:
    """The first piece of every line from an end, `reach` long, for shapely."""
    part = np.linspace(0.0, 1.0, 9)[None] * reach[:, None]
    s = np.where(end[:, None] == 0, part, bundle.length[line][:, None] - part)
    return shapely.linestrings(bundle.at(np.repeat(line[:, None], 9, 1), s))


def first_slip(bundle: Bundle, arcs: Places) -> float:
    """ε before anything is attached, part of H: twice the middle distance of a line to the nearest other."""
    nearest = np.full(len(bundle), np.inf)
    np.minimum.at(nearest, arcs.child, arcs.gap)
    known = nearest[np.isfinite(nearest)]
    return _bounded(2 * float(np.median(known)) / bundle.height if len(known) else 0.0)


def slip_of(gaps: Float[np.ndarray, " stroke"]) -> float:
    """ε of strokes whose gaps (parts of H) are known: what three in four keep to."""
    return _bounded(float(np.quantile(gaps, 0.75)) if len(gaps) else 0.0)


def _bounded(slip: float) -> float:
    return float(np.clip(slip, PRECISE, COARSE))
