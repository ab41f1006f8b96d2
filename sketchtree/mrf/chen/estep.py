"""What do the parts of Chen's E-step hand on to each other?

Each part takes a reading of the drawing (depths and labels) and returns another: first the bottom-up pass, then the
moving apart of branches that pass through each other, then ICM (Chen et al. 2008, §5.2.1).
"""

import abc
from typing import NamedTuple

import equinox as eqx
import numpy as np
from jaxtyping import Array, Float, Int, Key

from sketchtree.mrf.factor_graph import FactorGraph
from sketchtree.parameters import TreeParameters


class Reading(NamedTuple):
    """One hypothesis about the drawing: Z and L."""

    depth: Float[np.ndarray, " segment"]  # z of every tip, H = 1; 0 at bases and at the first segment of a stem
    label: Int[np.ndarray, " segment"]  # 1 the apical child, 2 … K laterals; 0 where there is no parent segment


class EStepPart(eqx.Module):
    """One part of the E-step."""

    @abc.abstractmethod
    def __call__(self, graph: FactorGraph, theta: TreeParameters, reading: Reading, key: Key[Array, ""]) -> Reading:
        """A better reading, or a first one; Θ is fixed."""

    def compile(self, graph: FactorGraph, theta: TreeParameters) -> None:
        """Make ready whatever does not depend on the drawing but on its size."""
        return None
