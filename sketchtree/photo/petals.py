"""Which pixels of a photo show petals, and which colours do its flowers have?

Petals are what is not bluer than red (a sky is, and what is half sky; BLUE) and hardly greenish (`flowering.GREENISH`), and of that the brighter half: they are paler than the twigs and the
young leaves between them. `photo_leaves.leafy_pixels` asks what is farther from the sky in colour, which white is less than wood.

All flowers of a tree have one hue, near enough, and its speckle is light and shade. So the hue is that of the petals, and a little of the petals near by; the lightness that of the place
where a flower is seen, with a share of the shade taken out, since whoever draws the tree throws another:

    c = L (ĉ + OWN (c_near − ĉ))        L = BRIGHTER Y^(1 − SHADE) Ŷ^SHADE        ĉ, Ŷ: hue and lightness of those in the sun    Y: of the place
"""

from dataclasses import replace

import numpy as np
from jaxtyping import Bool, Float

from sketchtree.foliage.leaves import Leaves
from sketchtree.photo.flowering import GREENISH
from sketchtree.photo.photo import Photo
from sketchtree.photo.photo_leaves import SeenFoliage

BLUE = 1.1  # times the red: petals of a wild cherry in the sun have .95, half before the sky 1.3
OWN = 0.25  # of how the hue differs from that of all; more, and the drawing is mottled
SHADE = 0.35  # of the photo's, in powers, is taken out: less than of leaves (`photo_leaves`), since white and its shade is all that flowers show
DARKEST = 0.15  # of the lightness in the sun: what is darker is wood, or the gap between flowers
BRIGHTER = 1.6  # times the photo's light: more than of leaves (`photo_leaves`), since petals are brightest in the sun and the mean over a square has the gaps between them in it
_DARKER = 75  # percent of the flowers that are darker than those in the sun
_LIGHTNESS = np.array([0.2126, 0.7152, 0.0722], np.float32)  # of linear sRGB


def petal_pixels(photo: Photo, mask: Bool[np.ndarray, "row column"]) -> Bool[np.ndarray, "row column"]:
    """Those of the mask; all of it where none does."""
    colour = photo.rgb[mask].astype(np.float32)
    sum_ = np.maximum(colour.sum(axis=1), 1.0)
    shows = (colour[:, 2] <= BLUE * colour[:, 0]) & (3.0 * colour[:, 1] - sum_ <= GREENISH * sum_)
    light = colour @ _LIGHTNESS
    if not shows.any():
        return mask
    shows &= light >= np.median(light[shows])
    found = np.zeros_like(mask)
    found[mask] = shows
    return found


def flower_colours(seen: SeenFoliage, flowers: Leaves) -> Float[np.ndarray, "flower 3"]:
    """Linear colours of the flowers of a photo's tree."""
    petals = replace(seen, leafy=petal_pixels(seen.photo, seen.mask)).coloured(flowers).seen
    place = replace(seen, leafy=None).coloured(flowers).seen
    light = np.maximum(petals @ _LIGHTNESS, 1e-4)
    hue, bright = petals / light[:, None], float(np.percentile(light, _DARKER))
    usual = np.median(hue[light >= bright], axis=0)
    own = BRIGHTER * np.maximum(place @ _LIGHTNESS, DARKEST * bright) ** (1 - SHADE) * bright**SHADE
    return np.clip((usual + OWN * (hue - usual)) * own[:, None], 0.0, 1.0)
