"""Do the tips reach the crown's surface of revolution?

    −log(1 + ((log ρ_t − m)/s)²),     ρ_t = √((x_t − x_trunk)² + z_t²) / R(y_t)

    R   the crown's half width at the tip's height, at least .06        m, s   0, .2 for order 1; −.12, .35 above

The tail must be heavy: a drawn tip may well lie inside.
"""

import equinox as eqx
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float, Int

from sketchtree.mrf.factor_graph import FactorGraph
from sketchtree.mrf.factors.extent import sidedness
from sketchtree.mrf.padding import Padding

NARROWEST = 0.06  # least R, H = 1
MEAN = (0.0, -0.12)
SD = (0.2, 0.35)


class Crown(eqx.Module):
    """One factor the tip of a limb that grows from another."""

    tip: Int[Array, " limb"]  # row
    aside: Float[Array, " limb"]  # x_t − x_trunk
    half_width: Float[Array, " limb"]  # R, floored
    mean: Float[Array, " limb"]  # m
    sd: Float[Array, " limb"]  # s
    weight: Float[Array, " limb"]  # 0 at stems and padding

    @classmethod
    def of(cls, graph: FactorGraph, pad: Padding, *, shape: float) -> "Crown":
        """The factors of a drawing."""
        above = np.minimum(np.maximum(graph.limb_order - 1, 0), 1)
        weight = shape * graph.limb_spreads * sidedness(graph)[graph.tree[graph.limb_tip]]
        return cls(
            tip=pad.index(graph.limb_tip, pad.limbs), aside=pad.real(graph.tip_aside, pad.limbs),
            half_width=pad.real(np.maximum(graph.half_width, NARROWEST), pad.limbs, fill=1.0),
            mean=pad.real(np.array(MEAN)[above], pad.limbs), sd=pad.real(np.array(SD)[above], pad.limbs, fill=1.0),
            weight=pad.real(weight, pad.limbs),
        )  # fmt: skip

    def log_potential(self, assignment, theta) -> Float[Array, " limb"]:
        """The Cauchy in log ρ."""
        z = assignment.tip.z[self.tip]
        log_rho = 0.5 * jnp.log(self.aside**2 + z**2 + 1e-8) - jnp.log(self.half_width)
        return -self.weight * jnp.log1p(((log_rho - self.mean) / self.sd) ** 2)
