"""How far may the tree grow? The crown as a surface of local revolution.

Chen et al. 2008, §6 (after Okabe et al. 2005): every outline drawn is revolved about a vertical axis of its own.
At height y an outline spans x ∈ [x_l(y), x_r(y)] on the page; about its axis x_a the surface lies at the radius

    w(θ, y) = w_r (1 + cos θ)/2 + w_l (1 − cos θ)/2,      w_l = x_a − x_l,   w_r = x_r − x_a

    θ     azimuth about the axis from +x towards the viewer (+z)
    x_a   the outline's centroid, or where a leaning outline leaves it aside, the nearest point that lies
          a quarter of the width inside: then the revolution is local to the height

On the page (θ = 0, π) the surface is the outline; a circle makes a sphere. Several outlines make the union
of their surfaces. Where an outline has several stretches at one height, the outermost ends count.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Float

from sketchtree.errors import OptionError

_BISECTIONS = 16  # to 2e-5 of a branch


@dataclass(frozen=True, eq=False)
class Lobe:
    """One outline revolved. Between two neighbouring heights both ends are straight lines."""

    height: Float[np.ndarray, " level"]  # metres, rising
    left: Float[np.ndarray, "slab 2"]  # x_l at the bottom and the top of each slab
    right: Float[np.ndarray, "slab 2"]
    axis: float  # x of the centroid
    centre_z: float = 0.0  # metres, depth of the axis

    @classmethod
    def from_outline(cls, outline: Float[np.ndarray, "point 2"], centre_z: float = 0.0) -> "Lobe":
        """The lobe of one closed outline (world metres, y up; the first point need not be repeated)."""
        outline = np.asarray(outline, float)
        ok = outline.ndim == 2 and outline.shape[1] == 2 and len(outline) >= 3 and np.isfinite(outline).all()
        if not ok or np.ptp(outline[:, 0]) <= 0 or np.ptp(outline[:, 1]) <= 0:
            raise OptionError(
                "A crown outline needs at least three finite points that enclose an area.",
                remedy="Draw the crown as a closed curve, or build with `--crown off`.",
            )
        a, b = outline, np.roll(outline, -1, axis=0)
        height, level = np.unique(outline[:, 1], return_inverse=True)
        level = level.ravel()
        first, last = np.minimum(level, np.roll(level, -1)), np.maximum(level, np.roll(level, -1))
        edge = np.repeat(np.arange(len(a)), last - first)
        slab = np.arange(len(edge)) - np.repeat(np.cumsum(last - first) - last, last - first)
        left, right = np.full((2, len(height) - 1, 2), [[[np.inf]], [[-np.inf]]])
        for end in (0, 1):
            t = (height[slab + end] - a[edge, 1]) / (b[edge, 1] - a[edge, 1])
            x = (1 - t) * a[edge, 0] + t * b[edge, 0]
            np.minimum.at(left[:, end], slab, x)
            np.maximum.at(right[:, end], slab, x)
        return cls(height, left, right, _centroid_x(a, b), centre_z)

    @property
    def reach(self) -> float:
        """The greatest distance of the surface from its axis, at most, metres."""
        return float((self.right - self.left).max())

    def axis_at(self, y: Float[np.ndarray, " height"]) -> Float[np.ndarray, "height 3"]:
        """The outline's own axis at these heights, metres: always inside it."""
        return np.stack([self._span(y)[2], y, np.full(len(y), self.centre_z)], axis=1)

    def edges_at(self, y: Float[np.ndarray, " height"]) -> tuple[Float[np.ndarray, " height"], Float[np.ndarray, " height"]]:
        """(x_l, x_r) at these heights, metres."""
        return self._span(y)[:2]

    def half_width_at(self, y: Float[np.ndarray, " height"]) -> Float[np.ndarray, " height"]:
        """From the axis to the nearer end of the outline at these heights, metres."""
        left, right, axis = self._span(y)
        return np.minimum(axis - left, right - axis)

    def _span(self, y):
        """(x_l, x_r, x_a) at each height; beyond the outline, by its last straight lines."""
        slab = np.searchsorted(self.height[1:-1], y, side="right")
        t = (y - self.height[slab]) / (self.height[slab + 1] - self.height[slab])
        left = self.left[slab, 0] + t * (self.left[slab, 1] - self.left[slab, 0])
        right = self.right[slab, 0] + t * (self.right[slab, 1] - self.right[slab, 0])
        quarter = 0.25 * (right - left)
        return left, right, np.minimum(np.maximum(self.axis, left + quarter), right - quarter)

    def on_page(self, point: Float[np.ndarray, "point 3"]) -> Bool[np.ndarray, " point"]:
        """Which points lie inside the outline as the page shows them, whatever their depth."""
        y = point[:, 1]
        left, right, _ = self._span(y)
        return (y >= self.height[0]) & (y <= self.height[-1]) & (point[:, 0] >= left) & (point[:, 0] <= right)

    def margin(self, point: Float[np.ndarray, "point 3"]) -> Float[np.ndarray, " point"]:
        """How far inside the surface each point lies, along its own radius, metres; negative outside."""
        y = point[:, 1]
        left, right, axis = self._span(y)
        dx, dz = point[:, 0] - axis, point[:, 2] - self.centre_z
        radius = np.hypot(dx, dz)
        cosine = dx / np.maximum(radius, 1e-300)
        surface = 0.5 * (right - left + (right + left - 2 * axis) * cosine)
        beyond = (y < self.height[0]) | (y > self.height[-1])
        return np.where(beyond, -np.inf, surface - radius)


@dataclass(frozen=True, eq=False)
class Envelope:
    """The space the tree may fill: the union of one or several lobes."""

    lobes: tuple[Lobe, ...]
    binding: bool = True  # what starts outside may not grow there; else (an implied crown) it grows freely

    @classmethod
    def from_outlines(cls, outlines, centre_z: float = 0.0) -> "Envelope":
        """The envelope of closed outlines (each point 2, world metres); raises OptionError for a degenerate one."""
        return cls(tuple(Lobe.from_outline(outline, centre_z) for outline in outlines))

    @property
    def bounds(self) -> tuple[Float[np.ndarray, " 3"], Float[np.ndarray, " 3"]]:
        """Two corners of a box that holds all lobes, metres."""
        low = [(lobe.left.min(), lobe.height[0], lobe.centre_z - lobe.reach) for lobe in self.lobes]
        high = [(lobe.right.max(), lobe.height[-1], lobe.centre_z + lobe.reach) for lobe in self.lobes]
        return np.min(low, axis=0), np.max(high, axis=0)

    def inside(self, point: Float[np.ndarray, "point 3"]) -> Bool[np.ndarray, " point"]:
        """Which points lie inside or on the surface."""
        within = np.zeros(len(point), bool)
        for lobe in self.lobes:
            within |= lobe.margin(point) >= 0
        return within

    def on_page(self, point: Float[np.ndarray, "point 3"]) -> Bool[np.ndarray, " point"]:
        """Which points lie inside an outline as the page shows them, whatever their depth."""
        return np.any([lobe.on_page(point) for lobe in self.lobes], axis=0)

    def exit_fraction(
        self, start: Float[np.ndarray, "branch 3"], end: Float[np.ndarray, "branch 3"], bisections: int = _BISECTIONS
    ) -> Float[np.ndarray, " branch"]:
        """The fraction of each segment from `start` to `end` that may be grown: 1 where the end is inside, else up to
        where the surface is first found by bisection. What starts and ends outside is 0 (1 if the envelope
        does not bind)."""
        fraction = self.inside(end).astype(float)
        out = np.flatnonzero(fraction == 0.0)
        start_inside = self.inside(start[out])
        if not self.binding:
            fraction[out[~start_inside]] = 1.0
        rows = out[start_inside]
        if len(rows):
            low = np.zeros(len(rows))
            high = np.ones(len(rows))
            origin, vector = start[rows], end[rows] - start[rows]
            for _ in range(bisections):
                middle = 0.5 * (low + high)
                within = self.inside(origin + middle[:, None] * vector)
                low, high = np.where(within, middle, low), np.where(within, high, middle)
            fraction[rows] = low
        return fraction


def _centroid_x(a, b):
    """x of the polygon's centroid; of its middle if its area vanishes (a curve that crosses itself evenly)."""
    middle, level = 0.5 * (a.min(axis=0) + a.max(axis=0))
    a, b = a - (middle, level), b - (middle, level)
    cross = a[:, 0] * b[:, 1] - b[:, 0] * a[:, 1]
    area = cross.sum()
    if abs(area) < 1e-9 * np.ptp(a[:, 0]) * np.ptp(a[:, 1]):
        return float(middle)
    x = float(((a[:, 0] + b[:, 0]) * cross).sum() / (3 * area))
    return float(middle) + (x if a[:, 0].min() < x < a[:, 0].max() else 0.0)
