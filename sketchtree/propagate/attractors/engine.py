"""One tree grows to its attractors (Tan et al. 2008, §3.1-3.2).

    repeat   a small set of branches (`candidates`) × every subtree of the library × 12 turns (`placement`), pruned by the foliage (`pruning`);
             the one that lowers the energy most replaces its branch; E2D drives one iteration, E3D the next
    until    no replacement lowers either energy, about a hundred iterations are done, or few attractors are far (ours)

The few best by gain alone are pruned by what stands there already, then the best of them is taken. Ours, each to be switched off by `Wanted`: several branches
are replaced in one iteration, those near which attractors are far are candidates first, and single twigs go to what is still far in the end (`ends`).
"""

from dataclasses import dataclass, field, replace

import numpy as np
from jaxtyping import Array, Float, Key

from sketchtree import keys
from sketchtree.axes import NULL
from sketchtree.limb_ids import child_limb_id
from sketchtree.propagate.attractors import ends
from sketchtree.propagate.attractors.attractors import Attractors, image_attractors, turned_joints, volume_attractors
from sketchtree.propagate.attractors.candidates import candidates
from sketchtree.propagate.attractors.gain import gains
from sketchtree.propagate.attractors.library import Library
from sketchtree.propagate.attractors.placement import Placed, placed
from sketchtree.propagate.attractors.places import Places
from sketchtree.propagate.attractors.pruning import DEEP, whole_branches, within_foliage
from sketchtree.propagate.attractors.revolved import Axes
from sketchtree.propagate.attractors.subtree import RATIO
from sketchtree.propagate.attractors.target import Target
from sketchtree.propagate.attractors.wanted import Wanted
from sketchtree.propagate.attractors.wood import Limb, Stretch, Wood

_BEST = 6  # placements that are looked at closely in one iteration
_IDLE = 8  # iterations in a row that nothing was found in, after which nothing is expected any more
_LEAST = 0.5  # leaf lengths: a smaller gain is none
_CLOSE = 0.6  # leaf lengths: branches nearer to one another are too near
_SHORTEST = 1.6  # leaf lengths: a shorter branch isn't replaced
_PIECE = 0.35  # leaf lengths: a shorter piece isn't grown
_SAMPLE = 0.5  # leaf lengths between places along the wood
_WIDE = 0.9  # of the distance between attractors in 3D: what is farther from the tree is empty
_FEW = 0.08  # of the attractors on the page still far: single twigs do the rest
_FEW_IN_SPACE = 0.25  # of those in space likewise
_RANK = 1 << 20  # ranks of limbs grown here start there, so that other stages' are others


@dataclass(eq=False)
class Course:
    """What a person would plot of a run: one entry an iteration."""

    driver: list[str] = field(default_factory=list)  # image | space | twigs
    image: list[float] = field(default_factory=list)  # E2D, metres
    space: list[float] = field(default_factory=list)  # E3D, metres
    in_space: list[int] = field(default_factory=list)  # attractors in 3D that there are then
    segments: list[int] = field(default_factory=list)  # straight pieces grown so far


@dataclass(eq=False)
class Choice:
    """One subtree in one turn on one branch."""

    most: float  # metres, that it can gain
    number: int  # of the stretch
    flat: int  # subtree and turn in one number
    at: Placed


class Engine:
    """One tree while it grows."""

    def __init__(self, wood: Wood, target: Target, library: Library, wanted: Wanted, leaf: float, key: Key[Array, ""]):
        self.wood, self.library, self.wanted, self.leaf, self.key = wood, library, wanted, leaf, keys.draw_key(key)
        self.seen = target.coarser()
        self.target = self.seen.closed(leaf)
        trunk = wood.trunk()
        self.axes = Axes.about_trunk(self.target, trunk) if wanted.axis == "trunk" else Axes.about_crown(self.target, trunk)
        rows = np.flatnonzero(self.seen.mask.any(axis=1))
        self.hearth = float(self.seen.top - (0.85 * rows[-1] + 0.15 * rows[0]) * self.seen.pixel)  # where the crown comes from, metres up
        self.image = Attractors.at(image_attractors(self.seen, leaf))
        self.space = Attractors.at(self._in_space())
        self.stretches: list[Stretch] = []
        self.parts: list[np.ndarray] = []  # places along each limb
        self.places, self.course, self.grown, self.iteration = Places(), Course(), 0, 0
        self.forked: set[tuple[int, float]] = set()  # (limb, metres along it): where a subtree of type I stands already; a shoot forks at its end once
        self._taken = 0
        self._take_up()

    def run(self, pulse=lambda: None) -> str:
        """Iteration after iteration; what ended it."""
        idle = 0
        while self.iteration < self.wanted.iterations and idle < _IDLE and not self._is_filled():
            pulse()
            driver = "image" if not self.wanted.alternate or self.iteration % 2 == 0 else "space"
            idle = 0 if self._iterate(driver) else idle + 1
            self._note(driver)
            self.iteration += 1
            if self.grown >= self.wanted.max_segments:
                return "max_segments"
        self._end_in_twigs(pulse)
        return "stalled" if idle >= _IDLE else "iterations" if self.iteration >= self.wanted.iterations else "filled"

    def _is_filled(self) -> bool:
        """Whether what is left is the work of twigs: few attractors are still far."""
        if not self.wanted.twigs or self.wanted.depth != "volume":
            return False
        few = np.mean(self.image.distance > self.leaf) < _FEW
        return bool(few and (not self.wanted.alternate or np.mean(self.space.distance > _WIDE * self.interval) < _FEW_IN_SPACE))

    def _end_in_twigs(self, pulse) -> None:
        """Single twigs to what is still far, on the page and in space by turns (`ends`)."""
        for round_ in range(ends.ROUNDS if self.wanted.twigs else 0):
            pulse()
            grew = self._reach(self.image, 0.9 * self.leaf, round_)
            self._note("twigs")
            if self.wanted.alternate and self.wanted.depth == "volume":
                grew |= self._reach(self.space, max(_WIDE * self.interval, 2.0 * self.leaf), round_ + ends.ROUNDS)
                self._note("twigs")
            if not grew or self.grown >= self.wanted.max_segments:
                return

    def _reach(self, attractors: Attractors, floor: float, round_: int) -> bool:
        """One round of twigs; whether any grew."""
        far = ends.farthest(attractors.place, attractors.distance, floor, ends.CELL * max(floor, self.leaf))
        far = far[: (self.wanted.max_segments - self.grown) // ends.PIECES + 1]
        if len(far) == 0 or len(self.parts) == 0:
            return False
        wood, samples = self.wood, self.parts
        number = np.repeat(np.arange(len(wood)), [len(one) for one in samples])
        arc = np.concatenate([np.arange(1, len(one) + 1) / len(one) * limb.length for one, limb in zip(samples, wood.limbs, strict=True)])
        parent, at, point = ends.ways(attractors.place[far], np.concatenate(samples), number, arc, wood, self.leaf, self.key, round_)
        free = self.target.inside(point[:, 1:]).all(axis=1) & (self.axes.out(point[:, -1]) <= np.maximum(DEEP, self.axes.out(point[:, 0])))
        for bearer, place, line in zip(parent[free].tolist(), at[free].tolist(), point[free], strict=True):
            self._bear(bearer, place, line)
        self._take_up()
        return bool(free.any())

    def _bear(self, parent: int, at: float, point: Float[np.ndarray, "point 3"]) -> None:
        """A new limb."""
        bearer = self.wood.limbs[parent]
        identity = int(child_limb_id(np.array([bearer.identity]), np.array([_RANK + bearer.sprouted]))[0])
        bearer.sprouted += 1
        self.wood.limbs.append(Limb(identity, parent, float(at), point, bearer.generation + 1, bearer.radius * RATIO, bearer.order + 1))
        self.grown += len(point) - 1

    def _iterate(self, driver: str) -> bool:
        """The replacements of one iteration, each of another branch; whether any lowers the energy."""
        attractors = self.image if driver == "image" else self.space
        need = attractors.need(len(self.wood)) if self.wanted.candidates == "need" else None
        open_ = []
        for number in candidates(self.stretches, self.wood, self.key, self.iteration, need):
            at = self._placed(self.stretches[number])
            gain = gains(attractors, at, self.library.reach * at.stretch.length)
            at.stretch.replaced += gain.max() <= _LEAST * self.leaf
            best = np.argsort(-gain, axis=None, kind="stable")[:_BEST]
            open_ += [Choice(float(gain.flat[flat]), number, int(flat), at) for flat in best if gain.flat[flat] > _LEAST * self.leaf]
        done = 0
        while done < self.wanted.replacements and (best := self._best(attractors, open_)) is not None:
            self._grow(*best)
            self._take_up()
            open_, done = [one for one in open_ if one.at.stretch is not best[1].stretch], done + 1
        return done > 0

    def _best(self, attractors: Attractors, open_: list["Choice"]):
        """Of the choices left, (subtree, placement) of that with the highest gain once it is pruned by what stands already; None where none is worth it. What has once been found is the most
        that will be found later, since the tree only comes nearer: so a choice is looked at anew only while it may still be the best."""
        best, gain = None, _LEAST * self.leaf
        for choice in sorted(open_, key=lambda one: (-one.most, one.number, one.flat)):
            if choice.most <= gain:
                break
            choice.most, *found = self._close(attractors, choice.flat, choice.at)
            if choice.most > gain:
                best, gain = found, choice.most
        return best

    def _placed(self, stretch: Stretch) -> Placed:
        """The library on a stretch, pruned by the foliage."""
        middle, _ = self.wood.line(stretch, np.array(0.5))
        light = self._light(middle)
        at = placed(self.library, self.wood, stretch, light, self.wanted.rise)
        if (stretch.limb, stretch.high) in self.forked:
            at = replace(at, there=at.there & ~self.library.is_type_one[:, None, None])
        return within_foliage(at, self.library, self.target, self.axes, light, _PIECE * self.leaf)

    def _light(self, point):
        """Unit vector away from where the crown comes from, and up."""
        out = self.axes.outward(point[None])[0]
        out[1] = max(point[1] - self.hearth, 0.0)
        out /= max(np.linalg.norm(out), 1e-300)
        light = out + [0.0, 0.5, 0.0]
        return light / max(np.linalg.norm(light), 1e-300)

    def _close(self, attractors: Attractors, flat: int, at: Placed):
        """(gain, subtree, turn, placement) of one placement, without branches too near to others."""
        subtree, turn = np.unravel_index(flat, at.there.shape[:2])
        one = Placed(at.stretch, at.middle, at.start[[subtree], turn][None][:, 0][:, None], at.end[[subtree], turn][:, None], at.there[[subtree], turn][:, None])
        library, stretch_length = self.library, at.stretch.length
        middle = 0.5 * (one.start + one.end)
        beyond = library.subtrees[subtree]
        outer = np.zeros(one.there.shape[-1], bool)
        outer[: len(beyond)] = np.r_[False, beyond.branch[1:] == beyond.branch[:-1]]
        room = np.maximum(_CLOSE * self.leaf, self.wanted.apart * np.r_[_lengths(beyond), np.zeros(len(outer) - len(beyond))] * stretch_length)
        away = self.places.distance(np.stack([middle, one.end]).reshape(-1, 3), float(room.max()))
        clear = (away.reshape(2, -1) > room).all(axis=0) | ~outer
        part = Library((beyond,), library.vector[[subtree]], library.share[[subtree]], library.along[[subtree]], library.there[[subtree]],
                       library.below[[subtree]], library.with_next[[subtree]])  # fmt: skip
        one = Placed(one.stretch, one.middle, one.start, one.end, whole_branches(one.there & clear, part))
        gain = gains(attractors, one, library.reach * at.stretch.length, 0.0)
        return float(gain[0, 0]), beyond, one

    def _grow(self, subtree, one: Placed) -> None:
        """The new branches become limbs."""
        stretch, wood = one.stretch, self.wood
        there, start, end = one.there[0, 0], one.start[0, 0], one.end[0, 0]
        piece_at: dict[int, tuple[int, float]] = {}
        for branch in range(subtree.branches):
            pieces = np.flatnonzero((subtree.branch == branch) & there[: len(subtree)])
            if len(pieces) == 0:
                continue
            first = pieces[0]
            above = subtree.parent[first]
            parent, at = (stretch.limb, stretch.low + subtree.share[first] * stretch.length) if above == NULL else piece_at[int(above)]
            self._bear(parent, at, np.concatenate([start[[first]], end[pieces]]))
            for piece, arc in zip(pieces, wood.limbs[-1].arc[1:], strict=True):
                piece_at[int(piece)] = (len(wood) - 1, float(arc))
        stretch.replaced += 1
        if subtree.is_type_one:
            self.forked.add((stretch.limb, stretch.high))

    def _take_up(self) -> None:
        """Distances, places and branches of what has grown since this was last asked."""
        first, wood = self._taken, self.wood
        for attractors in (self.image, self.space):
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

    def _in_space(self):
        """Attractors in 3D that are there from the start."""
        if self.wanted.depth == "joints":
            return np.zeros((0, 3))
        page = len(self.image.place) * self.leaf**2
        volume = page * 1.6 * float(self.axes.half.max())
        self.interval = max((volume / self.wanted.in_space) ** (1 / 3), self.leaf)
        return volume_attractors(self.target, self.axes, self.interval)

    def _note(self, driver: str) -> None:
        course = self.course
        course.driver.append(driver)
        course.image.append(self.image.energy)
        course.space.append(self.space.energy)
        course.in_space.append(len(self.space))
        course.segments.append(self.grown)


def _lengths(subtree):
    """How long the branch of each piece is; the supporting branch is 1 long."""
    return np.bincount(subtree.branch, np.linalg.norm(subtree.vector, axis=1))[subtree.branch]
