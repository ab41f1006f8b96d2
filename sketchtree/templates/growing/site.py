"""What do the limbs of a growing tree share? The recipe, the rows grown so far, the room they leave, the wind."""

from dataclasses import dataclass

from sketchtree.templates.growing.draws import Draws
from sketchtree.templates.growing.headings import Vector
from sketchtree.templates.growing.recipe import Recipe
from sketchtree.templates.growing.space import Space
from sketchtree.templates.growing.wind import Wind


@dataclass(frozen=True, eq=False)
class Bud:
    """Where a limb will start."""

    row: int  # of the parent's tip
    heading: Vector  # unit
    level: int  # of its recipe table
    order: int  # branching order
    length: float  # metres
    id: int  # of its random stream
    draws: Draws
    place: float = 0.0  # share of the length a fork's branch has behind it
    borne: float = 0.0  # place on the parent, 0-1; of a stem its rank


class Rows:
    """The skeleton's columns while it grows."""

    def __init__(self):
        self.parent, self.tip, self.order, self.limb, self.lost = [], [], [], [], []

    def __len__(self) -> int:
        return len(self.parent)

    def add(self, parent: int, tip: Vector, order: int, limb: int) -> int:
        """One more row; its number."""
        self.parent.append(parent)
        self.tip.append(tip)
        self.order.append(order)
        self.limb.append(limb)
        self.lost.append(0.0)  # metres of wood that broke off here
        return len(self.parent) - 1

    def cut(self, count: int) -> None:
        """Only the first `count` rows stay."""
        for column in (self.parent, self.tip, self.order, self.limb, self.lost):
            del column[count:]


@dataclass(frozen=True, eq=False)
class Site:
    """One tree while it grows."""

    recipe: Recipe
    seed: int
    rows: Rows
    space: Space | None  # None where no limb asks for room
    wind: Wind

    @classmethod
    def of(cls, recipe: Recipe, seed: int) -> "Site":
        """Bare ground."""
        widest = max(recipe.level(level).clearance for level in range(int(recipe.crown.levels)))
        return cls(recipe, seed, Rows(), Space(widest) if widest else None, Wind.of(recipe.crown))
