"""Which leaves of a tree can one card stand for, and how do they lie on it?

Leaves that follow each other on one stem: a *spray*. They lie near a plane, the one of the two widest directions of their feet and tips. In
it every spray has an own frame, y along the mean leaf, x so that its first leaf is on the right; the picture of all sprays of so many
leaves is the tree's typical one (medians of the places and headings), so it holds for every arrangement.
"""

from typing import NamedTuple

import numpy as np
from jaxtyping import Float, Int

_APART = 2.5  # times the usual step from foot to foot, a stem has come to its end


class Layout(NamedTuple):
    """Where the leaves of a spray lie on its picture, in leaf lengths."""

    foot: Float[np.ndarray, "leaf 2"]
    heading: Float[np.ndarray, " leaf"]  # radians from upright, positive to the right


def sprays(foot: Float[np.ndarray, "leaf 3"], most: int) -> Int[np.ndarray, "spray leaf"]:
    """Rows of the leaves of every spray, `most` at most, from stem to stem; -1 where a spray has fewer."""
    count = len(foot)
    step = np.linalg.norm(np.diff(foot, axis=0), axis=1)
    usual = np.median(step) if count > 1 else 0.0
    ends = np.r_[True, step > _APART * usual]
    run = np.cumsum(ends) - 1
    length = np.bincount(run)
    rank = np.arange(count) - np.flatnonzero(ends)[run]
    parts = np.ceil(length / most).astype(int)
    part = (rank * parts[run]) // length[run]  # parts of even size
    own = (np.cumsum(parts) - parts)[run] + part
    first = np.r_[True, np.diff(own) > 0]
    place = np.arange(count) - np.flatnonzero(first)[own]
    table = np.full((own[-1] + 1 if count else 0, most), -1)
    table[own, place] = np.arange(count)
    return table


def layout(foot: Float[np.ndarray, "spray leaf 3"], tip: Float[np.ndarray, "spray leaf 3"]) -> Layout:
    """The typical picture of some sprays of equally many leaves."""
    size = np.linalg.norm(tip - foot, axis=2).mean(axis=1)[:, None, None]
    middle = (0.5 * (foot + tip)).mean(axis=1, keepdims=True)
    foot, tip = (foot - middle) / size, (tip - middle) / size
    points = np.concatenate([foot, tip], axis=1)
    _, axes = np.linalg.eigh(np.einsum("spi,spj->sij", points, points))
    plane = axes[:, :, 1:]  # columns: the two widest directions
    ahead = np.einsum("si,sij->sj", (tip - foot).mean(axis=1), plane)
    ahead /= np.maximum(np.linalg.norm(ahead, axis=1, keepdims=True), 1e-9)
    across = np.stack([ahead[:, 1], -ahead[:, 0]], axis=1)
    first = np.einsum("si,sij,sj->s", tip[:, 0], plane, across)
    frame = np.einsum("sij,sjk->sik", plane, np.stack([across * np.where(first < 0, -1, 1)[:, None], ahead], axis=2))
    foot, reach = np.median(foot @ frame, axis=0), (tip - foot) @ frame
    reach = np.median(reach / np.maximum(np.linalg.norm(reach, axis=2, keepdims=True), 1e-9), axis=0)
    return Layout(foot, np.arctan2(reach[:, 0], reach[:, 1]))
