"""What kind of tree is it? The parameters Θ, the statistics of its limbs, and its habit.

Chen et al. 2008, §4. In the parent's frame a child segment is v_c = s R_y(ϕ) R_x(φ) v_p:

    s   scale             |v_c| / |v_p|                  s ~ N(μ_s, σ_s)
    φ   divergence        apical  φ ~ N(μ_α, σ_α);       lateral  φ ~ N(μ_β, σ_β)
    ϕ   orientation       apical  ϕ ~ N(μ_γ, σ_γ);       lateral  turned evenly about the parent

and the child labelled i of K has (§4, cases 1-3)

    θ_1 = {μ_α, σ_α, μ_γ, σ_γ}                           the apical child, i = 1
    θ_2 = {μ_β, σ_β, μ_γ + π, σ_γ}                       K = 2
    θ_i = {μ_β, σ_β, μ_γ + 2π(i − 1)/(K − 1), σ_γ}       K > 2, i = 2 … K
"""

import dataclasses
from dataclasses import dataclass, field

import numpy as np
from jaxtyping import Float, Int


@dataclass(frozen=True)
class TreeParameters:
    """Θ of one tree (Chen §4). Angles in radians; the scale is a ratio of segment lengths."""

    mu_s: float
    sigma_s: float
    mu_alpha: float
    sigma_alpha: float
    mu_beta: float
    sigma_beta: float
    mu_gamma: float
    sigma_gamma: float

    def child(self, label: int, child_count: int) -> tuple[float, float, float, float]:
        """θ_i = (mean divergence, its sd, mean orientation, its sd) of the child labelled `label`
        (1 the apical one) among `child_count` siblings. Chen §4, cases 1-3."""
        if not 1 <= label <= child_count:
            raise ValueError(f"label {label} of {child_count} children; labels run from 1")
        if label == 1:
            return self.mu_alpha, self.sigma_alpha, self.mu_gamma, self.sigma_gamma
        turn = np.pi if child_count == 2 else 2 * np.pi * (label - 1) / (child_count - 1)
        return self.mu_beta, self.sigma_beta, self.mu_gamma + turn, self.sigma_gamma

    def as_dict(self, degrees: bool = False) -> dict[str, float]:
        """{name: value}; with `degrees`, angles are in degrees (as in reports)."""
        values = dataclasses.asdict(self)
        if degrees:
            values = {k: v if k.endswith("_s") else float(np.degrees(v)) for k, v in values.items()}
        return values


GENERIC = TreeParameters(
    mu_s=1.0, sigma_s=0.6, mu_alpha=0.17, sigma_alpha=0.17,
    mu_beta=0.9, sigma_beta=0.3, mu_gamma=0.0, sigma_gamma=1.0,
)  # fmt: skip
"""A tree of no particular kind: apical bend 10° ± 10°, laterals at 52° ± 17°."""


@dataclass(frozen=True, eq=False)
class LimbStatistics:
    """How the limbs of one tree (or of many) branch, per branching order: what the default method
    learns Θ from. Beyond the paper, whose scale per *segment* says mostly where laterals happen to sit.

    `count`, `mean` and `variance` (of the population, ddof 0) per order 1 and 2+ for the divergence of
    a limb's first segment from its parent and for log(limb length / parent limb length); the mean square
    `bend` between successive segments of one limb per order 0, 1 and 2+. `count` 0 means unknown (then mean
    and variance are 0).
    """

    divergence_count: Int[np.ndarray, " 2"]
    divergence_mean: Float[np.ndarray, " 2"]  # radians
    divergence_variance: Float[np.ndarray, " 2"]  # radians²
    length_count: Int[np.ndarray, " 2"]
    length_mean: Float[np.ndarray, " 2"]  # log ratio
    length_variance: Float[np.ndarray, " 2"]
    bend_count: Int[np.ndarray, " 3"]
    bend_square: Float[np.ndarray, " 3"]  # radians², mean of the squared bend


@dataclass(frozen=True)
class Habit:
    """How a species fills in what was not drawn. Angles in degrees, as in its recipe."""

    height: float = 10.0  # metres, of the typical grown tree
    trunk_ratio: float = 0.022  # radius at the base / height
    pipe_exponent: float = 2.3  # n of the pipe model, r^n = Σ r_child^n
    twig_radius: float = 0.003  # metres, at the finest tips
    max_order: int = 4  # deepest order that carries wood (palm: 1)
    arrangement: str = "alternate"  # of laterals on a limb: alternate | opposite | whorled | spiral
    whorl: int = 1  # laterals a node (2 opposite, 3+ whorled)
    phyllotaxis: float = 137.5  # degrees between the azimuths of successive nodes
    lateral_spacing: float = 0.35  # metres between lateral nodes on a drawn-out limb
    lateral_ratio: float = 0.45  # length of a lateral / length of the limb it sits on
    lateral_angle: float = 50.0  # degrees from the parent, mean over orders ≥ 2
    twig_length: float = 0.25  # metres; a shorter open branch carries leaves and grows no further
    gravitropism: float = 0.0  # degrees a metre of undrawn growth; > 0 droops, < 0 rises
    apical_control: float = 0.6  # 0: laterals near the tip are longest (decurrent), 1: near the base (excurrent)
    leaf: str = "oak"  # leaf model of the foliage room
    leaf_arrangement: str = "alternate"  # opposite | decussate | alternate | whorled | spiral | fascicled | frond
    leaf_size: float = 0.09  # metres, blade length
    leaf_spacing: float = 0.04  # metres between leaf nodes along a twig
    bark: str = "oak"  # bark model of the geometry room
    extra: dict = field(default_factory=dict, compare=False)  # recipe keys a plug-in may read
