"""From the page to the world: how large is the tree, and how thick is what was drawn?"""

import numpy as np
from jaxtyping import Float

from sketchtree.parameters import Habit
from sketchtree.similarity import Similarity
from sketchtree.sketch.graph import SketchGraph
from sketchtree.sketch.strokes import Sketch

_STOUT = 1.6  # a trunk drawn thicker than its species has is at most this many times as thick
_THIN = 0.12  # radius of the thinnest line's branch / radius of the trunk, at most
_CARTOON = 0.05  # radius of a trunk drawn by its two edges / height of the drawing, at most


def page_to_world(graph: SketchGraph, height: float) -> Similarity:
    """The similarity that puts the first root at the origin and gives the drawing `height` metres.

    The drawing's height runs from the root to the highest point of branches and crown; a drawing
    much wider than high (a fallen or creeping tree) is scaled by its width instead."""
    points = np.concatenate([graph.xy, graph.curve_points, *graph.crown])
    root = graph.xy[np.flatnonzero(graph.is_base)[0]]
    extent = max(points[:, 1].max() - root[1], 0.4 * np.ptp(points[:, 0]), 1e-300)
    scale = height / extent
    return Similarity(scale, (-scale * root[0], -scale * root[1], 0.0))


def drawn_radius(sketch: Sketch, graph: SketchGraph, similarity: Similarity, habit: Habit) -> Float[np.ndarray, " segment"]:
    """Half the drawn width of each branch, metres; NaN where the widths say nothing (a width of 0 does not).

    An area of ink shows how thick the wood is, and so do the two edges of a trunk, up to `_CARTOON`: people who draw
    a trunk by its edges draw it wide. A pen's line does not show it: it shows which branch is thicker than which. The
    thickest line then stands for the trunk of such a tree (or up to `_STOUT` times that, if it was drawn so), the
    thinnest for a branch no thicker than `_THIN` of it, and those between for what lies between on a logarithmic scale."""
    radius = np.where(graph.width > 0, graph.width, np.nan) * similarity.scale / 2
    if np.isnan(radius).all():
        return radius
    if graph.width_is_wood:
        inked = np.array([stroke.filled or stroke.wood for stroke in sketch.strokes], bool)[graph.stroke]
        return np.where(inked, radius, np.minimum(radius, _CARTOON * graph.height * similarity.scale))
    thinnest, thickest = np.nanmin(radius), np.nanmax(radius)
    trunk = habit.trunk_ratio * similarity.scale * float(np.ptp(graph.xy[:, 1]))
    stem = float(np.clip(thickest, trunk, _STOUT * trunk))
    twig = min(float(thinnest), _THIN * stem)
    span = np.log(thickest / thinnest)
    return twig * (stem / twig) ** (np.log(radius / thinnest) / span) if span > 1e-9 else np.full(len(radius), np.nan)
