"""Where does each limb stand on its parent's surface?

As for a tube's collar (see `collars`), each generator of the limb is followed until it leaves the parent's wood, at F, and
goes over into the parent's surface at A, a collar's width aside. The points A, as places (θ, s) on the parent, are the limb's
outline: a polygon with one corner for each column of the limb, counter-clockwise seen from outside.

Thin limbs have a narrow collar of two rings: the outline, and the ring where the tube is clear of the parent.
"""

from dataclasses import dataclass, replace

import numpy as np
from jaxtyping import Float, Int

from sketchtree.axes import NULL
from sketchtree.geometry.collars import along, feet, skirt_of, ways_out, wood_near
from sketchtree.geometry.detail import Detail
from sketchtree.geometry.limbs import CentreLines
from sketchtree.geometry.one_piece.grid import Grid
from sketchtree.geometry.resolution import collar_rings

_WIDTH, _THIN_WIDTH = 1.2, 0.6  # of a collar, / radius of the limb
_LEAST = 0.5  # half the outline, at least, / radius of the limb
_BEHIND, _AHEAD, _PIECES = 5.0, 10.0, 30  # stretch of the parent that is searched, / its radius


@dataclass(frozen=True, eq=False)
class Collars:
    """One a lateral, in the order of the limbs."""

    limb: Int[np.ndarray, " fork"]
    size: Int[np.ndarray, " fork"]  # rings, the outline included; 2 for a thin limb
    top: Float[np.ndarray, " fork"]  # metres along the limb: its last ring
    width: Float[np.ndarray, " fork"]  # / radius of the limb
    ease: Float[np.ndarray, " fork"]  # share of the way from the shoulder to the top that the bow takes longer, for an outline that has moved


@dataclass(frozen=True, eq=False)
class Outlines:
    """The polygons, ragged: fork f owns the corners `start[f]:start[f + 1]`, one for each column of its limb."""

    limb: Int[np.ndarray, " fork"]
    parent: Int[np.ndarray, " fork"]
    thick: Float[np.ndarray, " fork"]  # radius of the parent there, metres
    thin: Float[np.ndarray, " fork"]  # radius of the limb past its collar, metres
    start: Int[np.ndarray, " fork+1"]
    theta: Float[np.ndarray, " corner"]  # radians, unwrapped within a fork
    s: Float[np.ndarray, " corner"]  # metres along the parent
    rise: Float[np.ndarray, "2 corner 2"]  # from A to F and from A to C on the parent's chart, radians and metres; 0 for thin limbs

    @property
    def of_corner(self) -> Int[np.ndarray, " corner"]:
        """The fork of each corner."""
        return np.repeat(np.arange(len(self.limb)), np.diff(self.start))

    def box(self) -> tuple[Float[np.ndarray, " fork"], ...]:
        """Least and largest θ, least and largest s."""
        first = self.start[:-1]
        if len(first) == 0:
            return (np.zeros(0),) * 4
        ends = [(np.minimum.reduceat(x, first), np.maximum.reduceat(x, first)) for x in (self.theta, self.s)]
        return *ends[0], *ends[1]

    def only(self, fork: Int[np.ndarray, " some"]) -> "Outlines":
        """Those of some forks, in order."""
        corner = np.flatnonzero(np.isin(self.of_corner, fork))
        start = np.r_[0, np.cumsum(np.diff(self.start)[fork])].astype(np.int64)
        return Outlines(*(x[fork] for x in (self.limb, self.parent, self.thick, self.thin)), start, self.theta[corner], self.s[corner], self.rise[:, corner])

    def moved(self, theta, s, across, along) -> "Outlines":
        """Scaled by `across` and `along` about the middle of their boxes, which come to stand at `theta` and `s` (all by fork)."""
        west, east, low, high = self.box()
        f = self.of_corner
        turned = theta[f] + across[f] * (self.theta - 0.5 * (west + east)[f])
        return replace(self, theta=turned, s=s[f] + along[f] * (self.s - 0.5 * (low + high)[f]))


def collars_of(lines: CentreLines, foot_side: Int[np.ndarray, " limb"], detail: Detail, height: float) -> Collars:
    """How large the collar of every lateral is; limbs that bear others keep the upper half of their length free."""
    limb = np.flatnonzero(lines.parent != NULL)
    if len(limb) == 0:
        return Collars(limb, limb, np.zeros(0), np.zeros(0), np.zeros(0))
    thick = lines.radius[lines.start[:-1]][limb] >= detail.collar_radius * height
    width = np.where(thick, _WIDTH, _THIN_WIDTH)
    way = ways_out(lines, limb)
    bears = np.isin(limb, lines.parent)
    most = np.where(bears, 0.5, 0.85) * lines.length[limb]
    top = np.where(way.leaves, np.minimum(way.clear(width + 0.4), most), 0.5 * lines.length[limb])
    return Collars(limb, np.where(thick, collar_rings(foot_side[limb]) - 1, 2), top, width, np.zeros(len(limb)))


def outlines(lines: CentreLines, grid: Grid, x: Float[np.ndarray, "vertex 3"], collars: Collars) -> tuple[Outlines, Float[np.ndarray, "3 corner 3"]]:
    """The outline of every lateral as it would be if it stood alone; and A, F and the place on each generator where the
    collar goes over into the tube, metres (world)."""
    side = grid.side[grid.ring.start[:-1]][collars.limb]
    start = np.r_[0, np.cumsum(side)].astype(np.int64)
    profile = np.zeros((3, start[-1], 3))
    for n, size in np.unique(np.stack([side, collars.size]), axis=1).T.tolist():
        some = np.flatnonzero((side == n) & (collars.size == size))
        corner = start[some][:, None] + np.arange(n)
        profile[:, corner] = _profiles(lines, grid, x, collars, some, n, size)
    parent = lines.parent[collars.limb]
    fork = np.repeat(np.arange(len(side)), side)
    theta, s = _chart(lines, grid, collars.limb, profile[0], fork)
    bowed = np.flatnonzero((collars.size > 2)[fork])
    rise = np.zeros((2, len(fork), 2))
    for k in (0, 1):
        over, up = _chart(lines, grid, collars.limb, profile[k + 1, bowed], fork[bowed])
        rise[k, bowed] = np.stack([_wrapped(over - theta[bowed]), up - s[bowed]], axis=1)
    _, thick = lines.at(parent, lines.parent_s[collars.limb])
    last = grid.ring.start[collars.limb] + collars.size - 1
    found = Outlines(collars.limb, parent, thick, grid.ring.radius[last], start, _continuous(theta, fork, start), s, rise)
    return _rounded(found), profile


def _profiles(lines, grid: Grid, x, collars: Collars, some, n: int, size: int):
    """A, F and the shoulder for the forks `some`, whose limbs have n columns and collars of `size` rings."""
    limb = collars.limb[some]
    rows = grid.ring.start[limb][:, None] + np.arange(size)
    tube, length = x[grid.first[rows][..., None] + np.arange(n)], grid.ring.s[rows[:, -1]]
    surface = wood_near(lines, limb)
    foot = feet(surface, tube, length)
    width = (collars.width[some] * grid.ring.radius[rows[:, -1]])[:, None]
    shoulder = np.minimum(foot + width, 0.97 * length[:, None])
    at_foot, at_shoulder = along(tube, foot, length), along(tube, shoulder, length)
    low, _, _ = skirt_of(surface, at_foot, at_shoulder, grid.ring.point[rows[:, -1]], width, 0.0)
    return np.stack([low, at_foot, at_shoulder])


def _chart(lines, grid: Grid, limb, point, fork):
    """θ and s on their parents of points near the feet of the limbs of `fork`."""
    parent, place = lines.parent[limb], lines.parent_s[limb]
    _, thick = lines.at(parent, place)
    along_s = np.clip(place[:, None] + thick[:, None] * np.linspace(-_BEHIND, _AHEAD, _PIECES + 1), 0.0, lines.length[parent][:, None])
    line, _ = lines.at(np.repeat(parent, _PIECES + 1).reshape(along_s.shape), along_s)
    a, d = line[:, :-1], np.diff(line, axis=1)
    squared = np.maximum(np.sum(d * d, axis=-1), 1e-18)
    share = np.clip(np.einsum("pkc,pkc->pk", point[:, None] - a[fork], d[fork]) / squared[fork], 0.0, 1.0)
    away = np.linalg.norm(point[:, None] - a[fork] - share[..., None] * d[fork], axis=-1)
    best = np.argmin(away, axis=1)
    s = along_s[fork, best] + share[np.arange(len(point)), best] * np.diff(along_s, axis=1)[fork, best]
    return grid.place(parent[fork], s, point), s


def _continuous(theta, fork, start):
    """θ without jumps round each fork."""
    step = _wrapped(np.r_[0.0, np.diff(theta)][: len(theta)])
    step[start[:-1]] = 0.0
    total = np.cumsum(step)
    return theta[start[:-1]][fork] + total - total[start[:-1]][fork]


def _wrapped(angle):
    return (angle + np.pi) % (2.0 * np.pi) - np.pi


def _rounded(o: Outlines) -> Outlines:
    """Outlines whose corners go once round their middle, counter-clockwise; where they don't, an ellipse takes their place."""
    if len(o.limb) == 0:
        return o
    f, first = o.of_corner, o.start[:-1]
    count = np.diff(o.start)
    west, east, low, high = o.box()
    least = _LEAST * o.thin
    x, y = (o.theta - 0.5 * (west + east)[f]) * o.thick[f], o.s - 0.5 * (low + high)[f]
    phi = np.arctan2(y, x)
    after = np.arange(1, len(phi) + 1)
    after[o.start[1:] - 1] = first
    turn = (phi[after] - phi + np.pi) % (2.0 * np.pi) - np.pi
    once = np.abs(np.add.reduceat(turn, first) - 2.0 * np.pi) < 1e-6
    good = once & (np.minimum.reduceat(turn, first) > 0.15 * np.pi / count) & (np.minimum(0.5 * (east - west) * o.thick, 0.5 * (high - low)) > 0.5 * least)
    wide, tall = (np.clip(half, least, 2.0 * o.thin) for half in (0.5 * (east - west) * o.thick, 0.5 * (high - low)))
    within = np.arange(len(f)) - first[f]
    even = 2.0 * np.pi * within / count[f]
    phase = np.arctan2(np.add.reduceat(np.sin(phi - even), first), np.add.reduceat(np.cos(phi - even), first))
    even = even + phase[f]
    middle = np.where(once, 0.5 * (west + east), o.theta[first])
    theta = np.where(good[f], o.theta, middle[f] + wide[f] * np.cos(even) / o.thick[f])
    return replace(o, theta=theta, s=np.where(good[f], o.s, 0.5 * (low + high)[f] + tall[f] * np.sin(even)))


