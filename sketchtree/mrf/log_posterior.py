"""How likely are these elevations? All factors of one drawing, Θ integrated out.

    E(ψ) = Σ_kinds Σ log_potential(assignment(ψ), Θ) + log p(Θ) − log p(Θ | ψ)        (any Θ; see `conjugate`)

The columns are padded to a bucket, so that drawings of like size share one compiled program: segments to a
power of two, limbs to a quarter, a half or all of that, competing tips to two a limb.
"""

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

from sketchtree.axes import NULL
from sketchtree.mrf.assignment import STEEPEST, Assignment, Page, page
from sketchtree.mrf.conjugate import LimbBelief, LimbData, LimbTheta, limb_prior
from sketchtree.mrf.factor_graph import FactorGraph
from sketchtree.mrf.factors.apical import Apical
from sketchtree.mrf.factors.competition import Competition
from sketchtree.mrf.factors.crown import MEAN, NARROWEST, SD, Crown
from sketchtree.mrf.factors.extent import Extent
from sketchtree.mrf.factors.lateral import Lateral
from sketchtree.mrf.factors.limb_length import LimbLength
from sketchtree.mrf.factors.plane import Plane
from sketchtree.mrf.factors.siblings import DECAY, KAPPA, Siblings
from sketchtree.mrf.factors.solid_angle import SolidAngle
from sketchtree.mrf.factors.stem import SD as STEM_SD
from sketchtree.mrf.factors.stem import SHRUB_SD, Stem
from sketchtree.mrf.prior import Prior

SMALLEST_BUCKET = 32
RIVALS = 12  # that one tip may have
RIVALS_OF_MANY = 6  # in very large drawings
MANY_LIMBS = 1024
LATERALS_FOR_TRUNK = 3  # below which a trunk's bend is not learnt
ONE_SIDED = (0.7, 0.9)  # |mean dx| / rms dx at which extent and crown begin to weaken, and have


class LogPosterior(eqx.Module):
    """E(ψ) of one drawing; the factor kinds are its fields."""

    page: Page
    solid_angle: SolidAngle
    lateral: Lateral
    apical: Apical
    stem: Stem
    limb_length: LimbLength
    siblings: Siblings
    competition: Competition
    extent: Extent
    crown: Crown
    plane: Plane
    belief: LimbBelief
    learns: Float[Array, ""]  # 1: Θ is learnt; 0: it stays the prior's
    learns_trunk: Float[Array, ""]  # 0 where too few laterals say what a trunk's bend means

    @property
    def factors(self) -> tuple:
        """Every kind of factor."""
        return (
            self.solid_angle, self.lateral, self.apical, self.stem, self.limb_length,
            self.siblings, self.competition, self.extent, self.crown, self.plane,
        )  # fmt: skip

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
        return sum(jnp.sum(kind.log_potential(assignment, theta)) for kind in self.factors)

    def theta(self, elevation: Float[Array, " segment"]) -> LimbTheta:
        """Θ at its posterior mean given ψ."""
        return self.belief.updated(self.data(self.page.assign(elevation))).mean()

    def data(self, assignment: Assignment) -> LimbData:
        """What these depths say about Θ."""
        learns_bend = jnp.concatenate([self.learns_trunk[None], jnp.ones(2, self.learns.dtype)])
        bend_kind = self.apical.kind * self.learns * learns_bend
        return LimbData(
            divergence=_moments(assignment.turn, self.lateral.kind * self.learns),
            length=_moments(self.limb_length.excess(assignment), self.limb_length.kind * self.learns),
            bend=(jnp.sum(bend_kind, axis=0), assignment.turn**2 @ bend_kind),
        )


def _moments(value, kind):
    count = jnp.sum(kind, axis=0)
    mean = value @ kind / jnp.maximum(count, 1.0)
    return count, mean, jnp.sum(kind * (value[:, None] - mean) ** 2, axis=0)


def bucket(graph: FactorGraph) -> tuple[int, int]:
    """(segments, limbs) that the columns are padded to."""
    segments = SMALLEST_BUCKET
    while segments < len(graph):
        segments *= 2
    limbs = segments // 4
    while limbs < graph.limb_count:
        limbs *= 2
    return segments, limbs


def log_posterior(
    graph: FactorGraph, prior: Prior, *, learns: bool = True, planar: bool = False, dtype=np.float32
) -> LogPosterior:
    """Compile a drawing and a prior to padded columns."""
    segments, limbs = bucket(graph)
    pad = _Padding(limbs, dtype)
    is_lateral = graph.limb_parent != NULL
    stem = np.flatnonzero(graph.limb_parent == NULL)
    shape = 0.0 if planar else 1.0
    return LogPosterior(
        page=page(graph, segments, limbs, dtype),
        solid_angle=SolidAngle(pad.real(~graph.is_base, segments)),
        lateral=Lateral(pad.real(np.eye(2)[np.clip(graph.order, 1, 2) - 1] * graph.is_lateral[:, None], segments)),
        apical=Apical(pad.real(np.eye(3)[np.minimum(graph.order, 2)] * graph.is_apical[:, None], segments)),
        stem=Stem(
            row=pad.index(graph.limb_first[stem], limbs),
            sd=pad.real(np.where(graph.limb_spreads[stem], SHRUB_SD, STEM_SD), limbs, fill=1.0),
            present=pad.real(np.ones(len(stem)), limbs),
        ),
        limb_length=LimbLength(
            parent=pad.index(np.where(is_lateral, graph.limb_parent, np.arange(graph.limb_count)), limbs),
            kind=pad.real(np.eye(2)[np.clip(graph.limb_order, 1, 2) - 1] * is_lateral[:, None], limbs),
            insertion=pad.real(graph.insertion, limbs),
        ),
        siblings=_siblings(graph, pad, shape),
        competition=_competition(graph, pad, shape),
        extent=_extent(graph, pad, shape),
        crown=_crown(graph, pad, shape),
        plane=Plane(pad.real((1 - shape) * ~graph.is_base, segments)),
        belief=limb_prior(prior, dtype),
        learns=np.asarray(float(learns), dtype),
        learns_trunk=np.asarray(float(is_lateral.sum() >= LATERALS_FOR_TRUNK), dtype),
    )  # fmt: skip


class _Padding:
    """Columns of a given length; the tail of index columns is 0, that of others `fill`."""

    def __init__(self, limbs: int, dtype):
        self.limbs, self.dtype = limbs, dtype

    def real(self, column, length, fill=0.0):
        return self._filled(np.asarray(column, float), length, fill).astype(self.dtype)

    def index(self, column, length):
        return self._filled(np.asarray(column, int), length, 0).astype(np.int32)

    @staticmethod
    def _filled(column, length, fill):
        return np.concatenate([column, np.full((length - len(column), *column.shape[1:]), fill, column.dtype)])


def _siblings(graph, pad, shape):
    """Every limb's siblings up to three ranks away, each pair from both ends."""
    sibling, strength = np.zeros((pad.limbs, 6), int), np.zeros((pad.limbs, 6))
    for (a, b), gap in zip(graph.sibling, graph.rank_gap, strict=True):
        for limb, other, slot in ((a, b, gap - 1), (b, a, gap + 2)):
            sibling[limb, slot], strength[limb, slot] = other, shape * KAPPA * DECAY[gap]
    return Siblings(pad.index(graph.limb_first, pad.limbs), pad.index(sibling, pad.limbs).T, pad.real(strength, pad.limbs).T)


def _competition(graph, pad, shape):
    """Every competing tip's nearest rivals, each pair from both ends or not at all."""
    most = RIVALS if pad.limbs <= MANY_LIMBS else RIVALS_OF_MANY
    rows, index = np.unique(graph.competitor, return_inverse=True)
    both = index.reshape(-1, 2)
    one, other = np.r_[both[:, 0], both[:, 1]], np.r_[both[:, 1], both[:, 0]]
    pair = np.tile(np.arange(len(both)), 2)
    apart = np.linalg.norm(graph.xy[rows[one]] - graph.xy[rows[other]], axis=1)
    while len(one):
        by = np.lexsort((np.arange(len(one)), apart, one))
        one, other, pair, apart = one[by], other[by], pair[by], apart[by]
        slot = np.arange(len(one)) - np.searchsorted(one, one)
        if slot.max() < most:
            break
        keep = ~np.isin(pair, pair[slot >= most])
        one, other, pair, apart = one[keep], other[keep], pair[keep], apart[keep]
    rival, present, square = (np.zeros((2 * pad.limbs, most), kind) for kind in (int, float, float))
    if len(one):
        rival[one, slot], present[one, slot], square[one, slot] = other, shape, apart**2
    return Competition(
        pad.index(rows, 2 * pad.limbs), pad.index(rival, 2 * pad.limbs).T, pad.real(present, 2 * pad.limbs).T,
        pad.real(square, 2 * pad.limbs).T, np.asarray(graph.crown_radius, pad.dtype),
    )  # fmt: skip


def _aside(graph):
    return graph.xy[graph.limb_tip, 0] - graph.trunk_x


def _sidedness(graph):
    """Weight of extent and crown per tree: 1, falling to .15 where every tip is on one side."""
    lateral = graph.limb_spreads
    tree = graph.tree[graph.limb_tip][lateral]
    aside = _aside(graph)[lateral]
    count = np.maximum(np.bincount(tree, minlength=graph.tree.max() + 1), 1)
    mean = np.bincount(tree, aside, minlength=len(count)) / count
    rms = np.sqrt(np.bincount(tree, aside**2, minlength=len(count)) / count)
    low, high = ONE_SIDED
    return 1 - 0.85 * np.clip((np.abs(mean) / np.maximum(rms, 1e-9) - low) / (high - low), 0, 1)


def _extent(graph, pad, shape):
    lateral = graph.limb_spreads
    tree = graph.tree[graph.limb_tip] % pad.limbs
    square = np.bincount(tree[lateral], _aside(graph)[lateral] ** 2, minlength=pad.limbs)
    some = np.bincount(tree[lateral], minlength=pad.limbs) > 0
    weight = np.zeros(pad.limbs)
    weight[: graph.tree.max() + 1] = _sidedness(graph)[: pad.limbs]
    return Extent(
        tip=pad.index(graph.limb_tip, pad.limbs), tree=pad.index(tree, pad.limbs), lateral=pad.real(lateral, pad.limbs),
        count=pad.real(np.maximum(np.bincount(tree[lateral], minlength=pad.limbs), 1), pad.limbs),
        width_square=pad.real(square, pad.limbs), weight=pad.real(shape * some * weight, pad.limbs),
    )  # fmt: skip


def _crown(graph, pad, shape):
    above = np.minimum(np.maximum(graph.limb_order - 1, 0), 1)
    weight = shape * graph.limb_spreads * _sidedness(graph)[graph.tree[graph.limb_tip]]
    return Crown(
        tip=pad.index(graph.limb_tip, pad.limbs), aside=pad.real(_aside(graph), pad.limbs),
        half_width=pad.real(np.maximum(graph.half_width, NARROWEST), pad.limbs, fill=1.0),
        mean=pad.real(np.array(MEAN)[above], pad.limbs), sd=pad.real(np.array(SD)[above], pad.limbs, fill=1.0),
        weight=pad.real(weight, pad.limbs),
    )  # fmt: skip
