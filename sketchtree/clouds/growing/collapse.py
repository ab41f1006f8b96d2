"""Which nodes say nothing?

Guo et al. 2018, §5.3, branch collapse: a node of degree 2 whose two edges run alike and are about as thick is taken into its parent. Taken one after the other, small turns would add up
to a bow cut short, so no node may have lain farther from the wood that is left than a share of its own radius (ours).
"""

import numpy as np
from jaxtyping import Bool, Float, Int

from sketchtree.axes import NULL
from sketchtree.traverse import child_count, generation

_ALIKE = 10.0  # degrees
_AS_THICK = 0.8  # the thinner over the thicker
_OFF = 0.35  # radii
_ROUNDS = 5  # each halves a straight chain at most


def collapsed(
    parent: Int[np.ndarray, " node"], place: Float[np.ndarray, "node 3"], radius: Float[np.ndarray, " node"], alike: float = _ALIKE
) -> tuple[Bool[np.ndarray, " node"], Int[np.ndarray, " node"]]:
    """(nodes that stay, the parent of every node among them, by its row in the table given)."""
    parent, stays, off = parent.copy(), np.ones(len(parent), bool), np.zeros(len(parent))
    for turn in range(2 * _ROUNDS):
        above = np.where(stays, parent, NULL)
        sole = np.full(len(parent), NULL)
        child = np.flatnonzero(above != NULL)
        sole[above[child]] = child
        degree = child_count(above)
        v = np.flatnonzero(stays & (above != NULL) & (degree == 1))
        depth = generation(above)
        v = v[depth[v] % 2 == turn % 2]
        u, w = above[v], sole[v]
        out, on = place[v] - place[u], place[w] - place[v]
        size = np.linalg.norm(out, axis=1) * np.linalg.norm(on, axis=1)
        straight = np.einsum("vi,vi->v", out, on) >= np.cos(np.radians(alike)) * size
        chord = place[w] - place[u]
        share = np.clip(np.einsum("vi,vi->v", out, chord) / np.maximum(np.einsum("vi,vi->v", chord, chord), 1e-300), 0.0, 1.0)
        aside = np.linalg.norm(out - share[:, None] * chord, axis=1) + np.maximum(off[v], off[w])
        thick = np.minimum(radius[u], radius[w]) >= _AS_THICK * np.maximum(radius[u], radius[w])
        good = straight & thick & (aside <= _OFF * radius[v])
        stays[v[good]], parent[w[good]], off[w[good]] = False, u[good], aside[good]
    return stays, parent


def kept(stays: Bool[np.ndarray, " node"], parent: Int[np.ndarray, " node"]) -> Int[np.ndarray, " kept"]:
    """Parents of the nodes that stay, numbered among themselves."""
    number = np.append(np.where(stays, np.cumsum(stays) - 1, NULL), NULL)
    return number[parent[stays]]
