"""How does a twig come to every place that is still farther than a leaf is long from the tree? (ours; the paper leaves that to many leaves)

Once whole subtrees gain little, single twigs do the rest, in a few rounds. In each, of the attractors that are still far the farthest in every cell of a grid gets one: from the wood nearest to it, a little
towards that wood's foot, so that it leaves its limb at a fork's angle and bends over to the attractor:

    b(t) = (1 − t)² p + 2 t (1 − t) (p + c u) + t² q      p: on the limb, whose direction there is h;  q: the attractor, or as far towards it as a twig is long;  c: ½ |q − p|
    u ∝ h + min(tan, 1) w                                 w: the unit vector from the limb to q, square to h;  tan: of the angle between h and q − p

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
_BENDS = 0.5  # of its length: how far a twig goes the way it left
_SPLAY = 1.0  # tangent of the angle at which a twig leaves its limb, at most
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
    point = curves(foot, heading, vector, PIECES, _BENDS)
    keep = (length > _SHORTEST * leaf) & (along > -0.2)
    keep = np.flatnonzero(keep)[np.argsort(length[keep], kind="stable")]
    bearer, at = limb[which][row, best], at[row, best]
    _, first = np.unique(np.stack([bearer[keep], np.floor(at[keep] / leaf).astype(np.int64)], axis=1), axis=0, return_index=True)
    keep = keep[np.sort(first)]  # one from a place, the shortest; the others wait for what has grown nearer by then
    return bearer[keep], at[keep], point[keep]


def curves(foot: Float[np.ndarray, "way 3"], heading: Float[np.ndarray, "way 3"], vector: Float[np.ndarray, "way 3"], pieces: int, bends: float) -> Float[np.ndarray, "way point 3"]:
    """b(t) from each foot, as points; `bends`: c / |q − p|."""
    length = np.linalg.norm(vector, axis=1, keepdims=True)
    ahead = (vector * heading).sum(axis=1, keepdims=True)
    aside = vector - ahead * heading
    wide = np.linalg.norm(aside, axis=1, keepdims=True)
    splay = np.where(ahead > 0, np.minimum(wide / np.maximum(ahead, 1e-300), _SPLAY), _SPLAY)
    leave = heading + splay * aside / np.maximum(wide, 1e-300)
    leave /= np.linalg.norm(leave, axis=1, keepdims=True)
    t = np.linspace(0.0, 1.0, pieces + 1)[:, None]
    return foot[:, None] + 2 * t * (1 - t) * (bends * length * leave)[:, None] + t**2 * vector[:, None]


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
