"""How like is a sketch to each view of each exemplar? Two scores, each a sum of terms of its own.

Chen et al. 2008, §7 (`chen_terms`), μ and σ in 2D:

    L_c(S, E | v) = −‖f_S − f_E|v‖                                             crown (footprint f)
    L_b(S, E | v) = −Σ_{x = s, α, β} (μ_x − μ_x,E|v)² / (σ_x² + σ_x,E|v²)      branching

Ours (`calibrated_terms`): each term is the log density of Student's t with NU degrees of freedom in the learnt `Metric`, times
a learnt weight; q is the squared Mahalanobis distance over the k figures that the sketch shows,

    term = −w (NU + k) / 2 · ln(1 + q / NU)

so that one odd trait costs little more. A trait that an exemplar lacks counts as `LACKING` standard deviations above the sketch's.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Float

from sketchtree.templates.seen.branching import Branching
from sketchtree.templates.exemplar import Views
from sketchtree.templates.matching.metric import BRANCHING, HARMONICS, POSTURE, Metric

SIGMA_FLOOR = (0.05, 0.01, 0.01)  # of sqrt(σ² + σ²) for s (1), α, β (rad): a drawing may be exactly regular
NU = 4.0
LACKING = 2.0


@dataclass(frozen=True, eq=False)
class SketchShape:
    """What matching knows of a sketch."""

    footprint: Float[np.ndarray, " direction"] | None  # None without a crown
    branching: Branching  # one view
    posture: Float[np.ndarray, " feature"]

    @property
    def traits(self) -> Float[np.ndarray, " trait"]:
        """Means of s, α, β and the posture; NaN where it is not shown."""
        return np.concatenate([self.branching.mean[0], self.posture])


def chen_terms(shape: SketchShape, views: Views):
    """(L_c or None, L_b), each (exemplar, view); exactly §7."""
    return crown_likeness(shape, views), branching_likeness(shape, views)


def crown_likeness(shape: SketchShape, views: Views) -> Float[np.ndarray, "exemplar view"] | None:
    """L_c = −‖f_S − f_E|v‖; None without a crown."""
    if shape.footprint is None:
        return None
    off = views.footprint - shape.footprint.astype(views.footprint.dtype)
    return -np.sqrt(np.einsum("...d,...d->...", off, off))


def branching_likeness(shape: SketchShape, views: Views) -> Float[np.ndarray, "exemplar view"]:
    """L_b. A statistic that sketch or view lacks is left out of the sum."""
    exemplar = views.branching
    mean, sd = (x[0].astype(exemplar.mean.dtype) for x in (shape.branching.mean, shape.branching.sd))
    variance = np.maximum(sd**2 + exemplar.sd**2, np.square(SIGMA_FLOOR, dtype=exemplar.mean.dtype))
    z = (mean - exemplar.mean) ** 2 / variance
    return -sum(np.where(np.isnan(z[..., x]), 0, z[..., x]) for x in range(z.shape[-1]))


def calibrated_terms(shape: SketchShape, views: Views, metric: Metric):
    """(crown or None, branching, posture), each (exemplar, view), as the formulas stand; `search` is the fast way."""
    w_crown, w_branching, w_posture = metric.weight.tolist()
    crown = None if shape.footprint is None else -w_crown * heavy(crown_distance(shape, views, metric), 2 * HARMONICS + 1)
    branching = heavy(*trait_distance(shape, views.branching.mean, metric, BRANCHING))
    posture = heavy(*trait_distance(shape, views.posture, metric, POSTURE))
    return crown, -w_branching * branching, -w_posture * posture


def crown_distance(shape: SketchShape, views: Views, metric: Metric) -> Float[np.ndarray, "exemplar view"]:
    """q of the crowns: the squared distance of the footprints' first harmonics."""
    off = (views.footprint - shape.footprint) @ metric.basis
    return np.einsum("...c,...c->...", off, off)


def trait_distance(shape: SketchShape, figures: Float[np.ndarray, "*view trait"], metric: Metric, among: slice):
    """(q, k) of the branching or of the posture, over what the sketch shows."""
    wanted = (shape.traits - metric.shift)[among]
    shown = ~np.isnan(wanted)
    off = figures[..., shown] - wanted[shown]
    off = np.where(np.isnan(off), LACKING * metric.sd[among][shown], off) @ whitening(metric, among, shown)
    return np.einsum("...t,...t->...", off, off), int(shown.sum())


def whitening(metric: Metric, among: slice, shown: Bool[np.ndarray, " trait"]) -> Float[np.ndarray, "kept kept"]:
    """W with ‖d W‖² the squared Mahalanobis distance of d, a difference of what is shown."""
    covariance = metric.covariance(among)[np.ix_(shown, shown)]
    return np.linalg.cholesky(np.linalg.inv(covariance)) if shown.any() else np.zeros((0, 0))


def heavy(q, k: int):
    """−log of Student's t in k dimensions, up to a constant. (log is several times faster than log1p in single precision.)"""
    return (NU + k) / 2 * np.log(1 + q / NU)
