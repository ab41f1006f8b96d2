"""Which limbs are drawn by their outlines? Long narrow paper between two lines of the pen, filled so that it thins to its middle.

The paper that the ink encloses falls into regions. With R the radius of the largest disc in a region and P the length of
its border, a limb has P / 4R ≥ LIMB (a disc has π/2, a square 2). Crossing branches enclose slender regions too, but they
end in a corner at the foot, and others stand beside them. What tells an outline is the trunk: a slender region low in the drawing,
about as wide at its foot as further up, with nothing drawn near either side, and not a corner between two lines that cross at its top. From it the regions that touch it across one line
are followed, as long as they are limbs and narrower. Outlines left open, at the foot or at a tip, are closed where
two free ends lie side by side.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Float, Int
from scipy.ndimage import binary_dilation, distance_transform_edt, find_objects, label
from skimage.draw import line as pixels_between

from sketchtree.sketch.raster.crossing import arm, crossings
from sketchtree.sketch.raster.tracing import Web

LIMB = 3.2  # least P / 4R of a limb …
TRUNK = 2.4  # … and of the trunk
WIDE = 0.22  # of the drawing's height: a trunk is narrower
HIGH = 0.15  # of the drawing's height: a trunk is longer
FOOT = 0.35  # of the drawing's height: the trunk's lower end is lower
FLAT = 0.55  # of the trunk's middle width: least width at its foot
UPRIGHT = 1.2  # of its middle width: least height of a trunk
LEVELS = (0.04, 0.5)  # of the trunk's height: where its foot is measured, and up to where it stands alone
CORNER = 0.65  # of its width at the foot: half way up, a region below a crossing is no wider
GOES_ON = 0.5  # of that width: lines that cross go on for longer; sides that meet at a tip may overshoot it
ALONE = 0.6  # least share of the rows of its lower half in which nothing stands within its own width of it
THIN = 0.03  # of the drawing's height: a line wider than this is a limb, no outline's
CAP = 0.18  # of the drawing's height: free ends side by side are no farther apart
ASIDE = 0.5  # cosine: ends side by side point the same way, across the line between them
NARROWER = 0.95  # a limb's greatest width, of that of the limb it grows from, at most
ACROSS = 2.5  # pens: regions on both sides of a line are no farther apart


@dataclass(frozen=True, eq=False)
class Filled:
    """The ink with the outlined limbs filled."""

    mask: Bool[np.ndarray, "row col"]
    inside: Bool[np.ndarray, "row col"]  # what was paper


def filled_outlines(mask: Bool[np.ndarray, "row col"], web: Web, pen: float) -> Filled | None:
    """Fill the limbs drawn by their outlines; None where there are none. `web` is that of the same ink."""
    rows = np.flatnonzero(mask.any(1))
    if len(rows) == 0:
        return None
    top, bottom = rows[0], rows[-1] + 1
    height = max(float(bottom - top), float(np.ptp(np.flatnonzero(mask.any(0)))) + 1.0)
    if pen > THIN * height:
        return None
    caps = _caps(mask.shape, web, height, pen)
    labels, count = label(~(mask | caps))
    if count < 2:
        return None
    width, slender, outside = _measures(labels, count)
    boxes = find_objects(labels)
    low = np.array([box[0].stop for box in boxes])
    tall = np.array([box[0].stop - box[0].start for box in boxes])
    limb = ~outside & (width >= 0.7 * pen) & (width <= WIDE * height)
    trunk = limb & (slender >= TRUNK) & (tall >= HIGH * height) & (low >= bottom - FOOT * height)
    crossed = crossings(web, pen) if trunk.any() else np.zeros((0, 3))
    for k in np.flatnonzero(trunk):
        trunk[k] = _is_trunk(labels, boxes[k], k + 1, mask, pen) and not _below(labels, boxes[k], k + 1, crossed, pen)
    if not trunk.any():
        return None
    taken = _follow(labels, boxes, trunk, np.where(limb & (slender >= LIMB), width, np.inf), width, pen)
    inside = np.r_[False, taken][labels]
    return Filled(mask | inside | (caps & binary_dilation(inside, iterations=2)), inside)


def _is_trunk(labels, box, number: int, mask: Bool[np.ndarray, "row col"], pen: float) -> bool:
    """Whether a region is as wide at its foot as further up and stands alone there."""
    rows = np.arange(box[0].start, box[0].stop)[::-1]  # from the foot up
    inside = labels[rows, box[1]] == number
    first = box[1].start + inside.argmax(1)
    last = box[1].stop - 1 - inside[:, ::-1].argmax(1)
    width = inside.sum(1)
    middle = float(np.median(width))
    foot, half = max(1, round(LEVELS[0] * len(rows))), max(2, round(LEVELS[1] * len(rows)))
    if width[foot] < FLAT * middle or len(rows) < UPRIGHT * middle:
        return False
    alone = 0
    for k in range(half):
        edge, away = round(ACROSS * pen), round(ACROSS * pen + middle)
        left = mask[rows[k], max(first[k] - away, 0) : max(first[k] - edge, 0)]
        right = mask[rows[k], last[k] + 1 + edge : last[k] + 1 + away]
        alone += not (left.any() or right.any())
    return alone >= ALONE * half


def _below(labels, box, number: int, crossed: Float[np.ndarray, "place 3"], pen: float) -> bool:
    """Whether a region is the corner below a crossing: it ends there, narrows towards it all the way, and both lines go on."""
    inside = labels[box] == number
    width = inside.sum(1)
    foot = float(np.median(width[-max(1, len(width) // 10) :]))
    top = np.array([box[1].start + np.flatnonzero(inside[0]).mean(), box[0].start]) + 0.5
    near = (np.hypot(*(crossed[:, :2] - top).T) <= 2 * ACROSS * pen) & (crossed[:, 2] >= GOES_ON * foot)
    return bool(near.any() and width[len(width) // 2] <= CORNER * foot)


def _measures(labels: Int[np.ndarray, "row col"], count: int):
    """(greatest width 2R, P / 4R, touches the picture's border) of every region of paper."""
    depth = distance_transform_edt(np.pad(labels > 0, 1))[1:-1, 1:-1]
    index = np.arange(1, count + 1)
    radius = np.zeros(count + 1)
    np.maximum.at(radius, labels.ravel(), depth.ravel())
    radius = radius[1:]
    border = np.bincount(labels[(depth > 0) & (depth < 1.5)], minlength=count + 1)[1:]
    rim = np.concatenate([labels[0], labels[-1], labels[:, 0], labels[:, -1]])
    return 2.0 * radius, border / np.maximum(4.0 * radius, 1.0), np.isin(index, rim)


def _caps(shape: tuple[int, int], web: Web, height: float, pen: float) -> Bool[np.ndarray, "row col"]:
    """Lines between free ends that lie side by side, each with the nearest such end."""
    ends = [(node, key) for node in sorted(web.at) if web.degree(node) == 1 for key in web.at[node]]
    caps = np.zeros(shape, bool)
    if len(ends) < 2:
        return caps
    place = np.array([web.place[node] for node, _ in ends])
    arms = [arm(web.edges[key], 0 if web.edges[key].a == node else 1, pen, 0.0) for node, key in ends]
    out = -np.array([(one.dx, one.dy) for one in arms])
    nearest = _side_by_side(place, out, CAP * height)
    for one, two in enumerate(nearest.tolist()):
        if two > one and nearest[two] == one:
            (x0, y0), (x1, y1) = np.floor(place[[one, two]]).astype(int)
            caps[pixels_between(y0, x0, y1, x1)] = True
    return binary_dilation(caps) if caps.any() else caps


def _side_by_side(place: Float[np.ndarray, "end 2"], out: Float[np.ndarray, "end 2"], reach: float) -> Int[np.ndarray, " end"]:
    """For every end the nearest one that lies beside it and points the same way; -1 for none."""
    chosen = np.full(len(place), -1)
    for k in range(len(place)):
        apart = place - place[k]
        far = np.hypot(*apart.T)
        along = np.abs(apart @ out[k]) / np.maximum(far, 1e-9)
        fits = (far > 0) & (far <= reach) & (out @ out[k] >= ASIDE) & (along <= 1 - ASIDE)
        if fits.any():
            chosen[k] = int(np.argmin(np.where(fits, far, np.inf)))
    return chosen


def _follow(labels, boxes, trunk: Bool[np.ndarray, " region"], limb: Float[np.ndarray, " region"], width, pen: float):
    """Mask of the trunk and of every limb (width, ∞ for others) that touches, across one line, something taken that is wider."""
    taken, waiting = trunk.copy(), np.flatnonzero(trunk).tolist()
    reach = max(1, int(np.ceil(ACROSS * pen)))
    while waiting:
        here = waiting.pop()
        window = tuple(slice(max(side.start - reach, 0), side.stop + reach) for side in boxes[here])
        near = distance_transform_edt(labels[window] != here + 1) <= reach
        beside = np.setdiff1d(labels[window][near], (0, here + 1)) - 1
        new = beside[(limb[beside] <= NARROWER * width[here]) & ~taken[beside]]
        taken[new] = True
        waiting += new.tolist()
    return taken
