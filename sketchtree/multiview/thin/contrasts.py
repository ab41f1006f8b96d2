"""Where do photos show wood too thin for depth maps? As a faint line before sky or an even cloth (ours).

A twig half as wide as a pixel has no depth of its own, but darkens the pixels that it crosses by half of what wide wood does, in every photo that has nothing behind it. So

    c   how far a pixel's colour is from that of the even place or the sky nearest to it, in the channel where they differ most; 1 where none is near

is read along the way that a twig would take, and `BESIDE` pixels to either side. A photo *shows* the twig there if c is more than noise on it and noise beside it; it looks *past*
the place if c is noise on it; else it says nothing, since other wood is behind or before. A twig is there if `LEAST` photos or more show it, and but a `SHARE` of those that say
anything look past.
"""

from typing import NamedTuple

import numpy as np
from jaxtyping import Bool, Float, Int

from sketchtree.multiview.cameras import Camera
from sketchtree.multiview.compiled import compiled
from sketchtree.multiview.outline import off_even
from sketchtree.multiview.workplace import block

NOISE = 0.03  # c of an even place
BESIDE = 2.2  # pixels
CLEAR = 0.5  # of c on the line: what c beside it may be, if it is more than noise
LEAST = 3  # photos
SHARE = 0.3
NEAR = 6  # pixels to the even place: farther in, all is plant
ABOUT = 0.6  # pixels: the line may be so far beside where it is thought to be


class Contrasts(NamedTuple):
    """What all photos show of thin wood, in the frame of their cloud."""

    to_pixel: Float[np.ndarray, "view 3 4"]
    contrast: Int[np.ndarray, "view row column"]  # c, 0-255
    sizes: Int[np.ndarray, "view 2"]  # width and height

    def scaled(self, by: float) -> "Contrasts":
        """The same of a cloud that was made so many times larger."""
        return self._replace(to_pixel=self.to_pixel * np.array([1.0 / by, 1.0 / by, 1.0 / by, 1.0]))


def contrasts_of(cameras: list[Camera], rgb: list[np.ndarray], empty: list[np.ndarray]) -> Contrasts:
    """Of all photos: [row column 3] colours and which pixels show nothing of the plant."""
    shown = block([np.round(255 * contrast(*one)).astype(np.uint8) for one in zip(rgb, empty, strict=True)])
    return Contrasts(np.array([camera.to_pixel for camera in cameras]), shown, np.array([camera.size for camera in cameras], np.int64))


def contrast(rgb: Float[np.ndarray, "row column 3"], empty: Bool[np.ndarray, "row column"]) -> Float[np.ndarray, "row column"]:
    """c of every pixel."""
    if not empty.any():
        return np.ones(empty.shape, np.float32)
    off, away = off_even(rgb, empty)
    return np.where(empty, 0.0, np.where(away <= NEAR, np.minimum(off, 1.0), 1.0)).astype(np.float32)


@compiled
def read(contrast, view, width, height, u, v):
    """c between four pixels, 0-1; −1 outside the picture."""
    if not (u >= 0.5 and v >= 0.5 and u < width - 0.5 and v < height - 0.5):
        return -1.0
    u, v = min(u - 0.5, width - 1.001), min(v - 0.5, height - 1.001)
    i, j = int(u), int(v)
    u, v = u - i, v - j
    top = contrast[view, j, i] * (1.0 - u) + contrast[view, j, i + 1] * u
    low = contrast[view, j + 1, i] * (1.0 - u) + contrast[view, j + 1, i + 1] * u
    return (top * (1.0 - v) + low * v) / 255.0


@compiled
def told(start, end, to_pixel, contrast, sizes):
    """(photos that show a line between two places, that look past it, sum of c of those that show it)."""
    shows, past, much = 0, 0, 0.0
    for view in range(len(to_pixel)):
        p = to_pixel[view]
        za = p[2, 0] * start[0] + p[2, 1] * start[1] + p[2, 2] * start[2] + p[2, 3]
        zb = p[2, 0] * end[0] + p[2, 1] * end[1] + p[2, 2] * end[2] + p[2, 3]
        if za <= 0.0 or zb <= 0.0:
            continue
        ua = (p[0, 0] * start[0] + p[0, 1] * start[1] + p[0, 2] * start[2] + p[0, 3]) / za
        va = (p[1, 0] * start[0] + p[1, 1] * start[1] + p[1, 2] * start[2] + p[1, 3]) / za
        ub = (p[0, 0] * end[0] + p[0, 1] * end[1] + p[0, 2] * end[2] + p[0, 3]) / zb
        vb = (p[1, 0] * end[0] + p[1, 1] * end[1] + p[1, 2] * end[2] + p[1, 3]) / zb
        long = np.sqrt((ub - ua) ** 2 + (vb - va) ** 2)
        if long < 0.7:  # end on: its sides can't be told
            continue
        nu, nv = -(vb - va) / long, (ub - ua) / long
        middle, beside, outside = 0.0, 0.0, False
        for k in range(2):
            share = 0.3 + 0.5 * k
            u, v = ua + share * (ub - ua), va + share * (vb - va)
            on = 0.0
            for shift in (-ABOUT, 0.0, ABOUT):
                c = read(contrast, view, sizes[view, 0], sizes[view, 1], u + shift * nu, v + shift * nv)
                if c < 0.0:
                    outside = True
                on = max(on, c)
            middle += 0.5 * on
            for side in (-BESIDE, BESIDE):
                beside = max(beside, read(contrast, view, sizes[view, 0], sizes[view, 1], u + side * nu, v + side * nv))
        if outside:
            continue
        if middle < NOISE:
            past += 1
        elif beside < max(NOISE, CLEAR * middle):
            shows += 1
            much += middle
    return shows, past, much
