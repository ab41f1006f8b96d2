"""How far do a sketch and another tree of its own kind lie apart? The metric that likeness is measured in.

    crown      the coefficient of the k-th harmonic of f_S − f_E|v        ~ N(0, σ_k²),        k = 0 … 12
    traits     x_S − x_E|v, x = (s, α, β) and the posture                 ~ N(shift, Σ)

with Σ = diag(sd) · correlation · diag(sd), branching and posture apart; `weight` holds w_C, w_B, w_P. All were learnt from sketches of
trees that are no exemplars (`weights`). A sketch shows a trait off by `shift` on the average, since it has fewer limbs than what was measured
of the exemplars.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from jaxtyping import Float
from scipy.linalg import block_diag

from sketchtree.templates.seen.branching import STATISTICS
from sketchtree.templates.seen.footprint import DIRECTIONS
from sketchtree.templates.seen.posture import FEATURES

TRAITS = (*STATISTICS, *FEATURES)
BRANCHING, POSTURE = slice(0, len(STATISTICS)), slice(len(STATISTICS), len(TRAITS))
HARMONICS = 12


@dataclass(frozen=True, eq=False)
class Metric:
    """Learnt once for sketches with a crown, once for those without."""

    name: str
    weight: Float[np.ndarray, " term"]  # w_C, w_B, w_P
    harmonic_sd: Float[np.ndarray, " harmonic"]  # σ_k, 0 … HARMONICS
    shift: Float[np.ndarray, " trait"]
    sd: Float[np.ndarray, " trait"]
    correlation: Float[np.ndarray, "trait trait"]  # 0 between branching and posture

    @cached_property
    def basis(self) -> Float[np.ndarray, "direction coefficient"]:
        """Σ_c (f · basis)_c² is the squared distance of a difference f of footprints."""
        return harmonics() / np.repeat(self.harmonic_sd, [1] + [2] * HARMONICS)

    def covariance(self, among: slice) -> Float[np.ndarray, "kept kept"]:
        """Σ of the branching or of the posture."""
        return self.correlation[among, among] * np.outer(self.sd[among], self.sd[among])


def harmonics() -> Float[np.ndarray, "direction coefficient"]:
    """1, √2 cos kθ, √2 sin kθ … over the directions, / K_f: a footprint's coefficients."""
    angle = 2 * np.pi * np.arange(DIRECTIONS) / DIRECTIONS
    waves = [w(k * angle) * np.sqrt(2) for k in range(1, HARMONICS + 1) for w in (np.cos, np.sin)]
    return np.stack([np.ones(DIRECTIONS), *waves], axis=1) / DIRECTIONS


def correlations(branching: list[list[float]], posture: list[list[float]]) -> Float[np.ndarray, "trait trait"]:
    """The correlation matrix of all traits; of both parts the rows left of the diagonal are given."""
    return block_diag(_symmetric(branching), _symmetric(posture))


def _symmetric(rows):
    whole = np.eye(len(rows) + 1)
    for i, row in enumerate(rows, start=1):
        whole[i, : len(row)] = whole[: len(row), i] = row
    return whole
