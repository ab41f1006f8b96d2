"""What does a steady wind make of a tree? It bends growth downwind and kills what points against it.

    heading ← heading turned towards w by wind(y / height) · step          w   unit, level, downwind
    chance that a lateral is shed = wind_shed · max(0, −heading · w)
"""

from dataclasses import dataclass
from math import cos, radians, sin

from sketchtree.templates.growing.headings import Vector, dot, towards
from sketchtree.templates.growing.profile import Profile
from sketchtree.templates.growing.tables import Crown


@dataclass(frozen=True)
class Wind:
    """The wind of one site."""

    way: Vector  # unit, downwind
    turn: Profile  # deg/m, over height / `height`
    shed: float
    height: float  # metres, of the tree

    @classmethod
    def of(cls, crown: Crown) -> "Wind":
        """The wind that `[crown]` describes."""
        way = (cos(radians(crown.downwind)), 0.0, sin(radians(crown.downwind)))
        return cls(way, crown.wind, crown.wind_shed, crown.height)

    def bent(self, heading: Vector, at: Vector, step: float) -> Vector:
        """`heading` after `step` metres of growth at `at`."""
        turn = self.turn(at[1] / self.height) * step
        return towards(heading, self.way, radians(turn)) if turn else heading

    def kills(self, heading: Vector, chance: float) -> bool:
        """Has the wind shed a lateral with this heading? `chance` is uniform in [0, 1)."""
        return chance < self.shed * max(0.0, -dot(heading, self.way))
