"""Every choice of one growth toward points. A species' recipe may make its own (`species`), and the command line any (`figures`)."""

from dataclasses import dataclass

from sketchtree.clouds.growing.heading import ALPHA, BETA
from sketchtree.clouds.growing.logistic import LEAST, MOST, RATE, START
from sketchtree.clouds.growing.perception import KILL, THETA
from sketchtree.clouds.growing.weights import EPS_A, EPS_D
from sketchtree.errors import OptionError

RANGES = {
    "theta": (1.0, 180.0),
    "kill": (0.05, 1.0),
    "alpha": (0.0, 100.0),
    "beta": (0.0, 100.0),
    "least": (1.0, 1000.0),
    "most": (1.0, 1000.0),
    "start": (0.1, 1000.0),
    "rate": (0.01, 10.0),
    "eps_d": (0.001, 10.0),
    "eps_a": (0.0, 1.0),
    "spread": (0.0, 90.0),
}
"""Within which each of the figures may lie."""

INFLUENCE = (1.0, 1000.0)
"""Internodes."""


@dataclass(frozen=True)
class Growing:
    """The paper's figures, and what is ours (the last lines)."""

    theta: float = THETA  # degrees, the cone that a bud perceives
    kill: float = KILL  # d_k / d_i
    alpha: float = ALPHA  # of V_opt
    beta: float = BETA  # of V_tropism
    tropism: tuple[float, float, float] = (0.0, -1.0, 0.0)  # as printed, downward; (0, 1, 0) upward
    influence: float | None = None  # internodes, constant; None: logistic (Eq. 6-7)
    least: float = LEAST  # internodes, of a logistic d_i
    most: float = MOST  # internodes, of a logistic d_i
    start: float = START  # H_0, internodes
    rate: float = RATE  # ρ_0
    weighted: bool = True  # points count by Eq. 8, or all alike
    eps_d: float = EPS_D  # ε_D, metres in the box
    eps_a: float = EPS_A  # ε_A
    fill: bool | None = False  # branches for the inside that nobody saw (Fig. 8); None: where the points leave it out
    spread: float = 6.0  # degrees, standard deviation of φ and ψ from bud to bud
    steered: bool = True  # a shoot turns at every internode, not only where it begins
    decided: bool = True  # where points fork, a bud takes the way of most
    settles: bool = True  # in the end thin wood moves to the middle of the points that it came to
    sheds: bool = True  # branches within the wood that bears them fall off while the tree grows
    dominant: bool = True  # of buds that would grow to the same place in one cycle only one does
    direct: bool = True  # a point goes to a bud that is hardly a detour from the root before it goes to another
    holds: bool = True  # what is taken does not follow a logistic d_i: d_k is a share of the least, so that reaching far while young takes no detail
    persists: bool = True  # where growth has ended, buds look farther once more, up to 12 l

    def __post_init__(self):
        for name, (low, high) in RANGES.items():
            if not low <= getattr(self, name) <= high:
                raise OptionError(f"`{name}` is {getattr(self, name)!r}.", remedy=f"Give a number from {low:g} to {high:g}.")
        if self.influence is not None and not INFLUENCE[0] <= self.influence <= INFLUENCE[1]:
            raise OptionError(f"`influence` is {self.influence!r}.", remedy="Give internodes, 1 to 1000, or None for the logistic model.")
        if self.least > self.most:
            raise OptionError(f"Buds would look at least {self.least:g} internodes and at most {self.most:g}.", remedy="Make `most` the larger one.")


def plain(internodes: float) -> Growing:
    """Plain space colonisation: points all alike, a constant influence distance, and none of what is ours. What the paper's Figures 5 and 6 are held against."""
    return Growing(influence=internodes, weighted=False, steered=False, decided=False, settles=False, dominant=False, sheds=False, direct=False, holds=False, persists=False)
