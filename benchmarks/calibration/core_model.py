"""A tree drawn from the model itself: Θ from its prior, then every direction and length given Θ.

The core of the model is the product of the factor kinds solid_angle, lateral, apical, stem, one kind of lengths (the variant),
and a factor of our own for what no kind speaks about. It lacks the kinds that cannot be drawn one after the other.

    limbs       limb_length; within a limb of segments i       −½ Σ c_i²/.3²,   c_i = log L_i − mean over the limb of log L
    segments    segment_length on laterals; the same c on the trunk

The factors are not normalised, and the target holds no normaliser that depends on Θ. So nothing is cut to range on its own:
a test that fails throws the whole tree away, Θ too.

    Θ           σ² = ν s²/χ²_ν,  μ ~ N(m, σ²/κ);   τ² = ν s²/χ²_ν
    stem        ψ ~ N(0, .08), kept with probability cos ψ; drawn straight up the page
    lateral     a ~ N(μ_o, σ_o), 0 ≤ a ≤ π, kept with probability sin a/(sin a + .02); azimuth even
    apical      a ~ Rayleigh(τ_o), a ≤ π, kept with probability sin a/a; azimuth even
    all         |ψ| ≤ 80°
    limbs       log Λ_j − log Λ_parent ~ N(a_o − .8(u_j − ½), ς_o),  c ~ N(0, .3²) less its mean
    segments    log L ~ N(m_o, s_o), H = 1

`segments` speaks of lengths relative to H, and H is the drawing's. Trees are drawn with a trunk of any size t (log t even), and t is
solved for H(t) = 1; that slice of the improper prior has the weight 1/(d log H/d log t), d log H/d log t being the share f of H that is the
trunk's. Kept with probability .5/f; f < .5 is thrown away, which the page alone decides and so cannot bend the posterior. Likewise
pages with a segment shorter than 1/500 H, which the factor graph would lengthen.
"""

from typing import NamedTuple

import equinox as eqx
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float, Int

from sketchtree.axes import NULL
from sketchtree.mrf.assignment import STEEPEST
from sketchtree.mrf.conjugate import LimbTheta, limb_prior
from sketchtree.mrf.factor_graph import FactorGraph
from sketchtree.mrf.factors import limb_length, stem
from sketchtree.mrf.padding import Padding
from sketchtree.mrf.prior import Prior
from sketchtree.sketch.graph import SketchGraph

VARIANTS = ("limbs", "segments")
LENGTHS = {"limbs": "limb_length", "segments": "segment_length"}  # the kind that a variant keeps
NOT_DRAWN = ("siblings", "competition", "extent", "crown", "plane")
SHARE_SD = 0.3  # of c
SHORTEST = 2e-3  # H; pages with a shorter segment are thrown away
TRUNK_SHARE = 0.5  # least f
HEIGHT = 800.0  # sketch units


class Topology(NamedTuple):
    """Who grows from whom; row 0 is the base, limb 0 the trunk."""

    parent: Int[np.ndarray, " segment"]
    limb: Int[np.ndarray, " segment"]
    limb_order: Int[np.ndarray, " limb"]
    host: Int[np.ndarray, " limb"]  # row that a limb grows from; 0 for the trunk


class World(NamedTuple):
    """A drawing and the truth behind it."""

    graph: SketchGraph
    elevation: Float[np.ndarray, " segment"]  # ψ; 0 at the base
    theta: LimbTheta
    tried: int  # trees drawn until this one was kept


class Shares(eqx.Module):
    """How alike are the segments of one limb? −½ Σ c²/.3², one factor a segment."""

    member: Float[Array, "segment limb"]  # 1 where a segment counts for its limb

    @classmethod
    def of_all(cls, graph: FactorGraph) -> "Shares":
        """On every limb."""
        return cls._of(graph, ~graph.is_base)

    @classmethod
    def of_stems(cls, graph: FactorGraph) -> "Shares":
        """On stems only."""
        return cls._of(graph, ~graph.is_base & (graph.order == 0))

    @classmethod
    def _of(cls, graph, counts):
        pad = Padding(graph)
        return cls(jnp.asarray(pad.real(np.eye(pad.limbs)[graph.limb] * counts[:, None], pad.segments)))

    def log_potential(self, assignment, theta) -> Float[Array, " segment"]:
        """The Gaussian in log L about the limb's mean."""
        counts = jnp.sum(self.member, axis=1)
        log_length = counts * jnp.log(assignment.length + 1e-9)
        mean = log_length @ self.member / jnp.maximum(jnp.sum(self.member, axis=0), 1.0)
        return -0.5 * ((log_length - self.member @ mean) / SHARE_SD) ** 2


def core_factors(variant: str) -> dict:
    """What `log_posterior` and `Elevation` need to be told to use the core alone."""
    out = {name: None for name in (*NOT_DRAWN, *(kind for own, kind in LENGTHS.items() if own != variant))}
    return out | {"shares": Shares.of_all if variant == "limbs" else Shares.of_stems}


def draw_topology(rng: np.random.Generator) -> Topology:
    """A trunk of 2-4 segments, 2-4 limbs on it, 1-2 on those; each of 1-3 segments; 6-15 in all."""
    while True:
        first, second = int(rng.integers(2, 5)), int(rng.integers(1, 3))
        count = [int(rng.integers(2, 5)), *rng.integers(1, 4, first + second).tolist()]
        if first + second >= 3 and 6 <= sum(count) <= 15:
            break
    parent, limb, host = [NULL, *range(count[0])], [0] * (count[0] + 1), [0]
    for j in range(1, len(count)):
        rows = range(1, count[0] + 1) if j <= first else [row for row, own in enumerate(limb) if 1 <= own <= first]
        host.append(int(rng.choice(rows)))
        start = len(parent)
        parent += [host[-1], *range(start, start + count[j] - 1)]
        limb += [j] * count[j]
    return Topology(*map(np.array, (parent, limb, [0] + [1] * first + [2] * second, host)))


def draw_world(topology: Topology, variant: str, rng: np.random.Generator) -> World:
    """One tree of the core model."""
    tried = 0
    while True:
        tried += 1
        theta = draw_prior(rng)
        direction = _directions(topology, theta, rng)
        if direction is None:
            continue
        length = _limb_lengths(topology, direction, theta, rng) if variant == "limbs" else _segment_lengths(topology, direction, theta, rng)
        if length is None:
            continue
        xy = tips(topology.parent, length[:, None] * direction[:, :2])
        height = np.ptp(xy, axis=0).max()
        page = length[1:] * np.hypot(*direction[1:, :2].T)
        if page.min() > SHORTEST * height:
            return World(_sketch(topology, xy * HEIGHT / height), np.arcsin(direction[:, 2]), theta, tried)


def draw_prior(rng: np.random.Generator) -> LimbTheta:
    """Θ from the generic prior."""
    belief = limb_prior(Prior(), np.float64)
    columns = []
    for m, kappa, nu, s2 in (belief.divergence, belief.length, belief.segment):
        variance = nu * s2 / rng.chisquare(nu)
        columns += [rng.normal(m, np.sqrt(variance / kappa)), np.sqrt(variance)]
    nu, s2 = belief.bend
    return LimbTheta(*columns, np.sqrt(nu * s2 / rng.chisquare(nu)))


def _directions(topology, theta, rng):
    """V of every row, +y at the base; None where a test fails."""
    v = np.zeros((len(topology.parent), 3))
    v[0] = (0.0, 1.0, 0.0)
    for row in range(1, len(v)):
        above = topology.parent[row]
        order = topology.limb_order[topology.limb[row]]
        if above == 0:
            psi = rng.normal(0.0, stem.SD)
            kept = rng.random() < np.cos(psi)
            v[row] = (0.0, np.cos(psi), np.sin(psi))
        else:
            a, kept = _angle(topology.limb[row] == topology.limb[above], order, theta, rng)
            v[row] = _turned(v[above], a, rng.uniform(0, 2 * np.pi))
        if not kept or abs(v[row, 2]) > np.sin(STEEPEST):
            return None
    return v


def _angle(is_apical, order, theta, rng):
    """(a, whether it passes its tests)."""
    if is_apical:
        a = rng.rayleigh(theta.bend_sd[order])
        chance = np.sin(a) / max(a, 1e-300)
    else:
        a = rng.normal(theta.divergence_mean[order - 1], theta.divergence_sd[order - 1])
        chance = np.sin(a) / (np.sin(a) + 0.02)
    return a, 0 <= a <= np.pi and rng.random() < chance


def _turned(axis, a, azimuth):
    """The direction at angle a from `axis`."""
    side = np.cross(axis, (1.0, 0.0, 0.0) if abs(axis[0]) < 0.6 else (0.0, 1.0, 0.0))
    side /= np.linalg.norm(side)
    across = np.cos(azimuth) * side + np.sin(azimuth) * np.cross(axis, side)
    return np.cos(a) * axis + np.sin(a) * across


def _limb_lengths(topology, direction, theta, rng):
    """L of every row; the trunk is 1 long."""
    flat = np.hypot(*direction[:, :2].T)
    length, log_limb = np.zeros(len(flat)), np.zeros(len(topology.host))
    for j, host in enumerate(topology.host):
        if j > 0:
            on, order = topology.limb[host], topology.limb_order[j]
            rows = np.flatnonzero(topology.limb == on)
            insertion = (length * flat)[rows[rows <= host]].sum() / (length * flat)[rows].sum()
            mean = theta.length_mean[order - 1] + limb_length.SLOPE * (insertion - 0.5)
            log_limb[j] = log_limb[on] + rng.normal(mean, theta.length_sd[order - 1])
        rows = np.flatnonzero((topology.limb == j) & (topology.parent != NULL))
        share = _share(len(rows), rng)
        length[rows] = np.exp(log_limb[j]) * share / share.sum()
    return length


def _segment_lengths(topology, direction, theta, rng):
    """L of every row where H = 1; None where the trunk's share of H is too small or is not kept."""
    order = topology.limb_order[topology.limb]
    on_trunk = order == 0
    which = np.maximum(order - 1, 0)
    length = np.exp(rng.normal(theta.segment_mean[which], theta.segment_sd[which]))
    length[on_trunk] = 0.0
    trunk = np.zeros(len(order))
    rows = np.flatnonzero(on_trunk)[1:]
    trunk[rows] = _share(len(rows), rng)
    from_trunk, from_limbs = (tips(topology.parent, x[:, None] * direction[:, :2]) for x in (trunk, length))
    size, share = _size_of_trunk(from_trunk, from_limbs)
    if share < TRUNK_SHARE or rng.random() > TRUNK_SHARE / share:
        return None
    return length + size * trunk


def _size_of_trunk(from_trunk, from_limbs):
    """(t with H(t) = 1, the trunk's share of H there), by Newton's method: H is convex in t and piecewise linear."""
    size = 1e4
    for _ in range(100):
        xy = size * from_trunk + from_limbs
        axis = int(np.argmax(np.ptp(xy, axis=0)))
        high, low = np.argmax(xy[:, axis]), np.argmin(xy[:, axis])
        height, slope = xy[high, axis] - xy[low, axis], from_trunk[high, axis] - from_trunk[low, axis]
        if slope <= 0 or size <= 0:
            return 0.0, 0.0
        if abs(height - 1) < 1e-12:
            return size, size * slope
        size += (1 - height) / slope
    return 0.0, 0.0


def _share(count, rng):
    c = rng.normal(0.0, SHARE_SD, count)
    return np.exp(c - c.mean())


def tips(parent: Int[np.ndarray, " segment"], step: Float[np.ndarray, "segment axis"]) -> Float[np.ndarray, "segment axis"]:
    """Where every row ends, each `step` from its parent's end; parents come first."""
    at = step.copy()
    for row in range(1, len(parent)):
        at[row] += at[parent[row]]
    return at


def _sketch(topology, xy) -> SketchGraph:
    n, limbs = len(xy), len(topology.host)
    return SketchGraph(
        parent=topology.parent, xy=xy, limb=topology.limb, stroke=topology.limb, tree=np.zeros(n, int), width=np.full(n, np.nan),
        joined=np.zeros(n, bool), curve_points=np.zeros((0, 2)), curve_start=np.zeros(n + 1, int),
        limb_id=np.arange(limbs), stroke_ids=tuple(f"s{k}" for k in range(limbs)), crown=(),
    )  # fmt: skip
