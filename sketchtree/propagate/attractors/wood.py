"""The tree while it grows: limbs as lines, and what grows where on which.

    limb      an apical chain of rows of the skeleton given, with all its drawn points; or a new branch, its pieces end to end
    stretch   what counts as one *branch* that can be replaced: a limb whole; of a given limb also its part in the foliage, and each longer piece between two joints

The paper's skeletons consist of straight pieces between joints (§2: joints that bend less than 30° are dropped). Drawn limbs are long and curved and bear many laterals, so that such
pieces would all be short; a subtree is therefore laid along the line of a stretch, curved or not. For a straight piece that is the paper's replacement.
"""

from dataclasses import dataclass, field

import numpy as np
from jaxtyping import Float, Int

from sketchtree.axes import NULL
from sketchtree.skeleton import TreeSkeleton
from sketchtree.traverse import limb_chains

_TANGENT = 0.08  # of a stretch: half of what its direction at a place is taken over
_FOOT = 1e-9  # metres: a shorter limb is a point
_LOOKS = 65  # places along a limb, of which the first in the foliage is where it enters that
_OUTSIDE = 0.2  # of a limb, before it enters the foliage: the part within counts as a branch too
_BETWEEN = 0.3  # of its limb, a piece between two joints is at least, to count as a branch


@dataclass(eq=False)
class Limb:
    """One limb."""

    identity: int  # the skeleton's 63-bit id
    parent: int  # number of the limb it grows on; NULL
    at: float  # metres along that
    point: Float[np.ndarray, "point 3"]  # from its foot, metres
    generation: int  # 1 for what was given, 1 more for every replacement
    radius: float  # metres, at its foot
    order: int
    rows: tuple[int, ...] = ()  # of the tree given; () for a new one
    row_end: Float[np.ndarray, " row"] = field(default_factory=lambda: np.zeros(0))  # metres along the limb, of the tip of each of those
    row_radius: Float[np.ndarray, " row"] = field(default_factory=lambda: np.zeros(0))  # metres, there
    sprouted: int = 0  # new branches it bears

    def __post_init__(self):
        step = np.linalg.norm(np.diff(self.point, axis=0), axis=1)
        self.arc = np.r_[0.0, np.cumsum(step)]

    @property
    def length(self) -> float:
        """Metres along it."""
        return float(self.arc[-1])

    @property
    def is_given(self) -> bool:
        """Whether it is of the tree that was given."""
        return len(self.rows) > 0

    def place(self, arc) -> Float[np.ndarray, "place 3"]:
        """Points so many metres along it."""
        return np.stack([np.interp(arc, self.arc, self.point[:, axis]) for axis in range(3)], axis=-1)

    def radius_at(self, arc) -> Float[np.ndarray, " place"]:
        """Its radius so many metres along it."""
        return np.interp(arc, self.row_end, self.row_radius) if len(self.row_radius) else np.full(np.shape(arc), self.radius)

    def samples(self, spacing: float) -> Float[np.ndarray, "sample 3"]:
        """Points about `spacing` apart, its foot left out."""
        count = max(int(np.ceil(self.length / spacing)), 1)
        return self.place(np.arange(1, count + 1) / count * self.length)


@dataclass(eq=False)
class Stretch:
    """A branch that may be replaced: a part of a limb."""

    limb: int  # number
    low: float  # metres along it
    high: float
    identity: int  # by which random numbers are drawn
    replaced: int = 0  # times, and times that nothing was gained by it

    @property
    def length(self) -> float:
        """Metres."""
        return self.high - self.low


class Wood:
    """All limbs of one tree; parents precede their children."""

    def __init__(self, limbs: list[Limb]):
        self.limbs = limbs
        self.given = len(limbs)

    @classmethod
    def of(cls, tree: TreeSkeleton) -> "Wood":
        """The limbs of a tree without roots."""
        row_limb, row_end, limbs = np.full(len(tree), NULL), np.zeros(len(tree)), []
        for rows in _stretches_of_one_limb(tree):
            first = rows[0]
            above = tree.parent[first]
            point = np.concatenate([tree.curve(first), *(tree.curve(row)[1:] for row in rows[1:])])
            count = np.diff(tree.curve_start)[rows] + 1
            parent, at = (NULL, 0.0) if above == NULL else (int(row_limb[above]), float(row_end[above]))
            limb = Limb(int(tree.limb[first]), parent, at, point, 1, float(tree.radius[rows].max()), int(tree.order[first]), tuple(rows.tolist()))
            limb.row_end, limb.row_radius = limb.arc[np.cumsum(count)], tree.radius[rows]
            row_limb[rows], row_end[rows] = len(limbs), limb.row_end
            limbs.append(limb)
        return cls(limbs)

    def __len__(self) -> int:
        return len(self.limbs)

    def trunk(self) -> Float[np.ndarray, "point 3"]:
        """The line of the main trunk: of the limbs on the ground the longest."""
        stems = [limb for limb in self.limbs if limb.parent == NULL]
        return max(stems, key=lambda limb: limb.length).point

    def joints(self, first: int = 0) -> Float[np.ndarray, "joint 3"]:
        """Where limbs from number `first` on fork off, and their tips."""
        limbs = self.limbs[first:]
        forks = [self.limbs[limb.parent].place(limb.at) for limb in limbs if limb.parent != NULL]
        return np.array(forks + [limb.point[-1] for limb in limbs]).reshape(-1, 3)

    def pieces(self, first: int = 0) -> tuple[Float[np.ndarray, "piece 3"], Float[np.ndarray, "piece 3"], Int[np.ndarray, " piece"]]:
        """(start, end, limb) of all straight pieces of the limbs from number `first` on."""
        limbs = self.limbs[first:]
        start, end = ([limb.point[ends] for limb in limbs] for ends in (slice(None, -1), slice(1, None)))
        number = np.repeat(np.arange(first, len(self)), [len(limb.point) - 1 for limb in limbs])
        return np.concatenate([np.zeros((0, 3)), *start]), np.concatenate([np.zeros((0, 3)), *end]), number

    def stretches(self, first: int, inside, shortest: float) -> list[Stretch]:
        """What of the limbs from number `first` on may be replaced, `inside` saying which points are in the foliage."""
        numbers = [k for k in range(first, len(self)) if self.limbs[k].length > max(_FOOT, shortest)]
        if not numbers:
            return []
        share = np.linspace(0.0, 1.0, _LOOKS)
        within = inside(np.stack([self.limbs[k].place(share * self.limbs[k].length) for k in numbers]))
        enters = np.where(within.any(axis=1), share[np.argmax(within, axis=1)], np.nan)
        return [one for k, at in zip(numbers, enters.tolist(), strict=True) if at == at for one in self._stretches(k, at * self.limbs[k].length) if one.length > shortest]

    def _stretches(self, number: int, low: float) -> list[Stretch]:
        """What of a limb that enters the foliage `low` metres along may be replaced."""
        limb = self.limbs[number]
        found = [Stretch(number, 0.0, limb.length, limb.identity)]
        found += [Stretch(number, low, limb.length, limb.identity ^ (1 << 40))] if low > _OUTSIDE * limb.length else []
        if limb.is_given:
            joints = sorted(child.at for child in self.limbs if child.parent == number and low < child.at < limb.length)
            cuts = [low, *joints, limb.length]
            between = [(a, b) for a, b in zip(cuts[:-1], cuts[1:], strict=True) if _BETWEEN * (limb.length - low) <= b - a < limb.length - low]
            found += [Stretch(number, a, b, limb.identity ^ (k + 1)) for k, (a, b) in enumerate(between)]
        return found

    def line(self, stretch: Stretch, share) -> tuple[Float[np.ndarray, "*place 3"], Float[np.ndarray, "*place 3 3"]]:
        """(places, frames) at shares of a stretch. Columns of a frame: x level where it can be, y along the limb, z."""
        limb, share = self.limbs[stretch.limb], np.asarray(share)
        arc = stretch.low + share * stretch.length
        before, after = (limb.place(np.clip(arc + side * _TANGENT * stretch.length, 0.0, limb.length)) for side in (-1.0, 1.0))
        return limb.place(arc), frames(after - before)


def frames(direction: Float[np.ndarray, "*place 3"]) -> Float[np.ndarray, "*place 3 3"]:
    """A right-handed frame about each direction: x level, or along the page where that is upright; y the direction; z."""
    y = direction / np.maximum(np.linalg.norm(direction, axis=-1, keepdims=True), 1e-300)
    upright = np.abs(y[..., 1:2]) > 0.985
    side = np.where(upright, np.cross(y, [0.0, 0.0, 1.0]), np.cross(y, [0.0, 1.0, 0.0]))
    x = side / np.maximum(np.linalg.norm(side, axis=-1, keepdims=True), 1e-300)
    return np.stack([x, y, np.cross(x, y)], axis=-1)


def _stretches_of_one_limb(tree: TreeSkeleton) -> list[Int[np.ndarray, " row"]]:
    """The rows of every limb from its foot to its tip; what goes by one id but hangs elsewhere is a limb of its own. Limbs after those that bear them."""
    found = []
    for rows in limb_chains(tree.parent, tree.limb):
        breaks = np.flatnonzero(tree.parent[rows[1:]] != rows[:-1]) + 1
        found += np.split(rows, breaks)
    return sorted(found, key=lambda rows: rows[0])
