"""Is the crown a conifer's? What the silhouette says, where leaves hide how the tree branches.

A spruce, a fir or a young pine stands as a cone whose leader is seen to the tip and whose limbs reach down to the ground; broadleaves that narrow upwards show a bare trunk below or
lose it in the crown. All five must hold, or it is taken for a broadleaf, as most trees are. Of the crowns of 44 exemplars only four pass: deodar cedar, both Norway spruces and young Scots
pine; of 14 photos the spruce alone. Columns (cypress, larch) and umbrellas (old pines) don't: they need `--template`.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Float

from sketchtree.axes import NULL
from sketchtree.photo.marked import Marked
from sketchtree.photo.trace.traced import Traced

# of the exemplars' crowns, and the photos': conifers / the broadleaf that comes nearest
_NARROWS = 0.63  # mean width of the upper half, of that of the lower half: .51-.60 / .64 (elm in winter; an apple's thin leader .33)
_SLENDER = 0.8  # width, of the tree's height: .40-.71 / .86 (the elm)
_LOW = 0.14  # where the crown begins, of the tree's height: 0-.07 / .20 (cherry), .24 (the apple)
_LEADER = 0.9  # how high the trunk can be followed, of the tree's height: 1 / .5-1
_WIDEST = 0.7  # how far down the crown is widest, of its height: .75-.95 / .55 (the elm)
_STRAYS = 0.005  # of the foliage, at its top and at its bottom, that may be something else
_FLANKS = 0.05  # of a row's foliage, at its left and at its right, likewise
_ROWS = 10  # that the crown is cut into


@dataclass(frozen=True)
class CrownShape:
    """The silhouette of one tree; all of the tree's height from its foot to the crown's top, unless said otherwise."""

    narrows: float  # mean width of the upper half / of the lower half
    width: float
    begins: float
    leader: float  # how high the trunk can be followed
    widest: float  # how far down the crown, of the crown's height

    @classmethod
    def of(cls, mask: Bool[np.ndarray, "row column"], marked: Marked, traced: Traced) -> "CrownShape | None":
        """Of the foliage; None where there is none above the trunk's foot."""
        trunk = _trunk(marked, traced)
        share = np.cumsum(mask.sum(axis=1)) / max(int(mask.sum()), 1)
        top, bottom = int(np.searchsorted(share, _STRAYS)), int(np.searchsorted(share, 1 - _STRAYS)) + 1
        height = float(trunk[:, 1].max()) - top
        if not mask.any() or height <= 0:
            return None
        edge = np.linspace(top, bottom, _ROWS + 1).astype(int)
        width = np.array([_spread(mask[a : max(b, a + 1)].sum(axis=0)) for a, b in zip(edge[:-1], edge[1:], strict=True)])
        half = _ROWS // 2
        return cls(
            narrows=float(width[:half].mean() / max(width[half:].mean(), 1.0)),
            width=float(width.max() / height),
            begins=float((trunk[:, 1].max() - bottom) / height),
            leader=float((trunk[:, 1].max() - trunk[:, 1].min()) / height),
            widest=float((np.argmax(width) + 0.5) / _ROWS),
        )

    @property
    def is_cone(self) -> bool:
        """As a conifer stands in the open."""
        return self.narrows <= _NARROWS and self.width <= _SLENDER and self.begins <= _LOW and self.leader >= _LEADER and self.widest >= _WIDEST


def _trunk(marked: Marked, traced: Traced) -> Float[np.ndarray, "point 2"]:
    """The trunk as drawn, or as traced where no stroke runs along it."""
    if marked.branches:
        return marked.branches[0]
    return traced.xy if (traced.parent != NULL).any() else marked.crown


def _spread(count) -> float:
    """How wide the foliage of some rows is, pixels, without what strays."""
    share = np.cumsum(count) / max(int(count.sum()), 1)
    return float(np.searchsorted(share, 1 - _FLANKS) - np.searchsorted(share, _FLANKS) + 1)
