"""Which leaves of a grown tree does the photo confirm, and in which colours does it show them (§4)?

"We keep only those leaves that are projected inside the foliage region in the input image. Leaves are textured according to their projected position." A leaf looks through the page at
its middle. Its colour is the mean of the pixels within REACH of a leaf from there that show a leaf, or of the nearest such pixels (ours). A pixel shows a leaf where its colour is likelier
a leaf's than that of what is between the leaves, is not most of the way to the latter (a blossom no broader than a pixel is half sky), and is not on a limb that was traced: so no leaf is
as blue as the sky, or as brown as the wood.

A photo's colours have its light and shadows in them, and whoever draws the tree throws others. So half of the shadows are taken out, and leaves are as bright as in light of their own
(ours; Y the lightness of a leaf, Ȳ that of the brighter ones, c and c̄ the colours at lightness 1, of the leaf and of the brighter ones):

    Y' = BRIGHTER Y^(1 − SHADE) Ȳ^SHADE        c' = 1 + VIVID (c̄ + min(Y / Ȳ, 1)^½ (c − c̄) − 1)

What is darkest tells least of its colour. And where blue outweighs red, it does so hardly more than in the brighter ones: that is the sky's light, or the sky.
"""

from dataclasses import dataclass, replace

import numpy as np
from jaxtyping import Bool, Float
from PIL import Image, ImageDraw
from scipy import ndimage
from scipy.spatial import cKDTree

from sketchtree.axes import NULL
from sketchtree.foliage.leaves import Leaves, select
from sketchtree.foliage.painting import to_linear
from sketchtree.photo.foliage import Foliage
from sketchtree.photo.photo import Photo, at_pixels, turned_over
from sketchtree.photo.trace.traced import Traced
from sketchtree.similarity import Similarity

REACH = 0.2  # leaf lengths: pixels so far from where it is seen count for its colour; farther, and all leaves become alike
SHADE = 0.5  # of the photo's shadows, in powers, is taken out
BRIGHTER = 1.25  # times the photo's light: leaves shade each other, so a crown comes out darker than its leaves are (six colour photos: by as much, within 6 units of L*)
VIVID = 1.15  # times as far from grey: they shine, too, so a crown comes out greyer (by a sixth)
BLUER = 1.1  # times the blue of the brighter ones, where blue outweighs red
_DARKER = 75  # percent of the leaves that are darker than the brighter ones
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

    def coarser(self, times: int) -> "SeenFoliage":
        """The foliage in pixels so many times as large; where most of one is foliage, it is."""
        if times == 1:
            return self
        rows, columns = (-(-side // times) for side in self.mask.shape)
        whole = np.zeros((rows * times, columns * times), bool)
        whole[: self.mask.shape[0], : self.mask.shape[1]] = self.mask
        share = whole.reshape(rows, times, columns, times).mean(axis=(1, 3))
        return replace(self, mask=share >= 0.5, similarity=Similarity(times * self.similarity.scale, self.similarity.translate), leafy=None)

    def confirmed(self, leaves: Leaves) -> Leaves:
        """The leaves that project into the foliage, and the short shoots they stand on."""
        return on_shoots(select(leaves, at_pixels(self.mask, self.pixels(middles(leaves)))))

    def coloured(self, leaves: Leaves) -> Leaves:
        """The same leaves in the colours of the photo."""
        if len(leaves) == 0:
            return leaves
        reach = max(int(round(REACH * float(np.median(leaves.size)) / self.similarity.scale)), 1)
        leafy = self.mask if self.leafy is None else self.leafy
        box = box_of(leafy)
        place = np.floor(self.pixels(middles(leaves))).astype(np.int64) - [box[1].start, box[0].start]
        column, row = (np.clip(place[:, axis], 0, leafy[box].shape[1 - axis] - 1) for axis in (0, 1))
        picture, known = _foliage_alone(self.photo.rgb[box], leafy[box], reach)
        if not known[row, column].all():
            row, column = ndimage.distance_transform_edt(~known, return_distances=False, return_indices=True)[:, row, column]
        return replace(leaves, seen=picture[row, column])


def box_of(mask: Bool[np.ndarray, "row column"]) -> tuple[slice, slice]:
    """The least rectangle that holds a mask; the whole of an empty one."""
    rows, columns = (np.flatnonzero(mask.any(axis=axis)) for axis in (1, 0))
    return np.s_[rows[0] : rows[-1] + 1, columns[0] : columns[-1] + 1] if len(rows) else np.s_[0 : mask.shape[0], 0 : mask.shape[1]]


def _foliage_alone(rgb, leafy, reach: int) -> tuple[Float[np.ndarray, "row column 3"], Bool[np.ndarray, "row column"]]:
    """(means of the foliage's linear colours over squares, where there is any)."""
    side = 2 * reach + 1
    near = ndimage.uniform_filter(leafy.astype(np.float32), side, mode="constant")
    lit = to_linear(np.arange(256) / 255.0).astype(np.float32)[rgb] * leafy[..., None]
    total = np.stack([ndimage.uniform_filter(lit[..., channel], side, mode="constant") for channel in range(3)], axis=2)
    return total / np.maximum(near, 1e-9)[..., None], near > 0.5 / side**2


def without_shadows(colour: Float[np.ndarray, "leaf 3"]) -> Float[np.ndarray, "leaf 3"]:
    """Linear colours of leaves with a share of the photo's shadows taken out. (Of flowers: `petals`.)"""
    light = np.maximum(colour @ _LIGHTNESS, 1e-4)
    bright = float(np.percentile(light, _DARKER))
    own = colour / light[:, None]
    usual = np.median(own[light >= bright], axis=0)
    cold = (own[:, 2] > own[:, 0]) & (own[:, 2] > BLUER * usual[2])
    own[cold] = usual + ((BLUER - 1) * usual[2] / (own[cold, 2] - usual[2]))[:, None] * (own[cold] - usual)
    mixed = usual + np.sqrt(np.minimum(light / bright, 1.0))[:, None] * (own - usual)
    return np.clip((1.0 + VIVID * (mixed - 1.0)) * (BRIGHTER * light ** (1 - SHADE) * bright**SHADE)[:, None], 0.0, 1.0)


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


def on_shoots(leaves: Leaves) -> Leaves:
    """The same without the short shoots that bear none of them: no leaf starts nearer to the end of those than they are long."""
    if len(leaves.shoot) == 0:
        return leaves
    end, length = leaves.shoot[:, 1], np.linalg.norm(leaves.shoot[:, 1] - leaves.shoot[:, 0], axis=1)
    if len(leaves) == 0:
        return replace(leaves, shoot=leaves.shoot[:0])
    away, _ = cKDTree(leaves.position, balanced_tree=False, compact_nodes=False).query(end, distance_upper_bound=float(length.max()))
    return replace(leaves, shoot=leaves.shoot[away < length])
