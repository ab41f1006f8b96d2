"""What if the template's Θ does not fit the sketch? Depths, labels and Θ together.

Chen et al. 2008, §5.3, an EM-like alternation of a few rounds (the paper: fewer than ten):

    E   Z, L = argmax P(Z, L | X, Y, Θ)             the parts of the E-step, one after the other (§5.2.1)
    M   Θ    = argmax Π_i P(Θ | s_i, α_i, β_i, γ_i)     (Eq. 4): averages and standard deviations of

    s   |v_i|/|v_pi| of every segment       α   φ where the label is 1       β   φ of the laterals
    γ   ϕ less the turn that the label asks for (§4, cases 1-3); circular mean, and √(−2 ln R) for σ_γ

Ours: floors under the σ (.05, .03 rad, .03 rad, .1 rad), without which they shrink to nothing on small trees; a
parameter with fewer than two observations stays as it was; a tree of one stroke stays on the page. Without `learn`, Θ
is insisted on and one round is all.
"""

from typing import NamedTuple

import jax
import numpy as np
from jaxtyping import Array, Float, Key

from sketchtree.mrf.chen.estep import EStepPart, Reading
from sketchtree.mrf.factor_graph import FactorGraph
from sketchtree.mrf.frames import wrap
from sketchtree.mrf.chen.labels import LabelParameters, families, log_joint
from sketchtree.mrf.measure import rotations
from sketchtree.mrf.prior import Prior, checked_theta
from sketchtree.mrf.solver import AbstractSolver
from sketchtree.parameters import TreeParameters

FLOORS = {"s": 0.05, "alpha": 0.03, "beta": 0.03, "gamma": 0.1}  # least σ; ratio, then radians
FEWEST = 2


class Rotations(NamedTuple):
    """What Eq. 2 looks at, one row a segment that diverges from another."""

    row: np.ndarray
    scale: np.ndarray  # s
    tilt: np.ndarray  # φ
    turn: np.ndarray  # ϕ
    label: np.ndarray
    child_count: np.ndarray  # K


class State(NamedTuple):
    """Only what the next round needs."""

    reading: Reading
    theta: TreeParameters
    moved: float  # Σ|Δz| of the last round
    rounds: int


class Info(NamedTuple):
    """What a person would plot; nats, drawn heights, radians."""

    log_posterior: float  # log P(Z, L | X, Y, Θ) of Eq. 3 after the round
    moved: float
    mu_s: float
    mu_alpha: float
    mu_beta: float
    mu_gamma: float


class EM(AbstractSolver):
    """Rounds of E and M; a round of E alone where Θ is not to be learnt."""

    e_step: tuple[EStepPart, ...]
    learn: bool = True
    rounds: int = 6  # at most; the paper needs fewer than ten

    @property
    def name(self) -> str:
        return "chen" if self.learn else "chen-fixed"

    @property
    def default_steps(self) -> int:
        return self.rounds

    def init(self, graph: FactorGraph, prior: Prior, key: Key[Array, ""]) -> State:
        n = len(graph)
        return State(Reading(np.zeros(n), np.zeros(n, np.int64)), checked_theta(prior.theta), np.inf, 0)

    def compile(self, graph: FactorGraph, prior: Prior) -> None:
        for part in self.e_step:
            part.compile(graph, prior.theta)

    def step(self, graph: FactorGraph, prior: Prior, state: State, key: Key[Array, ""]) -> tuple[State, Info]:
        reading = state.reading
        for k, part in enumerate(self.e_step):
            reading = part(graph, state.theta, reading, jax.random.fold_in(key, k))
        reading = reading._replace(depth=np.where(_has_laterals(graph), reading.depth, 0.0))
        theta = maximise(rotations_of(graph, reading), state.theta) if self.learn else state.theta
        moved = float(np.abs(reading.depth - state.reading.depth).sum())
        log_posterior = log_probability(graph, reading, state.theta)
        info = Info(log_posterior, moved, theta.mu_s, theta.mu_alpha, theta.mu_beta, theta.mu_gamma)
        return State(reading, theta, moved, state.rounds + 1), info

    def terminate(self, graph: FactorGraph, prior: Prior, state: State) -> bool:
        limit = self.rounds if self.learn else 1
        return state.rounds >= limit or state.moved < 0.01

    def depth(self, graph: FactorGraph, state: State) -> Float[np.ndarray, " segment"]:
        return state.reading.depth

    def log_posterior(self, graph: FactorGraph, prior: Prior, state: State) -> float | None:
        return log_probability(graph, state.reading, state.theta)

    def theta(self, graph: FactorGraph, prior: Prior, state: State) -> TreeParameters | None:
        return state.theta


def _has_laterals(graph: FactorGraph):
    """Rows of trees with more than one limb: a lone stroke says nothing of depth, so it stays on the page."""
    tree = graph.tree[graph.limb_first]
    return (np.bincount(tree, minlength=int(graph.tree.max()) + 1) > 1)[graph.tree]


def rotations_of(graph: FactorGraph, reading: Reading) -> Rotations:
    """s, φ, ϕ and the label of every segment whose parent is a segment."""
    vector = np.c_[graph.xy, reading.depth]
    vector = np.where(graph.is_base[:, None], 0.0, vector - vector[np.maximum(graph.parent, 0)])
    scale, tilt, turn, row = rotations(graph.parent, graph.is_base, vector)
    return Rotations(row, scale, tilt, turn, reading.label[row], families(graph).child_count[row])


def maximise(seen: Rotations, before: TreeParameters) -> TreeParameters:
    """The M-step: averages and standard deviations, with floors."""
    values = before.as_dict()
    apical = seen.label == 1
    for name, sample in (("s", seen.scale), ("alpha", seen.tilt[apical]), ("beta", seen.tilt[~apical])):
        if len(sample) >= FEWEST:
            values[f"mu_{name}"] = float(np.mean(sample))
            values[f"sigma_{name}"] = max(float(np.std(sample)), FLOORS[name])
    if len(seen.turn) >= FEWEST:
        resultant = np.mean(np.exp(1j * (seen.turn - asked_turn(seen))))
        values["mu_gamma"] = float(np.angle(resultant))
        values["sigma_gamma"] = max(float(np.sqrt(-2 * np.log(np.clip(abs(resultant), 1e-6, 1.0)))), FLOORS["gamma"])
    return TreeParameters(**values)


def asked_turn(seen: Rotations) -> Float[np.ndarray, " pair"]:
    """What the label adds to μ_γ: 0, π, or 2π (i − 1)/(K − 1)."""
    gap = np.where(seen.child_count == 2, np.pi, 2 * np.pi * (seen.label - 1) / np.maximum(seen.child_count - 1, 1))
    return np.where(seen.label == 1, 0.0, gap)


def log_probability(graph: FactorGraph, reading: Reading, theta: TreeParameters) -> float:
    """log P(Z, L | X, Y, Θ), Eq. 3: the sum of Eq. 2 over all pairs, up to a constant."""
    seen = rotations_of(graph, reading)
    apical = seen.label == 1
    columns = LabelParameters(
        np.where(apical, theta.mu_alpha, theta.mu_beta),
        np.where(apical, theta.sigma_alpha, theta.sigma_beta),
        wrap(theta.mu_gamma + asked_turn(seen)),
        np.full(len(apical), theta.sigma_gamma),
    )
    return float(np.sum(log_joint(seen.scale, seen.tilt, seen.turn, columns, theta)))
