"""How likely are these elevations? All factors of one drawing, Θ integrated out.

    E(ψ) = Σ_kinds Σ log_potential(assignment(ψ), Θ) + log p(Θ) − log p(Θ | ψ)        (any Θ; see `conjugate`)

The sum runs over the kinds of `KINDS`, less those left out or replaced, and over the factors of a user's own.
"""

import dataclasses
from collections.abc import Mapping
from typing import Any

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

from sketchtree.axes import NULL
from sketchtree.mrf.assignment import STEEPEST, Assignment, Page, page
from sketchtree.mrf.compilation import compiled
from sketchtree.mrf.conjugate import LimbBelief, LimbData, LimbTheta, limb_prior
from sketchtree.mrf.factor_graph import FactorGraph
from sketchtree.mrf.factors.apical import Apical
from sketchtree.mrf.factors.competition import Competition
from sketchtree.mrf.factors.crown import Crown
from sketchtree.mrf.factors.extent import Extent
from sketchtree.mrf.factors.lateral import Lateral
from sketchtree.mrf.factors.limb_length import LimbLength
from sketchtree.mrf.factors.own import Own, own_factor
from sketchtree.mrf.factors.plane import Plane
from sketchtree.mrf.factors.segment_length import SegmentLength
from sketchtree.mrf.factors.siblings import Siblings
from sketchtree.mrf.factors.solid_angle import SolidAngle
from sketchtree.mrf.factors.stem import Stem
from sketchtree.mrf.padding import Padding
from sketchtree.mrf.prior import Prior

KINDS = (
    "solid_angle", "lateral", "apical", "stem", "limb_length", "segment_length", "siblings", "competition", "extent", "crown", "plane",
)  # fmt: skip
LATERALS_FOR_TRUNK = 3  # below which a trunk's bend is not learnt


class LogPosterior(eqx.Module):
    """E(ψ) of one drawing; the factor kinds are its fields."""

    page: Page
    solid_angle: SolidAngle
    lateral: Lateral
    apical: Apical
    stem: Stem
    limb_length: LimbLength
    segment_length: SegmentLength
    siblings: Siblings
    competition: Competition
    extent: Extent
    crown: Crown
    plane: Plane
    own: tuple[Own, ...]  # the user's factors
    left_out: tuple[str, ...] = eqx.field(static=True)  # kinds that do not count
    belief: LimbBelief
    learns: Float[Array, ""]  # 1: Θ is learnt; 0: it stays the prior's
    learns_trunk: Float[Array, ""]  # 0 where too few laterals say what a trunk's bend means

    @property
    def factors(self) -> dict[str, Any]:
        """Every kind of factor that counts, by name."""
        kinds = {name: getattr(self, name) for name in KINDS if name not in self.left_out}
        return kinds | {own.name: own for own in self.own}

    def __call__(self, elevation: Float[Array, " segment"]) -> Float[Array, ""]:
        """E(ψ), nats; −inf beyond ±80°."""
        inside = jnp.max(jnp.abs(elevation)) < STEEPEST
        assignment = self.page.assign(jnp.clip(elevation, -STEEPEST, STEEPEST))
        posterior = self.belief.updated(self.data(assignment))
        theta = jax.lax.stop_gradient(posterior.mean())
        bayes = self.belief.log_density(theta) - posterior.log_density(theta)
        return jnp.where(inside, self.given(assignment, theta) + jnp.sum(bayes), -jnp.inf)

    def given(self, assignment: Assignment, theta: LimbTheta) -> Float[Array, ""]:
        """Σ log_potential at one Θ."""
        return sum(jnp.sum(kind.log_potential(assignment, theta)) for kind in self.factors.values())

    def updated(self, elevation: Float[Array, " segment"]) -> LimbBelief:
        """p(Θ | ψ)."""
        return self.belief.updated(self.data(self.page.assign(elevation)))

    def theta(self, elevation: Float[Array, " segment"]) -> LimbTheta:
        """Θ at its posterior mean given ψ."""
        return self.updated(elevation).mean()

    def data(self, assignment: Assignment) -> LimbData:
        """What these depths say about Θ. A kind that does not count says nothing."""
        kinds = ("lateral", "limb_length", "segment_length", "apical")
        lateral, length, segment, bend = (float(name not in self.left_out) for name in kinds)
        learns_bend = jnp.concatenate([self.learns_trunk[None], jnp.ones(2, self.learns.dtype)])
        bend_kind = self.apical.kind * (bend * self.learns) * learns_bend
        return LimbData(
            divergence=_moments(assignment.turn, self.lateral.kind * (lateral * self.learns)),
            length=_moments(self.limb_length.excess(assignment), self.limb_length.kind * (length * self.learns)),
            segment=_moments(self.segment_length.log_length(assignment), self.segment_length.kind * (segment * self.learns)),
            bend=(jnp.sum(bend_kind, axis=0), assignment.turn**2 @ bend_kind),
        )


def _moments(value, kind):
    count = jnp.sum(kind, axis=0)
    mean = value @ kind / jnp.maximum(count, 1.0)
    return count, mean, jnp.sum(kind * (value[:, None] - mean) ** 2, axis=0)


def log_posterior(
    graph: FactorGraph,
    prior: Prior,
    *,
    learns: bool = True,
    planar: bool = False,
    factors: Mapping[str, Any] = {},
    dtype=np.float32,
) -> LogPosterior:
    """Compile a drawing and a prior to padded columns.

    `factors` are the user's, by name: the name of a kind replaces it, any other adds one, None leaves the kind out. Each
    has `log_potential(assignment, theta)`, or makes such an object from the graph (see `factors.own`). Where `lateral`,
    `limb_length`, `segment_length` or `apical` does not count, the part of Θ that belongs to it stays the prior's.
    Raises `InferenceError` for a factor that can't be used.
    """
    pad = Padding(graph, dtype)
    shape = 0.0 if planar else 1.0
    posterior = LogPosterior(
        page=page(graph, pad.segments, pad.limbs, dtype),
        solid_angle=SolidAngle.of(graph, pad),
        lateral=Lateral.of(graph, pad),
        apical=Apical.of(graph, pad),
        stem=Stem.of(graph, pad),
        limb_length=LimbLength.of(graph, pad),
        segment_length=SegmentLength.of(graph, pad),
        siblings=Siblings.of(graph, pad, shape=shape),
        competition=Competition.of(graph, pad, shape=shape),
        extent=Extent.of(graph, pad, shape=shape),
        crown=Crown.of(graph, pad, shape=shape),
        plane=Plane.of(graph, pad, shape=shape),
        own=(),
        left_out=tuple(name for name in KINDS if name in factors),
        belief=limb_prior(prior, dtype),
        learns=np.asarray(float(learns), dtype),
        learns_trunk=np.asarray(float(np.sum(graph.limb_parent != NULL) >= LATERALS_FOR_TRUNK), dtype),
    )
    own = tuple(own_factor(name, given, posterior, graph) for name, given in factors.items() if given is not None)
    return dataclasses.replace(posterior, own=own)


def own_energy(posterior: LogPosterior, elevation: Float[np.ndarray, "tree segment"]) -> Float[np.ndarray, " tree"]:
    """Σ log_potential of the user's own factors for many trees, nats."""
    padded = np.zeros((len(elevation), len(posterior.page.length)), np.float32)
    padded[:, : elevation.shape[1]] = np.clip(elevation, -STEEPEST, STEEPEST)

    def energy(posterior, psi):
        assignment = posterior.page.assign(psi)
        theta = posterior.belief.updated(posterior.data(assignment)).mean()
        return sum(jnp.sum(own.log_potential(assignment, theta)) for own in posterior.own)

    arguments = (posterior, padded)
    program = compiled(jax.vmap(energy, in_axes=(None, 0)), *arguments, name="own energy", keep=False)
    return np.nan_to_num(np.asarray(program(*arguments), float), nan=-np.inf)
