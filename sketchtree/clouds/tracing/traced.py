"""The wood that was seen, as a skeleton: every step in order.

    points → graph of neighbours → ways from the foot → layers → nodes → limbs → thickness and axes → no bumps → radii (Guo et al. 2018, Eq. 5) → TreeSkeleton

This is ours: the paper grows a tree toward the points instead (`clouds.growing`), which gives a likely tree; this one gives the tree that stands there.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int

from sketchtree.axes import NULL
from sketchtree.clouds.tracing.allometry import noise, radii
from sketchtree.clouds.tracing.joined import Joined, joined
from sketchtree.clouds.tracing.layers import layers
from sketchtree.clouds.tracing.limbs import bumps, limbs_of, steps
from sketchtree.clouds.tracing.smoothed import led_back, smoothed, straightened
from sketchtree.clouds.tracing.spurs import spurs
from sketchtree.clouds.tracing.thickness import measured
from sketchtree.clouds.tracing.ways import Ways, ways
from sketchtree.skeleton import Kind, TreeSkeleton
from sketchtree.skeleton_rows import limbs, parents_first, tree_of
from sketchtree.traverse import generations, is_tip

_LAYER = 0.006  # of the height
_WIDE, _FINE, _THICK = 2.0, 0.35, 1.2  # a first layer is at least so many spacings wide; a second so many of the spacing there, and so many radii
_ACROSS, _BESIDE = 2.0, 0.75  # radii, spacings: points of a second layer that are farther from one another are of two twigs
_STRAIGHT = 1.2  # power of steps for the first layers, which find out how thick the wood is
THINNEST = 0.00015  # of the height: the radius of a twig


@dataclass(frozen=True, eq=False)
class Traced:
    """A tree that was found in points."""

    skeleton: TreeSkeleton
    gamma: float  # of Eq. 5
    pieces: int  # that the points fell into before gaps were bridged


@dataclass(frozen=True, eq=False)
class _Wood:
    parent: Int[np.ndarray, " node"]
    centre: Float[np.ndarray, "node 3"]
    radius: Float[np.ndarray, " node"]
    limb: Int[np.ndarray, " node"]
    of_point: Int[np.ndarray, " point"]  # NULL: of a bump
    gamma: float


def traced(xyz: Float[np.ndarray, "point 3"], feet: list[Int[np.ndarray, " start"]], graph: Joined | None = None, foot_radius: float | None = None) -> Traced:
    """The tree that stands on feet, each of which is some of the points. Metres, y up. `foot_radius`: how thick the trunk is at its foot, metres, where that was measured."""
    graph = joined(xyz) if graph is None else graph
    height = float(np.ptp(xyz[:, 1]))
    first = np.full(len(xyz), max(_LAYER * height, _WIDE * float(np.median(graph.spacing))))
    rough = _wood(xyz, graph, ways(xyz, graph, feet, _STRAIGHT), first, THINNEST * height, foot_radius)
    thick = np.where(rough.of_point == NULL, 0.0, rough.radius[rough.of_point])
    wood = _wood(xyz, graph, ways(xyz, graph, feet), np.maximum(_FINE * graph.spacing, _THICK * thick), THINNEST * height, foot_radius, thick)
    return Traced(_skeleton(wood), wood.gamma, graph.pieces)


def _wood(xyz, graph: Joined, way: Ways, width, thinnest: float, foot: float | None, thick=None) -> _Wood:
    """Limbs and their thickness, by layers that are so wide at each point. `thick`: about how thick the wood is there, if that is known."""
    found = layers(xyz, graph, way, width, None if thick is None else np.maximum(_ACROSS * thick, _BESIDE * graph.spacing))
    parent, of_point, width, end = found.parent, found.of_point, found.width, found.end
    limb = limbs_of(parent, found.centre)
    about = None if thick is None else np.bincount(of_point, thick, len(parent)) / found.size
    seen = measured(xyz, of_point, parent, found.centre, limb, width, about)
    part_of = bumps(parent, seen.centre, limb, np.nan_to_num(seen.radius), width, strips=thick is not None)
    if thick is not None:
        spacing = np.bincount(of_point, graph.spacing, len(parent)) / found.size
        part_of = _without(part_of, spurs(parent, seen.centre, end, limb, np.where(seen.known, seen.radius, about), spacing, noise(seen, limb)))
    kept = np.flatnonzero(part_of == np.arange(len(parent)))
    above = np.where(parent[kept] == NULL, NULL, part_of[parent[kept]])
    place = np.full(len(parent) + 1, NULL)
    place[kept] = np.arange(len(kept))
    order = parents_first(np.where(above == NULL, NULL, place[above]), "the cloud")
    kept, above = kept[order], above[order]
    place[kept] = np.arange(len(kept))
    parent, of_point, width, end = np.where(above == NULL, NULL, place[above]), place[part_of[of_point]], width[kept], end[kept]
    limb = limbs_of(parent, seen.centre[kept])
    about = np.where(seen.known, seen.radius, 0.0 if about is None else about)[kept]
    seen = measured(xyz, of_point, parent, seen.centre[kept], limb, width, about)
    centre = smoothed(parent, seen.centre, limb, seen.known)
    tips = is_tip(parent)
    centre[tips] = end[tips]  # a layer's middle would leave half of it out
    radius, gamma = radii(parent, steps(parent, centre), limb, seen, width, thinnest, foot)
    return _Wood(parent, straightened(parent, centre, limb, radius), radius, limb, of_point, gamma)


def _without(part_of, spur):
    """Both together: what is part of a spur is part of what that is part of; NULL where that is nothing."""
    both, ends = np.where(part_of != np.arange(len(part_of)), part_of, spur), np.append(spur, NULL)
    while (ends[both] != both).any():
        both = ends[both]
    return both


def _skeleton(wood: _Wood) -> TreeSkeleton:
    """The table, its branches led back to where they leave."""
    parent = led_back(wood.parent, wood.centre, wood.limb, wood.radius)
    order = parents_first(parent, "the cloud")
    place = np.argsort(order)
    parent, centre, radius = np.where(parent[order] == NULL, NULL, place[parent[order]]), wood.centre[order], wood.radius[order]
    for rows in generations(parent)[1:]:
        radius[rows] = np.minimum(radius[rows], radius[parent[rows]])
    named, rank = limbs(parent, centre, radius)
    return TreeSkeleton.from_columns(parent, centre, radius, limb=named, order=rank, tree=tree_of(parent), kind=np.full(len(parent), int(Kind.OBSERVED)))
