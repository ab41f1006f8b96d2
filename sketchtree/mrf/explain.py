"""Which factor pulled a limb where? The log posterior of a result, kind by kind.

    energy_k     Σ log_potential of kind k, nats
    pull_kj      d energy_k / d(ψ of all of limb j), nats per radian; > 0 pulls the limb's tip towards the viewer

At a peak of the posterior the pulls on a limb add up to about 0; what remains is the part of Θ that moves along.
"""

from dataclasses import dataclass
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Float

from sketchtree.mrf.depths import elevation_of
from sketchtree.mrf.factor_graph import FactorGraph
from sketchtree.mrf.log_posterior import log_posterior
from sketchtree.mrf.prior import Prior


@dataclass(frozen=True, eq=False)
class Explanation:
    """What every kind of factor says of one set of depths."""

    graph: FactorGraph
    energy: dict[str, float]  # kind → nats
    pull: dict[str, Float[np.ndarray, " limb"]]  # kind → nats per radian

    def strongest(self, limb: int, count: int = 3) -> list[tuple[str, float]]:
        """The kinds that pull hardest at a limb, and how hard."""
        ranked = sorted(self.pull, key=lambda kind: -abs(self.pull[kind][limb]))
        return [(kind, float(self.pull[kind][limb])) for kind in ranked[:count]]

    def __str__(self) -> str:
        lines = [f"{'kind':16s}{'energy':>10s}   pulls hardest at"]
        for kind, energy in self.energy.items():
            limb = int(np.argmax(np.abs(self.pull[kind])))
            lines.append(f"{kind:16s}{energy:10.2f}   {self.graph.limb_name[limb]} ({self.pull[kind][limb]:+.1f} nats/rad)")
        return "\n".join(lines)


def explain(graph: FactorGraph, prior: Prior, solver: Any, depth: Float[np.ndarray, " segment"]) -> Explanation:
    """Energies and pulls at depths in sketch units, under the model of `solver` (an `Elevation`). Θ is at its
    posterior mean given these depths."""
    posterior = log_posterior(
        graph, prior, learns=solver.theta_mode == "fit", planar=solver.planar, factors=solver.factors, dtype=np.float32
    )
    psi = np.zeros(len(posterior.page.length), np.float32)
    psi[: len(graph)] = elevation_of(graph, np.asarray(depth, float) / graph.scale)
    theta = posterior.theta(jnp.asarray(psi))
    energy, pull = {}, {}
    for kind, factor in posterior.factors.items():
        if kind == "plane" and not solver.planar:
            continue
        value, slope = jax.value_and_grad(lambda at: jnp.sum(factor.log_potential(posterior.page.assign(at), theta)))(jnp.asarray(psi))
        energy[kind] = float(value)
        pull[kind] = np.bincount(graph.limb, np.asarray(slope, float)[: len(graph)], minlength=graph.limb_count)
    return Explanation(graph, energy, pull)
