"""Where does a photo show foliage that no leaf of the tree covers yet, and which twig bears one there?

Ours. Twigs bear most leaves where the light is. A leaf more is put with its middle over a place of the foliage that is open (at random, as likely as it is open), its foot on one of the
NEAR twigs that are seen nearest to there, within REACH of a leaf's length, whichever depth they have; its face is turned to the light, as every leaf's is (`foliage.populate`). It
is kept by the rule for every leaf: most of it in the foliage, and more of what it adds inside than outside. After ROUNDS of this what is still open has no twig near, or is finer than
a leaf. An umbel more stands on a short shoot s leaf lengths long, where its twig bears any (`umbels`).

    d = (u sin τ, ± cos τ)        sin τ = g / ((½ + s) l), at least FLATTEST        u: on the page, from foot to place    g: how far that is    l: the leaf's length
"""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
from jaxtyping import Array, Bool, Float, Int, Key
from scipy.spatial import cKDTree

from sketchtree.foliage.buds import SUNK
from sketchtree.foliage.leaves import Leaves, select
from sketchtree.foliage.twigs import Twigs
from sketchtree.keys import numpy_generator, stage_key
from sketchtree.photo.leaf_cover import INSIDE, Page
from sketchtree.photo.leaf_spots import LeafSpots, seen_area, spot_count
from sketchtree.photo.photo_leaves import SeenFoliage
from sketchtree.photo.umbels import on_own_shoots, stalk

ROUNDS = 4
NEAR = 6
REACH = 0.75
FLATTEST = 0.6
THICKEST = 0.4  # leaf lengths: thicker wood bears no leaf here
_CLOSE = 0.25  # leaf lengths: a foot nearer to the place than that would have its leaf look at the viewer, and is taken last
_TRIES = 4.0  # leaves that are tried, over what would cover all that is open
_EVERY = 1 / 3  # leaf lengths between two places on a twig
_SMALLEST, _LARGEST = 0.85, 1.15  # of the leaves that are there
_OUTWARD, _ASTRAY = 0.4, 0.5  # of the light's direction: out of the crown, and at random
_UP = np.array([0.0, 1.0, 0.0])
Bears = Callable[[Float[np.ndarray, "foot 3"], Int[np.ndarray, " foot"], np.random.Generator], Bool[np.ndarray, " foot"]]


def filled(
    leaves: Leaves, page: Page, seen: SeenFoliage, wood: Twigs, axis: Float[np.ndarray, " 3"], *, most: int, key: Key[Array, ""], bears: Bears | None = None,
) -> Leaves:  # fmt: skip
    """The leaves and as many more as it takes, `most` in all. `wood` bears them; `axis`: a place that out of the crown is away from, metres. `bears`: leaves are umbels, on short
    shoots, where it says so."""
    if len(leaves) == 0:
        return leaves
    size, draw = float(np.median(leaves.size)), numpy_generator(stage_key(key, "filling"))
    length = size / seen.similarity.scale
    count, feet = spot_count(leaves.model, length), _Feet.on(wood.select(np.maximum(wood.start_radius, wood.end_radius) <= THICKEST * size), seen, _EVERY * size)
    if bears is not None:
        feet = feet.select(bears(feet.place, feet.segment, draw))
    if len(feet) == 0:
        return leaves
    spots = LeafSpots.of(leaves, seen, count)
    depth = page.depth(page.pixels(*spots.at(1.0)), spots.area)
    for _ in range(ROUNDS):
        left = np.where(page.mask, page.open(depth), 0.0)
        room = most - len(leaves)
        tries = int(min(_TRIES * left.sum() / seen_area(leaves.model, length), 2 * room))
        if tries <= 0:
            break
        more = _tried(leaves, feet, _open_places(page, left, tries, draw), size, length, axis, draw, on_shoots=bears is not None)
        spots = LeafSpots.of(more, seen, count)
        pixel = page.pixels(*spots.at(1.0))
        inside = page.mask[pixel]
        gain = page.open(depth)[pixel] * np.minimum(spots.area, 1.0)
        good = np.flatnonzero((inside.mean(axis=1) >= INSIDE) & (np.where(inside, gain, -gain).sum(axis=1) > 0))[:room]
        depth = depth + page.depth(pixel[good], spots.area[good])
        leaves = followed(leaves, replace(select(more, good), shoot=more.shoot[good] if len(more.shoot) else more.shoot))
    return leaves


def followed(leaves: Leaves, more: Leaves) -> Leaves:
    """Both, in this order."""
    columns = ("position", "direction", "normal", "size", "tint", "segment", "shoot")
    return replace(leaves, **{name: np.concatenate([getattr(leaves, name), getattr(more, name)]) for name in columns})


class _Feet:
    """Places along the twigs where a leaf may start."""

    def __init__(self, place, radius, segment, seen: SeenFoliage):
        self.place, self.radius, self.segment = place, radius, segment
        self.photo, self.seen = seen, seen.pixels(place)
        self.nearest = cKDTree(self.seen, balanced_tree=False, compact_nodes=False) if len(place) else None

    def __len__(self) -> int:
        return len(self.place)

    @classmethod
    def on(cls, wood: Twigs, seen: SeenFoliage, every: float) -> "_Feet":
        """One each `every` metres."""
        count = np.maximum(np.ceil(wood.length / every), 1).astype(np.int64)
        piece = np.repeat(np.arange(len(wood)), count)
        share = (np.arange(len(piece)) - np.repeat(np.cumsum(count) - count, count) + 0.5) / count[piece]
        radius = wood.start_radius[piece] + share * (wood.end_radius - wood.start_radius)[piece]
        return cls(wood.start[piece] + share[:, None] * (wood.end - wood.start)[piece], radius, wood.row[piece], seen)

    def select(self, keep: Bool[np.ndarray, " foot"]) -> "_Feet":
        """Only some of them."""
        return _Feet(self.place[keep], self.radius[keep], self.segment[keep], self.photo)

    def for_places(self, place: Float[np.ndarray, "place 2"], length: float, draw: np.random.Generator) -> tuple[Int[np.ndarray, " place"], Float[np.ndarray, " place"]]:
        """(a foot for each place, how far it is seen from there; infinite where none is near)."""
        away, foot = self.nearest.query(place, k=NEAR, distance_upper_bound=REACH * length)
        taken = (draw.random(away.shape) + np.where(away < _CLOSE * length, 1.0, 0.0) + np.where(np.isfinite(away), 0.0, np.inf)).argmin(axis=1)[:, None]
        return np.take_along_axis(foot, taken, axis=1)[:, 0], np.take_along_axis(away, taken, axis=1)[:, 0]


def _open_places(page: Page, left: Float[np.ndarray, " pixel"], count: int, draw: np.random.Generator) -> Float[np.ndarray, "place 2"]:
    """Places in the photo, as likely as they are open."""
    run = np.cumsum(left, dtype=float)
    pixel = np.minimum(np.searchsorted(run, draw.random(count) * run[-1], side="right"), len(run) - 1)
    return page.places(pixel, draw.random((count, 2)))


def _tried(leaves: Leaves, feet: _Feet, place, size: float, length: float, axis, draw: np.random.Generator, *, on_shoots: bool) -> Leaves:
    """A leaf over each place that a foot is near, or an umbel on a short shoot."""
    foot, away = feet.for_places(place, length, draw)
    found = np.isfinite(away)
    foot, away, place = foot[found], away[found], place[found]
    along = (place - feet.seen[foot]) / np.maximum(away, 1e-9)[:, None]
    shoot = stalk(draw.random(len(foot))) if on_shoots else np.zeros(len(foot))
    flat = np.clip(away / (length * (0.5 + shoot)), FLATTEST, 1.0)
    to_viewer = np.sqrt(1.0 - flat**2) * np.where(draw.random(len(foot)) < 0.5, -1.0, 1.0)
    direction = _unit(np.column_stack([flat * along[:, 0], -flat * along[:, 1], to_viewer]))
    light = _UP + _OUTWARD * _unit((feet.place[foot] - axis) * [1.0, 0.0, 1.0]) + _ASTRAY * draw.normal(size=(len(foot), 3))
    across = light - np.einsum("ij,ij->i", light, direction)[:, None] * direction
    start = feet.place[foot] + SUNK * feet.radius[foot][:, None] * direction
    sizes = size * draw.uniform(_SMALLEST, _LARGEST, len(foot))
    plain = Leaves(leaves.model, start, direction, _unit(across), sizes, draw.random(len(foot)), feet.segment[foot])
    return on_own_shoots(plain, size * shoot, draw) if on_shoots else plain


def _unit(vector):
    return vector / np.maximum(np.linalg.norm(vector, axis=1, keepdims=True), 1e-12)
