"""How does a twig come to every place that is still farther than a leaf is long from the tree? (ours; the paper leaves that to many leaves)

Once whole subtrees gain little, single twigs do the rest, in a few rounds. In each, of the attractors that are still far the farthest in every cell of a grid gets one: from the wood nearest to it, a little
towards that wood's foot, so that it leaves its limb sharply and bends over to the attractor:

    b(t) = (1 − t)² p + 2 t (1 − t) (p + c h) + t² q      p: on the limb, whose direction there is h;  q: the attractor, or as far towards it as a twig is long;  c: ½ |q − p|

Attractors of the page have no depth: theirs is that of the wood nearest on the page, and a little more or less, by the limb's id, so that twigs stand to all sides.
"""

import numpy as np
from jaxtyping import Float, Int
from scipy.spatial import cKDTree

from sketchtree import keys
from sketchtree.propagate.attractors.wood import Wood

ROUNDS = 9
_LONGEST = 6.0  # leaf lengths, of a twig
_SHORTEST = 0.6
CELL = 1.8  # leaf lengths: one twig in such a cell and round
BACK = 0.7  # of the way to the attractor: how far towards its foot on the limb a twig starts
ALONG = 1.6  # the same where the limb itself is as near: a twig goes along it for a while
_BENDS = 0.5  # of its length: how far a twig follows its limb's direction
PIECES = 3
_CHOICES = 6  # places along the wood, of which each takes the one it comes from best
_DEEP = 0.8  # of the way on the page, a twig may go before or behind it


def farthest(place: Float[np.ndarray, "attractor axis"], distance: Float[np.ndarray, " attractor"], floor: float, cell: float) -> Int[np.ndarray, " far"]:
    """Of the attractors farther than `floor` the farthest in every cell of a grid, farthest first."""
    far = np.flatnonzero(distance > floor)
    far = far[np.argsort(-distance[far], kind="stable")]
    _, first = np.unique(np.floor(place[far] / cell).astype(np.int64), axis=0, return_index=True)
    return far[np.sort(first)]


def ways(
    place: Float[np.ndarray, "far axis"], samples: Float[np.ndarray, "sample 3"], limb: Int[np.ndarray, " sample"], arc: Float[np.ndarray, " sample"],
    wood: Wood, leaf: float, key: np.uint64, round_: int, back: float = BACK,
) -> tuple[Int[np.ndarray, " twig"], Float[np.ndarray, " twig"], Float[np.ndarray, "twig point 3"]]:  # fmt: skip
    """(the limb that each twig grows on, metres along it, its points from its foot), shortest first; one for each place, as far as any wood serves, and one from each leaf length of wood."""
    axes, many = place.shape[1], min(_CHOICES, len(samples))
    away, which = cKDTree(samples[:, :axes]).query(place, k=many)
    away, which = away.reshape(len(place), -1), which.reshape(len(place), -1)
    target = np.broadcast_to(place[:, None, :axes], (*which.shape, axes))
    if axes == 2:
        seed = np.array([one.identity for one in wood.limbs], np.int64)[limb[which]] ^ np.arange(len(place))[:, None]
        lean = 2.0 * keys.uniform(key, seed.ravel(), round_).reshape(which.shape) - 1.0
        target = np.concatenate([target, (samples[which, 2] + _DEEP * lean * away)[..., None]], axis=-1)
    foot, heading, at = feet(wood, limb[which], np.maximum(arc[which] - back * away, 0.35 * arc[which]))
    vector = target - foot
    length = np.linalg.norm(vector, axis=-1)
    along = (vector * heading).sum(axis=-1) / np.maximum(length, 1e-300)
    best = np.argmin(length * (2.0 - along), axis=1)  # near, and ahead rather than behind
    row = np.arange(len(place))
    foot, vector, heading, length, along = (column[row, best] for column in (foot, vector, heading, length, along))
    share = np.minimum(1.0, _LONGEST * leaf / np.maximum(length, 1e-300))
    vector, length = vector * share[:, None], length * share
    t = np.linspace(0.0, 1.0, PIECES + 1)[:, None]
    point = foot[:, None] + 2 * t * (1 - t) * (_BENDS * length[:, None] * heading)[:, None] + t**2 * vector[:, None]
    keep = (length > _SHORTEST * leaf) & (along > -0.2)
    keep = np.flatnonzero(keep)[np.argsort(length[keep], kind="stable")]
    bearer, at = limb[which][row, best], at[row, best]
    _, first = np.unique(np.stack([bearer[keep], np.floor(at[keep] / leaf).astype(np.int64)], axis=1), axis=0, return_index=True)
    keep = keep[np.sort(first)]  # one from a place, the shortest; the others wait for what has grown nearer by then
    return bearer[keep], at[keep], point[keep]


def feet(wood: Wood, limb, arc):
    """(place, direction, metres along) of these limbs, where a twig may start."""
    starts = np.cumsum([0] + [len(one.arc) for one in wood.limbs])
    point = np.concatenate([one.point for one in wood.limbs])
    stride = max(one.length for one in wood.limbs) + 1.0
    run = np.concatenate([one.arc + k * stride for k, one in enumerate(wood.limbs)])
    right = np.clip(np.searchsorted(run, limb * stride + arc), starts[limb] + 1, starts[limb + 1] - 1)
    span = run[right] - run[right - 1]
    share = np.clip((limb * stride + arc - run[right - 1]) / np.maximum(span, 1e-300), 0.0, 1.0)[..., None]
    vector = point[right] - point[right - 1]
    return point[right - 1] + share * vector, vector / np.maximum(np.linalg.norm(vector, axis=-1, keepdims=True), 1e-300), arc
