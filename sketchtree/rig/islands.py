"""Which vertices lie inside a limb that only passes by?

Where limbs run through each other, vertices of one lie deepest in the other's wood; moved with that they would tear their own
limb's skin. On a surface a limb borders only on what it grows from, what grows from it and its siblings, close to their feet. So the mesh
is cut along every edge between limbs that are not so related; of two pieces that meet at such an edge the smaller is an island,
and its vertices get places on the limb around it. What then is left hangs together by a third limb: there pieces are of one limb each.
"""

import numpy as np
from jaxtyping import Bool, Float, Int

from sketchtree.axes import NULL
from sketchtree.geometry.limbs import CentreLines
from sketchtree.geometry.mesh import Mesh
from sketchtree.rig.boughs import Boughs
from sketchtree.rig.place import Places, places_on, wood_places

_ROUNDS = 2  # of either kind
_AFAR = 4.0  # radii from a limb: what reaches as far is no island in it
_NEAR_FOOT, _RADII = 5.0, 5.0  # a limb borders on others up to here: of what of it is buried, and of its radius there


def mesh_places(lines: CentreLines, limbs: Boughs, mesh: Mesh) -> Places:
    """Limb and place of every vertex of a wood mesh, islands joined to the limb they are part of. Copies of a vertex (at
    seams of the texture) share one place."""
    place = wood_places(lines, mesh.position)
    if not len(mesh.triangle) or not len(lines):
        return place
    a, b = mesh.triangle.ravel(), np.roll(mesh.triangle, -1, axis=1).ravel()
    if not foreign_edges(lines, limbs, place, a, b).any():
        return place
    one = welded(mesh.position)
    a, b = one[a], one[b]
    for rank in range(2 * _ROUNDS):
        foreign = foreign_edges(lines, limbs, place, a, b)
        if not foreign.any():
            break
        apart = foreign if rank < _ROUNDS else place.limb[a] != place.limb[b]
        _join(lines, mesh.position, place, a, b, foreign, apart)
    return Places(place.limb[one], place.s[one])


def welded(position: Float[np.ndarray, "vertex 3"]) -> Int[np.ndarray, " vertex"]:
    """The first vertex at the same position, for every vertex."""
    order = np.lexsort(position.T)
    new = np.r_[True, (np.diff(position[order], axis=0) != 0).any(axis=1)][: len(order)]
    first = np.minimum.reduceat(order, np.flatnonzero(new)) if len(order) else order
    one = np.empty(len(position), np.int64)
    one[order] = first[np.cumsum(new) - 1]
    return one


def foreign_edges(lines: CentreLines, limbs: Boughs, place: Places, a, b) -> Bool[np.ndarray, " edge"]:
    """Which of the edges from vertices `a` to `b` lie between limbs that do not grow from each other, or far from where they do."""
    foreign = np.zeros(len(a), bool)
    edge = np.flatnonzero(place.limb[a] != place.limb[b])
    a, b = a[edge], b[edge]
    left, right = place.limb[a], place.limb[b]
    reach = _NEAR_FOOT * limbs.buried + _RADII * lines.radius[lines.start[:-1]]
    left_near, right_near = place.s[a] <= reach[left], place.s[b] <= reach[right]
    kin = (_grows_from(lines, left, right) & left_near) | (_grows_from(lines, right, left) & right_near)
    siblings = (lines.parent[left] == lines.parent[right]) & (lines.parent[left] != NULL) & left_near & right_near
    foreign[edge] = ~(kin | siblings)
    return foreign


def _grows_from(lines: CentreLines, limb, other) -> Bool[np.ndarray, " edge"]:
    """Whether the limb grows from the other, directly or not."""
    above, found = limb, np.zeros(len(limb), bool)
    while (above != NULL).any():
        above = np.where(above == NULL, NULL, lines.parent[above])
        found |= above == other
    return found


def _join(lines: CentreLines, position, place: Places, a, b, foreign, apart) -> None:
    """Give the vertices of every island a place on the limb around it; writes to `place`. Pieces end at the edges `apart`."""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    count = len(position)
    link = coo_array((np.ones((~apart).sum(), np.int8), (a[~apart], b[~apart])), shape=(count, count))
    pieces, piece = connected_components(link, directed=False)
    size = np.bincount(piece, minlength=pieces)
    a, b = np.r_[a[foreign], b[foreign]], np.r_[b[foreign], a[foreign]]
    smaller = (size[piece[a]] < size[piece[b]]) | ((size[piece[a]] == size[piece[b]]) & (piece[a] > piece[b]))
    a, b = a[smaller], b[smaller]
    around = np.full(pieces, NULL)
    order = np.argsort(size[piece[b]], kind="stable")  # the largest neighbour is written last
    around[piece[a][order]] = place.limb[b][order]
    rows = np.flatnonzero(around[piece] != NULL)
    found = places_on(lines, around[piece[rows]], position[rows])
    point, radius = lines.at(found.limb, found.s)
    near = np.linalg.norm(position[rows] - point, axis=1) <= _AFAR * radius
    place.limb[rows[near]], place.s[rows[near]] = found.limb[near], found.s[near]
