"""How like the true tree is what was grown into its first orders? Figures of the undrawn part; heights and lengths over H.

With N tips in all, n_b of the true tree and m_b of the grown one in bin b:

    length     Wasserstein-1 between the lengths of undrawn pieces from fork to fork
    angle      the same between divergence angles where undrawn limbs start, degrees
    height     Σ_b |m_b − n_b| / Σ_b n_b over ten bins of height (the bar's "tips per height bin")
    radius     the same over ten bins of distance from the trunk's axis
    rise, way  Wasserstein-1 of the tips' heights and of their distances from the axis
    density    Σ_b |m_b − n_b| / Σ_b n_b over 5 × 4 bins of both: tips per volume, as both trees have the same bins
    sky        mean IoU of the crown's silhouette from eight sides: branches thickened by `_THICK`, gaps closed by `_CLOSED`
    gap        largest empty azimuth sector of the whole tree seen from above, degrees
"""

import numpy as np
from jaxtyping import Bool, Float
from scipy import ndimage

from benchmarks.metrics import wasserstein
from sketchtree.skeleton import TreeSkeleton
from sketchtree.traverse import child_count, generations, is_tip, limb_chains

NAMES = ("length", "angle", "height", "radius", "rise", "way", "density", "sky", "gap")
_BINS = 10
_SIDES = 8
_GRID = 96  # raster cells per H
_THICK = 0.03  # H
_CLOSED = 0.06  # H: gaps in the crown that are narrower than twice this are filled
_CHORD = 0.03  # H
_COUNTS = 0.5  # of the 90th percentile of reach: what is nearer to the axis closes no gap


def compare(true: TreeSkeleton, true_new: Bool[np.ndarray, " segment"], grown: TreeSkeleton, grown_new: Bool[np.ndarray, " segment"]) -> dict:
    """Every figure of NAMES; `…_new` marks the rows that were not drawn. Both trees have the same frame, base at the origin."""
    height = true.height
    t, g = (Undrawn(tree, new, height) for tree, new in ((true, true_new), (grown, grown_new)))
    bins = np.linspace(0.0, 1.0, _BINS + 1)
    far = np.linspace(0.0, max(np.quantile(t.way, 0.99), 1e-9), _BINS + 1)
    return {
        "length": wasserstein(t.pieces, g.pieces),
        "angle": wasserstein(t.angles, g.angles),
        "height": _relative(t.rise, g.rise, bins),
        "radius": _relative(t.way, g.way, far),
        "rise": wasserstein(t.rise, g.rise),
        "way": wasserstein(t.way, g.way),
        "density": _relative_2d(t, g, bins[::2], np.linspace(0.0, far[-1], 5)),
        "sky": silhouettes(true, grown, height),
        "gap": largest_gap(grown),
    }


class Undrawn:
    """What was not drawn of one tree, measured once."""

    def __init__(self, tree: TreeSkeleton, new: Bool[np.ndarray, " segment"], height: float):
        tips = tree.tip[new & is_tip(tree.parent)]
        self.rise = np.clip(tips[:, 1] / height, 0.0, 1.0 - 1e-9)
        self.way = np.hypot(tips[:, 0], tips[:, 2]) / height
        self.pieces = pieces(tree, new) / height
        self.angles = angles(tree, new, height)


def pieces(tree: TreeSkeleton, new) -> Float[np.ndarray, " piece"]:
    """Lengths from fork to fork, or to the tip, of the marked rows."""
    along, whole = tree.length.copy(), child_count(tree.parent) != 1
    for rows in generations(tree.parent)[1:]:
        above = tree.parent[rows]
        goes_on = ~whole[above] & new[rows] & new[above]
        along[rows[goes_on]] += along[above[goes_on]]
    return along[whole & new]


def angles(tree: TreeSkeleton, new, height: float) -> Float[np.ndarray, " limb"]:
    """Degrees between the first `_CHORD` H of every marked lateral and the last `_CHORD` H of the limb that it grows from (or what
    there is of them): trees are digitised in steps of .5 to 5 % of their height, and the very first step from a limb's axis to
    its bark says nothing of where the lateral goes."""
    chord = _CHORD * height
    rows = {int(chain[0]): chain for chain in limb_chains(tree.parent, tree.limb)}
    found = []
    for first, chain in rows.items():
        above = tree.parent[first]
        if above < 0 or not new[first] or tree.is_base[above]:
            continue
        origin, out, back = tree.tip[above], tree.tip[chain], [tree.tip[above]]
        row = above
        while not tree.is_base[row] and tree.limb[row] == tree.limb[above] and np.linalg.norm(back[-1] - origin) < chord:
            row = tree.parent[row]
            back.append(tree.tip[row])
        far = np.linalg.norm(out - origin, axis=1)
        end = out[np.argmax(far >= chord)] if (far >= chord).any() else out[-1]
        a, b = end - origin, origin - back[-1]
        size = np.linalg.norm(a) * np.linalg.norm(b)
        if size > 0:
            found.append(np.degrees(np.arccos(np.clip(a @ b / size, -1, 1))))
    return np.array(found)


def silhouettes(a: TreeSkeleton, b: TreeSkeleton, height: float) -> float:
    """Mean IoU over `_SIDES` azimuths."""
    found = []
    for turn in np.arange(_SIDES) * np.pi / _SIDES * 2:
        shapes = [_shadow(tree, turn, height) for tree in (a, b)]
        found.append(np.sum(shapes[0] & shapes[1]) / max(np.sum(shapes[0] | shapes[1]), 1))
    return float(np.mean(found))


def _shadow(tree: TreeSkeleton, turn: float, height: float):
    row = np.flatnonzero(~tree.is_base)
    count = np.maximum(2, np.ceil(tree.length[row] / height * _GRID * 1.5)).astype(int)
    which = np.repeat(row, count)
    t = (np.arange(len(which)) - np.repeat(np.cumsum(count) - count, count)) / np.repeat(count - 1, count)
    point = tree.start[which] + tree.vector[which] * t[:, None]
    x = np.cos(turn) * point[:, 0] + np.sin(turn) * point[:, 2]
    cell = np.stack([x / height + 1.25, point[:, 1] / height + 0.25], axis=1) * _GRID
    cell = np.clip(cell.astype(int), 0, [int(2.5 * _GRID) - 1, int(1.6 * _GRID) - 1])
    mask = np.zeros((int(2.5 * _GRID), int(1.6 * _GRID)), bool)
    mask[cell[:, 0], cell[:, 1]] = True
    thick, closed = _disc(_THICK), _disc(_CLOSED)
    return ndimage.binary_fill_holes(ndimage.binary_closing(ndimage.binary_dilation(mask, thick), closed))


def _disc(radius: float):
    cells = int(np.ceil(radius * _GRID))
    y, x = np.ogrid[-cells : cells + 1, -cells : cells + 1]
    return x * x + y * y <= cells * cells


def largest_gap(tree: TreeSkeleton) -> float:
    """The widest sector around the trunk's axis, degrees, into which no tip reaches far."""
    foot = tree.tip[tree.is_base][0]
    tip = tree.tip[is_tip(tree.parent) & ~tree.is_base] - foot
    reach = np.hypot(tip[:, 0], tip[:, 2])
    if len(reach) == 0:
        return 360.0
    tip = tip[reach >= _COUNTS * np.quantile(reach, 0.9)]
    azimuth = np.sort(np.arctan2(tip[:, 2], tip[:, 0]))
    return float(np.degrees(np.diff(np.r_[azimuth, azimuth[0] + 2 * np.pi]).max()))


def _relative(true, grown, edges) -> float:
    n, m = (np.histogram(np.minimum(x, edges[-1] - 1e-9), edges)[0] for x in (true, grown))
    return float(np.abs(m - n).sum() / max(n.sum(), 1))


def _relative_2d(t: Undrawn, g: Undrawn, rise, way) -> float:
    n, m = (np.histogram2d(x.rise, np.minimum(x.way, way[-1] - 1e-9), [rise, way])[0] for x in (t, g))
    return float(np.abs(m - n).sum() / max(n.sum(), 1))
