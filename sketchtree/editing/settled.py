"""Which depth has every drawn limb come to? Kept by limb id, so that the next answer starts there and solves only what was touched."""

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
from jaxtyping import Float


@dataclass(frozen=True, eq=False)
class Depths:
    """One limb's."""

    share: Float[np.ndarray, " node"]  # rising from 0, its foot, to 1, its tip
    depth: Float[np.ndarray, " node"]  # sketch units, as `Held.depth`
    course: str  # digest of its course on the page and of what it hangs on: another course is another limb to solve


@dataclass(frozen=True, eq=False)
class Settled:
    """All limbs'. Empty: nothing is known yet."""

    limbs: Mapping[int, Depths] = field(default_factory=dict)
    parents: Mapping[int, int] = field(default_factory=dict)  # limb → the limb it grows on; trunks have none
    template: str | None = None  # the exemplar that was used; None: none yet
    asked: str = ""  # digest of the options that bear on depths: with others, all limbs are solved again

    def __len__(self) -> int:
        return len(self.limbs)
