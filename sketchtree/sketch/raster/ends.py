"""Where do lines truly begin and end? Thinning takes away the ends of thick ones, and a pen leaves gaps.

A thinned line stops half its width before a blunt end: it is drawn straight on through the ink, to half a pen before the
paper. Two free ends that point at each other across at most GAP pens are one line, across PALE pens if the gap is darker than the
paper as a pencil's faint touch is; so are short dashes in a row, whose gaps are as long as themselves.
"""

import numpy as np
from jaxtyping import Bool, Float
from scipy.ndimage import map_coordinates
from scipy.spatial import cKDTree

from sketchtree.sketch.raster.ink import Ink
from sketchtree.sketch.raster.lines_of import Traced, end_direction

GAP = 3.0  # pens between two ends of one line
PALE = 8.0  # pens, where ink too pale to be followed fills the gap …
TOUCH = (0.1, 0.7)  # … of the darkness of a good line at least, and of the grain: the middle of what lies between
DASH = 1.6  # of the shorter line's length: the gap in a row of dashes
TOWARDS = np.radians(32)  # greatest angle between an end and the other one
HEADING = 3.0  # widths over which it is seen where an end points
DASHES = 12.0  # pens: a longer line is no dash
STEPS = 4.0  # half widths: how far an end is drawn on at most


def drawn_on(lines: list[Traced], mask: Bool[np.ndarray, "row col"], pen: float) -> None:
    """Lengthen the free ends of thick lines through the ink, in place."""
    for line in lines:
        for side in (0, 1):
            if line.joints[side] >= 0 or line.closed:
                continue
            half = 0.5 * float(line.width[0 if side == 0 else -1])
            reach = _through(mask, line.points[0 if side == 0 else -1], end_direction(line, side), STEPS * half + pen)
            more = reach - 0.5 * min(pen, 2 * half)
            if more > 0.35 * pen:
                line.grow(side, (line.points[0 if side == 0 else -1] + more * end_direction(line, side))[None])


def _through(mask: Bool[np.ndarray, "row col"], start, direction, most: float) -> float:
    """How far the ink goes on from a point in a direction, pixels."""
    steps = np.arange(0.0, most, 0.5)
    at = np.floor(start + steps[:, None] * direction).astype(int)
    inside = (at >= 0).all(1) & (at[:, 0] < mask.shape[1]) & (at[:, 1] < mask.shape[0])
    ink = np.zeros(len(at), bool)
    ink[inside] = mask[at[inside, 1], at[inside, 0]]
    return float(steps[np.argmin(ink)]) if not ink.all() else float(most)


def bridged(lines: list[Traced], pen: float, *, ink: Ink | None = None) -> list[Traced]:
    """Join the lines whose free ends point at each other across a gap; with the `ink` also over pale gaps, and dashes in a row."""
    ends = [(k, side) for k, line in enumerate(lines) if not line.closed for side in (0, 1) if line.joints[side] < 0]
    if len(ends) < 2:
        return lines
    place = np.array([lines[k].points[0 if side == 0 else -1] for k, side in ends])
    out = np.array([end_direction(lines[k], side, HEADING) for k, side in ends])
    length = np.array([lines[k].length for k, _ in ends])
    dash = np.array([ink is not None and lines[k].joints == (-1, -1) for k, _ in ends]) & (length <= DASHES * pen)
    reach = np.where(dash, np.maximum(GAP * pen, DASH * length), GAP * pen)
    pairs = cKDTree(place).query_pairs(float(max(reach.max(), PALE * pen if ink else 0.0)), output_type="ndarray")
    if len(pairs) == 0:
        return lines
    a, b = pairs.T
    apart = place[b] - place[a]
    far = np.maximum(np.hypot(*apart.T), 1e-9)
    lean = np.stack([_angle(out[a], apart), _angle(out[b], -apart)]).max(0)
    own = np.array([k for k, _ in ends])
    near = far <= np.minimum(reach[a], reach[b])
    if ink is not None:
        near |= (far <= PALE * pen) & _touched(ink, place[a], place[b])
    fits = near & (lean <= TOWARDS) & (own[a] != own[b])
    fits |= (far <= 1.2 * pen) & (own[a] != own[b]) & (_angle(out[a], -out[b]) <= 2 * TOWARDS)
    price = np.round(far * (1 + lean), 6)
    mate: dict[int, int] = {}
    for k in np.lexsort((b, a, price)):
        if fits[k] and a[k] not in mate and b[k] not in mate:
            mate[int(a[k])], mate[int(b[k])] = int(b[k]), int(a[k])
    return _joined(lines, ends, mate)


def _touched(ink: Ink, one: Float[np.ndarray, "pair 2"], two: Float[np.ndarray, "pair 2"]) -> Bool[np.ndarray, " pair"]:
    """Whether a faint touch of the pen fills the gap between two points."""
    t = np.linspace(0.2, 0.8, 13)
    x, y = np.moveaxis(one[:, None] + t[:, None] * (two - one)[:, None], 2, 0)
    between = np.median(map_coordinates(ink.d, [y - 0.5, x - 0.5], order=1, mode="nearest"), axis=1)
    return between >= max(TOUCH[0] * ink.contrast, TOUCH[1] * ink.grain)


def _angle(a: Float[np.ndarray, "row 2"], b: Float[np.ndarray, "row 2"]) -> Float[np.ndarray, " row"]:
    return np.abs(np.arctan2(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0], (a * b).sum(1)))


def _joined(lines: list[Traced], ends: list[tuple[int, int]], mate: dict[int, int]) -> list[Traced]:
    """The lines with their paired ends joined, chain by chain."""
    partner = {ends[one]: ends[two] for one, two in mate.items()}
    done = np.zeros(len(lines), bool)
    result = []
    starts = [(k, side) for k in range(len(lines)) for side in (0, 1) if (k, side) not in partner]
    for start in starts + [(k, 0) for k in range(len(lines))]:
        if done[start[0]]:
            continue
        chain, here = [], start
        while here is not None and not done[here[0]]:
            done[here[0]] = True
            chain.append(lines[here[0]] if here[1] == 0 else lines[here[0]].reversed())
            here = partner.get((here[0], 1 - here[1]))
        result.append(chain[0] if len(chain) == 1 else _chained(chain, here is not None))
    return result


def _chained(chain: list[Traced], ring: bool) -> Traced:
    points, width = np.concatenate([c.points for c in chain]), np.concatenate([c.width for c in chain])
    joints = (-1, -1) if ring else (chain[0].joints[0], chain[-1].joints[1])
    return Traced(points, width, ring, joints, frozenset().union(*(c.passes for c in chain)))
