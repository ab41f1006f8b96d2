"""Which of what is opaque is limb, and which twigs? Limb is where much runs through on its way to the ground.

The twigs of a tree in winter are finer than pixels: its matte is a veil of specks and holes, whose contour says nothing, and whose medial axis runs round every hole. Ours, beside the paper, after how rivers are found in
heights: every pixel of the trunk is joined to the ground by its cheapest way,

    cost of a pixel   1 / ((e + ½) ā³)        e   distance to the edge, small holes filled        ā   alpha, smoothed by a pixel

and the opacity of all pixels runs down these ways, which hang together as a tree. A limb is where at least `LEAST` of the trunk's height, in pixels², runs through (in a veil `VEILED` times that), and goes on from there by
its largest tributary until hardly anything is left. What lies within a limb's thickness of its way stays in the trunk; twigs are left out. As thick as its matte is wide a limb is only where that is no veil:

    in a veil    r ≤ `SPARE` R (flow / flow at the ground)^(1/2)        R of the stem; the pipe model        a veil: small holes are `HOLES` of it and more

Where hardly anything shows through there is no veil: a clean silhouette stays as it is.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Float, Int
from scipy import ndimage
from skimage.graph import MCP_Geometric

from sketchtree.trunk.foot import stands_at

LEAST = 0.08  # pixels² a pixel of the trunk's height
ENDS = 0.125  # of that, until which a limb goes on
VEILED = 3.0
HOLES = 0.05
CLEAN = 0.001  # of a piece: so few small holes are no veil
SPARE = 1.0
PIPES = 2.0
STEM = 0.8  # of the flow at the ground: where so much runs through is the stem
_NEAR = 6.0  # pixels, σ of what is near by
_LOOSE, _AROUND = 1.15, 1.0  # of a limb's thickness, and pixels: what stays round its way
_HANGS = 1.5  # pixels: thinner limbs in a veil are made two pixels wide, so that their axis hangs together
_THIN = 0.2  # of a veil, from which on limbs may hang by less than a pixel
_FAINTEST = 0.05  # alpha, in the cost of a way


@dataclass(frozen=True, eq=False)
class Drainage:
    """How every pixel of a piece runs to the ground. Pixels are numbered row by row."""

    order: Int[np.ndarray, " pixel"]  # pixels that are reached, the farthest first
    onward: Int[np.ndarray, " pixel"]  # the pixel that each of them runs to; −1 at the ground
    flow: Float[np.ndarray, "row column"]  # opacity that runs through, pixels²


def drained(alpha: Float[np.ndarray, "row column"], piece: Bool[np.ndarray, "row column"], filled: Bool[np.ndarray, "row column"], start: tuple[int, int] | None = None) -> Bool[np.ndarray, "row column"]:
    """The limbs of a piece. `filled`: the piece without its small holes; `start`: row and column where it stands (None: the middle of its foot)."""
    if np.count_nonzero(filled & ~piece) <= CLEAN * np.count_nonzero(piece):
        return filled
    room = ndimage.distance_transform_edt(filled)
    start = _foot(piece, room) if start is None else start
    water = drainage(alpha, piece, room, start)
    near = np.maximum(ndimage.gaussian_filter(filled.astype(np.float64), _NEAR, mode="constant"), 1e-6)
    veil = np.clip(ndimage.gaussian_filter((filled & ~piece).astype(np.float64), _NEAR, mode="constant") / near / HOLES, 0.0, 1.0)
    high = float(np.ptp(np.flatnonzero(piece.any(axis=1)))) + 1.0
    ways = _ways(water, LEAST * high * (1.0 + (VEILED - 1.0) * veil)) & piece
    whole = float(water.flow[start])
    stem = float(np.median(room[ways & (water.flow >= STEM * whole)]))
    thin = np.minimum(room, SPARE * stem * (water.flow / max(whole, 1e-9)) ** (1.0 / PIPES))
    kept = filled & around(ways, (1.0 - veil) * (_LOOSE * room + _AROUND) + veil * thin)
    return kept | ndimage.binary_dilation(ways & (room < _HANGS) & (veil > _THIN), structure=np.ones((2, 2)))


def drainage(alpha, piece, room, start: tuple[int, int]) -> Drainage:
    """How a piece runs to where it stands."""
    solid = np.maximum(ndimage.gaussian_filter(alpha, 1.0), _FAINTEST)
    walk = MCP_Geometric(np.where(piece, 1.0 / ((room + 0.5) * solid**3), -1.0))
    far, came = walk.find_costs([start])
    reached = np.flatnonzero(np.isfinite(far) & piece)
    order = reached[np.argsort(-far.ravel()[reached], kind="stable")]
    steps = np.array([row * piece.shape[1] + column for row, column in walk.offsets])
    by = came.ravel()[order]
    onward = np.where(by >= 0, order - steps[np.maximum(by, 0)], -1)
    flow = np.where(piece, alpha, 0.0).ravel().tolist()
    for here, there in zip(order.tolist(), onward.tolist(), strict=True):
        if there >= 0:
            flow[there] += flow[here]
    found = np.zeros(piece.size)
    found[order] = np.array(flow)[order]
    return Drainage(order, onward, found.reshape(piece.shape))


def _ways(water: Drainage, least: Float[np.ndarray, "row column"]) -> Bool[np.ndarray, "row column"]:
    """The ways of limbs: where enough runs through, and on from there by the largest tributaries."""
    flow, enough = water.flow.ravel(), least.ravel()
    kept = flow >= enough
    largest = np.full(flow.size, -1)
    rising = water.order[np.argsort(flow[water.order], kind="stable")]
    onward = np.full(flow.size, -1)
    onward[water.order] = water.onward
    largest[onward[rising[:-1]]] = rising[:-1]  # of several tributaries the last, which is the largest, stays; the ground, the largest of all, runs nowhere
    for end in np.flatnonzero(kept & (largest >= 0) & ~kept[largest]).tolist():
        at = end
        while largest[at] >= 0 and flow[largest[at]] >= ENDS * enough[end]:
            at = int(largest[at])
            kept[at] = True
    return kept.reshape(water.flow.shape)


def around(ways: Bool[np.ndarray, "row column"], radius: Float[np.ndarray, "row column"]) -> Bool[np.ndarray, "row column"]:
    """The pixels within the circle of the nearest pixel of the ways."""
    away, (row, column) = ndimage.distance_transform_edt(~ways, return_indices=True)
    return away <= np.ceil(2.0 * radius[row, column]) / 2.0


def _foot(piece, room) -> tuple[int, int]:
    rows, columns = np.nonzero(piece)
    at = stands_at(np.column_stack([columns, rows]).astype(np.float64), room[rows, columns])
    return int(rows[at]), int(columns[at])
