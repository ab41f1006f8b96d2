"""A matte in, the trunk's skeleton out (§II.2, Algorithm 1), every step in order.

    alpha → binary → contour → discrete curve evolution → edits by hand → segments → medial axis, pruned → rooted tree → blunt ends off, bare below the crown → smooth limbs from their bearers' axes up to the contour
"""

import numpy as np
from jaxtyping import Float
from scipy.spatial import KDTree

from sketchtree.errors import OptionError
from sketchtree.trunk.binary import Binary, binary_trunk
from sketchtree.trunk.blunt import without_blunt
from sketchtree.trunk.edits import VertexEdits, Vertices, edited
from sketchtree.trunk.evolution import evolve
from sketchtree.trunk.foot import bare_below, stands_at
from sketchtree.trunk.limb_lines import limb_lines
from sketchtree.trunk.medial import medial_axis, within
from sketchtree.trunk.noise import noise_level, roughness
from sketchtree.trunk.outline import Outline, outline
from sketchtree.trunk.rooted import Rooted, rooted
from sketchtree.trunk.segments import convex, segments
from sketchtree.trunk.trunk_skeleton import TrunkSkeleton

GAP = 3.0  # pixels: the gap to give for the matte of a photo; thin twigs fall apart there
_LEAST_RADIUS = 0.5  # pixels
_PROTRUDES, _ROUGH = 2.0, 4.0  # pixels, and of the contour's roughness: what a branch stands out, at least
_LOST = 5.0  # pixels of axis that are left out unremarked
_NEAR = 2.0  # pixels: a tip so near to a vertex that a person added is the one that was asked for


def trunk_skeleton(
    alpha: Float[np.ndarray, "row column"], *, vertices: int | None = None, edits: VertexEdits = VertexEdits(), root: tuple[float, float] | None = None, gap: float = 0.0
) -> TrunkSkeleton:
    """The skeleton of the trunk in a matte. `vertices`: m (None: by the contour's roughness); `root`: a point of the trunk where it stands (None: the middle of its foot); `gap`: of pieces that belong to it.
    Pixels, y down.

    Raises SketchError for an empty matte, OptionError for m < 3, and for edits and a root of what does not exist, unless the edits are not `exact`: then those are passed over."""
    asked = edits.vertices if vertices is None else vertices
    if asked is not None and asked < 3:
        raise OptionError(f"The contour can't be evolved to {asked} vertices: a polygon has at least 3.", remedy="Ask for 3 or more, or let the number be found.")
    if not 0.0 <= gap < float("inf"):
        raise OptionError(f"A gap of {gap:g} pixels can't be bridged.", remedy="Give pixels from 0 on.")
    binary, root, beside = _standing(alpha, root, gap, edits.exact)
    shape = outline(binary)
    polygon, told = _evolved(shape, asked)
    polygon, passed = edited(polygon, shape.rings, edits)
    told += [*beside, *passed]
    axis = medial_axis(binary, shape.rings, segments(shape.rings, polygon))
    told += [f"Parts of the trunk, {axis.lost:.0f} pixels long, hang on it by less than a pixel, and were left out."] if axis.lost > _LOST else []
    nearest = KDTree(np.concatenate(shape.rings))
    wide = nearest.query(axis.xy)[0]
    tree, _ = rooted(axis.xy, axis.edges, wide, stands_at(axis.xy, wide) if root is None else int(np.argmin(np.hypot(*(axis.xy - root).T))))
    tree = without_blunt(tree, _asked(tree, shape, polygon), max(_PROTRUDES, _ROUGH * roughness(shape.rings)))
    tree, below = bare_below(tree, _asked(tree, shape, polygon))
    told += [f"{below} short {'branch' if below == 1 else 'branches'} below the crown {'was' if below == 1 else 'were'} left out."] if below else []
    return _finished(tree, binary, shape, polygon, root, (*binary.warnings, *told))


def _standing(alpha, root, gap: float, exact: bool) -> tuple[Binary, tuple[float, float] | None, list[str]]:
    """(the trunk, where it stands, remarks)."""
    try:
        return binary_trunk(alpha, root, gap), root, []
    except OptionError as error:
        if exact:
            raise
        return binary_trunk(alpha, None, gap), None, [f"{error.message} The middle of its foot was taken instead."]


def _evolved(shape: Outline, asked: int | None) -> tuple[Vertices, list[str]]:
    """(the vertices that are left, remarks)."""
    found = evolve(shape.rings, vertices=asked, noise=noise_level(shape.rings))
    told = []
    if asked is not None and found.count != asked:
        why = "the contour has no more" if found.count < asked else "with fewer it would cross itself"
        told = [f"{asked} vertices were asked for; {found.count} are left, since {why}."]
    return Vertices.of(found.kept, [convex(ring[rows]) for ring, rows in zip(shape.rings, found.kept, strict=True)]), told


def _asked(tree: Rooted, shape: Outline, polygon: Vertices):
    """Tips at vertices that a person added."""
    added = np.concatenate([ring[rows[own]] for ring, rows, own in zip(shape.rings, polygon.rows, polygon.added, strict=True)])
    if len(added) == 0:
        return np.zeros(len(tree.parent), bool)
    return KDTree(added).query(tree.xy)[0] <= _NEAR


def _finished(tree: Rooted, binary: Binary, shape: Outline, polygon: Vertices, root, warnings) -> TrunkSkeleton:
    """Smooth lines up to the contour, as a graph with few nodes."""

    def inside(points):
        return within(binary, points)

    stands = np.count_nonzero(tree.parent == 0) == 1 and root is None
    xy, radius, parent = limb_lines(tree, inside, on_ground=stands)
    edges = np.column_stack([parent[1:], np.arange(1, len(parent))])
    corners = tuple(ring[rows] for ring, rows in zip(shape.rings, polygon.rows, strict=True))
    return TrunkSkeleton(xy, edges, np.maximum(radius, _LEAST_RADIUS), 0, corners, polygon.parting, shape, warnings)
