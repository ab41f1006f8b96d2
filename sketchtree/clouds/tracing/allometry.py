"""How thick is the wood everywhere, seen or not?

Guo et al. 2018, Eq. 5: a child is as thick as the share of the wood that it bears,

    d_ci = d_p (l_ci / Σ_j l_cj)^γ       which along all ways from the foot is       d = d_root (l / l_root)^γ

    l   length of all branches that it bears      γ   diameter coefficient, 0.41-0.50 in Table 2

The paper takes γ from a species and the diameter from the foot alone. Here both come of every place whose thickness was seen, γ held near what species have; then what was seen
and what the rule says are weighed against each other by how sure they are, and no branch is thicker than what bears it.
"""

import numpy as np
from jaxtyping import Float, Int
from scipy.optimize import isotonic_regression
from scipy.sparse import csr_matrix, diags
from scipy.sparse.linalg import spsolve

from sketchtree.axes import NULL
from sketchtree.clouds.tracing.thickness import Measured
from sketchtree.traverse import generations, limb_chains, sum_to_root

GAMMA, _GAMMA_SD, _BETWEEN = 0.46, 0.02, (0.38, 0.56)  # mean of Table 2; its spread about what leads from the foot to a twig, and how far that may be from it
_TWIG, _TWIG_BEARS = 0.003, 0.1  # metres: the radius of a twig that bears so much wood
_SPREAD = 0.30  # of thickness round the rule, as a logarithm
_SURE = 0.06  # spread of a thickness that was seen all round
_ODD = 1.0  # a logarithm: so far from the rule it is something else that was seen
_CLEAR, _BLURRED, _LIKE = 0.2, 0.3, 1.3  # points typically lie at most so many radii off the bark, or up to so many if that is like what they do at the stem: more is a cluster of twigs
_THICK = 3.0  # times what points lie off the bark: how thick wood is that is thinner can't be seen
_ALONG, _ASIDE, _ALONE = 0.10, 0.30, 1.5  # spread of a step from node to node, of that into another limb, and of thickness round the rule where nothing near was seen
_MOSTLY, _FADES = 0.35, 0.9  # how much of what is known of a node is that of those before it
_STEPS = 20
_MOST, _ENOUGH = 0.7, 8  # the foot's thickness is told by wood that bears so much of all, by so many places at least


def radii(
    parent: Int[np.ndarray, " node"], step: Float[np.ndarray, " node"], limb: Int[np.ndarray, " node"], seen: Measured, width: Float[np.ndarray, " node"], thinnest: float, foot: float | None = None
) -> tuple[Float[np.ndarray, " node"], float]:
    """(radius of every node, metres; γ). `step`: metres from its parent; `width`: of its layer, metres; `thinnest`: metres, of any twig; `foot`: radius there, metres, where it is known."""
    borne = np.log(sum_to_root(parent, step) + 0.5 * width)
    scatter = noise(seen, limb)
    radius = np.sqrt(np.maximum(np.nan_to_num(seen.radius) ** 2 - scatter**2, 0.0))
    typical = np.nan_to_num(seen.off, nan=np.inf)
    known = seen.known & (radius > _THICK * scatter) & (typical < np.clip(_LIKE * scatter, _CLEAR * radius, _BLURRED * radius)) & (seen.seen >= 0.5)
    log = np.log(np.where(known, radius, 1.0))
    spread = np.where(known, _SURE / np.maximum(seen.seen, 0.1) + typical / np.maximum(radius, 1e-9) / 4, np.inf)
    goes_back = _goes_back(parent, known)
    rule, gamma = _rule(borne, log, known & goes_back, spread, thinnest, foot)
    known &= np.abs(log - rule) < np.where(goes_back, _ODD, _ODD / 3)
    trust = np.where(known, spread**-2.0, 0.0)
    best = rule + _beside(parent, limb, np.where(known, log - rule, 0.0), trust)
    for rows in limb_chains(parent, limb):
        best[rows] = isotonic_regression(best[rows], weights=trust[rows] + 1.0, increasing=False).x
    for rows in generations(parent)[1:]:
        best[rows] = np.minimum(best[rows], best[parent[rows]])
    return np.maximum(np.exp(best), thinnest), gamma


def noise(seen: Measured, limb) -> float:
    """Metres that points lie off the bark, typically, where the stem was seen."""
    stem = seen.known & (limb == limb[0])
    return float(np.median(seen.off[stem])) if stem.any() else 0.0


def _beside(parent, limb, seen, trust):
    """How far from the rule the logarithm of thickness is: near what was seen of it, changing little from node to node of a limb, more where one leaves another. Least squares."""
    child = np.flatnonzero(parent != NULL)
    stiff = np.where(limb[child] == limb[parent[child]], _ALONG, _ASIDE) ** -2.0
    size = len(parent)
    joint = csr_matrix((np.r_[stiff, stiff], (np.r_[child, parent[child]], np.r_[parent[child], child])), shape=(size, size))
    return spsolve((diags(trust + _ALONE**-2 + np.asarray(joint.sum(axis=1)).ravel()) - joint).tocsc(), trust * seen)


def _goes_back(parent, known):
    """Nodes before which, along the wood, most were seen too: what is seen far out among twigs alone is no measure."""
    share = known.astype(float)
    for rows in generations(parent)[1:]:
        share[rows] += _FADES * (share[parent[rows]] - share[rows])
    return share > _MOSTLY


def _rule(borne, log, known, spread, thinnest: float, foot: float | None):
    """(log radius by Eq. 5 at every node, γ): d_root and γ by least squares that odd ones count little in."""
    most = borne.max()
    if not known.any():
        return np.full(len(borne), np.log(thinnest)) + GAMMA * (borne - borne.min()), GAMMA
    x, y, sure = borne[known] - most, log[known], 1.0 / (spread[known] ** 2 + _SPREAD**2)
    low = x > np.log(_MOST) if (x > np.log(_MOST)).sum() >= _ENOUGH else x >= np.sort(x)[-min(_ENOUGH, len(x))]
    usual = GAMMA
    root = float(np.median(y[low] - usual * x[low])) if foot is None else float(np.log(foot))
    if most > np.log(_TWIG_BEARS) and root > np.log(_TWIG):
        usual = float(np.clip((root - np.log(_TWIG)) / (most - np.log(_TWIG_BEARS)), *_BETWEEN))
    weight, gamma = sure, usual
    for _ in range(_STEPS):
        error = y - root - gamma * x
        weight = sure / (1.0 + (error / _SPREAD) ** 2)
        noise = max(np.sum(weight * error**2) / weight.sum(), _SURE**2)
        per = weight / weight.sum() * len(x) ** 0.5 / noise  # places of one tree are no strangers to one another: the root of their number counts
        gamma = (np.sum(per * x * (y - root)) + usual / _GAMMA_SD**2) / (np.sum(per * x**2) + _GAMMA_SD**-2)
    return root + gamma * (borne - most), float(gamma)
