"""How much of each pixel is tree, by which method? The names of the methods, and what is done around each: alpha that the file has, size, warnings."""

from collections.abc import Callable

import numpy as np
from jaxtyping import Array, Key
from PIL import Image

from sketchtree.errors import OptionError, SketchError
from sketchtree.matting.alpha import Matte
from sketchtree.matting.closed_form import closed_form
from sketchtree.matting.layered import layered
from sketchtree.matting.normalised import normalised
from sketchtree.matting.scribbles import Scribbles
from sketchtree.matting.standing_out import TOLD, stands_out
from sketchtree.photo.photo import Photo
from sketchtree.watch import Pulse, no_pulse

__all__ = ["DEFAULT", "LARGEST", "MATTINGS", "Matte", "find_matte"]

MATTINGS: dict[str, Callable[..., Matte]] = {"layered": layered, "closed-form": closed_form, "normalised": normalised}
DEFAULT = "layered"
LARGEST = 400_000  # pixels that are worked on: the factors of 10⁶ take some gigabytes
_SMALLEST = 3  # pixels: a window
_FULL = 250  # of 255: alpha from which a file's own counts as none


def find_matte(photo: Photo, scribbles: Scribbles | None, *, key: Key[Array, ""], method: str = DEFAULT, largest: int = LARGEST, pulse: Pulse = no_pulse) -> Matte:
    """The matte of a photo: its own alpha where it has one, else by a method and scribbles; `pulse` is called a few times a second meanwhile. Raises SketchError for scribbles of which one side marks nothing."""
    if method not in MATTINGS:
        raise OptionError(f"There is no matting called '{method}'.", remedy=f"Choose one of: {', '.join(MATTINGS)}.")
    if photo.alpha is not None and (photo.alpha < _FULL).any():
        told = f"{photo.name} is transparent in part; its own alpha was taken as the matte" + (", and the scribbles were not used." if scribbles is not None else ".")
        return Matte(photo.alpha / np.float32(255), "alpha of the file", (), (told,))
    if scribbles is None:
        raise SketchError(f"{photo.name} needs scribbles that say what is tree.", remedy="Give --scribbles FILE: one line along the trunk (foreground), one beside the tree (background).")
    if min(photo.width, photo.height) < _SMALLEST:
        raise SketchError(f"{photo.name} has {photo.width} × {photo.height} pixels; {_SMALLEST} × {_SMALLEST} are the least.", remedy="Give a larger photo.")
    fore, back = scribbles.masks(photo)  # what is wrong with them is said of the photo as it is
    said = (*scribbles.warnings, *scribbles.overlapping(photo))
    if photo.width * photo.height <= largest:
        found = MATTINGS[method](photo, scribbles, key=key, pulse=pulse)
    else:
        found = _smaller(photo, scribbles, method, largest, key, pulse)
    said += () if stands_out(photo, fore, back, found.alpha, key) else (TOLD,)
    return Matte(found.alpha, found.method, found.course, (*said, *found.warnings))


def _smaller(photo: Photo, scribbles: Scribbles, method: str, largest: int, key, pulse: Pulse) -> Matte:
    """The matte of a smaller copy, enlarged."""
    scale = (largest / (photo.width * photo.height)) ** 0.5
    size = max(int(photo.width * scale), _SMALLEST), max(int(photo.height * scale), _SMALLEST)
    small = Photo(np.asarray(Image.fromarray(photo.rgb).resize(size, Image.Resampling.BOX)), None, photo.name)
    along = np.array([size[0] / photo.width, size[1] / photo.height])
    found = MATTINGS[method](small, _apart(scribbles.scaled(along, scale), small), key=key, pulse=pulse)
    alpha = np.asarray(Image.fromarray(np.asarray(found.alpha)).resize((photo.width, photo.height), Image.Resampling.BILINEAR))
    told = f"{photo.name} has {photo.width} × {photo.height} pixels; the matte was found on {size[0]} × {size[1]} and enlarged."
    return Matte(np.clip(alpha, 0, 1), found.method, found.course, (told, *found.warnings))


def _apart(scribbles: Scribbles, photo: Photo) -> Scribbles:
    """The scribbles with as narrow a brush as it takes that of both sides something is left on the small photo too."""
    try:
        scribbles.masks(photo)
    except SketchError as error:
        if "lie over all" not in error.message or scribbles.brush < 1e-3:
            raise
        return _apart(scribbles.scaled(np.ones(2), 0.5), photo)
    return scribbles
