"""Which leaves of a grown tree does the photo confirm, and in which colours does it show them (§4)?

"We keep only those leaves that are projected inside the foliage region in the input image. Leaves are textured according to their projected position." A leaf
looks through the page at its middle. Its colour is the mean of the pixels within half a leaf of there that show a leaf, or of the nearest such pixels (ours). A pixel shows a leaf where
its colour is likelier a leaf's than that of what is between the leaves, is not most of the way to the latter (a blossom no broader than a pixel is half sky), and is not on a limb that
was traced: so no leaf is as blue as the sky, or as brown as the wood.

A photo's colours have its light and shadows in them, and whoever draws the tree throws others. So half of the shadows are taken out, and leaves are as bright as in light of their own
(ours; Y the lightness of a leaf, Ȳ that of the brighter ones, c and c̄ the colours at lightness 1, of the leaf and of the brighter ones):

    Y' = BRIGHTER Y^(1 − SHADE) Ȳ^SHADE        c' = c̄ + min(Y / Ȳ, 1)^½ (c − c̄)

What is darkest tells least of its colour. And where blue outweighs red, it does so hardly more than in the brighter ones: that is the sky's light, or the sky.
"""

from dataclasses import dataclass, replace

import numpy as np
from jaxtyping import Bool, Float
from PIL import Image, ImageDraw
from scipy import ndimage

from sketchtree.axes import NULL
from sketchtree.foliage.leaves import Leaves, select
from sketchtree.foliage.painting import to_linear
from sketchtree.photo.foliage import Foliage
from sketchtree.photo.photo import Photo, at_pixels, turned_over
from sketchtree.photo.trace.traced import Traced
from sketchtree.similarity import Similarity

SHADE = 0.5  # of the photo's shadows, in powers, is taken out
BRIGHTER = 1.5  # times the photo's light
BLUER = 1.1  # times the blue of the brighter ones, where blue outweighs red
_PERCENT = 75  # percent of the leaves that are darker than the brighter ones
_LIGHTNESS = np.array([0.2126, 0.7152, 0.0722])  # of linear sRGB
_PURE = 0.6  # of the way that leaves are from what is between them, for the most part


@dataclass(frozen=True, eq=False)
class SeenFoliage:
    """The foliage of one tree in its photo, and where the photo hangs in the world."""

    photo: Photo
    mask: Bool[np.ndarray, "row column"]
    similarity: Similarity  # pixels, y up → metres
    leafy: Bool[np.ndarray, "row column"] | None = None  # pixels of the mask that show a leaf; None: all

    def pixels(self, place: Float[np.ndarray, "place 3"]) -> Float[np.ndarray, "place 2"]:
        """Where places of the world are seen in the photo (orthographic camera, §3.1); pixels, y down."""
        return turned_over(self.similarity.to_sketch(place)[:, :2])

    def moved(self, by: Float[np.ndarray, " 3"]) -> "SeenFoliage":
        """The same hanging elsewhere in the world, metres."""
        return replace(self, similarity=Similarity(self.similarity.scale, tuple((np.asarray(self.similarity.translate) + by).tolist())))

    def confirmed(self, leaves: Leaves) -> Leaves:
        """The leaves that project into the foliage, and the short shoots that end in it."""
        kept = select(leaves, at_pixels(self.mask, self.pixels(middles(leaves))))
        return replace(kept, shoot=leaves.shoot[at_pixels(self.mask, self.pixels(leaves.shoot[:, 1]))])

    def coloured(self, leaves: Leaves) -> Leaves:
        """The same leaves in the colours of the photo."""
        if len(leaves) == 0:
            return leaves
        reach = max(int(round(0.5 * float(np.median(leaves.size)) / self.similarity.scale)), 1)
        picture, known = self._foliage_alone(reach)
        place = self.pixels(middles(leaves))
        column, row = np.floor(place).astype(np.int64).T
        row, column = np.clip(row, 0, self.photo.height - 1), np.clip(column, 0, self.photo.width - 1)
        nearest = ndimage.distance_transform_edt(~known, return_distances=False, return_indices=True)[:, row, column] if known.any() else np.stack([row, column])
        return replace(leaves, seen=picture[nearest[0], nearest[1]])

    def _foliage_alone(self, reach: int) -> tuple[Float[np.ndarray, "row column 3"], Bool[np.ndarray, "row column"]]:
        """(means of the foliage's linear colours over squares, where there is any)."""
        weight = (self.mask if self.leafy is None else self.leafy).astype(np.float32)
        side = 2 * reach + 1
        near = ndimage.uniform_filter(weight, side, mode="constant")
        lit = to_linear(np.arange(256) / 255.0).astype(np.float32)[self.photo.rgb] * weight[..., None]
        total = ndimage.uniform_filter(lit, (side, side, 1), mode="constant")
        known = near > 0.5 / side**2
        return np.where(known[..., None], total / np.maximum(near, 1e-9)[..., None], 0.0), known


def without_shadows(colour: Float[np.ndarray, "leaf 3"]) -> Float[np.ndarray, "leaf 3"]:
    """Linear colours of leaves with half of the photo's shadows taken out."""
    light = np.maximum(colour @ _LIGHTNESS, 1e-4)
    bright = float(np.percentile(light, _PERCENT))
    own = colour / light[:, None]
    usual = np.median(own[light >= bright], axis=0)
    cold = (own[:, 2] > own[:, 0]) & (own[:, 2] > BLUER * usual[2])
    own[cold] = usual + ((BLUER - 1) * usual[2] / (own[cold, 2] - usual[2]))[:, None] * (own[cold] - usual)
    mixed = usual + np.sqrt(np.minimum(light / bright, 1.0))[:, None] * (own - usual)
    return np.clip(mixed * (BRIGHTER * light ** (1 - SHADE) * bright**SHADE)[:, None], 0.0, 1.0)


def leafy_pixels(photo: Photo, foliage: Foliage, traced: Traced | None = None) -> Bool[np.ndarray, "row column"]:
    """The pixels of the foliage that show a leaf; all of them where none does."""
    room = foliage.mask if traced is None else foliage.mask & ~wood_pixels(traced, foliage.mask.shape)
    if not room.any():
        return foliage.mask
    colour = photo.rgb[room].astype(np.float32)
    likely = foliage.leaf.log_density(colour) > foliage.background.log_density(colour)
    if not likely.any():
        return foliage.mask
    away = np.linalg.norm(colour[:, None] - foliage.background.mean[None].astype(np.float32), axis=2).min(axis=1)
    own = np.zeros_like(foliage.mask)
    own[room] = likely & (away >= _PURE * np.percentile(away[likely], 75))
    return own


def wood_pixels(traced: Traced, shape: tuple[int, int]) -> Bool[np.ndarray, "row column"]:
    """The pixels of limbs that were traced."""
    image = Image.new("L", shape[::-1])
    pen = ImageDraw.Draw(image)
    for row in np.flatnonzero(traced.parent != NULL):
        up = traced.parent[row]
        pen.line([*traced.xy[up].tolist(), *traced.xy[row].tolist()], fill=255, width=max(round(2 * float(traced.radius[row])), 1))
    return np.asarray(image) > 0


def middles(leaves: Leaves) -> Float[np.ndarray, "leaf 3"]:
    """The middle of every blade, metres."""
    return leaves.position + 0.5 * leaves.size[:, None] * leaves.direction
