"""How far, and over which detours, do buds look where nothing nearer is left?

In every cycle buds look as far as the influence says (`logistic`). Where none grew, all look farther, up to d_i's most, 12 l; then ways may be a longer detour; and in the end buds look over
gaps, up to 60 l (ours). As soon as one grows, they look as far as before.
"""

from dataclasses import dataclass

import numpy as np

from sketchtree.clouds.growing.logistic import Influence
from sketchtree.clouds.growing.wanted import Growing

_WIDER, _WIDEST = 1.5, 60.0  # how much farther in each cycle in which none grew, and how many internodes at most
_DETOURS = (1.15, 1.3, 1.5, 2.0, 3.0, np.inf)  # τ, one after the other
_LEAST, _LAST = 2, 2.0  # points that a bud grows for, as long as others have them, and the τ from which one is enough


@dataclass
class Patience:
    """What the next cycle begins with."""

    influence: Influence
    wanted: Growing
    wider: float = 1.0
    turn: int = 0

    def __post_init__(self):
        self.turn = 0 if self.wanted.direct else len(_DETOURS) - 1

    @property
    def detour(self) -> float:
        """τ."""
        return _DETOURS[self.turn]

    @property
    def least(self) -> int:
        """Points that a bud grows for."""
        return 1 if self.wanted.direct and self.detour >= _LAST else _LEAST

    @property
    def farthest(self) -> float:
        """Internodes that buds will ever look."""
        return _WIDEST if self.wanted.persists else self.wanted.most

    def look(self, cycle: int) -> float:
        """Internodes that buds look in a cycle."""
        units = self.influence(cycle)
        return min(units * self.wider, max(self._most(), units))

    def grew(self) -> None:
        """Something did."""
        self.wider = 1.0

    def lost(self, cycle: int) -> bool:
        """Nothing grew in a cycle: look farther, or round more. False where there is nothing more to try."""
        if not self.influence.falling(cycle + 1):
            return True
        if self.wanted.persists and self.look(cycle) < self._most():
            self.wider *= _WIDER
        elif self.turn < len(_DETOURS) - 1:
            self.turn, self.wider = self.turn + 1, 1.0
        else:
            return False
        return True

    def _most(self) -> float:
        return _WIDEST if self.detour == np.inf else self.wanted.most
