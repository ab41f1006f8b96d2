"""Which colour has the bark in the photo?

That of the pixels along the limbs that were traced, thick ones first, well inside their edges and below the foliage, if there are some. Of a backlit trunk a photo shows the shade, so a bark is
only as dark or as light as half the way (in powers, as the shadows of leaves are taken out) from the species' own, and of its hue only as much as its light shows. Y: lightness of the
linear colour c, c' = c / Y its hue, of the photo p and the species s:

    Y = (BRIGHTER Y_p)^½ Y_s^½, within DARKEST-LIGHTEST        c = Y (w c'_p + (1 − w) c'_s),   w = min(Y_p / SEEN, 1)

A grey photo says nothing, and a limb that isn't wider than THIN pixels hardly more than its edges.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Float
from PIL import Image, ImageDraw

from sketchtree.axes import NULL
from sketchtree.foliage.painting import to_linear
from sketchtree.geometry.bark import Colour, bark_colour
from sketchtree.photo.foliage import Foliage
from sketchtree.photo.photo import Photo
from sketchtree.photo.photo_leaves import BRIGHTER
from sketchtree.photo.trace.traced import Traced

DARKEST, LIGHTEST = 0.01, 0.6  # lightness of a bark, linear: wet yew, birch
SEEN = 0.02  # lightness of a pixel from which its hue is more than the camera's noise
THIN = 2.0  # pixels, radius
_INNER = 0.6  # of a limb's radius, where no sky shines round it
_FEW = 40  # pixels that say something
_ENOUGH = 2_000  # pixels, of the thickest limbs
_LIGHTNESS = np.array([0.2126, 0.7152, 0.0722])  # of linear sRGB


@dataclass(frozen=True)
class SeenBark:
    """The colour of the wood as the photo shows it, linear; None: it says nothing."""

    colour: Colour | None

    def __call__(self, bark: str) -> Colour | None:
        """The mean colour of a tree's bark of that name; None: its own."""
        if self.colour is None:
            return None
        seen, own = np.array(self.colour), np.array(bark_colour(bark))
        light, usual = max(float(seen @ _LIGHTNESS), 1e-4), float(own @ _LIGHTNESS)
        share = min(light / SEEN, 1.0)
        hue = share * seen / light + (1 - share) * own / usual
        return tuple(np.clip(np.clip(np.sqrt(BRIGHTER * light * usual), DARKEST, LIGHTEST) * hue, 0.0, 1.0).round(4).tolist())


def seen_bark(photo: Photo, foliage: Foliage, traced: Traced) -> SeenBark:
    """The wood's colour: the median of its pixels, in linear light."""
    if photo.is_grey:
        return SeenBark(None)
    wood = _wood(traced, foliage.mask.shape)
    clear = wood & ~foliage.mask
    wood = clear if clear.sum() >= _FEW and not foliage.bare else wood
    if wood.sum() < _FEW:
        return SeenBark(None)
    lit = to_linear(np.arange(256) / 255.0)[photo.rgb[wood]]
    return SeenBark(tuple(np.median(lit, axis=0).tolist()))


def _wood(traced: Traced, shape: tuple[int, int]) -> Bool[np.ndarray, "row column"]:
    """Pixels well inside the limbs, of the thickest that together have ENOUGH."""
    image = Image.new("L", shape[::-1])
    pen = ImageDraw.Draw(image)
    rows = np.flatnonzero((traced.parent != NULL) & (traced.radius >= THIN))
    length: Float[np.ndarray, " joint"] = np.hypot(*(traced.xy[rows] - traced.xy[traced.parent[rows]]).T)
    order = np.argsort(-traced.radius[rows], kind="stable")
    thickest, covered = rows[order], np.cumsum((2 * _INNER * traced.radius[rows] * length)[order])
    for row in thickest[: int(np.searchsorted(covered, _ENOUGH)) + 1]:
        pen.line([*traced.xy[traced.parent[row]].tolist(), *traced.xy[row].tolist()], fill=255, width=max(round(2 * _INNER * float(traced.radius[row])), 1))
    return np.asarray(image) > 0
