"""What do the limbs say about Θ, and what remains of the posterior when Θ is integrated out?

Divergences, log length ratios and log segment lengths of order o = 1, 2+ are Gaussian with unknown mean and variance under a
Normal-Inverse-Gamma prior (m0, κ0, ν0, s0²); bends of order o = 0, 1, 2+ are Gaussian in two directions with an unknown
variance τ² under a scaled Inverse-χ² prior (ν0, s0²). Given n observations x with mean x̄ and sum of squares S
about it:

    κn = κ0 + n      mn = (κ0 m0 + n x̄)/κn      νn = ν0 + n      νn sn² = ν0 s0² + S + κ0 n (x̄ − m0)²/κn
    bends:           νn = ν0 + 2n               νn sn² = ν0 s0² + Σ a²

Means are m, variances s² (Θ at its posterior mean); σ²_MAP = (νn sn²/2)/(νn/2 + 1). For any Θ Bayes' rule says

    log p(ψ) = log p(ψ | Θ) + log p(Θ) − log p(Θ | ψ)

so the posterior without Θ is the factors' sum at one convenient Θ and two densities (Chib 1995 uses it so).
The default means come from 24 synthetic exemplars, the default spreads from grown and measured trees on which no figure is
reported (measured trees branch far less evenly than grown ones); a template's own statistics move m0 and s0².
"""

from typing import NamedTuple

import equinox as eqx
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

from sketchtree.errors import InferenceError
from sketchtree.mrf.prior import Prior


class LimbTheta(NamedTuple):
    """Θ of the default method, per branching order."""

    divergence_mean: Float[Array, " 2"]  # μ_o, radians, o = 1, 2+
    divergence_sd: Float[Array, " 2"]  # σ_o
    length_mean: Float[Array, " 2"]  # a_o, log ratio of limb lengths
    length_sd: Float[Array, " 2"]  # ς_o
    segment_mean: Float[Array, " 2"]  # m_o, log of segment lengths, H = 1
    segment_sd: Float[Array, " 2"]  # s_o
    bend_sd: Float[Array, " 3"]  # τ_o, radians, o = 0, 1, 2+


class LimbData(NamedTuple):
    """Sufficient statistics of one assignment: counts, means, and sums of squares about the means
    (bends: about 0)."""

    divergence: tuple[Array, Array, Array]
    length: tuple[Array, Array, Array]
    segment: tuple[Array, Array, Array]
    bend: tuple[Array, Array]


class LimbBelief(eqx.Module):
    """A Normal-Inverse-Gamma for divergence and for length, and an Inverse-χ² for bends."""

    divergence: Float[Array, "4 2"]  # m, κ, ν, s² per order 1, 2+
    length: Float[Array, "4 2"]
    segment: Float[Array, "4 2"]
    bend: Float[Array, "2 3"]  # ν, s² per order 0, 1, 2+

    def mean(self) -> LimbTheta:
        """Θ with means m and variances s²."""
        normal = [column for kind in self._normals for column in (kind[0], jnp.sqrt(kind[3]))]
        return LimbTheta(*normal, jnp.sqrt(self.bend[1]))

    def mode(self) -> LimbTheta:
        """Θ at the joint mode, σ²_MAP = (ν s²/2)/(ν/2 + 1) (the Normal's own σ in the joint density left out)."""
        sd = [jnp.sqrt(nu * s2 / (nu + 2)) for nu, s2 in (*(kind[2:] for kind in self._normals), self.bend)]
        return LimbTheta(*[column for kind, own in zip(self._normals, sd) for column in (kind[0], own)], sd[-1])

    @property
    def _normals(self):
        return self.divergence, self.length, self.segment

    def updated(self, data: LimbData) -> "LimbBelief":
        """The posterior given one assignment's statistics."""
        count, square = data.bend
        nu = self.bend[0] + 2 * count
        bend = jnp.stack([nu, (self.bend[0] * self.bend[1] + square) / nu])
        normals = zip(self._normals, (data.divergence, data.length, data.segment), strict=True)
        return LimbBelief(*(_normal_update(belief, *seen) for belief, seen in normals), bend)

    def log_density(self, theta: LimbTheta) -> Float[Array, " 9"]:
        """log density of (mean, variance) of each kind and order at Θ, up to terms of κ0, ν0 and counts alone."""
        return jnp.concatenate(
            [
                _normal_inverse_gamma(self.divergence, theta.divergence_mean, theta.divergence_sd**2),
                _normal_inverse_gamma(self.length, theta.length_mean, theta.length_sd**2),
                _normal_inverse_gamma(self.segment, theta.segment_mean, theta.segment_sd**2),
                _inverse_chi2(self.bend[0], self.bend[1], theta.bend_sd**2),
            ]
        )


GENERIC_BELIEF = {
    "divergence": [[1.045, 0.893], [0.42, 1.37], [6.0, 6.0], [0.039, 0.040]],
    "length": [[-1.35, -1.09], [0.69, 0.36], [6.0, 6.0], [0.7, 0.5]],
    "segment": [[-2.35, -2.5], [0.5, 0.5], [6.0, 6.0], [0.25, 0.15]],
    "bend": [[6.0, 6.0, 6.0], [0.03, 0.1, 0.25]],
}

MOST_TEMPLATE_LIMBS = 8.0  # κ0 + n is held to this
TEMPLATE_NU = 12.0  # ν0 under a template


def limb_prior(prior: Prior, dtype=np.float32) -> LimbBelief:
    """The conjugate prior: the generic one, moved by the template's own statistics where it has any.

    With n of the template's observations m0 moves as by data, κ0 + n is held to at most 8, ν0 = 12 and s0² is
    the template's own, shrunk to the generic one with weight 6.
    """
    generic = {name: np.array(value) for name, value in GENERIC_BELIEF.items()}
    if prior.belief is not None:
        checked_belief(prior.belief)
        generic = {name: np.array(getattr(prior.belief, name), float) for name in generic}
    limbs = prior.limbs
    if limbs is not None:
        for name in ("divergence", "length"):
            count, mean, variance = (getattr(limbs, f"{name}_{part}") for part in ("count", "mean", "variance"))
            generic[name] = _moved(generic[name], np.asarray(count, float), np.asarray(mean), np.asarray(variance))
        n = np.asarray(limbs.bend_count, float)
        nu, s2 = generic["bend"]
        moved = (nu * s2 + n * np.asarray(limbs.bend_square)) / (nu + 2 * n)
        generic["bend"] = np.stack([np.where(n > 0, TEMPLATE_NU, nu), np.where(n > 0, moved, s2)])
    checked_belief(LimbBelief(**generic))
    return LimbBelief(**{name: np.asarray(value, dtype) for name, value in generic.items()})


def checked_belief(belief: LimbBelief) -> LimbBelief:
    """The belief itself. Raises `InferenceError` naming the kind and order whose numbers are no prior: not finite, or a κ, ν
    or variance that is not positive."""
    for name, generic in GENERIC_BELIEF.items():
        kind = np.asarray(getattr(belief, name), float)
        if kind.shape != np.shape(generic):
            raise InferenceError(f"`{name}` of the prior has the shape {kind.shape}.", remedy=f"Give {np.shape(generic)}: a row a hyperparameter, a column an order.")
        positive = kind[-3:] if len(kind) == 4 else kind
        bad = ~np.isfinite(kind).all(axis=0) | (positive <= 0).any(axis=0)
        if bad.any():
            order = int(np.flatnonzero(bad)[0]) + (0 if name == "bend" else 1)
            raise InferenceError(
                f"`{name}` of order {order} of the prior is {kind[:, np.flatnonzero(bad)[0]].tolist()}.",
                remedy="Give finite numbers; κ, ν and variances above 0.",
            )
    return belief


def _moved(belief, n, mean, variance):
    m, kappa, nu, s2 = belief
    some = n > 0
    moved = (kappa * m + n * mean) / (kappa + n)
    shrunk = (nu * s2 + n * variance) / (nu + n)
    told = np.stack([moved, np.minimum(kappa + n, MOST_TEMPLATE_LIMBS), np.full(2, TEMPLATE_NU), shrunk])
    return np.where(some, told, belief)


def _normal_update(belief, count, mean, square):
    m, kappa, nu, s2 = belief
    kappa_n, nu_n = kappa + count, nu + count
    total = nu * s2 + square + kappa * count * (mean - m) ** 2 / kappa_n
    return jnp.stack([(kappa * m + count * mean) / kappa_n, kappa_n, nu_n, total / nu_n])


def _normal_inverse_gamma(belief, mean, variance):
    m, kappa, nu, s2 = belief
    normal = 0.5 * jnp.log(kappa / variance) - 0.5 * kappa * (mean - m) ** 2 / variance
    return normal + _inverse_chi2(nu, s2, variance)


def _inverse_chi2(nu, s2, variance):
    half = nu / 2
    return half * jnp.log(half * s2) - (half + 1) * jnp.log(variance) - half * s2 / variance


def theta_names() -> tuple[str, ...]:
    """The names of the columns that `draw_theta` fills: LimbTheta's fields with their orders."""
    return tuple(
        f"{field}_{order}{'+' if order == 2 else ''}"
        for field in LimbTheta._fields
        for order in ((0, 1, 2) if field.startswith("bend") else (1, 2))
    )


def draw_theta(belief: LimbBelief, generator: np.random.Generator) -> Float[np.ndarray, "sample parameter"]:
    """One Θ from each of many beliefs (columns with a sample axis in front): σ² = ν s² / χ²_ν, μ ~ N(m, σ²/κ)."""
    columns = []
    for kind in belief._normals:
        mean, kappa, nu, s2 = np.moveaxis(np.asarray(kind), 1, 0)
        variance = nu * s2 / generator.chisquare(nu)
        columns += [mean + np.sqrt(variance / kappa) * generator.standard_normal(mean.shape), np.sqrt(variance)]
    nu, s2 = np.moveaxis(np.asarray(belief.bend), 1, 0)
    return np.concatenate([*columns, np.sqrt(nu * s2 / generator.chisquare(nu))], axis=1)
