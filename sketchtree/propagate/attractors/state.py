"""What is known of one tree while it grows to its attractors?

Its limbs (`wood`), where they are (`places`, `thick`), where foliage is and how far each attractor is from the tree. Whoever grows a limb says so (`bear`); distances, places and branches that may be
replaced follow once for all that has grown since (`take_up`).
"""

from dataclasses import dataclass, field

import numpy as np
from jaxtyping import Array, Float, Key
from scipy.spatial import cKDTree

from sketchtree import keys
from sketchtree.limb_ids import child_limb_id
from sketchtree.propagate.attractors.attractors import Attractors, distances, image_attractors, turned_joints, volume_attractors
from sketchtree.propagate.attractors.places import Places
from sketchtree.propagate.attractors.revolved import Axes
from sketchtree.propagate.attractors.subtree import RATIO
from sketchtree.propagate.attractors.target import Target
from sketchtree.propagate.attractors.thick import Thick
from sketchtree.propagate.attractors.wanted import Wanted
from sketchtree.propagate.attractors.wood import Limb, Stretch, Wood

_SAMPLE = 0.5  # leaf lengths between places along the wood
_SHORTEST = 1.6  # leaf lengths: a shorter branch isn't replaced
_UNDER = 0.9  # leaf lengths: foliage so near to a drawn limb has no twig yet for its leaves
_BARK = 1.0  # leaf lengths: a limb as thick hides the leaves that would hang before it, and bears none
_LOOSE = 0.3  # of the distance between attractors in 3D: so far each is off the grid at most, along each axis, so that nothing grows along its lines


@dataclass(eq=False)
class Course:
    """What a person would plot of a run: one entry an iteration."""

    driver: list[str] = field(default_factory=list)  # boughs | image | space | twigs
    image: list[float] = field(default_factory=list)  # E2D, metres
    space: list[float] = field(default_factory=list)  # E3D, metres
    in_space: list[int] = field(default_factory=list)  # attractors in 3D that there are then
    segments: list[int] = field(default_factory=list)  # straight pieces grown so far


class State:
    """One tree while it grows."""

    def __init__(self, wood: Wood, target: Target, wanted: Wanted, leaf: float, key: Key[Array, ""]):
        self.wood, self.wanted, self.leaf, self.key = wood, wanted, leaf, keys.draw_key(key)
        seen = target.coarser()
        self.target = seen.closed(leaf)  # wood may go through
        self.home = seen.dense(leaf) if wanted.dense else self.target  # wood may end in
        trunk = wood.trunk()
        self.axes = Axes.about_trunk(self.target, trunk) if wanted.axis == "trunk" else Axes.about_crown(self.target, trunk)
        rows = np.flatnonzero(seen.mask.any(axis=1))
        self.hearth = float(seen.top - (0.85 * rows[-1] + 0.15 * rows[0]) * seen.pixel)  # where the crown comes from, metres up
        self.thick = Thick.of(wood, leaf)
        self.image = Attractors.at(image_attractors(self.home if wanted.dense else seen, leaf))
        self.space = Attractors.at(self._in_space())
        self.stretches: list[Stretch] = []
        self.parts: list[np.ndarray] = []  # places along each limb
        self.places, self.course, self.grown, self._taken = Places(), Course(), 0, 0
        self.take_up()
        self.along = self._along_limbs(seen)

    @property
    def is_full(self) -> bool:
        """Whether as much has grown as may."""
        return self.grown >= self.wanted.max_segments

    def bear(self, parent: int, at: float, point: Float[np.ndarray, "point 3"]) -> None:
        """A new limb."""
        bearer = self.wood.limbs[parent]
        identity = int(child_limb_id(np.array([bearer.identity]), np.array([self.wanted.first_rank + bearer.sprouted]))[0])
        bearer.sprouted += 1
        self.wood.limbs.append(Limb(identity, parent, float(at), point, bearer.generation + 1, bearer.radius * RATIO, bearer.order + 1))
        self.grown += len(point) - 1

    def take_up(self) -> None:
        """Distances, places and branches of what has grown since this was last asked."""
        first, wood = self._taken, self.wood
        for attractors in (self.image, self.space, *((self.along,) if first else ())):
            attractors.approach(*wood.pieces(first))
        new = [limb.samples(_SAMPLE * self.leaf) for limb in wood.limbs[first:]]
        self.parts += new
        self.places.add(np.concatenate([np.zeros((0, 3)), *new]))
        self.stretches += wood.stretches(first, self.target.inside, _SHORTEST * self.leaf)
        if self.wanted.depth == "joints":
            more = turned_joints(wood.joints(first), self.target, self.axes)
            if len(more):
                more = Attractors.at(more)
                more.approach(*wood.pieces())
                self.space.add(more)
        self._taken = len(wood)

    def note(self, driver: str) -> None:
        """One entry more of the course."""
        course = self.course
        course.driver.append(driver)
        course.image.append(self.image.energy)
        course.space.append(self.space.energy)
        course.in_space.append(len(self.space))
        course.segments.append(self.grown)

    def light(self, point: Float[np.ndarray, "*point 3"]) -> Float[np.ndarray, "*point 3"]:
        """Unit vectors away from where the crown comes from, and up."""
        out = self.axes.outward(point)
        out[..., 1] = np.maximum(point[..., 1] - self.hearth, 0.0)
        light = _unit(out) + [0.0, 0.5, 0.0]
        return _unit(light)

    def along_wood(self):
        """(number of the limb, metres along it) of each of `parts`, end to end."""
        number = np.repeat(np.arange(len(self.wood)), [len(one) for one in self.parts])
        arc = np.concatenate([np.zeros(0), *(np.arange(1, len(one) + 1) / len(one) * limb.length for one, limb in zip(self.parts, self.wood.limbs, strict=True))])
        return number, arc

    def _in_space(self):
        """Attractors in 3D that are there from the start."""
        if self.wanted.depth == "joints":
            return np.zeros((0, 3))
        page = len(self.image.place) * self.leaf**2
        volume = page * 1.6 * float(self.axes.half.max())
        self.interval = max((volume / self.wanted.in_space) ** (1 / 3), self.leaf)
        place = volume_attractors(self.home, self.axes, self.interval)
        number = np.arange(place.size).reshape(place.shape)
        return place + _LOOSE * self.interval * (2.0 * keys.uniform(self.key, number.ravel(), 0).reshape(place.shape) - 1.0)

    def _along_limbs(self, seen: Target) -> Attractors:
        """Attractors on the page, of all foliage, that a drawn limb is near, though none whose bark would show: no leaf has a twig there yet, so that they count as far until something grows (ours)."""
        if not self.wanted.along:
            return Attractors.at(np.zeros((0, 2)))
        place, thick = image_attractors(seen, self.leaf), self.thick
        near = distances(place, *(ends[:, :2] for ends in self.wood.pieces()[:2]))[0] <= _UNDER * self.leaf
        bark = thick.radius > _BARK * self.leaf
        if bark.any():
            away, ball = cKDTree(thick.place[bark, :2]).query(place)
            near &= away > thick.radius[bark][ball] + _UNDER * self.leaf
        return Attractors.at(place[near])


def _unit(vector):
    return vector / np.maximum(np.linalg.norm(vector, axis=-1, keepdims=True), 1e-300)
