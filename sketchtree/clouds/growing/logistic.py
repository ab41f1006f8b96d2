"""How far does a bud look at every stage of a plant's life?

Guo et al. 2018, §5.2, Eq. 6-7: growth is fast where a plant is young and has room, then slow (the logistic model),

    H_t = H_max / (1 + (H_max / H_0 − 1) e^(−ρ_0 t))
    ρ_t = dH/dt = H_max ρ_0 (H_max / H_0 − 1) e^(−ρ_0 t) / (1 + (H_max / H_0 − 1) e^(−ρ_0 t))²
    d_i = ρ_t l,    kept within [4 l, 12 l]  (`least`, `most` of `wanted`)

    t     cycles of growth            H_max  K, the most internodes from the root to a leaf; the plant's height is K l
    H_0   2       ρ_0   0.3           l      internode, metres

The paper gives H_max in metres and H_0 = 2 with no unit; counted in internodes both, ρ_t is what Table 1 calls it, internodes of one shoot in one cycle. That is our reading.
"""

from dataclasses import dataclass
from typing import Protocol

import numpy as np

START, RATE = 2.0, 0.3
LEAST, MOST = 4.0, 12.0
"""Internodes that a bud may look (d_i ∈ [4 l, 12 l])."""


def length_at(t: float, most: float, start: float = START, rate: float = RATE) -> float:
    """H_t, internodes (Eq. 6)."""
    return most / (1.0 + (most / start - 1.0) * np.exp(-rate * t))


def growth_units(t: float, most: float, start: float = START, rate: float = RATE) -> float:
    """ρ_t, internodes a cycle (Eq. 7)."""
    falls = (most / start - 1.0) * np.exp(-rate * t)
    return most * rate * falls / (1.0 + falls) ** 2


class Influence(Protocol):
    """How many internodes a bud looks in cycle t."""

    def __call__(self, t: int) -> float: ...

    def falling(self, t: int) -> bool:
        """Whether it never looks farther again than in cycle t."""
        ...


@dataclass(frozen=True)
class Logistic:
    """d_i by Eq. 7, for a plant that is so many internodes high."""

    most: float  # K
    start: float = START  # H_0
    rate: float = RATE  # ρ_0
    between: tuple[float, float] = (LEAST, MOST)  # internodes that a bud may look

    def __call__(self, t: int) -> float:
        return float(np.clip(growth_units(t, self.most, self.start, self.rate), *self.between))

    def falling(self, t: int) -> bool:
        return self.most <= 2 * self.start or t >= np.log(self.most / self.start - 1.0) / self.rate


@dataclass(frozen=True)
class Constant:
    """The same distance always: plain space colonisation. The paper's Figure 5 shows 5 and 10."""

    internodes: float

    def __call__(self, t: int) -> float:
        return self.internodes

    def falling(self, t: int) -> bool:
        return True
