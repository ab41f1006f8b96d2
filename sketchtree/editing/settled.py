"""Which depth has every drawn limb come to? Kept by limb id, so that the next answer starts there and solves only what was touched."""

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
from jaxtyping import Float

from sketchtree.parameters import TreeParameters
from sketchtree.propagate.blocks.block import Blocks

MEASURED = "measured"  # `Settled.asked`: depths that were seen in points, whatever the options are
COURSE = 9  # places along a limb by which its course is told from another


def course_of(points: Float[np.ndarray, "point 2"]) -> Float[np.ndarray, "place 2"]:
    """Where a line on a page runs, at even shares of its length: as `Depths.course`."""
    along = np.r_[0.0, np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))]
    even = np.linspace(0.0, along[-1], COURSE)
    return np.stack([np.interp(even, along, points[:, axis]) for axis in (0, 1)], axis=1)


@dataclass(frozen=True, eq=False)
class Depths:
    """One limb's, that was drawn or adopted."""

    share: Float[np.ndarray, " node"]  # rising from 0, its foot, to 1, its tip; by length on the page it was drawn on
    depth: Float[np.ndarray, " node"]  # sketch units, as `Held.depth`
    sd: Float[np.ndarray, " node"]  # of the depth, sketch units; NaN unknown
    course: Float[np.ndarray, "place 2"]  # where on that page it runs, at even shares: another course is another limb to solve
    parent: int | None  # the limb it grows on; None for a stem
    strokes: tuple[str, ...]  # ids of the strokes that drew it; none: adopted
    view_deg: float = 0.0  # azimuth of its page
    rough: bool = False  # found in a hurry: the next answer begins there, and solves it again


@dataclass(frozen=True, eq=False)
class Manner:
    """In what manner the rest grows, as it was measured on the drawing once: a stroke more does not change it everywhere."""

    theta: TreeParameters
    blocks: Blocks | None  # of the drawn limbs, metres; None of several trees, each of which has its own
    limbs: frozenset[int]  # that there were
    scale: float  # metres a sketch unit


@dataclass(frozen=True, eq=False)
class Settled:
    """All limbs'. Empty: nothing is known yet."""

    limbs: Mapping[int, Depths] = field(default_factory=dict)
    template: str | None = None  # the exemplar that was used; None: none yet
    asked: str = ""  # the options that bear on depths: with others, all limbs are solved again
    manner: Manner | None = None  # in which the rest grows, kept until the drawing is another
    axis: float = 0.0  # x of the first root, sketch units: turned pages turn about the vertical through it

    def __len__(self) -> int:
        return len(self.limbs)

    def borne(self, limb: int) -> tuple[int, ...]:
        """All limbs that grow, at any remove, on this one."""
        on: dict[int, list[int]] = {}
        for one, depths in self.limbs.items():
            on.setdefault(depths.parent, []).append(one)
        found, queue = [], list(on.get(limb, ()))
        while queue:
            found.append(queue.pop())
            queue += on.get(found[-1], ())
        return tuple(found)
