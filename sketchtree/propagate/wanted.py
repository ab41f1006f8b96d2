"""What is to be grown: every choice of one run of propagation, with its unit and range."""

from dataclasses import dataclass

import numpy as np

from sketchtree.errors import OptionError
from sketchtree.parameters import Habit, TreeParameters
from sketchtree.propagate.blocks.block import Blocks
from sketchtree.propagate.space.light import check_strength
from sketchtree.skeleton import TreeSkeleton

GENERATIONS = 5  # without a crown (Chen §6)
CROWN_GENERATIONS = 12  # with one, or where a hollow one is filled, at most
MOST_GENERATIONS = 50
DENSITIES = (0.01, 10.0)


@dataclass(frozen=True)
class Wanted:
    """How a drawn tree is completed. Raises OptionError for a value out of range."""

    habit: Habit
    theta: TreeParameters
    crown: tuple = ()  # closed outlines, each (point 2), world metres
    generations: float | None = None  # 0-50; 3.5: three and half of the fourth; None: 5 without a crown, at most 12 with one
    fill: bool = False  # keep on until the crown is evenly filled
    max_segments: int = 200_000  # of the result, drawn ones included; ≥ 1
    obstacles: tuple = ()  # what nothing grows through: each a trimesh.Trimesh, world metres; a closed one is solid
    regions: tuple = ()  # the same on the page, through all depths: closed outlines, each (point 2), world metres
    exemplar: TreeSkeleton | None = None  # lends its blocks where the drawing has too few
    density: float = 1.0  # laterals a metre of limb, over the habit's, 0.01-10
    thorough: float | None = None  # 0-1, how completely the drawn orders were drawn; None: judged from the drawing
    fixed: bool = False  # Θ is held: nothing is made more like what was drawn
    like: Blocks | None = None  # blocks of the drawing by which its manner is judged; None: as it is. While somebody draws, a limb more changes nothing elsewhere
    only: frozenset[int] | None = None  # ids of the drawn limbs that grow, for an answer in a hurry: no crown is filled, no limb led into it; None: all
    light: float = 0.0  # 0-1, how much growth turns to the light and how few buds open in the shade; 0: not at all

    def __post_init__(self):
        if self.max_segments < 1:
            raise OptionError(f"max_segments is {self.max_segments}, but must be 1 or more.", remedy="Give a positive number.")
        if self.generations is not None and not 0 <= self.generations <= MOST_GENERATIONS:
            raise OptionError(
                f"generations is {self.generations:g}, but must lie between 0 and {MOST_GENERATIONS}.", remedy="5 to 12 make a full tree."
            )
        check_strength(self.light)
        if not (np.isfinite(self.density) and DENSITIES[0] <= self.density <= DENSITIES[1]):
            raise OptionError(
                f"density is {self.density:g}, but must lie between {DENSITIES[0]:g} and {DENSITIES[1]:g}.",
                remedy="1 is the species' own; 2 has twice as many twigs on every limb.",
            )
        if self.thorough is not None and not 0 <= self.thorough <= 1:
            raise OptionError(
                f"thorough is {self.thorough:g}, but must lie between 0 and 1.",
                remedy="1: every limb of the drawn orders is drawn; None: judge by the drawing.",
            )

    @property
    def limit(self) -> int:
        """Generations at most, before a hollow crown is filled; the last may be cut back (`after.level`)."""
        if self.generations is None:
            return CROWN_GENERATIONS if len(self.crown) else GENERATIONS
        return int(np.ceil(self.generations))
