"""What can be done to a tree by hand, so that it outlives every other change?

An edit names a limb by its id (the stroke that drew it; for an undrawn one its parent and its rank), never by a row, and says what is so in the
drawing's own units. Seed, template, leaves and generations may change: it holds.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
from jaxtyping import Float


@dataclass(frozen=True, eq=False)
class Held:
    """The depth of a drawn limb at some places along it."""

    limb: int
    share: Float[np.ndarray, " place"]  # rising; 0 its foot, 1 its tip, by length on the page it was drawn on
    depth: Float[np.ndarray, " place"]  # sketch units, towards the viewer of that page, 0 in the plane through the first root
    whole: bool = False  # between the places too: the limb is locked as it is


@dataclass(frozen=True, eq=False)
class Cleared:
    """An undrawn limb was deleted: where it stood nothing grows."""

    limb: int
    path: Float[np.ndarray, "point 3"]  # sketch units, y up, z towards the viewer of the front page
    radius: float  # of the room that stays clear, sketch units


@dataclass(frozen=True, eq=False)
class Adopted:
    """An undrawn limb is kept as if it had been drawn in space."""

    limb: int
    parent: int  # the drawn or adopted limb it grows on
    share: float  # where on it, 0-1 of the parent's length
    path: Float[np.ndarray, "point 3"]  # from its foot, which is 0 0 0; sketch units
    radius: float  # at its foot, sketch units
    was: int = -1  # its id while it was undrawn
    foot: Float[np.ndarray, " 3"] | None = None  # where it started when it was found; not kept
    on: "Adopted | None" = None  # the undrawn limb it grows on, which has to be adopted first; not kept


@dataclass(frozen=True, eq=False)
class Edits:
    """All of them. No limb is in one list twice."""

    held: Mapping[int, Held] = field(default_factory=dict)
    cleared: Mapping[int, Cleared] = field(default_factory=dict)
    adopted: Mapping[int, Adopted] = field(default_factory=dict)

    def __bool__(self) -> bool:
        return bool(self.held or self.cleared or self.adopted)
