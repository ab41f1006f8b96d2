"""Patterns that repeat without a seam: what barks are drawn with.

All are arrays over one square tile, row 0 at the top, and continue periodically on all sides. Lengths are shares of the
tile's side. The same seed gives the same pattern.
"""

import numpy as np
from jaxtyping import Float
from scipy.ndimage import gaussian_filter, map_coordinates
from scipy.spatial import cKDTree


def clouds(
    pixels: int, seed: int, across: float, along: float, smoothness: float = 2.0
) -> Float[np.ndarray, "row column"]:
    """Gaussian noise of mean 0 and variance 1 with correlation lengths `across` (x) and `along` (y).

    White noise through the filter (1 + (f_x across)² + (f_y along)²)^(−smoothness); larger is softer.
    """
    white = np.random.default_rng(seed).standard_normal((pixels, pixels))
    fy = np.fft.fftfreq(pixels, 1.0 / pixels)[:, None]
    fx = np.fft.rfftfreq(pixels, 1.0 / pixels)[None]
    soft = (1.0 + (2.0 * np.pi * across * fx) ** 2 + (2.0 * np.pi * along * fy) ** 2) ** (-smoothness)
    soft[0, 0] = 0.0
    result = np.fft.irfft2(np.fft.rfft2(white) * soft, (pixels, pixels))
    return result / result.std()


def warped(image: Float[np.ndarray, "row column"], right, down) -> Float[np.ndarray, "row column"]:
    """The image seen through a displacement field (shares of the tile)."""
    size = len(image)
    row, column = np.mgrid[:size, :size].astype(float)
    return map_coordinates(image, [row + size * down, column + size * right], order=1, mode="grid-wrap")


def furrows(noise: Float[np.ndarray, "row column"], width: float) -> Float[np.ndarray, "row column"]:
    """0 in the furrows along the zero lines of a noise, rising to 1 on the ridges between; they meet and part like a net."""
    return 1.0 - np.exp(-((np.abs(noise) / width) ** 1.3))


def scales(
    pixels: int, seed: int, count: int, stretch: float, wobble: float
) -> tuple[Float[np.ndarray, "row column"], Float[np.ndarray, "row column"], Float[np.ndarray, "row column 2"]]:
    """A tiling by about `count` irregular cells, `stretch` times as tall as wide, with borders that wobble.

    Returns the distance to the nearest border (in mean cell widths), a number 0-1 per cell, and the place within
    the cell (x right, y down, in mean cell widths).
    """
    rng = np.random.default_rng(seed)
    span = np.array([1.0, 1.0 / stretch])  # measure y in units that make cells round
    centre = _spread(rng, count, span)
    coarse = max(pixels // 2, 64)
    grid = (np.mgrid[:coarse, :coarse][::-1].reshape(2, -1).T + 0.5) / coarse
    width = np.sqrt(span.prod() / count)
    shift = np.stack([clouds(coarse, seed + axis + 1, 0.2 * width, 0.2 * width * stretch, 1.7).ravel() for axis in (0, 1)], axis=1)
    place = (grid * span + wobble * width * shift) % span
    distance, cell = cKDTree(centre, boxsize=span).query(place, k=2)
    border = (distance[:, 1] - distance[:, 0]) / width
    inside = (place - centre[cell[:, 0]] + span / 2) % span - span / 2
    value = rng.random(len(centre))[cell[:, 0]]
    return _finer(border, coarse, pixels), _nearest(value, coarse, pixels), np.stack(
        [_nearest(inside[:, axis] / width, coarse, pixels) for axis in (0, 1)], axis=-1
    )


def dashes(
    pixels: int, seed: int, count: int, length: tuple[float, float], thickness: tuple[float, float]
) -> Float[np.ndarray, "row column"]:
    """Horizontal spindles (lenticels): 1 on their middles, 0 away from them."""
    rng = np.random.default_rng(seed)
    image = np.zeros((pixels, pixels))
    for _ in range(count):
        x, y = rng.random(2) * pixels
        a, b = (0.5 * pixels * rng.uniform(*bounds) for bounds in (length, thickness))
        tilt = rng.normal(0.0, 0.03)
        column = np.arange(int(x - a) - 1, int(x + a) + 3)
        row = np.arange(int(y - 3 * b) - 2, int(y + 3 * b) + 4)
        u = (column - x) / a
        v = (row[:, None] - y - tilt * (column - x)) / b
        drawn = np.clip(1.0 - u**2, 0.0, 1.0) * np.exp(-(v**2))
        where = np.ix_(row % pixels, column % pixels)
        image[where] = np.maximum(image[where], drawn)
    return image


def blurred(image: Float[np.ndarray, "row column"], radius: float) -> Float[np.ndarray, "row column"]:
    """A Gaussian blur of standard deviation `radius` (share of the tile), periodic."""
    return gaussian_filter(image, radius * len(image), mode="wrap", truncate=2.5)


def ramp(value, low: float, high: float):
    """0 below `low`, 1 above `high`, smooth between (cubic)."""
    t = np.clip((value - low) / (high - low), 0.0, 1.0)
    return t * t * (3.0 - 2.0 * t)


def mixed(share: Float[np.ndarray, "row column"], first, second) -> Float[np.ndarray, "row column 3"]:
    """Colour `first` where share is 0, `second` where it is 1. Each is one colour or an image of them."""
    first, second = np.asarray(first, float), np.asarray(second, float)
    return first + share[..., None] * (second - first)


def _spread(rng, count: int, span):
    """Points on a jittered grid: no two cells of very different size."""
    columns = max(round(np.sqrt(count * span[0] / span[1])), 1)
    rows = 2 * max(round(count / columns / 2), 1)  # even, so that the shifted rows meet across the tile's edge
    place = np.stack(np.meshgrid(np.arange(columns), np.arange(rows)), axis=-1).reshape(-1, 2).astype(float)
    place[:, 0] += 0.5 * (place[:, 1] % 2)
    place = (place + 0.5 + rng.uniform(-0.38, 0.38, place.shape)) / [columns, rows]
    return (place * span) % span


def _finer(flat, coarse: int, pixels: int):
    row = (np.arange(pixels) + 0.5) * coarse / pixels - 0.5
    return map_coordinates(flat.reshape(coarse, coarse), np.meshgrid(row, row, indexing="ij"), order=1, mode="grid-wrap")


def _nearest(flat, coarse: int, pixels: int):
    row = (np.arange(pixels) * coarse) // pixels
    return flat.reshape(coarse, coarse)[np.ix_(row, row)]
