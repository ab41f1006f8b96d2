"""The foliage where somebody has marked it already: a mask made by hand, or by another program."""

import os

import numpy as np
from jaxtyping import Array, Bool, Key

from sketchtree.errors import SketchError
from sketchtree.keys import stage_key
from sketchtree.photo.appearance import fit_mixture
from sketchtree.photo.foliage import Foliage
from sketchtree.photo.foliage_mask import within
from sketchtree.photo.marked import Marked
from sketchtree.photo.photo import Photo
from sketchtree.photo.read_photo import read_photo

_LEAF, _BACKGROUND = 4, 6  # components, as many as the paper's rule has


def read_mask(path: str | os.PathLike, photo: Photo) -> Bool[np.ndarray, "row column"]:
    """A grey picture of the photo's size, white where foliage is. Raises SketchError."""
    picture = read_photo(path)
    if (picture.width, picture.height) != (photo.width, photo.height):
        raise SketchError(
            f"{picture.name} has {picture.width} × {picture.height} pixels, the photo {photo.width} × {photo.height}.", remedy="Give a mask of the photo's size, or none."
        )
    return picture.rgb.mean(axis=2) > 127


def known_foliage(photo: Photo, marked: Marked, mask: Bool[np.ndarray, "row column"], *, key: Key[Array, ""]) -> Foliage:
    """What of a mask lies within the stroke round a tree's crown, and its colours. Raises SketchError where that is nothing."""
    inside = within(marked.crown, mask.shape)
    own = mask & inside
    if not own.any():
        raise SketchError("the mask is black everywhere within it.", stroke=marked.crown_name, remedy="Draw it round the white part of the mask.")
    between = inside & ~mask if (inside & ~mask).any() else ~mask
    between = between if between.any() else mask
    leaf, background = (
        fit_mixture(photo.rgb[where], count, key=stage_key(key, name)) for where, count, name in ((own, _LEAF, "leaf"), (between, _BACKGROUND, "background"))
    )
    return Foliage(own, inside, leaf, background)
