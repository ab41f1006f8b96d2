"""How far may the tree reach, and how closely has what stands there to be known?

    box         all that is drawn and the crown, and beyond it `_BEYOND` of the height where no crown was drawn
    influence   D = `_FEELS` spacings of laterals: from there on branches turn away
    pitch       h of the grids: `_FINE` of the spacing, or wider, so that no grid has too many corners
    band        what a grid has to tell apart: D, the grid's own slack (`distance_field`) and the clearance, which is some `_WIDE` h
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Float

from sketchtree.parameters import Habit
from sketchtree.propagate.space.envelope import Envelope
from sketchtree.skeleton import TreeSkeleton

_BEYOND = 0.5  # of the height
_FEELS = 3.0  # spacings of laterals
_FINE = 1 / 5  # of the spacing of laterals
_WIDE = 4.0  # pitches
_ROUNDS = 20  # to a pitch that fits


@dataclass(frozen=True, eq=False)
class Domain:
    """A box that the tree does not leave."""

    low: Float[np.ndarray, " 3"]  # metres
    high: Float[np.ndarray, " 3"]
    ground: float  # y of the lowest root, metres
    root: Float[np.ndarray, "root 3"]
    spacing: float  # of laterals, metres

    @classmethod
    def of(cls, tree: TreeSkeleton, envelope: Envelope | None, habit: Habit, height: float) -> "Domain":
        """The box of a drawn tree (`height` in metres, its crown included; `habit` to its scale)."""
        points = [tree.tip, tree.curve_points, *([] if envelope is None else envelope.bounds)]
        points = np.concatenate([np.reshape(p, (-1, 3)) for p in points])
        feels = _FEELS * habit.lateral_spacing
        beyond = feels + (0.0 if envelope is not None and envelope.binding else _BEYOND * height)
        ground = float(tree.tip[tree.is_base, 1].min())
        low, high = points.min(axis=0) - beyond, points.max(axis=0) + beyond
        low[1] = min(points[:, 1].min(), ground) - feels
        return cls(low, high, ground, tree.tip[tree.is_base], habit.lateral_spacing)

    @property
    def influence(self) -> float:
        """D, metres."""
        return _FEELS * self.spacing

    def holds(self, point: Float[np.ndarray, "point axis"]) -> Bool[np.ndarray, " point"]:
        """Which points lie in the box: of space, or of two axes on the page."""
        axes = point.shape[1]
        return ((point >= self.low[:axes]) & (point <= self.high[:axes])).all(axis=1)

    def grid(self, low, high, most: float) -> tuple[np.ndarray, np.ndarray, float, float]:
        """(low, high, pitch, band) of a grid about what lies between two corners (metres; two axes or three), as far as
        that is in the box, of `most` corners at most."""
        axes, pitch = len(low), _FINE * self.spacing
        for _ in range(_ROUNDS):
            band = self.influence + _WIDE * pitch
            first = np.maximum(low - band, self.low[:axes] - 2 * pitch)
            last = np.minimum(high + band, self.high[:axes] + 2 * pitch)
            corners = float(np.prod(np.maximum(last - first, 0.0) / pitch + 3.0))
            if corners <= most:
                break
            pitch *= 1.02 * (corners / most) ** (1 / axes)
        return first, last, pitch, band
