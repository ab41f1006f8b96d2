"""Which parameters Θ does a given tree have?

Chen et al. 2008, §4. A frame R travels with every segment (its y axis along the segment); the child's is

    R_c = R_p R_y(ϕ) R_x(φ),   so   R_pᵀ v_c / |v_c| = (sin φ sin ϕ, cos φ, sin φ cos ϕ)

    s = |v_c| / |v_p|          mean and sd over all parent-child pairs
    φ ∈ [0, π]                 μ_α, σ_α over apical, μ_β, σ_β over lateral pairs
    ϕ                          μ_γ, σ_γ: circular mean and sd of ϕ − offset_i, offset_i of θ_i in §4:
                               0 apical; π for K = 2; 2π(i − 1)/(K − 1) for i = 2 … K

The apical child continues its parent's limb; where a limb ends in several, it is the one with the smallest φ.
Labels of the other children go by rising ϕ, begun at the one that fits μ_γ best. A base's frame is
the world's, turned by the least rotation to the stem.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Float, Int

from sketchtree.axes import NULL
from sketchtree.parameters import GENERIC, TreeParameters
from sketchtree.skeleton import TreeSkeleton
from sketchtree.traverse import generations

SHRINKAGE = 8.0  # pairs that the whole tree's Θ counts for in an order's
STRAIGHT = np.radians(2.0)  # below this divergence the orientation says nothing


@dataclass(frozen=True, eq=False)
class Pairs:
    """Every parent-child pair of a tree and the rotation between the two, radians."""

    child: Int[np.ndarray, " pair"]  # row of the child
    parent: Int[np.ndarray, " pair"]  # row of the parent, never a base
    scale: Float[np.ndarray, " pair"]
    divergence: Float[np.ndarray, " pair"]  # φ
    orientation: Float[np.ndarray, " pair"]  # ϕ, (−π, π]
    apical: Bool[np.ndarray, " pair"]


def parent_child_pairs(tree: TreeSkeleton) -> Pairs:
    """s, φ and ϕ of every pair (§4), in the order of the child rows. Segments of no length are left out."""
    length, direction = tree.length, _directions(tree)
    phi, gamma = _rotations(tree, direction)
    child = np.flatnonzero(~tree.is_base)
    parent = tree.parent[child]
    keep = ~tree.is_base[parent] & (length[parent] > 1e-9) & (length[child] > 1e-9)
    child, parent = child[keep], parent[keep]
    apical = _apical(tree, child, parent, phi[child])
    return Pairs(child, parent, length[child] / length[parent], phi[child], gamma[child], apical)


def estimate(tree: TreeSkeleton) -> TreeParameters:
    """Θ of the whole tree (§4)."""
    return _theta(parent_child_pairs(tree), None, GENERIC)


def estimate_by_order(tree: TreeSkeleton) -> tuple[TreeParameters, TreeParameters, TreeParameters]:
    """Θ of the pairs whose parent is of order 0, 1, and 2 or more, shrunk towards the tree's own Θ as if
    that were `SHRINKAGE` pairs. Beyond the paper, whose one Θ fits neither palms nor spruces."""
    pairs, whole = parent_child_pairs(tree), estimate(tree)
    order = np.minimum(tree.order[pairs.parent], 2)
    return tuple(_theta(pairs, order == o, whole, SHRINKAGE) for o in range(3))


def circular_mean(angle: Float[np.ndarray, " pair"], weight: float = 0.0, towards: float = 0.0) -> float:
    """Mean direction of `angle` and of `weight` more angles at `towards`; radians."""
    s = np.sin(angle).sum() + weight * np.sin(towards)
    c = np.cos(angle).sum() + weight * np.cos(towards)
    return float(np.arctan2(s, c)) if np.hypot(s, c) > 1e-12 else 0.0


def circular_sd(angle: Float[np.ndarray, " pair"]) -> float:
    """√(−2 ln R̄), R̄ the mean resultant length; radians."""
    if len(angle) == 0:
        return 0.0
    resultant = np.hypot(np.sin(angle).mean(), np.cos(angle).mean())
    return float(np.sqrt(-2.0 * np.log(np.clip(resultant, 1e-12, 1.0))))


def _theta(pairs: Pairs, among, prior: TreeParameters, weight: float = 0.0) -> TreeParameters:
    among = np.ones(len(pairs.child), bool) if among is None else among
    mu_s, sigma_s = _normal(pairs.scale[among], prior.mu_s, prior.sigma_s, weight)
    mu_a, sigma_a = _normal(pairs.divergence[among & pairs.apical], prior.mu_alpha, prior.sigma_alpha, weight)
    mu_b, sigma_b = _normal(pairs.divergence[among & ~pairs.apical], prior.mu_beta, prior.sigma_beta, weight)
    mu_g, sigma_g = _orientation(pairs, among, prior, weight)
    return TreeParameters(mu_s, sigma_s, mu_a, sigma_a, mu_b, sigma_b, mu_g, sigma_g)


def _normal(x, prior_mean: float, prior_sd: float, weight: float) -> tuple[float, float]:
    """Mean and sd of `x` and of `weight` more values with the prior's mean and sd."""
    n = len(x) + weight
    if n == 0:
        return prior_mean, prior_sd
    mean = (x.sum() + weight * prior_mean) / n
    square = ((x - mean) ** 2).sum() + weight * (prior_sd**2 + (prior_mean - mean) ** 2)
    return float(mean), float(np.sqrt(square / n))


def _orientation(pairs: Pairs, among, prior: TreeParameters, weight: float) -> tuple[float, float]:
    among = among & (pairs.divergence > STRAIGHT)
    if not among.any():
        return prior.mu_gamma, prior.sigma_gamma
    mu = circular_mean(pairs.orientation[among & pairs.apical], weight, prior.mu_gamma)
    for _ in range(3):
        residual = pairs.orientation[among] - _offsets(pairs, mu)[among]
        mu = circular_mean(residual, weight, prior.mu_gamma)
    spread = np.angle(np.exp(1j * (residual - mu)))
    if weight == 0:
        return mu, circular_sd(spread)
    return mu, float(_normal(spread, np.angle(np.exp(1j * (prior.mu_gamma - mu))), prior.sigma_gamma, weight)[1])


def orientation_residual(pairs: Pairs, among: Bool[np.ndarray, " pair"], mu: float) -> Float[np.ndarray, " kept"]:
    """ϕ − offset_i − μ_γ, (−π, π], of those pairs that say anything of it."""
    kept = among & (pairs.divergence > STRAIGHT)
    return np.angle(np.exp(1j * (pairs.orientation - _offsets(pairs, mu) - mu)))[kept]


def _offsets(pairs: Pairs, mu: float) -> Float[np.ndarray, " pair"]:
    """offset_i of every pair: what §4 adds to μ_γ for the child's label."""
    offset = np.zeros(len(pairs.child))
    rows = np.flatnonzero(~pairs.apical)
    rows = rows[np.lexsort((np.mod(pairs.orientation[rows] - mu, 2 * np.pi), pairs.parent[rows]))]
    for group in np.split(rows, np.flatnonzero(np.diff(pairs.parent[rows])) + 1) if len(rows) else []:
        offset[group] = _even_turns(pairs.orientation[group] - mu, len(group))
    return offset


def _even_turns(orientation, laterals: int):
    """2π(i − 1)/(K − 1) for laterals in rising orientation, i from the cyclic start that fits best."""
    if laterals == 1:
        return np.array([np.pi])
    turns = 2 * np.pi * np.arange(1, laterals + 1) / laterals
    starts = [np.roll(turns, k) for k in range(laterals)]
    return max(starts, key=lambda turn: np.cos(orientation - turn).sum())


def _apical(tree: TreeSkeleton, child, parent, divergence) -> Bool[np.ndarray, " pair"]:
    """The child on its parent's limb, else the one of the smallest divergence."""
    continues = tree.limb[child] == tree.limb[parent]
    order = np.lexsort((child, divergence, ~continues, parent))
    first = np.ones(len(order), bool)
    first[1:] = parent[order][1:] != parent[order][:-1]
    apical = np.zeros(len(child), bool)
    apical[order[first]] = True
    return apical


def _directions(tree: TreeSkeleton) -> Float[np.ndarray, "segment 3"]:
    length = tree.length
    ok = length > 1e-9
    direction = np.where(ok[:, None], tree.vector / np.where(ok, length, 1.0)[:, None], 0.0)
    for row in np.flatnonzero(~ok):  # a segment of no length points on as its parent does
        direction[row] = (0, 1, 0) if tree.parent[row] == NULL else direction[tree.parent[row]]
    return direction


def _rotations(tree: TreeSkeleton, direction):
    """φ and ϕ of every row in its parent's frame; a stem's first segment is given ϕ = φ = 0."""
    n = len(tree)
    frame, phi, gamma = np.tile(np.eye(3), (n, 1, 1)), np.zeros(n), np.zeros(n)
    for rows in generations(tree.parent)[1:]:
        above = tree.parent[rows]
        local = np.einsum("rji,rj->ri", frame[above], direction[rows])
        radial = np.hypot(local[:, 0], local[:, 2])
        phi[rows] = np.arctan2(radial, local[:, 1])
        gamma[rows] = np.where(radial > 1e-9, np.arctan2(local[:, 0], local[:, 2]), 0.0)
        # A stem's frame is the least rotation from y: R_y(ϕ) R_x(φ) R_y(−ϕ).
        undo = np.where(tree.is_base[above], -gamma[rows], 0.0)
        turned = np.einsum("rij,rjk,rkl->ril", _about_y(gamma[rows]), _about_x(phi[rows]), _about_y(undo))
        frame[rows] = np.einsum("rij,rjk->rik", frame[above], turned)
    return phi, gamma


def _about_y(angle):
    c, s, zero, one = np.cos(angle), np.sin(angle), np.zeros_like(angle), np.ones_like(angle)
    return np.stack([c, zero, s, zero, one, zero, -s, zero, c], -1).reshape(-1, 3, 3)


def _about_x(angle):
    c, s, zero, one = np.cos(angle), np.sin(angle), np.zeros_like(angle), np.ones_like(angle)
    return np.stack([one, zero, zero, zero, c, -s, zero, s, c], -1).reshape(-1, 3, 3)
