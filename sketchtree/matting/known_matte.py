"""The matte where somebody has one already: made by hand, or by another program."""

import os

import numpy as np

from sketchtree.errors import SketchError
from sketchtree.matting.alpha import Matte
from sketchtree.photo.photo import Photo
from sketchtree.photo.read_photo import read_photo


def read_matte(path: str | os.PathLike, photo: Photo) -> Matte:
    """A picture of the photo's size, white where the tree is, or transparent where it is not. Raises SketchError."""
    picture = read_photo(path)
    if (picture.width, picture.height) != (photo.width, photo.height):
        raise SketchError(
            f"{picture.name} has {picture.width} × {picture.height} pixels, the photo {photo.width} × {photo.height}.", remedy="Give a matte of the photo's size, or scribbles."
        )
    alpha = picture.rgb.mean(axis=2) if picture.alpha is None else picture.alpha
    return Matte((alpha / 255.0).astype(np.float32), "given")
