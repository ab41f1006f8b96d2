"""Where may the tree grow, and which way does it turn there?

A *barrier* ends growth: the crown's surface (Chen et al. 2008, §6: branches "are scaled back to touch the surface, and the
propagation terminates here"), an obstacle, a place that a neighbour holds. A *guide* turns a branch before it comes to
that: away from an obstacle or a neighbour, towards the light. Both look at many branches at once.

    free fraction    f = min over barriers of the share of a step that may be grown
    heading          d ← guide_k( … guide_1(d)), each of unit length

A branch that would meet a barrier is planned no longer than its straight way there. Where that barrier is a guide too, it
will turn and go along it: then `_ALONG` of the rest is planned as well.
"""

from dataclasses import dataclass
from typing import Protocol

import numpy as np
from jaxtyping import Bool, Float, Int

_ALONG = 0.5  # of what a branch would have had beyond


class Barrier(Protocol):
    """What ends a branch."""

    def inside(self, point: Float[np.ndarray, "point 3"]) -> Bool[np.ndarray, " point"]:
        """Which points wood may be at."""
        ...

    def exit_fraction(
        self, start: Float[np.ndarray, "branch 3"], end: Float[np.ndarray, "branch 3"], bisections: int = 16
    ) -> Float[np.ndarray, " branch"]:
        """The fraction of each segment from `start` to `end` that may be grown, 0-1."""
        ...


class Guide(Protocol):
    """What turns a branch."""

    def turned(
        self,
        start: Float[np.ndarray, "branch 3"],
        heading: Float[np.ndarray, "branch 3"],
        step: Float[np.ndarray, " branch"],
        limb: Int[np.ndarray, " branch"],
    ) -> Float[np.ndarray, "branch 3"]:
        """Unit headings of the next `step` (metres) of the branches that have come to `start`."""
        ...


@dataclass(frozen=True, eq=False)
class Space:
    """All barriers and guides of one tree. Without any, it grows freely."""

    barriers: tuple[Barrier, ...] = ()
    guides: tuple[Guide, ...] = ()

    def inside(self, point: Float[np.ndarray, "point 3"]) -> Bool[np.ndarray, " point"]:
        """Which points no barrier excludes."""
        within = np.ones(len(point), bool)
        for barrier in self.barriers:
            within &= barrier.inside(point)
        return within

    def exit_fraction(
        self, start: Float[np.ndarray, "branch 3"], end: Float[np.ndarray, "branch 3"], bisections: int = 16
    ) -> Float[np.ndarray, " branch"]:
        """The fraction of each segment that all barriers allow."""
        fraction = np.ones(len(start))
        for barrier in self.barriers:
            fraction = np.minimum(fraction, barrier.exit_fraction(start, end, bisections))
        return fraction

    def reach(
        self, start: Float[np.ndarray, "branch 3"], end: Float[np.ndarray, "branch 3"], bisections: int = 16
    ) -> Float[np.ndarray, " branch"]:
        """The share of the straight way from `start` to `end` that a branch is planned to grow, 0-1."""
        share = np.ones(len(start))
        for barrier in self.barriers:
            free = barrier.exit_fraction(start, end, bisections)
            turns = any(barrier is guide for guide in self.guides)
            share = np.minimum(share, free + _ALONG * (1.0 - free) * (free > 0) if turns else free)
        return share

    def turned(self, start, heading, step, limb) -> Float[np.ndarray, "branch 3"]:
        """The headings after every guide."""
        for guide in self.guides:
            heading = guide.turned(start, heading, step, limb)
        return heading
