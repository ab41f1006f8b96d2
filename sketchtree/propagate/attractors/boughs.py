"""How do boughs come to the parts of a crown that no drawn limb goes to? (ours)

Where leaves hide all limbs but a few, a lobe of the crown may be many branches away from the nearest: replaced one after the other, they reach it as a chain of ever shorter shoots, as no tree grows. So
boughs go there first, in rounds from coarse to fine: of the attractors in space that are farther from the tree than a span, the farthest in every cell of a grid as large gets one. From all places
along the wood it takes the one that costs least,

    |q − p| (_TURN − cos_limb − _LIGHT cos_light)        angles between the way to the attractor q and the direction of the limb at p, or the light at q

so that a bough comes from within and doesn't run along the outside of the crown; of which the way is seen in foliage and free of thick limbs, and goes as a twig does (`ends`).
"""

import numpy as np
from jaxtyping import Float

from sketchtree.propagate.attractors.ends import curves, feet
from sketchtree.propagate.attractors.state import State

SPANS = (0.7, 0.5, 0.36, 0.26)  # of half the width of the crown: from how far off a bough comes, round after round
LEAST = 5.0  # leaf lengths: subtrees do what is nearer
_AGAIN = 2  # rounds of one span: a bough may grow on another
_CELL = 1.2  # spans: one bough in such a cell and round
_TURN = 2.3  # how much way a turn is worth: more is less
_LIGHT = 0.6  # how much coming towards the light counts, beside going on as the limb does
_EVERY = 3  # places along the wood: one in so many is looked at
_CHOICES = 10  # places that are looked at closely
_PIECES = 6  # of a bough
_BENDS = 0.6  # of its length: how far a bough goes the way it left
_STEEP = 0.1  # cosine between the limb and the way, at least: nothing turns back


def grow_boughs(state: State, pulse) -> None:
    """Round after round, all that is needed."""
    for span in np.array(SPANS) * float(state.axes.half.max()):
        for _ in range(_AGAIN if span > LEAST * state.leaf else 0):
            pulse()
            if state.is_full or not _round(state, float(span)):
                break
            state.note("boughs")


def _round(state: State, span: float) -> bool:
    """One bough to every cell that is farther off than a span; whether any grew. The farthest first, and each may take what the one before it has brought near."""
    space, grew = state.space, False
    waiting = space.distance > span
    while waiting.any() and not state.is_full:
        far = int(np.argmax(np.where(waiting, space.distance, 0.0)))
        waiting &= np.linalg.norm(space.place - space.place[far], axis=1) > _CELL * span
        found = _way(state, space.place[far])
        if found is not None:
            state.bear(*found)
            state.take_up()
            waiting &= space.distance > span
            grew = True
    return grew


def _way(state: State, goal: Float[np.ndarray, " 3"]) -> tuple[int, float, Float[np.ndarray, "point 3"]] | None:
    """(the limb that a bough to `goal` grows on, metres along it, its points), or None where no way is free."""
    limb, arc = state.along_wood()
    limb, arc = limb[::_EVERY], arc[::_EVERY]
    foot, heading, arc = feet(state.wood, limb, arc)
    vector = goal - foot
    length = np.maximum(np.linalg.norm(vector, axis=1), 1e-300)
    cosine = (vector * heading).sum(axis=1) / length
    cost = np.where((cosine > _STEEP) & state.target.inside(foot), length * (_TURN - cosine - _LIGHT * (vector @ state.light(goal)) / length), np.inf)
    best = np.argsort(cost, kind="stable")[:_CHOICES]
    best = best[np.isfinite(cost[best])]
    point = curves(foot[best], heading[best], vector[best], _PIECES, _BENDS)
    free = state.target.inside(point[:, 1:]).all(axis=1)
    for k in np.flatnonzero(free):
        pieces = np.full(_PIECES, best[k])
        if not state.thick.struck(point[k, :-1], point[k, 1:], limb[pieces], arc[pieces]).any():
            return int(limb[best[k]]), float(arc[best[k]]), point[k]
    return None
