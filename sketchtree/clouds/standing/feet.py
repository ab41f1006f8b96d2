"""On which points does the plant stand? One set of start points for each root.

`auto` takes the stems that come out of the ground (`stems`, `parted`): one for a tree, several for a shrub; or those that touch there and are apart farther up (`told`, `apart`), if
those are more. A number asks for so many roots: the stems with most points and, where there are
fewer, peaks of projected density (`told`; Guo et al. 2018, §5.3) in what is low. A start set is the lowest ring of its stem.
"""

from dataclasses import dataclass
from typing import Literal

import numpy as np
from jaxtyping import Float, Int

from sketchtree.clouds.standing.apart import apart, slim
from sketchtree.clouds.standing.parted import parted
from sketchtree.clouds.standing.stems import OVER, breast_height, stems
from sketchtree.clouds.standing.told import told
from sketchtree.errors import OptionError

MOST = 200  # roots
_STEMS = 40  # that are looked for where nobody said how many there are
_SHARE = 0.15  # of the largest stem's points: a thinner one bears nothing of its own
_RING = 0.006  # of the height: how high the lowest ring is
_FEWEST = 6  # points of a ring, where the stem has as many


@dataclass(frozen=True, eq=False)
class Feet:
    """Where a plant stands, its largest stem first."""

    rows: list[Int[np.ndarray, "_"]]  # the lowest ring of each stem: what `tracing.traced` begins with
    place: Float[np.ndarray, "foot 3"]  # its middle, metres
    stems: list[Int[np.ndarray, "_"]]  # the points of each stem, up to a bit above breast height


def feet(xyz: Float[np.ndarray, "point 3"], above: Float[np.ndarray, " point"] | None = None, *, count: int | Literal["auto"] = "auto") -> Feet:
    """The feet of one plant. `above`: metres above the ground, where that is known; `count`: how many roots. Raises OptionError for a number that can't be had."""
    if count != "auto" and not 1 <= count <= min(MOST, len(xyz)):
        raise OptionError(f"`roots` is {count}; the cloud has {len(xyz):,} points.", remedy=f"Say auto, or 1 to {MOST}.")
    above = xyz[:, 1] - xyz[:, 1].min() if above is None else above
    found = stems(xyz, above)
    whole = [found.rows[k] for k in np.flatnonzero(found.plant == 0)]
    groups = parted(xyz, above, whole)
    groups = [rows for rows in groups if len(rows) >= _SHARE * len(groups[0])]
    if count == "auto":
        groups = max(_large(slim(xyz, above, groups, _top(above))), _touching(xyz, above, np.sort(np.concatenate(whole))), key=len)
    else:
        groups = groups[:count] if len(groups) >= count else max(groups, told(xyz, above, count), key=len)
    rings = [_ring(above, some, _RING * float(np.ptp(above))) for some in groups]
    return Feet(rings, np.array([np.median(xyz[ring], axis=0) for ring in rings]), groups)


def _touching(xyz, above, among) -> list:
    """Stems that touch at the ground and nobody counted, the largest first."""
    found = _large(apart(xyz, above, told(xyz, above, min(_STEMS, len(among)), among), _top(above)))
    return [rows for rows in found if len(rows) >= _SHARE * len(found[0])]


def _large(found: list) -> list:
    return sorted(found, key=len, reverse=True)


def _top(above) -> float:
    """Up to where stems are sought, metres above the ground."""
    return OVER * breast_height(float(np.ptp(above)))


def _ring(above, rows, thick: float):
    """The lowest points of a stem."""
    lowest = np.sort(above[rows])
    level = max(lowest[0] + thick, lowest[min(_FEWEST, len(lowest)) - 1])
    return rows[above[rows] <= level]
