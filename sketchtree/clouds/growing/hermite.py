"""Where does a branch turn too sharply?

Guo et al. 2018, §5.3, branch smooth: where a node's edges u→v and v→w turn by more than ϑ = 20°, both become Hermite curves,

    p(s) = (2 s³ − 3 s² + 1) p_0 + (s³ − 2 s² + s) m_0 + (−2 s³ + 3 s²) p_1 + (s³ − s²) m_1

    p_0, p_1   an edge's ends       m   its length along the tangent there: w − u at a sharp node, the edge itself at any other

The curve goes through v, so that what v bears stays where it is.
"""

import numpy as np
from jaxtyping import Float, Int

from sketchtree.axes import NULL
from sketchtree.clouds.growing.heading import unit

SHARP = 20.0  # degrees
_AT = np.array([0.25, 0.5, 0.75])


def smoothed(
    parent: Int[np.ndarray, " node"], place: Float[np.ndarray, "node 3"], radius: Float[np.ndarray, " node"], sharp: float = SHARP
) -> tuple[Int[np.ndarray, " row"], Float[np.ndarray, "row 3"], Float[np.ndarray, " row"]]:
    """(parent, place, radius) with nodes added on edges at sharp turns. A limb goes on in the thickest child."""
    goes_on = _goes_on(parent, radius)
    v = np.flatnonzero((parent != NULL) & (goes_on != NULL))
    before, after = unit(place[v] - place[parent[v]]), unit(place[goes_on[v]] - place[v])
    turns = np.einsum("vi,vi->v", before, after) < np.cos(np.radians(sharp))
    tangent = np.full((len(parent), 3), np.nan)
    tangent[v[turns]] = unit(place[goes_on[v[turns]]] - place[parent[v[turns]]])
    end = np.flatnonzero(parent != NULL)
    start = parent[end]
    leads = goes_on[start] == end  # a branch's first edge keeps its angle where it leaves
    m0 = np.where(leads[:, None], tangent[start], np.nan)
    bent = np.isfinite(m0[:, 0]) | np.isfinite(tangent[end, 0])
    end, start, m0 = end[bent], start[bent], m0[bent]
    edge = place[end] - place[start]
    length = np.linalg.norm(edge, axis=1, keepdims=True)
    m0, m1 = (np.where(np.isfinite(m), m * length, edge) for m in (m0, tangent[end]))
    inner = curve(place[start], m0, place[end], m1, _AT)
    thick = radius[start, None] + _AT * (radius[end] - radius[start])[:, None]
    return _inserted(parent, place, radius, end, inner, thick)


def curve(
    p0: Float[np.ndarray, "edge 3"], m0: Float[np.ndarray, "edge 3"], p1: Float[np.ndarray, "edge 3"], m1: Float[np.ndarray, "edge 3"], at: Float[np.ndarray, " place"]
) -> Float[np.ndarray, "edge place 3"]:
    """Points of Hermite curves."""
    s = at[None, :, None]
    p0, m0, p1, m1 = (each[:, None] for each in (p0, m0, p1, m1))
    return (2 * s**3 - 3 * s**2 + 1) * p0 + (s**3 - 2 * s**2 + s) * m0 + (3 * s**2 - 2 * s**3) * p1 + (s**3 - s**2) * m1


def _goes_on(parent, radius):
    """The thickest child of every node."""
    child = np.flatnonzero(parent != NULL)
    order = child[np.lexsort((radius[child], parent[child]))]
    goes_on = np.full(len(parent), NULL)
    goes_on[parent[order]] = order  # of each node's children the last, the thickest, stays
    return goes_on


def _inserted(parent, place, radius, end, inner, thick):
    """The table with `inner` nodes just before each row of `end`."""
    more = np.zeros(len(parent), np.int64)
    more[end] = inner.shape[1]
    row = np.arange(len(parent)) + np.cumsum(more)
    size = len(parent) + int(more.sum())
    new_parent, new_place, new_radius = np.arange(size) - 1, np.zeros((size, 3)), np.zeros(size)
    new_place[row], new_radius[row] = place, radius
    first = row - more
    new_parent[first] = np.where(parent == NULL, NULL, row[parent])
    at = row[end][:, None] - inner.shape[1] + np.arange(inner.shape[1])
    new_place[at], new_radius[at] = inner, thick
    return new_parent, new_place, new_radius
