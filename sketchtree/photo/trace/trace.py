"""Which limbs show in the photo? Every stroke, what grows off it, how thick it all is; as one table (Tan et al. 2008, §2).

    strokes → colours of wood → places on the strokes → circles onward → thickness → joints that say something
"""

from dataclasses import dataclass

import numpy as np
import shapely
from jaxtyping import Array, Float, Key

from sketchtree.axes import NULL
from sketchtree.errors import OptionError, SketchError
from sketchtree.photo.foliage import Foliage
from sketchtree.photo.marked import Marked
from sketchtree.photo.photo import Photo
from sketchtree.photo.trace.clear import NEAR_BY, plainly_seen
from sketchtree.photo.trace.edges import edges_at, roughness, tapered
from sketchtree.photo.trace.follow import Walk, follow, reseated, smoothest_foot, without_bumps
from sketchtree.photo.trace.limbs import carried_on
from sketchtree.photo.trace.lines import evenly
from sketchtree.photo.trace.palette import Palette
from sketchtree.photo.trace.thickness import BLUR, TAPER, half_widths, largest_circle
from sketchtree.photo.trace.traced import Traced
from sketchtree.photo.trace.wood_likeness import WoodLikeness, learn_wood

WIDTHS = ("measured", "paper")
CIRCLE = 50.0 / 1500.0  # radius of the circle / longer side of the photo (§2)
_UNDER = 3.0 / 1500.0  # width of a stroke
_THICKEST = 0.12  # half a trunk / longer side of the photo
_ALL = 0.6  # of how far a limb's edges are looked for (NEAR_BY circles): a limb so thick leaves too little beside it
_ENOUGH = 0.6  # share of a stroke's places where a run of wood must be seen
_WALL = 3.0  # a run of wood so many times as wide as the edges say is a wall or a tree behind
_FLARE = 1.6  # a root's thickness / that of the thinner parts of the trunk above it, at most
_STEEPEST = 4.0  # of a stroke's distance from the limb it hangs on: so far below its nearest place its foot may lie, where a pen began beside the limb
_ONE_PLACE = 0.25  # of the circle's radius: a stroke that starts so near to another starts on it


@dataclass(frozen=True)
class Tracing:
    """How limbs are traced. `Tracing(strict=True, widths="paper")` is the paper's way."""

    circle: float = CIRCLE  # its radius / longer side of the photo
    strict: bool = False  # the paper's line of sight: not one pixel of it may be anything but wood
    widths: str = "measured"  # measured: where the photo shows them; paper: the root's, × 0.75 a generation
    most: int = 2_000  # places found, at most; 0: the strokes alone

    def __post_init__(self):
        if self.widths not in WIDTHS:
            raise OptionError(f"widths is {self.widths!r}, but must be {' or '.join(WIDTHS)}.", remedy=f"{WIDTHS[0]} is what is taken by default.")

    def __call__(self, photo: Photo, marked: Marked, foliage: Foliage | None = None, *, key: Key[Array, ""], palette: Palette | None = None) -> Traced:
        """The visible limbs of one tree. `palette`: the photo's, if it is at hand (strokes that come and go leave it as it is). Raises SketchError without a stroke."""
        if not marked.branches:
            raise SketchError("No stroke marks the trunk.", remedy="Draw one from the root up along the trunk.")
        longer = max(photo.width, photo.height)
        radius = max(self.circle * longer, 4.0)
        likeness = learn_wood(Palette.of(photo) if palette is None else palette, marked, foliage, width=max(round(_UNDER * longer), 1), key=key)
        walk, points = places_on(photo, likeness, marked, radius, _THICKEST * longer)
        walk = follow(likeness, walk, radius, on_strokes=points, within=room_for(marked, radius), most=self.most, strict=self.strict)
        walk = reseated(without_bumps(walk, radius), likeness, radius)
        if self.widths == "paper":
            return _table(walk, root_radius(likeness, marked.branches[0], radius, _THICKEST * longer))
        return _table(plainly_seen(walk, photo, radius), None)


def room_for(marked: Marked, radius: float) -> shapely.Geometry:
    """Where branches may be found: within the crown's stroke and a circle's width round it, above the root (ours: below lie grass, shadows and other trees)."""
    crown = shapely.make_valid(shapely.Polygon(marked.crown))
    room = crown.buffer(2 * radius)
    left, top, right, _ = room.bounds
    lowest = min(float(marked.branches[0][0][1]) - radius, crown.bounds[3] + radius)
    return room.intersection(shapely.box(left, min(top, lowest), right, lowest))


def places_on(photo: Photo, likeness: WoodLikeness, marked: Marked, radius: float, most: float) -> tuple[Walk, Float[np.ndarray, "point 2"]]:
    """(places half a circle apart on every stroke, points along all strokes a pixel or so apart). Each stroke but the first hangs on those before it, at the nearest
    place, or below it where it leaves more smoothly."""
    walk, points = Walk(), []
    for k, stroke in enumerate(marked.branches):
        fine, _ = evenly(stroke, 1.0)
        place, along = evenly(stroke, 0.5 * radius)
        half = half_along(photo, likeness, place, along, radius, most)
        above = NULL
        if k:
            known = np.array(walk.xy)
            above = int(np.argmin(np.hypot(*(known - place[0]).T)))
            gap = float(np.hypot(*(known[above] - place[0])))
            if gap < _ONE_PLACE * radius:
                place, half = place[1:], half[1:]
            else:
                above = smoothest_foot(known, walk.parent, walk.drawn, above, place[0], along[0], radius, _STEEPEST * gap)
        for spot, width in zip(place, np.minimum(half, np.inf if above == NULL else walk.half[above]), strict=True):
            above = walk.add(above, spot, float(width), k, True, 0)
        points.append(fine)
    return walk, np.concatenate(points)


def root_radius(likeness: WoodLikeness, stroke: Float[np.ndarray, "point 2"], radius: float, most: float) -> float:
    """Half the trunk's thickness at its root: the largest circle of wood there (§2), but no more than `_FLARE` times what is seen across the thinner parts of the trunk (ours: grass and
    shadow at the root may look like wood)."""
    place, along = evenly(stroke, 0.5 * radius)
    seen = half_widths(likeness, place, along, most)[: max(len(place) // 2, 2)]
    flare = _FLARE * float(np.nanpercentile(seen, 25)) if np.isfinite(seen).any() else np.inf
    return min(largest_circle(likeness, place[0], most, enough=flare), flare)


def half_along(
    photo: Photo, likeness: WoodLikeness, place: Float[np.ndarray, "place 2"], along: Float[np.ndarray, "place 2"], radius: float, most: float
) -> Float[np.ndarray, " place"]:
    """Half widths along a stroke whose places are half a circle apart: by the limb's edges, looked for near by at first and farther where it is thicker, and by the run of wood across it;
    the one that changes less from place to place counts for more (furrowed bark has many edges, a hedge behind a trunk is wood)."""
    reach = NEAR_BY * radius
    while True:
        half = edges_at(photo.rgb, place, along, reach=reach, step=0.5 * radius).half
        if np.median(half[: len(half) // 2 + 1]) < _ALL * reach or reach > most:
            break
        reach *= 2
    run = half_widths(likeness, place, along, most) - BLUR
    known = np.flatnonzero(run > 0)
    if len(known) < _ENOUGH * len(run) or np.median(run[known]) > _WALL * np.median(half[known]):
        return tapered(half, most)
    share = roughness(half) ** 2 / (roughness(half) ** 2 + roughness(run[known]) ** 2)
    half[known] = half[known] ** (1 - share) * run[known] ** share
    return tapered(half, most)


def _table(walk: Walk, root: float | None) -> Traced:
    """The joints that say something, with generations and radii: those seen, or `root` × TAPER a generation."""
    parent, xy, half = np.array(walk.parent), np.array(walk.xy), np.array(walk.half)
    carries = carried_on(parent, xy, half, np.array(walk.stroke), np.array(walk.drawn))
    generation = np.zeros(len(parent), np.int64)
    for row in range(1, len(parent)):
        if parent[row] != NULL:
            generation[row] = generation[parent[row]] + (carries[parent[row]] != row)
    thick = _narrowing(parent, carries, half) if root is None else root * TAPER**generation
    return Traced(parent, xy, thick, generation, np.array(walk.stroke), np.array(walk.drawn))


def _narrowing(parent, carries, half) -> Float[np.ndarray, " joint"]:
    """Measured half widths, none thicker than the one before it; a lateral at most `TAPER` of its parent's."""
    radius = np.array(half)
    for row in range(len(parent)):
        if parent[row] != NULL:
            most = radius[parent[row]] * (1.0 if carries[parent[row]] == row else TAPER)
            radius[row] = min(radius[row], most)
    return np.maximum(radius, 0.5)
