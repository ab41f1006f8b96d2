"""One tree grows to its attractors (Tan et al. 2008, §3.1-3.2).

    boughs   to what is far from all wood (ours; `boughs`)
    repeat   a small set of branches (`candidates`) × every subtree of the library × 12 turns (`placement`), pruned by the foliage (`pruning`);
             the one that lowers the energy most replaces its branch; E2D drives one iteration, E3D the next
    until    no replacement lowers either energy, about a hundred iterations are done, or few attractors are far (ours)
    twigs    to what is still far (ours; `ends`)

The best by gain alone are pruned by what stands there already, then the best of them is taken. Ours, each to be switched off by `Wanted`: several branches
are replaced in one iteration, those near which attractors are far are candidates first.
"""

from dataclasses import dataclass, replace

import numpy as np
from jaxtyping import Bool

from sketchtree.axes import NULL
from sketchtree.propagate.attractors import ends
from sketchtree.propagate.attractors.attractors import Attractors
from sketchtree.propagate.attractors.boughs import grow_boughs
from sketchtree.propagate.attractors.candidates import candidates
from sketchtree.propagate.attractors.gain import gains
from sketchtree.propagate.attractors.library import Library
from sketchtree.propagate.attractors.placement import Placed, placed
from sketchtree.propagate.attractors.pruning import DEEP, whole_branches, within_foliage
from sketchtree.propagate.attractors.state import State
from sketchtree.propagate.attractors.subtree import Subtree
from sketchtree.propagate.attractors.wood import Stretch

_BEST = 6  # placements of one branch that are looked at closely in one iteration
_IDLE = 8  # iterations in a row that nothing was found in, after which nothing is expected any more
_LEAST = 0.5  # leaf lengths: a smaller gain is none
_CLOSE = 0.6  # leaf lengths: branches nearer to one another are too near
_AWAY = 0.4  # of its length: the first piece of a branch ends so far from all that stands; beside a branch that goes the same way it doesn't
_PIECE = 0.35  # leaf lengths: a shorter piece isn't grown
_WIDE = 0.9  # of the distance between attractors in 3D: what is farther from the tree is empty
_FEW = 0.08  # of the attractors on the page still far: single twigs do the rest
_FEW_IN_SPACE = 0.25  # of those in space likewise


@dataclass(eq=False)
class Choice:
    """One subtree in one turn on one branch."""

    most: float  # metres, that it can gain
    number: int  # of the stretch
    flat: int  # subtree and turn in one number
    at: Placed


class Engine:
    """Grows one tree."""

    def __init__(self, state: State, library: Library):
        self.state, self.library, self.wanted, self.leaf, self.iteration = state, library, state.wanted, state.leaf, 0
        self.in_volume = self.wanted.alternate and self.wanted.depth == "volume"  # attractors that fill the foliage revolved drive too
        self.forked: set[tuple[int, float]] = set()  # (limb, metres along it): where a subtree of type I stands already; a shoot forks at its end once

    def run(self, pulse=lambda: None) -> str:
        """Iteration after iteration; what ended it."""
        idle, state = 0, self.state
        if self.wanted.boughs and self.wanted.iterations and self.in_volume:
            grow_boughs(state, pulse)
        while self.iteration < self.wanted.iterations and idle < _IDLE and not self._is_filled():
            pulse()
            driver = "image" if not self.wanted.alternate or self.iteration % 2 == 0 else "space"
            idle = 0 if self._iterate(state.image if driver == "image" else state.space) else idle + 1
            state.note(driver)
            self.iteration += 1
            if state.is_full:
                return "max_segments"
        self._end_in_twigs(pulse)
        return "stalled" if idle >= _IDLE else "iterations" if self.iteration >= self.wanted.iterations else "filled"

    def _is_filled(self) -> bool:
        """Whether what is left is the work of twigs: few attractors are still far."""
        if not self.wanted.twigs or self.wanted.depth != "volume":
            return False
        few = np.mean(self.state.image.distance > self.leaf) < _FEW
        return bool(few and (not self.wanted.alternate or np.mean(self.state.space.distance > _WIDE * self.state.interval) < _FEW_IN_SPACE))

    def _end_in_twigs(self, pulse) -> None:
        """Single twigs to what is still far, on the page, along drawn limbs and in space by turns (`ends`)."""
        state = self.state
        for round_ in range(ends.ROUNDS if self.wanted.twigs else 0):
            pulse()
            grew = self._reach(state.image, 0.9 * self.leaf, round_)
            grew |= self._reach(state.along, 0.9 * self.leaf, round_ + 2 * ends.ROUNDS, ends.ALONG)
            state.note("twigs")
            if self.in_volume:
                grew |= self._reach(state.space, max(_WIDE * state.interval, 2.0 * self.leaf), round_ + ends.ROUNDS)
                state.note("twigs")
            if not grew or state.is_full:
                return

    def _reach(self, attractors: Attractors, floor: float, round_: int, back: float = ends.BACK) -> bool:
        """One round of twigs; whether any grew."""
        state, wood = self.state, self.state.wood
        far = ends.farthest(attractors.place, attractors.distance, floor, ends.CELL * max(floor, self.leaf))
        far = far[: (self.wanted.max_segments - state.grown) // ends.PIECES + 1]
        if len(far) == 0 or len(state.parts) == 0:
            return False
        parent, at, point = ends.ways(attractors.place[far], np.concatenate(state.parts), *state.along_wood(), wood, self.leaf, state.key, round_, back)
        free = state.target.inside(point[:, 1:]).all(axis=1) & (state.axes.out(point[:, -1]) <= np.maximum(DEEP, state.axes.out(point[:, 0])))
        struck = state.thick.struck(point[:, :-1].reshape(-1, 3), point[:, 1:].reshape(-1, 3), np.repeat(parent, ends.PIECES), np.repeat(at, ends.PIECES))
        free &= ~struck.reshape(-1, ends.PIECES).any(axis=1)
        for bearer, place, line in zip(parent[free].tolist(), at[free].tolist(), point[free], strict=True):
            state.bear(bearer, place, line)
        state.take_up()
        return bool(free.any())

    def _iterate(self, attractors: Attractors) -> bool:
        """The replacements of one iteration, each of another branch; whether any lowers the energy."""
        state = self.state
        need = attractors.need(len(state.wood)) if self.wanted.candidates == "need" else None
        open_: list[Choice] = []
        for number in candidates(state.stretches, state.wood, state.key, self.iteration, need):
            at = self._placed(state.stretches[number])
            gain = gains(attractors, at, self.library.reach * at.stretch.length)
            at.stretch.replaced += gain.max() <= _LEAST * self.leaf
            best = np.argsort(-gain, axis=None, kind="stable")[:_BEST]
            open_ += [Choice(float(gain.flat[flat]), number, int(flat), at) for flat in best if gain.flat[flat] > _LEAST * self.leaf]
        done = 0
        while done < self.wanted.replacements and (best := self._best(attractors, open_)) is not None:
            self._grow(*best)
            state.take_up()
            open_, done = [one for one in open_ if one.at.stretch is not best[1].stretch], done + 1
        return done > 0

    def _placed(self, stretch: Stretch) -> Placed:
        """The library on a stretch, pruned by the foliage."""
        state = self.state
        middle, _ = state.wood.line(stretch, np.array(0.5))
        light = state.light(middle)
        at = placed(self.library, state.wood, stretch, light, self.wanted.rise)
        if (stretch.limb, stretch.high) in self.forked:
            at = replace(at, there=at.there & ~self.library.is_type_one[:, None, None])
        return within_foliage(at, self.library, state.target, state.home, state.axes, light, _PIECE * self.leaf)

    def _best(self, attractors: Attractors, open_: list[Choice]) -> tuple[Subtree, Placed] | None:
        """Of the choices left, that with the highest gain, less its wood, once it is pruned by what stands already; None where none is worth it. What has once been found is the most
        that will be found later, since the tree only comes nearer: so a choice is looked at anew only while it may still be the best."""
        best, gain = None, _LEAST * self.leaf
        for choice in sorted(open_, key=lambda one: (-one.most, one.number, one.flat)):
            if choice.most <= gain:
                break
            choice.most, *found = self._close(attractors, choice.flat, choice.at)
            if choice.most > gain:
                best, gain = tuple(found), choice.most
        return best

    def _close(self, attractors: Attractors, flat: int, at: Placed) -> tuple[float, Subtree, Placed]:
        """(gain less what its wood costs, subtree, placement) of one placement, without branches too near to others or through thick limbs."""
        subtree, turn = np.unravel_index(flat, at.there.shape[:2])
        one = Placed(at.stretch, at.middle, at.start[[subtree], turn][None][:, 0][:, None], at.end[[subtree], turn][:, None], at.there[[subtree], turn][:, None])
        part, stretch = self.library.only(int(subtree)), at.stretch
        clear = self._is_clear(one, part.subtrees[0])
        at_limb = stretch.low + part.share[0] * stretch.length
        clear &= ~self.state.thick.struck(one.start[0, 0], one.end[0, 0], np.full(len(clear), stretch.limb), at_limb)
        one = replace(one, there=whole_branches(one.there & clear, part))
        gain = gains(attractors, one, self.library.reach * stretch.length)[0, 0]
        wood = np.linalg.norm((one.end - one.start)[one.there], axis=1).sum()
        return float(gain - self.wanted.thrift * wood), part.subtrees[0], one

    def _is_clear(self, one: Placed, beyond: Subtree) -> Bool[np.ndarray, " piece"]:
        """Which pieces of the only subtree placed are far enough from other wood; the first of a branch need only lead away from it."""
        start, end = one.start[0, 0], one.end[0, 0]
        outer = np.zeros(len(end), bool)
        outer[: len(beyond)] = np.r_[False, beyond.branch[1:] == beyond.branch[:-1]]
        long = np.r_[_lengths(beyond), np.zeros(len(outer) - len(beyond))] * one.stretch.length
        room = np.where(outer, np.maximum(_CLOSE * self.leaf, self.wanted.apart * long), _AWAY * np.linalg.norm(end - start, axis=1))
        away = self.state.places.distance(np.concatenate([0.5 * (start + end), end]), float(room.max())).reshape(2, -1) > room
        return away[1] & (away[0] | ~outer)

    def _grow(self, subtree: Subtree, one: Placed) -> None:
        """The new branches become limbs."""
        stretch, state = one.stretch, self.state
        there, start, end = one.there[0, 0], one.start[0, 0], one.end[0, 0]
        piece_at: dict[int, tuple[int, float]] = {}
        for branch in range(subtree.branches):
            pieces = np.flatnonzero((subtree.branch == branch) & there[: len(subtree)])
            if len(pieces) == 0:
                continue
            first = pieces[0]
            above = subtree.parent[first]
            parent, at = (stretch.limb, stretch.low + subtree.share[first] * stretch.length) if above == NULL else piece_at[int(above)]
            state.bear(parent, at, np.concatenate([start[[first]], end[pieces]]))
            for piece, arc in zip(pieces, state.wood.limbs[-1].arc[1:], strict=True):
                piece_at[int(piece)] = (len(state.wood) - 1, float(arc))
        stretch.replaced += 1
        if subtree.is_type_one:
            self.forked.add((stretch.limb, stretch.high))


def _lengths(subtree: Subtree):
    """How long the branch of each piece is; the supporting branch is 1 long."""
    return np.bincount(subtree.branch, np.linalg.norm(subtree.vector, axis=1))[subtree.branch]
