"""How far is a recovered tree from the true one? Every figure is unchanged by the mirror z → −z.

Both trees have the same drawn x and y; z differs. With v_i the segment that ends at node i,
R recovered and T true:

    elev      mean over segments of | |v_z|/|v| R − |v_z|/|v| T |
    w_div     Wasserstein-1 between the divergence angles of laterals, degrees
    w_ratio   the same between |v_i|/|v_pi|, each at most 5
    w_az      the same between azimuth gaps of successive siblings along one limb, degrees
    depth     | log(z-extent R / z-extent T) |, at most 3; an extent counts as 1 % of the width at least
    iou       of the branches' raster seen from 90°, lines thickened to 2.5 % H; the better of two mirrors
    hull      of the convex hulls of laterals seen from 90°; the better of two mirrors
    overlaps  pairs of segments with axes nearer than ½(r_i + r_j); relatives and one stroke left out

H is the drawn height. Figures that a case cannot have (no laterals) are NaN.
"""

import numpy as np
import shapely
from jaxtyping import Float
from scipy.ndimage import binary_dilation

from benchmarks.drawing import Case
from sketchtree.axes import NULL

NAMES = ("elev", "w_div", "w_ratio", "w_az", "depth", "iou", "hull", "overlaps")
LOWER_IS_BETTER = {name: name not in ("iou", "hull") for name in NAMES}
_GRID = 160  # raster cells per H


def evaluate(case: Case, depth: Float[np.ndarray, " segment"]) -> dict[str, float]:
    """Every figure of NAMES for recovered depths (sketch units)."""
    true, found = case.position, np.c_[case.graph.xy, depth]
    true, found = (xyz - [0, 0, xyz[0, 2]] for xyz in (true, found))
    t, r = Shape(case, true), Shape(case, found)
    return {
        "elev": float(np.mean(np.abs(t.steepness - r.steepness))),
        "w_div": wasserstein(t.divergence, r.divergence),
        "w_ratio": wasserstein(np.minimum(t.ratio, 5), np.minimum(r.ratio, 5)),
        "w_az": wasserstein(t.azimuth_gap, r.azimuth_gap),
        "depth": _depth(true, found),
        "iou": _best_mirror(found, lambda xyz, mask=_raster(case, true): _iou(mask, _raster(case, xyz))),
        "hull": _hull(case, true, found),
        "overlaps": float(overlaps(case, found)),
    }


class Shape:
    """Lengths and angles of one tree, measured once."""

    def __init__(self, case: Case, xyz: Float[np.ndarray, "segment 3"]):
        graph = case.graph
        self.case = case
        self.vector = np.where(graph.is_base[:, None], 0.0, xyz - xyz[graph.parent])
        self.length = np.linalg.norm(self.vector, axis=1)
        row = np.flatnonzero(~graph.is_base)
        self.steepness = np.abs(self.vector[row, 2]) / np.maximum(self.length[row], 1e-9)
        up = graph.parent[row]
        pair = row[~graph.is_base[up] & (self.length[up] >= 1e-9) & (self.length[row] >= 1e-9)]
        up = graph.parent[pair]
        self.ratio = self.length[pair] / self.length[up]
        cosine = np.einsum("pa,pa->p", self.vector[pair], self.vector[up]) / (self.length[pair] * self.length[up])
        angle = np.degrees(np.arccos(np.clip(cosine, -1, 1)))
        self.divergence = angle[graph.limb[pair] != graph.limb[up]]
        self.azimuth_gap = self._azimuth_gaps()

    def _azimuth_gaps(self):
        """Angles between successive siblings, seen along the segment that carries them."""
        graph, gaps = self.case.graph, []
        first = graph.limb_first
        for limb in range(len(first)):
            rank = {int(row): k for k, row in enumerate(_chain(graph, limb))}
            own = [row for row in first[graph.limb_parent == limb] if int(graph.parent[row]) in rank]
            side = [self._sideways(row) for row in sorted(own, key=lambda row: rank[int(graph.parent[row])])]
            for a, b in zip(side[:-1], side[1:]):
                if a is not None and b is not None:
                    gaps.append(np.degrees(np.arccos(np.clip(a @ b, -1, 1))))
        return np.array(gaps)

    def _sideways(self, row):
        along = self.vector[self.case.graph.parent[row]]
        if self.case.graph.is_base[self.case.graph.parent[row]]:
            along = np.array([0.0, 1.0, 0.0])
        along = along / (np.linalg.norm(along) + 1e-12)
        side = self.vector[row] - along * (self.vector[row] @ along)
        size = np.linalg.norm(side)
        return side / size if size >= 1e-9 else None


def _chain(graph, limb):
    """The rows of a limb, its junction first."""
    rows = np.flatnonzero((graph.limb == limb) & ~graph.is_base)
    return np.r_[graph.parent[rows[0]], rows]


def wasserstein(a: np.ndarray, b: np.ndarray) -> float:
    """Mean distance between the quantile functions, on 200 midpoints; NaN where one is empty."""
    if len(a) == 0 or len(b) == 0:
        return float("nan")
    q = (np.arange(200) + 0.5) / 200
    return float(np.mean(np.abs(np.quantile(a, q) - np.quantile(b, q))))


def _depth(true, found) -> float:
    extent = max(np.ptp(found[:, 2]), 0.01 * np.ptp(true[:, 0]))
    return float(min(3.0, abs(np.log(max(extent, 1e-12) / max(np.ptp(true[:, 2]), 1e-6)))))


def _best_mirror(xyz, score) -> float:
    return max(score(xyz), score(xyz * [1, 1, -1]))


def _raster(case: Case, xyz):
    """Which cells the branches cover, seen from 90° (z across, y up)."""
    row, scale = np.flatnonzero(~case.graph.is_base), _GRID / case.height
    a, b = xyz[case.graph.parent[row]], xyz[row]
    count = np.maximum(2, np.linalg.norm(b - a, axis=1) * scale * 1.5).astype(int)
    which = np.repeat(np.arange(len(row)), count)
    rank = np.arange(len(which)) - np.repeat(np.cumsum(count) - count, count)
    point = a[which] + (b - a)[which] * (rank / (count - 1)[which])[:, None]
    across, high = (point[:, 2] * scale + 1.5 * _GRID).astype(int), (point[:, 1] * scale + 20).astype(int)
    mask = np.zeros((_GRID + 40, 3 * _GRID), bool)
    inside = (across >= 0) & (across < mask.shape[1]) & (high >= 0) & (high < mask.shape[0])
    mask[high[inside], across[inside]] = True
    return binary_dilation(mask, iterations=4)


def _iou(a, b) -> float:
    return float((a & b).sum() / (a | b).sum())


def _hull(case: Case, true, found) -> float:
    lateral = case.graph.order > 0
    if lateral.sum() < 3:
        return float("nan")

    def hull(xyz):
        return shapely.MultiPoint(xyz[lateral][:, [2, 1]]).convex_hull.buffer(0.01 * case.height)

    target = hull(true)
    return _best_mirror(found, lambda xyz: target.intersection(hull(xyz)).area / target.union(hull(xyz)).area)


def overlaps(case: Case, xyz: Float[np.ndarray, "segment 3"]) -> int:
    """How many pairs of segments pass through each other: axes nearer than half the sum of their radii.

    Left out: pairs that share a node, a stroke or a grandparent, as forks are meant to touch."""
    graph = case.graph
    row = np.flatnonzero(~graph.is_base)
    i, j = (row[k] for k in np.triu_indices(len(row), 1))
    up, up2 = graph.parent, np.where(graph.is_base, NULL, graph.parent[graph.parent])
    apart = (up[i] != up[j]) & (up[i] != j) & (up[j] != i) & (graph.limb[i] != graph.limb[j])
    apart &= (up2[i] != up[j]) & (up2[j] != up[i]) & (up2[i] != j) & (up2[j] != i)
    reach = case.radius[i] + case.radius[j]
    low, high = np.minimum(xyz[up], xyz), np.maximum(xyz[up], xyz)
    boxes = (low[i] - reach[:, None] <= high[j]).all(1) & (low[j] - reach[:, None] <= high[i]).all(1)
    i, j, reach = (column[apart & boxes] for column in (i, j, reach))
    return int(np.sum(segment_distance(xyz[up[i]], xyz[i], xyz[up[j]], xyz[j]) < 0.5 * reach))


def segment_distance(p, q, r, s) -> Float[np.ndarray, " pair"]:
    """The least distance between segments p→q and r→s, row by row (Ericson 2005, §5.1.9)."""
    d, e, gap = q - p, s - r, p - r
    a, b, c = ((x * y).sum(1) for x, y in ((d, d), (d, e), (d, gap)))
    ee, f = (e * e).sum(1), (e * gap).sum(1)
    area = a * ee - b * b
    first = np.where(area > 1e-12, np.clip((b * f - c * ee) / np.where(area > 1e-12, area, 1), 0, 1), 0.0)
    second = (b * first + f) / (ee + 1e-12)
    first = np.where(second < 0, np.clip(-c / (a + 1e-12), 0, 1), first)
    first = np.where(second > 1, np.clip((b - c) / (a + 1e-12), 0, 1), first)
    second = np.clip(second, 0, 1)
    return np.linalg.norm(p + d * first[:, None] - r - e * second[:, None], axis=1)


def win_rate(found: list[float], rival: list[float], *, lower: bool = True) -> float:
    """Share of cases in which `found` beats `rival`; a draw counts half, NaN not at all."""
    gap = np.array(rival) - np.array(found) if lower else np.array(found) - np.array(rival)
    gap = gap[np.isfinite(gap)]
    return float(np.mean(np.where(np.abs(gap) <= 1e-9, 0.5, gap > 0))) if len(gap) else float("nan")


def medians(rows: list[dict[str, float]]) -> dict[str, float]:
    """The median of every figure over cases, NaN left out."""
    columns = {name: np.array([row[name] for row in rows], float) for name in rows[0]}
    known = {name: column[np.isfinite(column)] for name, column in columns.items()}
    return {name: float(np.median(column)) if len(column) else float("nan") for name, column in known.items()}
