"""Is the plant in leaf, and which points are its leaves?

First the cloud as a whole, thinned to 20,000 points so that it is looked at as coarsely as any. *Ends* are points on which next to nothing hangs (b < 3, `borne`). It is in leaf where ends are
many and fill space (`turning.filling`), or are green where its wood is not (`green`); or, where a scan is finer than it is looked at by, so that none of its wood is left out, where leaves
explain more of it than wood does (π, `leaves_among`), though they are few:

    ends ≥ 0.66 of the points  and  median D of the ends ≥ 2.05        or        π ≥ 0.6  and  median D ≥ 2

Six trees of ours in leaf have 0.73-0.78 and 2.1-2.7, bare ones 0.37-0.53 and 1.5-2.0; five scans of others that came with no leaves 0.43-0.66 and 1.8-2.3, none of them enough of both.
With a third of their leaves left they have 0.64-0.72, 2.1-2.4 and a π of 0.64-0.86; bare ones that are off by 0.3 % of their height a π of up to 0.56, but a bare spruce.
If it isn't, all points are wood.

Then each point of at most 100,000, by b, κ (`turning`) and colour where that tells; the others are what the nearest of these is:

    log odds of a leaf = 4.33 − 0.95 b + 0.42 log(κ + 0.003) [+ 2 green]

fitted on two trees of ours, an apple and a birch, scanned at 100,000 and 25,000 points, wood and leaves weighed alike; `benchmarks.cloud_leaves` measures it on others. What stands on a way
to wood that is sure is wood too, so that limbs don't fall into pieces where leaves hide them.
"""

from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from jaxtyping import Bool, Float, Int
from scipy.spatial import cKDTree
from scipy.special import expit

from sketchtree.axes import NULL
from sketchtree.clouds.leafy.borne import borne
from sketchtree.clouds.leafy.green import green_odds
from sketchtree.clouds.leafy.turning import filling, turning
from sketchtree.clouds.tracing.joined import joined
from sketchtree.clouds.tracing.ways import Ways, ways
from sketchtree.clouds.voxels import voxel_rows, voxel_size
from sketchtree.errors import OptionError
from sketchtree.skeleton import TreeSkeleton

IN_LEAF = ("auto", "yes", "no")
ENDS, ENDS_SHARE, FILLS = 3.0, 0.66, 2.05
_EXPLAINS, _FILLS_FEW = 0.6, 2.0  # π and D, where a scan has at least so many points as two looks:
_LOOKS = 2.0
_GREEN_SHARE = 0.55  # of the points are ends at least, where they are green
_BASE, _BORNE, _TURNING, _NEVER_FLAT, _GREEN = 4.33, 0.95, 0.42, 0.003, 2.0
_SURE, _BEARS = -1.0, 5.0  # log odds of wood that is sure; b of what bears much
_CERTAIN = 1.0  # log odds of a leaf that is no twig, as many leaves as there are: of a tree with a tenth of its leaves a third of what is taken for leaves is twigs
_USUAL = 0.8  # log odds that this makes at most: what could as well be a twig stays unsure
_STEPS = 60  # of expectation and maximisation
_FEWEST = 300  # points that leaves may be told among
_TWIG, _BARK = 0.003, 1.3  # of the height: radius of a twig; radii within which points are bark
_STRAY = 0.03  # of the height: farther from the bark of the wood that was traced, outside or inside, lies no point of wood
_COARSE, _FINE = 20_000, 100_000  # points that the whole is looked at by, and that leaves are told among
_AREA = 0.28  # of the square of their spacing: the leaf behind a point, seen or hidden; 0.17-0.57 on six trees of ours at 12,000 to 550,000 points


@dataclass(frozen=True, eq=False)
class Leafiness:
    """What of a cloud is leaves."""

    leaf: Bool[np.ndarray, " point"]
    sure: Bool[np.ndarray, " point"]  # those of them that are no twigs, as far as can be told
    area: Float[np.ndarray, " point"]  # m² of leaf that each stands for, seen or hidden; 0 of wood; a rough figure
    in_leaf: bool
    ends: float  # share of the points on which next to nothing hangs
    fills: float  # median D of those
    green: bool  # whether colour told

    @property
    def share(self) -> float:
        """Of the points."""
        return float(np.mean(self.leaf))

    @property
    def remark(self) -> str | None:
        """What a person should know; None of a bare plant."""
        return f"About {100 * self.share:.0f} % of the points are leaves; they are no wood." if self.in_leaf else None


def check_in_leaf(wanted: str) -> None:
    """Refuse what is not of `IN_LEAF`. Raises OptionError."""
    if wanted not in IN_LEAF:
        raise OptionError(f"Whether a plant is in leaf can't be {wanted!r}.", remedy=f"Choose one of: {', '.join(IN_LEAF)}.")


def leafiness(xyz: Float[np.ndarray, "point 3"], feet: list[Int[np.ndarray, " start"]], colour: Float[np.ndarray, "point 3"] | None = None, wanted: str = "auto") -> Leafiness:
    """Which points of a plant on its feet are leaves. `wanted`: of `IN_LEAF`, whether it is in leaf. Raises OptionError."""
    check_in_leaf(wanted)
    bare = np.zeros(len(xyz), bool), np.zeros(len(xyz), bool), np.zeros(len(xyz))
    if wanted == "no" or len(xyz) < _FEWEST:
        return Leafiness(*bare, False, 0.0, 0.0, False)
    whole = _seen(xyz, feet, colour, _COARSE)
    ends = whole.hangs < ENDS
    share = float(np.mean(ends))
    fills = float(np.median(filling(whole.xyz, whole.xyz[ends]))) if ends.any() else 0.0
    found = (share >= ENDS_SHARE and fills >= FILLS) or (whole.green is not None and share >= _GREEN_SHARE)
    found = found or (fills >= _FILLS_FEW and len(xyz) >= _LOOKS * _COARSE and leaves_among(_odds(whole)) >= _EXPLAINS)
    if wanted == "auto" and not found:
        return Leafiness(*bare, False, share, fills, whole.green is not None)
    fine = _seen(xyz, feet, colour, _FINE)
    odds = _odds(fine)
    wood = _led_to(odds < _SURE, fine.way) | (odds < 0)
    wood[np.concatenate(fine.feet)] = True
    nearest = cKDTree(fine.xyz).query(xyz)[1]
    leaf = ~wood[nearest]
    area = np.where(leaf, (_AREA * fine.spacing**2 / np.maximum(np.bincount(nearest, minlength=len(fine.xyz)), 1))[nearest], 0.0)
    return Leafiness(leaf, leaf & (odds + _usual(odds) > _CERTAIN)[nearest], area, True, share, fills, fine.green is not None)


def off_bark(found: Leafiness, xyz: Float[np.ndarray, "point 3"], wood: TreeSkeleton) -> Leafiness:
    """The same, once the wood is known: points on the bark of limbs thicker than twigs are no leaves, however they look."""
    thick = np.flatnonzero((wood.radius > _TWIG * np.ptp(xyz[:, 1])) & ~wood.is_base)
    leaf = np.flatnonzero(found.leaf)
    if not len(thick) or not len(leaf):
        return found
    far, radius = _from_axes(xyz[leaf], wood, thick, wood.radius[thick] / 2)
    bark = leaf[far < _BARK * radius]
    still, sure, area = found.leaf.copy(), found.sure.copy(), found.area.copy()
    still[bark], sure[bark], area[bark] = False, False, 0.0
    return replace(found, leaf=still, sure=sure, area=area)


def left_out(points: Float[np.ndarray, "point 3"], wood: TreeSkeleton) -> float:
    """The share of the points that are wood which lie nowhere near the bark that was traced in them, 0 to 1: how wrong it was to take leaves away. Three trees in leaf have up to 0.03, a herb 0.67."""
    high = float(np.ptp(points[:, 1]))
    far, radius = _from_axes(points, wood, np.flatnonzero(~wood.is_base), _STRAY / 5 * high)
    return float(np.mean(np.abs(far - radius) > _STRAY * high))


def _from_axes(points, wood: TreeSkeleton, rows, apart):
    """(metres from the nearest of places so far apart on the axes of some segments, the radius there)."""
    count = np.ceil(wood.length[rows] / apart).astype(np.int64) + 1
    of = np.repeat(rows, count)
    share = (np.arange(len(of)) - np.repeat(np.cumsum(count) - count, count)) / np.repeat(count, count)
    far, near = cKDTree(wood.start[of] + share[:, None] * wood.vector[of]).query(points)
    return far, wood.radius[of[near]]


class _Seen(NamedTuple):
    """A plant by fewer points."""

    xyz: Float[np.ndarray, "point 3"]
    feet: list[Int[np.ndarray, " start"]]
    way: Ways
    spacing: Float[np.ndarray, " point"]  # metres
    hangs: Float[np.ndarray, " point"]  # b
    green: Float[np.ndarray, " point"] | None


def _seen(xyz, feet, colour, most: int) -> _Seen:
    """The plant by at most about so many points, all of its feet among them."""
    kept = np.ones(len(xyz), bool)
    if len(xyz) > most:
        kept[:] = False
        kept[voxel_rows(xyz, voxel_size(xyz, most))] = True
        kept[np.concatenate(feet)] = True
    place = np.cumsum(kept) - 1
    some, start = xyz[kept], [place[rows] for rows in feet]
    graph = joined(some)
    way = ways(some, graph, start)
    hangs = borne(some, way)
    return _Seen(some, start, way, graph.spacing, hangs, green_odds(None if colour is None else colour[kept], hangs > _BEARS, hangs < ENDS))


def _odds(seen: _Seen) -> Float[np.ndarray, " point"]:
    """Log odds of a leaf, of every point, wood and leaves being as many."""
    return _BASE - _BORNE * seen.hangs + _TURNING * np.log(turning(seen.xyz) + _NEVER_FLAT) + (0.0 if seen.green is None else _GREEN * seen.green)


def leaves_among(odds: Float[np.ndarray, " point"]) -> float:
    """π, the share of leaves that explains log odds best, which are those of as many leaves as wood:

        π = mean of 1 / (1 + e^−(odds + log π / (1 − π)))        (Saerens et al. 2002, by expectation and maximisation)
    """
    share = 0.5
    for _ in range(_STEPS):
        share = float(np.clip(expit(odds + np.log(share / (1 - share))).mean(), 1e-4, 1 - 1e-4))
    return share


def _usual(odds) -> float:
    """How much likelier a leaf is than among as many leaves as wood, log π / (1 − π), where they are more."""
    share = leaves_among(odds)
    return float(np.clip(np.log(share / (1.0 - share)), 0.0, _USUAL))


def _led_to(sure: Bool[np.ndarray, " point"], way: Ways) -> Bool[np.ndarray, " point"]:
    """Those points and all on the ways to them."""
    on, before = sure.tolist(), way.before.tolist()
    for point in np.argsort(-way.length, kind="stable").tolist():
        if on[point] and before[point] != NULL:
            on[before[point]] = True
    return np.array(on)

