"""How do the branches of a drawing branch? Gaussians of 2D length ratio and angles.

Chen et al. 2008, §7. For every parent-child pair of a drawing or of an exemplar's projection:

    s_2D   length ratio |v_c| / |v_p|
    α_2D   angle to the parent of the child with the smallest such angle (taken to be apical)
    β_2D   angle to the parent of every other child (lateral)

each ~ N(μ_x,2D, σ_x,2D). Pairs with a segment shorter than `SHORT` of the drawing's size are left
out: seen end on, they say nothing. A statistic of no pair is NaN.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float

from sketchtree.axes import NULL
from sketchtree.templates.seen.drawing import Drawing

STATISTICS = ("s", "alpha", "beta")
SHORT = 0.01


@dataclass(frozen=True, eq=False)
class Branching:
    """μ, σ and the number of pairs behind them, of one tree or of many; angles in radians.
    The last axis is in the order of `STATISTICS`."""

    mean: Float[np.ndarray, "*exemplar view statistic"]
    sd: Float[np.ndarray, "*exemplar view statistic"]
    count: Float[np.ndarray, "*exemplar view statistic"]


def branching(drawing: Drawing) -> Branching:
    """The statistics of every view at once."""
    child = np.flatnonzero(drawing.parent != NULL)
    child = child[drawing.parent[drawing.parent[child]] != NULL]
    parent = drawing.parent[child]
    vector = drawing.tip - drawing.start
    length = np.hypot(vector[..., 0], vector[..., 1])
    long = length > SHORT * np.maximum(drawing.size, 1e-12)[:, None]
    seen = long[:, child] & long[:, parent]
    angle = _angle(vector[:, child], vector[:, parent])
    apical = _smallest(np.where(seen, angle, np.inf), parent) & seen
    ratio = length[:, child] / np.where(seen, length[:, parent], 1.0)
    masks = (seen, apical, seen & ~apical)
    columns = [_moments(x, mask) for x, mask in zip((ratio, angle, angle), masks, strict=True)]
    mean, sd, count = (np.stack(column, axis=1) for column in zip(*columns, strict=True))
    return Branching(mean, sd, count)


def _angle(a, b):
    cross = a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]
    return np.abs(np.arctan2(cross, np.sum(a * b, axis=-1)))


def _smallest(angle, parent):
    """Of every parent's children the one with the smallest angle, per view; ties go to the first."""
    view, pair = angle.shape
    if pair == 0:
        return np.zeros((view, 0), bool)
    keys = np.broadcast_to(parent, angle.shape)
    order = np.lexsort((np.broadcast_to(np.arange(pair), angle.shape), angle, keys), axis=-1)
    group = np.take_along_axis(keys, order, axis=1)
    first = np.ones(angle.shape, bool)
    first[:, 1:] = group[:, 1:] != group[:, :-1]
    smallest = np.zeros(angle.shape, bool)
    np.put_along_axis(smallest, order, first, axis=1)
    return smallest


def _moments(x, mask):
    count = mask.sum(axis=1)
    safe = np.maximum(count, 1)
    mean = np.where(mask, x, 0.0).sum(axis=1) / safe
    square = np.where(mask, (x - mean[:, None]) ** 2, 0.0).sum(axis=1) / safe
    none = count == 0
    return np.where(none, np.nan, mean), np.where(none, np.nan, np.sqrt(square)), count.astype(float)
