"""How much of the leaves of a tree does a scan show? What is before a leaf hides it.

Leaves are stood for by spots spread over what is drawn on each. From six sides, and from as many slanting up, a spot is seen that no other lies before, in pixels as wide as a spot stands for:

    p = √(a / K)        a  area drawn on a leaf, K  its spots

What is seen is counted as a scan's points are, in cubes that have some (`cubes`), so that it makes no odds how many points each has.
"""

from functools import lru_cache

import numpy as np
from jaxtyping import Bool, Float, Int

from sketchtree.foliage.card_shape import card
from sketchtree.foliage.cards import turned
from sketchtree.foliage.leaves import Leaves
from sketchtree.foliage.models import leaf_painting
from sketchtree.foliage.triangles import drawn_area

SPOTS = 10
"""Of a leaf."""

_FINE = 24  # places that spots are chosen of, along the edge of each triangle of a card
_SIDES, _TILTS = 6, (0.0, 0.5)  # directions that it is seen from, radians below level
_BEHIND = 1.5  # pixels that a spot may lie behind the nearest


@lru_cache(maxsize=None)
def spots_of(model: str) -> Float[np.ndarray, "spot 3"]:
    """Places spread over what is drawn on a card, leaf lengths."""
    corner, uv, triangle = card(model)
    painting = leaf_painting(model)
    one, other = (axis.ravel() for axis in np.meshgrid(np.arange(_FINE), np.arange(_FINE)))
    share = (np.stack([one, other, _FINE - 1 - one - other], axis=1)[one + other < _FINE] + 1 / 3) / _FINE
    place, at = np.concatenate(share @ corner[triangle]), np.concatenate(share @ uv[triangle])
    pixel = np.clip((at * painting.coverage.shape[::-1]).astype(int), 0, np.array(painting.coverage.shape[::-1]) - 1)
    return _spread(place[painting.coverage[pixel[:, 1], pixel[:, 0]] > 0.5], SPOTS)


def _spread(place, count: int):
    """So many of the places, each as far as can be from those before it."""
    chosen, away = [0], np.full(len(place), np.inf)
    while len(chosen) < min(count, len(place)):
        away = np.minimum(away, np.linalg.norm(place - place[chosen[-1]], axis=1))
        chosen.append(int(away.argmax()))
    return place[chosen]


def spots(leaves: Leaves) -> Float[np.ndarray, "leaf spot 3"]:
    """Places on every leaf, metres."""
    return leaves.position[:, None] + turned(spots_of(leaves.model)[None], leaves) * leaves.size[:, None, None]


def shown(place: Float[np.ndarray, "spot 3"], pixel: float) -> Bool[np.ndarray, " spot"]:
    """Which spots are seen from some side."""
    seen = np.zeros(len(place), bool)
    for turn in 2 * np.pi * np.arange(_SIDES) / _SIDES:
        level = np.array([np.sin(turn), 0.0, np.cos(turn)])
        right = np.array([level[2], 0.0, -level[0]])
        for tilt in _TILTS:
            towards = np.cos(tilt) * level - np.sin(tilt) * np.array([0.0, 1.0, 0.0])
            near = place @ towards
            first = _nearest(place @ np.stack([right, np.cross(towards, right)], axis=1), near, pixel)
            seen |= near >= first - _BEHIND * pixel
    return seen


def _nearest(across: Float[np.ndarray, "spot 2"], near: Float[np.ndarray, " spot"], pixel: float) -> Float[np.ndarray, " spot"]:
    """How near the nearest in each spot's pixel is."""
    cell = np.floor((across - across.min(axis=0)) / pixel).astype(np.int64)
    number = cell[:, 0] * (cell[:, 1].max() + 1) + cell[:, 1]
    order = np.argsort(number, kind="stable")
    begins = np.flatnonzero(np.r_[True, np.diff(number[order]) > 0])
    most = np.maximum.reduceat(near[order], begins)
    found = np.empty(len(near))
    found[order] = np.repeat(most, np.diff(np.r_[begins, len(order)]))
    return found


def pixel_of(leaves: Leaves) -> float:
    """As wide as a spot of these leaves stands for, metres."""
    return float(np.sqrt(drawn_area(leaf_painting(leaves.model)) / SPOTS * np.mean(leaves.size**2)))


def cubes(place: Float[np.ndarray, "point 3"], edge: float) -> Int[np.ndarray, "cube 3"]:
    """The cubes of that edge that have some of the places."""
    return np.unique(np.floor(place / edge).astype(np.int64), axis=0)
