"""Which branches would no tree of this thickness have?

While a tree grows, Eq. 5 says how thick its wood is so far. A branch that lies within wood much thicker than itself, or hardly outside, can't be: it grew to points of that bark. One
that has stopped growing is shed at once (`buried`); in the end, what bears real branches and still runs within thicker wood is taken into that, and its branches hang there (`absorbed`).
The paper applies the allometric rule "on-the-fly after each growth iteration" and leaves open how; this is our reading.
"""

import numpy as np
from jaxtyping import Bool, Float, Int
from scipy.spatial import cKDTree

from sketchtree.axes import NULL
from sketchtree.clouds.growing.collapse import kept
from sketchtree.clouds.growing.perception import workers
from sketchtree.clouds.growing.thickness import radii
from sketchtree.skeleton_rows import parents_first
from sketchtree.traverse import generations

_OUT = 1.5  # radii of thicker wood that a branch must leave behind
_SAME, _OVERLAP = 1.2, 0.8  # radii within which it is that wood; share of both radii within which two are one
_ROUNDS = 3  # wood that took others in is thicker, and takes in more
_THICKER = 1.5  # times as thick as the branch's own foot
_NEAREST = 12  # thick nodes that are looked at


def buried(
    parent: Int[np.ndarray, " node"],
    place: Float[np.ndarray, "node 3"],
    root: Float[np.ndarray, " node"],
    gamma: float,
    alive: Bool[np.ndarray, " node"],
) -> Bool[np.ndarray, " node"]:
    """Nodes to shed. `root`: radius at bases; `alive`: nodes that grew of late, whose branches are spared."""
    stays = alive | (_within(parent, place, radii(parent, _steps(parent, place), root, gamma), _OUT) == NULL)
    for rows in reversed(generations(parent)[1:]):  # what bears something that stays does too
        np.logical_or.at(stays, parent[rows], stays[rows])
    return ~stays & (parent != NULL)


def absorbed(
    parent: Int[np.ndarray, " node"], place: Float[np.ndarray, "node 3"], root: Float[np.ndarray, " root"], gamma: float
) -> tuple[Int[np.ndarray, " kept"], Float[np.ndarray, "kept 3"]]:
    """(parent, place) of what is left, roots first. `root`: radius at the roots. A branch hangs as far below the place where it comes out as the wood there is thick."""
    for _ in range(_ROUNDS):
        radius = radii(parent, _steps(parent, place), np.append(root, np.ones(len(parent) - len(root))), gamma)
        host = _within(parent, place, radius, _SAME, _OVERLAP)
        if (host == NULL).all():
            break
        parent = parent.copy()
        hangs = np.flatnonzero((parent != NULL) & (host[parent] != NULL) & (host == NULL))
        parent[hangs] = _below(parent, place, radius, host[parent[hangs]], host == NULL)
        stays = host == NULL
        parent, place = kept(stays, parent), place[stays]
        order = parents_first(parent, "the cloud")
        parent, place = np.append(np.argsort(order), NULL)[parent[order]], place[order]
    return parent, place


def _below(parent, place, radius, node, stays):
    """The node as far back along the wood as it is thick, of those that stay."""
    node, left = node.copy(), radius[node].copy()
    while len(back := np.flatnonzero(((left > 0) | ~stays[node]) & (parent[node] != NULL))):
        left[back] -= np.linalg.norm(place[node[back]] - place[parent[node[back]]], axis=1)
        node[back] = parent[node[back]]
    return node


def _steps(parent, place):
    return np.where(parent == NULL, 0.0, np.linalg.norm(place - place[parent], axis=1))


def _within(parent, place, radius, out: float, overlap: float = 0.0):
    """The thicker node of another limb within so many of whose radii each node lies, or within so much of both, not itself so; NULL where there is none.

    It is thicker than the node, so it never stands on it, and what hangs there instead makes no circle."""
    foot, host = _first_of_limb(parent, radius), np.full(len(parent), NULL)
    thick = np.flatnonzero(out * radius > 0.5 * np.median(_steps(parent, place)))
    if not len(thick):
        return host
    distance, near = cKDTree(place[thick]).query(place, k=min(_NEAREST, len(thick)), distance_upper_bound=out * float(radius.max()), workers=workers(len(place)))
    distance, near = distance.reshape(len(place), -1), near.reshape(len(place), -1)
    other = thick[np.minimum(near, len(thick) - 1)]
    own = radius[:, None]
    much = (radius[other] > _THICKER * radius[foot][:, None]) & (distance < out * radius[other])
    one = (radius[other] > own) & (distance < overlap * (own + radius[other]))
    good = np.isfinite(distance) & (parent != NULL)[:, None] & (foot[other] != foot[:, None]) & (much | one)
    rows = good.any(axis=1)
    good &= ~rows[other]  # what is itself taken in takes nothing in
    rows = np.flatnonzero(good.any(axis=1))
    host[rows] = other[rows, good[rows].argmax(axis=1)]
    return host


def _first_of_limb(parent, radius):
    """The first node of every node's limb, which follows the thickest child."""
    child = np.flatnonzero(parent != NULL)
    order = child[np.lexsort((-radius[child], parent[child]))]
    leads = np.zeros(len(parent), bool)
    leads[order[np.r_[True, np.diff(parent[order]) != 0][: len(order)]]] = True
    foot = np.arange(len(parent))
    for rows in generations(parent)[1:]:
        foot[rows] = np.where(leads[rows], foot[parent[rows]], rows)
    return foot
