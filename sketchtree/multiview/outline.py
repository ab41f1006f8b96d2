"""Where does a photo show for sure that nothing of the plant is there? And which places of a cloud can't be, since photos look past them?

A twig two pixels wide has a depth that is uncertain by several pixels along the ray, so that its points make a fat bundle. But beside it each photo shows sky or an
even cloth, and nothing can stand before those: that is known to a fraction of a pixel. So (ours)

    α = min(1, c / C)        c   how far a pixel's colour is from that of the even place or the sky nearest to it, in the channel where they differ most
                             C   the most of it in the pixel and those around, so that of a pixel that the twig fills; within two pixels where c is no more
                                 than noise

is how much of a pixel the plant fills. A photo looks past a place where α, read between pixels, is under `HALF`. A place can't be if more than `SHARE` of the photos
that have it in the picture look past it, and more than `SPARE` of them. In some photos an even patch of bark is taken for a place where nothing stands; hence the
shares. A point at such a place is moved along its ray to the nearest that can be, `MOST` pixels at most; where there is none it is no point.
"""

from typing import NamedTuple

import numpy as np
from jaxtyping import Bool, Float, Int
from scipy.ndimage import distance_transform_edt, maximum_filter, uniform_filter

from sketchtree.multiview.cameras import Camera
from sketchtree.multiview.compiled import compiled
from sketchtree.multiview.workplace import block

HALF = 0.5
NEAR = 4  # pixels to the even place: farther in, all is plant
CONTRAST = 0.06  # c of noise; C under which a pixel can't be told from what is beside it
SHARE, SPARE = 0.2, 2
MOST = 6


class Outlines(NamedTuple):
    """What all photos show of where the plant is."""

    to_pixel: Float[np.ndarray, "view 3 4"]
    filled: Int[np.ndarray, "view row column"]  # α, 0-255
    sizes: Int[np.ndarray, "view 2"]  # width and height


def outlines_of(cameras: list[Camera], filled: list[Float[np.ndarray, "row column"]]) -> Outlines:
    """Of the α of all photos."""
    return Outlines(np.array([camera.to_pixel for camera in cameras]), block([np.round(255 * alpha).astype(np.uint8) for alpha in filled]), np.array([camera.size for camera in cameras], np.int64))


def filled(rgb: Float[np.ndarray, "row column 3"], empty: Bool[np.ndarray, "row column"]) -> Float[np.ndarray, "row column"]:
    """α of every pixel; `empty`: sky, and what is even behind the plant."""
    if not empty.any():
        return np.ones(empty.shape, np.float32)
    off, away = off_even(rgb, empty)
    most = np.where(off < CONTRAST, maximum_filter(off, 5), maximum_filter(off, 3))
    alpha = np.where((away <= NEAR) & (most >= CONTRAST), np.minimum(off / np.maximum(most, 1e-6), 1.0), 1.0)
    return np.where(empty, 0.0, alpha).astype(np.float32)


def off_even(rgb: Float[np.ndarray, "row column 3"], empty: Bool[np.ndarray, "row column"]) -> tuple[Float[np.ndarray, "row column"], Float[np.ndarray, "row column"]]:
    """(how far each pixel's colour is from that of the nearest empty place, in the channel where they differ most; how many pixels away that is)."""
    away, (y, x) = distance_transform_edt(~empty, return_indices=True)
    weight = uniform_filter(empty.astype(np.float32), 3)
    there = np.stack([uniform_filter(np.where(empty, rgb[..., k], 0.0), 3) / np.maximum(weight, 1e-6) for k in range(3)], axis=2)[y, x]
    return np.abs(rgb - there).max(axis=2), away


def looked_past(xyz: Float[np.ndarray, "point 3"], outlines: Outlines) -> Bool[np.ndarray, " point"]:
    """Which places can't be."""
    past, held = np.zeros(len(xyz), np.int64), np.zeros(len(xyz), np.int64)
    _count(np.ascontiguousarray(xyz), *outlines, 255 * HALF, past, held)
    return (past > SPARE) & (past > SHARE * held)


def brought_in(xyz: Float[np.ndarray, "point 3"], eye: Float[np.ndarray, " 3"], pixel: float, outlines: Outlines) -> tuple[np.ndarray, Bool[np.ndarray, " point"]]:
    """(the points of the photo taken from `eye`, moved where they can be; which of them can). `pixel`: the width of one, over the depth."""
    found, wrong = np.array(xyz), looked_past(xyz, outlines)
    for step in (sign * k for k in range(1, MOST + 1) for sign in (1, -1)):
        rows = np.flatnonzero(wrong)
        tried = eye + (1.0 + step * pixel) * (xyz[rows] - eye)
        there = ~looked_past(tried, outlines)
        found[rows[there]], wrong[rows[there]] = tried[there], False
    return found, ~wrong


@compiled
def _count(xyz, to_pixel, filled, sizes, half, past, held):
    """Fill by how many photos each place is looked past, and how many have it in the picture."""
    for k in range(len(xyz)):
        x, y, z = xyz[k, 0], xyz[k, 1], xyz[k, 2]
        for view in range(len(to_pixel)):
            p = to_pixel[view]
            depth = p[2, 0] * x + p[2, 1] * y + p[2, 2] * z + p[2, 3]
            if depth <= 0.0:
                continue
            u = (p[0, 0] * x + p[0, 1] * y + p[0, 2] * z + p[0, 3]) / depth
            v = (p[1, 0] * x + p[1, 1] * y + p[1, 2] * z + p[1, 3]) / depth
            width, height = sizes[view, 0], sizes[view, 1]
            if not (u >= 0.0 and v >= 0.0 and u < width and v < height):
                continue
            held[k] += 1
            u, v = min(max(u - 0.5, 0.0), width - 1.001), min(max(v - 0.5, 0.0), height - 1.001)
            i, j = int(u), int(v)
            u, v = u - i, v - j
            top = filled[view, j, i] * (1.0 - u) + filled[view, j, i + 1] * u
            low = filled[view, j + 1, i] * (1.0 - u) + filled[view, j + 1, i + 1] * u
            if top * (1.0 - v) + low * v < half:
                past[k] += 1
