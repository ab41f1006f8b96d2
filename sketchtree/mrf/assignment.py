"""A value for every unknown: the elevations ψ, and what follows from them.

    V_i = (e_i cos ψ_i, sin ψ_i)     unit direction in 3D           L_i = ℓ_i / cos ψ_i     its length
    p_i = (x_i, y_i, Σ dz)           position of its tip            dz_i = ℓ_i tan ψ_i      its depth
    Λ_j = Σ_{i ∈ j} L_i              length of limb j
    a_i = angle(V_i, V_p(i))         turn away from its parent segment

ψ_i ∈ (−80°, 80°). x and y are the drawing's whatever ψ is.
"""

from typing import NamedTuple

import equinox as eqx
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Bool, Float, Int

from sketchtree.mrf.adjoint import from_parents, sum_to_tips
from sketchtree.mrf.factor_graph import FactorGraph
from sketchtree.mrf.factors.angles import Vectors, angle
from sketchtree.traverse import generation

STEEPEST = np.radians(80.0)  # largest |ψ|


class Assignment(NamedTuple):
    """ψ and all that the factors read off it. H = 1."""

    elevation: Float[Array, " segment"]  # ψ, radians
    direction: Vectors  # V; +y at a base
    parent_direction: Vectors  # V of the parent segment; +y where that is a base
    turn: Float[Array, " segment"]  # a, radians
    length: Float[Array, " segment"]  # L; 0 at a base
    tip: Vectors  # p
    limb_length: Float[Array, " limb"]  # Λ
    is_segment: Bool[Array, " segment"]  # neither base nor padding


class Walk(eqx.Module):
    """A depth-first walk over the rows, and the children of each row."""

    opened: Int[Array, " segment"]  # rows in the order of opening
    closed: Int[Array, " segment"]  # rows in the order of closing
    rank: Int[Array, " segment"]  # place of each row in `opened`
    behind: Int[Array, " segment"]  # how many rows are closed before it opens
    extent: Int[Array, " segment"]  # rows of its subtree, itself included
    parent: Int[Array, " segment"]  # itself at a base
    by_parent: Int[Array, " segment"]  # rows in the order of their parents
    child_start: Int[Array, " segment"]  # a row's children are by_parent[child_start:child_end]
    child_end: Int[Array, " segment"]


class Page(eqx.Module):
    """The drawing as the unknowns need it, padded with rows that are bases and empty limbs."""

    is_segment: Bool[Array, " segment"]  # neither base nor padding
    direction: Float[Array, "segment 2"]  # e
    length: Float[Array, " segment"]  # ℓ
    xy: Float[Array, "segment 2"]
    limb: Int[Array, " segment"]
    walk: Walk
    limb_count: int = eqx.field(static=True)  # padded

    def assign(self, elevation: Float[Array, " segment"]) -> Assignment:
        """All that follows from ψ."""
        psi = jnp.where(self.is_segment, elevation, 0.0)
        cos, sin = jnp.cos(psi), jnp.sin(psi)
        direction = Vectors(self.direction[:, 0] * cos, self.direction[:, 1] * cos, sin)
        above = Vectors(*(from_parents(column, self.walk) for column in direction))
        length = self.length / cos
        tip = Vectors(self.xy[:, 0], self.xy[:, 1], sum_to_tips(self.length * sin / cos, self.walk))
        limb_length = jnp.zeros(self.limb_count, psi.dtype).at[self.limb].add(length)
        return Assignment(psi, direction, above, angle(direction, above), length, tip, limb_length, self.is_segment)

    def depth(self, elevation: Float[Array, " segment"]) -> Float[Array, " segment"]:
        """z of every tip."""
        return sum_to_tips(self.length * jnp.tan(elevation), self.walk)


def page(graph: FactorGraph, segments: int, limbs: int, dtype=np.float32) -> Page:
    """The page padded to `segments` rows and `limbs` limbs; both at least the graph's own."""
    n = len(graph)
    pad = segments - n
    return Page(
        is_segment=np.asarray(np.r_[~graph.is_base, np.zeros(pad, bool)]),
        direction=np.asarray(np.r_[graph.direction, np.tile([0.0, 1.0], (pad, 1))], dtype),
        length=np.asarray(np.r_[graph.length, np.zeros(pad)], dtype),
        xy=np.asarray(np.r_[graph.xy, np.zeros((pad, 2))], dtype),
        limb=np.asarray(np.r_[graph.limb, np.full(pad, limbs - 1)], np.int32),
        walk=_walk(graph.parent, segments),
        limb_count=limbs,
    )


def _walk(parent: Int[np.ndarray, " segment"], segments: int) -> Walk:
    n = len(parent)
    tail = np.arange(n, segments)
    extent, rank = _subtrees(parent)
    depth = generation(parent)
    above = np.r_[np.where(parent < 0, np.arange(n), parent), tail]
    by_parent = np.argsort(above, kind="stable")
    columns = {
        "opened": np.r_[np.argsort(rank), tail],
        "closed": np.r_[np.lexsort((-depth, rank + extent)), tail],
        "rank": np.r_[rank, tail],
        "behind": np.r_[rank - depth, tail],
        "extent": np.r_[extent, np.ones(len(tail), int)],
        "parent": above,
        "by_parent": by_parent,
        "child_start": np.searchsorted(above[by_parent], np.arange(segments), side="left"),
        "child_end": np.searchsorted(above[by_parent], np.arange(segments), side="right"),
    }
    return Walk(**{name: np.asarray(column, np.int32) for name, column in columns.items()})


def _subtrees(parent: Int[np.ndarray, " segment"]):
    """Rows in every subtree, and the place of every row in a depth-first walk."""
    n = len(parent)
    extent = np.ones(n, np.int64)
    for row in range(n - 1, -1, -1):
        if parent[row] >= 0:
            extent[parent[row]] += extent[row]
    rank = np.zeros(n, np.int64)
    free = np.zeros(n, np.int64)  # next free place inside each subtree
    base = 0
    for row in range(n):
        if parent[row] < 0:
            rank[row], base = base, base + extent[row]
        else:
            rank[row] = free[parent[row]]
            free[parent[row]] += extent[row]
        free[row] = rank[row] + 1
    return extent, rank
