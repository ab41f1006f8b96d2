"""Which colours are foliage, given what the background looks like? A mixture learnt beside one that is known.

What is inside the crown's stroke is a part π of foliage, of unknown colours f, and a part of background b(I | x), known from around it (`surroundings`):

    a(I | x) = π f(I) + (1 − π) b(I | x)

f begins with the colours that are rare around the crown (the tail TAIL of what is usual there), and expectation maximisation improves f and π for ROUNDS; no longer: in time f would
take the sky's blur for leaves. What it has taken so is given back (`without_blur`): a component that lies much nearer to a colour of the sky than to leaves proper is the sky seen
between leaves that the picture could not part.
"""

import numpy as np
from jaxtyping import Array, Float, Key

from sketchtree.photo.appearance import Mixture, fit_mixture

COMPONENTS = 6
TAIL = 0.05
ROUNDS = 4
BLUR = 0.4
_WIDER = 3.0  # added to the standard deviation of every component
_SHARE = (0.05, 0.95)  # π is within


def learn_leaves(
    colour: Float[np.ndarray, "pixel 3"], background: Float[np.ndarray, " pixel"], rare: np.ndarray, *, key: Key[Array, ""]
) -> tuple[Mixture, float]:
    """(f, π) of pixels inside the crown; `background`: log b of each; `rare`: the rows that f begins with."""
    leaf = _wider(fit_mixture(colour[rare], COMPONENTS, key=key))
    share = float(np.clip(len(rare) / len(colour), 0.3, 0.7))
    for _ in range(ROUNDS):
        parts = leaf.log_parts(colour)
        own = np.logaddexp.reduce(parts, axis=1)
        sure = leaf_probability(own, background, share)
        share = float(np.clip(sure.mean(), *_SHARE))
        leaf = _refitted(colour, np.exp(parts - own[:, None]) * sure[:, None])
    return leaf, share


def without_blur(leaf: Mixture, background: Float[np.ndarray, "component 3"]) -> Mixture:
    """f without components that are mostly a background brighter than they are, and than the leaves: nearer to one of these colours than BLUR of the way to leaves proper."""
    if not len(background):
        return leaf
    apart = np.linalg.norm(leaf.mean[:, None] - background[None], axis=2)
    nearest, away = background[apart.argmin(axis=1)].mean(axis=1), apart.min(axis=1)
    proper = away >= 0.5 * away.max()
    to_proper = np.linalg.norm(leaf.mean[:, None] - leaf.mean[None, proper], axis=2).min(axis=1)
    bright = (nearest > leaf.mean.mean(axis=1)) & (nearest > np.average(leaf.mean[proper], axis=0, weights=leaf.weight[proper]).mean())
    return leaf.only(proper | ~bright | (away >= BLUR * (away + to_proper)))


def leaf_probability(leaf: Float[np.ndarray, " pixel"], background: Float[np.ndarray, " pixel"], share: float) -> Float[np.ndarray, " pixel"]:
    """P(foliage | I, x) from log f and log b."""
    odds = leaf - background + np.log(share) - np.log1p(-share)
    return 1.0 / (1.0 + np.exp(np.clip(-odds, -50, 50)))


def _refitted(colour, belongs: Float[np.ndarray, "pixel component"]) -> Mixture:
    held = belongs.sum(axis=0)
    belongs, held = belongs[:, held > 1.0], held[held > 1.0]
    mean = (belongs.T @ colour) / held[:, None]
    square = np.einsum("pk,pi,pj->kij", belongs, colour, colour, optimize=True) / held[:, None, None]
    covariance = square - mean[:, :, None] * mean[:, None, :]
    return _wider(Mixture(held / held.sum(), mean, covariance + np.eye(3)))


def _wider(mixture: Mixture) -> Mixture:
    return Mixture(mixture.weight, mixture.mean, mixture.covariance + _WIDER**2 * np.eye(3))
