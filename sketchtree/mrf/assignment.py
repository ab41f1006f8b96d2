"""A value for every unknown: the elevations ψ, and what follows from them.

    V_i = (e_i cos ψ_i, sin ψ_i)     unit direction in 3D           L_i = ℓ_i / cos ψ_i     its length
    p_i = (x_i, y_i, Σ dz)           position of its tip            dz_i = ℓ_i tan ψ_i      its depth
    Λ_j = Σ_{i ∈ j} L_i              length of limb j
    a_i = angle(V_i, V_p(i))         turn away from its parent segment

ψ_i ∈ (−80°, 80°). x and y are the drawing's whatever ψ is. The depths of tips are sums along the way to the
base, taken for all rows at once from two running sums: over rows in the order in which a depth-first walk
opens them, less over those that it has closed.
"""

from typing import NamedTuple

import equinox as eqx
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Bool, Float, Int

from sketchtree.mrf.factor_graph import FactorGraph
from sketchtree.mrf.factors.angles import angle
from sketchtree.traverse import generation

STEEPEST = np.radians(80.0)  # largest |ψ|


class Assignment(NamedTuple):
    """ψ and all that the factors read off it. H = 1."""

    elevation: Float[Array, " segment"]  # ψ, radians
    direction: Float[Array, "segment 3"]  # V; +y at a base
    parent_direction: Float[Array, "segment 3"]  # V of the parent segment; +y where that is a base
    turn: Float[Array, " segment"]  # a, radians
    length: Float[Array, " segment"]  # L; 0 at a base
    tip: Float[Array, "segment 3"]  # p
    limb_length: Float[Array, " limb"]  # Λ


class Page(eqx.Module):
    """The drawing as the unknowns need it, padded with rows that are bases and empty limbs."""

    is_segment: Bool[Array, " segment"]  # neither base nor padding
    parent: Int[Array, " segment"]  # itself at a base
    direction: Float[Array, "segment 2"]  # e
    length: Float[Array, " segment"]  # ℓ
    xy: Float[Array, "segment 2"]
    limb: Int[Array, " segment"]
    opened: Int[Array, " segment"]  # rows in the order of opening
    closed: Int[Array, " segment"]  # rows in the order of closing
    rank: Int[Array, " segment"]  # place of each row in `opened`
    behind: Int[Array, " segment"]  # how many rows are closed before it opens
    extent: Int[Array, " segment"]  # rows of its subtree, itself included
    limb_count: int = eqx.field(static=True)  # padded

    def assign(self, elevation: Float[Array, " segment"]) -> Assignment:
        """All that follows from ψ."""
        psi = jnp.where(self.is_segment, elevation, 0.0)
        cos, sin = jnp.cos(psi), jnp.sin(psi)
        direction = jnp.concatenate([self.direction * cos[:, None], sin[:, None]], axis=1)
        above = direction[self.parent]
        length = self.length / cos
        tip = jnp.concatenate([self.xy, self.depth(psi)[:, None]], axis=1)
        limb_length = jnp.zeros(self.limb_count, psi.dtype).at[self.limb].add(length)
        return Assignment(psi, direction, above, angle(direction, above), length, tip, limb_length)

    def depth(self, elevation: Float[Array, " segment"]) -> Float[Array, " segment"]:
        """z of every tip."""
        rise = self.length * jnp.tan(elevation)
        zero = jnp.zeros(1, rise.dtype)
        opened = jnp.cumsum(rise[self.opened])
        closed = jnp.concatenate([zero, jnp.cumsum(rise[self.closed])])
        return opened[self.rank] - closed[self.behind]


def page(graph: FactorGraph, segments: int, limbs: int, dtype=np.float32) -> Page:
    """The page padded to `segments` rows and `limbs` limbs; both at least the graph's own."""
    n = len(graph)
    extent, rank = _subtrees(graph.parent)
    opened = np.argsort(rank)
    depth = generation(graph.parent)
    behind = rank - depth
    closed = np.lexsort((-depth, rank + extent))
    pad = segments - n
    tail = np.arange(n, segments)
    return Page(
        is_segment=np.asarray(np.r_[~graph.is_base, np.zeros(pad, bool)]),
        parent=np.asarray(np.r_[np.where(graph.is_base, np.arange(n), graph.parent), tail], np.int32),
        direction=np.asarray(np.r_[graph.direction, np.tile([0.0, 1.0], (pad, 1))], dtype),
        length=np.asarray(np.r_[graph.length, np.zeros(pad)], dtype),
        xy=np.asarray(np.r_[graph.xy, np.zeros((pad, 2))], dtype),
        limb=np.asarray(np.r_[graph.limb, np.full(pad, limbs - 1)], np.int32),
        opened=np.asarray(np.r_[opened, tail], np.int32),
        closed=np.asarray(np.r_[closed, tail], np.int32),
        rank=np.asarray(np.r_[rank, tail], np.int32),
        behind=np.asarray(np.r_[behind, tail], np.int32),
        extent=np.asarray(np.r_[extent, np.ones(pad)], np.int32),
        limb_count=limbs,
    )


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
