"""The photo in few colours, so that a question about all pixels is asked once a colour.

Each channel of the smoothed picture in steps of eight levels; a grey photo in all of its levels. Worth keeping while strokes come and go: it depends on the photo alone.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int
from scipy import ndimage

from sketchtree.photo.photo import Photo

_STEP = 8


@dataclass(frozen=True, eq=False)
class Palette:
    """A photo by number."""

    colour: Float[np.ndarray, "colour 3"]  # 0-255
    number: Int[np.ndarray, "row column"]  # which colour every pixel has

    @classmethod
    def of(cls, photo: Photo) -> "Palette":
        """The palette of the photo smoothed over 3 × 3 pixels (ours: grain and compression make single pixels lie)."""
        rgb = ndimage.uniform_filter(photo.rgb, size=(3, 3, 1), mode="nearest")
        if photo.is_grey:
            level = np.arange(256.0)
            return cls(np.stack([level] * 3, axis=1), rgb[..., 0].astype(np.int32))
        steps = 256 // _STEP
        bins = (rgb // _STEP).astype(np.int32)
        number = (bins[..., 0] * steps + bins[..., 1]) * steps + bins[..., 2]
        used = np.flatnonzero(np.bincount(number.reshape(-1), minlength=steps**3))
        place = np.zeros(steps**3, np.int32)
        place[used] = np.arange(len(used))
        colour = np.stack([used // steps**2, used // steps % steps, used % steps], axis=1) * _STEP + (_STEP - 1) / 2
        return cls(colour, place[number])
