"""Is the plant in leaf, and which points are its leaves?

First the cloud as a whole. *Ends* are points on which next to nothing hangs (b < 3, `borne`). It is in leaf where ends are many and fill space (`turning.filling`), or are green where its
wood is not (`green`):

    ends ≥ 0.62 of the points  and  median D of the ends ≥ 1.95

Our trees in leaf have 0.66-0.79 and 2.05-2.8, bare ones 0.32-0.54 and 1.5-2.1; five scans of others that came with no leaves 0.43-0.66 and 1.8-2.3, none of them enough of both. If it isn't, all points are wood.

Then each point, by b, κ (`turning`) and colour where that tells:

    log odds of a leaf = 4.33 − 0.95 b + 0.42 log(κ + 0.003) [+ 2 green]

fitted on two trees of ours, an apple and a birch, scanned at 100,000 and 25,000 points, wood and leaves weighed alike; the others are what `benchmarks.cloud_leaves` measures. What stands on a way
to wood that is sure is wood too, so that limbs don't fall into pieces where leaves hide them.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Float, Int

from sketchtree.axes import NULL
from sketchtree.clouds.leafy.borne import borne
from sketchtree.clouds.leafy.green import green_odds
from sketchtree.clouds.leafy.turning import filling, turning
from sketchtree.clouds.tracing.joined import Joined
from sketchtree.clouds.tracing.ways import Ways
from sketchtree.errors import OptionError

IN_LEAF = ("auto", "yes", "no")
ENDS, ENDS_SHARE, FILLS = 3.0, 0.62, 1.95
_GREEN_SHARE = 0.55  # of the points are ends at least, where they are green
_BASE, _BORNE, _TURNING, _NEVER_FLAT, _GREEN = 4.33, 0.95, 0.42, 0.003, 2.0
_SURE, _BEARS = -1.0, 5.0  # log odds of wood that is sure; b of what bears much
_FEWEST = 300  # points that leaves may be told among
_AREA = 0.9  # of the square of their spacing, that a point of a surface stands for: π d² / 3.5, d the distance to the third or fourth nearest


@dataclass(frozen=True, eq=False)
class Leafiness:
    """What of a cloud is leaves."""

    leaf: Bool[np.ndarray, " point"]
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


def leafiness(
    xyz: Float[np.ndarray, "point 3"], graph: Joined, way: Ways, feet: list[Int[np.ndarray, " start"]], colour: Float[np.ndarray, "point 3"] | None = None, wanted: str = "auto"
) -> Leafiness:
    """Which points are leaves. `way`: ways along `graph` from `feet`; `wanted`: of `IN_LEAF`, whether the plant is in leaf. Raises OptionError."""
    if wanted not in IN_LEAF:
        raise OptionError(f"A plant isn't in leaf {wanted!r}.", remedy=f"Choose one of: {', '.join(IN_LEAF)}.")
    bare = np.zeros(len(xyz), bool)
    if wanted == "no" or len(xyz) < _FEWEST:
        return Leafiness(bare, False, 0.0, 0.0, False)
    hangs = borne(xyz, way)
    ends = hangs < ENDS
    share = float(np.mean(ends))
    fills = float(np.median(filling(xyz, xyz[ends]))) if ends.any() else 0.0
    green = green_odds(colour, hangs > _BEARS, ends)
    found = (share >= ENDS_SHARE and fills >= FILLS) or (green is not None and share >= _GREEN_SHARE)
    if wanted == "auto" and not found:
        return Leafiness(bare, False, share, fills, green is not None)
    odds = _BASE - _BORNE * hangs + _TURNING * np.log(turning(xyz) + _NEVER_FLAT) + (0.0 if green is None else _GREEN * green)
    wood = _led_to(odds < _SURE, way) | (odds < 0)
    wood[np.concatenate(feet)] = True
    return Leafiness(~wood, True, share, fills, green is not None)


def _led_to(sure: Bool[np.ndarray, " point"], way: Ways) -> Bool[np.ndarray, " point"]:
    """Those points and all on the ways to them."""
    on, before = sure.tolist(), way.before.tolist()
    for point in np.argsort(-way.length, kind="stable").tolist():
        if on[point] and before[point] != NULL:
            on[before[point]] = True
    return np.array(on)


def leaf_area(graph: Joined, leaf: Bool[np.ndarray, " point"]) -> Float[np.ndarray, " point"]:
    """Square metres of leaf that each point stands for; 0 of wood."""
    return np.where(leaf, _AREA * graph.spacing**2, 0.0)
