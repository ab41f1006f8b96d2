"""How does one triangle hold a whole picture? The drawing, moved into the smallest triangle round it whose axis is upright.

    half width at height y:  k (Y − y),   k = max h(y) / (Y − y),   Y the apex that makes the triangle smallest;   or upside down

Several such pictures stand in one texture, a `Strip`.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float
from scipy import ndimage

from sketchtree.foliage.card_shape import foot_of
from sketchtree.foliage.layers import placed
from sketchtree.foliage.painting import Painting

CHANNELS = ("coverage", "vein", "stem", "shade", "height")
_ALIGNED = 128  # pixels
_PIXELS, _FEW = 256, 6  # along the longer side of a picture, where there are few; half of it where there are more


@dataclass(frozen=True, eq=False)
class Strip:
    """Pictures in triangles, in rows in one texture."""

    painting: Painting
    corner: Float[np.ndarray, "picture 3 2"]  # of each triangle, in its picture's own coordinates: leaf lengths
    uv: Float[np.ndarray, "picture 3 2"]
    covered: Float[np.ndarray, " picture"]  # area drawn, in squares of the leaf's length


def strip(leaf: Painting, pictures: list[tuple[Float[np.ndarray, "leaf 2"], Float[np.ndarray, " leaf"]]]) -> Strip:
    """The pictures in one texture; each is given by its leaves' feet and headings (radians from upright, positive to the right)."""
    corner = [_triangle(_rim(leaf, *stand)) for stand in pictures]
    pixels = _PIXELS if len(pictures) <= _FEW else _PIXELS // 2
    softened: dict[float, dict] = {}
    drawn = [_drawn(leaf, *stand, box, pixels, softened) for stand, box in zip(pictures, corner, strict=True)]
    columns = int(np.ceil(np.sqrt(len(drawn))))
    rows = [drawn[k : k + columns] for k in range(0, len(drawn), columns)]
    wide = max(sum(one.coverage.shape[1] for one in row) for row in rows)
    uv, bands, top = [], [], 0
    high = sum(max(len(one.coverage) for one in row) for row in rows)
    for row in rows:
        tall, left = max(len(one.coverage) for one in row), 0
        band = {c: np.full((tall, wide), float(c == "shade")) for c in CHANNELS}
        for one in row:
            place = (corner[len(uv)] - [one.left, one.top]) / [one.right - one.left, one.bottom - one.top]
            uv.append((place * one.coverage.shape[::-1] + [left, top]) / [wide, high])
            for c in CHANNELS:
                band[c][: len(one.coverage), left : left + one.coverage.shape[1]] = getattr(one, c)
            left += one.coverage.shape[1]
        bands.append(band)
        top += tall
    painting = Painting(*(np.vstack([band[c] for band in bands]) for c in CHANNELS), 0.0, 1.0, 0.0, 1.0)
    return Strip(painting, np.array(corner), np.array(uv), np.array([drawn_area(one) for one in drawn]))


@dataclass(frozen=True, eq=False)
class Outlines:
    """The leaf's own picture with as much clear space round it as its simple outlines need."""

    painting: Painting
    corner: dict[str, Float[np.ndarray, "corner 2"]]  # `triangle`; of a blade `diamond` (foot, right, tip, left); of a tuft `box`; leaf lengths from the foot
    uv: dict[str, Float[np.ndarray, "corner 2"]]
    covered: float  # area drawn, in squares of the leaf's length


def outlines(leaf: Painting, waist: float | None) -> Outlines:
    """The smallest triangle round the drawing and, with a `waist`, the smallest diamond whose side corners are at that height (leaf lengths from the foot),
    without one the smallest box.

    The picture has half the leaf's resolution. Its pixels are means of four of the leaf's, and stand at multiples of `_ALIGNED`: graphics cards
    average both textures to the same smaller ones, so both are seen alike from afar."""
    rim = _rim(leaf, np.zeros((1, 2)), np.zeros(1))
    low, high = rim.min(axis=0), rim.max(axis=0)
    box = np.array([low, [high[0], low[1]], high, [low[0], high[1]]])
    corner = {"triangle": _triangle(rim)} | ({"box": box} if waist is None else {"diamond": _diamond(rim, waist)})
    painting, uv = _aligned(leaf, corner)
    return Outlines(painting, corner, uv, drawn_area(leaf))


def _diamond(rim: Float[np.ndarray, "point 2"], waist: float) -> Float[np.ndarray, "4 2"]:
    x, y = np.abs(rim[:, 0]), rim[:, 1]
    above, below = y > waist, y < waist
    best = None
    for wide in x.max() * np.geomspace(1.03, 2.5, 60):
        reach = (wide * y - x * waist) / (wide - x)  # where a side through (wide, waist) and the point meets the midrib
        tip, foot = np.max(reach[above], initial=y.max()), np.min(reach[below], initial=y.min())
        if best is None or wide * (tip - foot) < best[0]:
            best = wide * (tip - foot), [[0.0, foot], [wide, waist], [0.0, tip], [-wide, waist]]
    return np.array(best[1])


def _aligned(leaf: Painting, corner: dict[str, Float[np.ndarray, "corner 2"]]):
    """The picture, and the corners' places in it."""
    rows, columns = leaf.coverage.shape
    pixel = np.array([2 * (leaf.right - leaf.left) / columns, 2 * (leaf.top - leaf.bottom) / rows])
    up = foot_of(leaf)
    every = np.concatenate(list(corner.values()))
    before = np.array([leaf.left - every[:, 0].min(), every[:, 1].max() - (leaf.top - up)])
    before = _ALIGNED * np.ceil(np.maximum(before / pixel, 0) / _ALIGNED).astype(int)
    end = np.array([every[:, 0].max() - leaf.left, (leaf.top - up) - every[:, 1].min()]) / pixel
    size = before + _ALIGNED * np.ceil(np.maximum(end, [columns // 2, rows // 2]) / _ALIGNED).astype(int)
    after = size - before - [columns // 2, rows // 2]
    half = lambda image: image.reshape(rows // 2, 2, columns // 2, 2).mean(axis=(1, 3))  # noqa: E731
    around = (before[1], after[1]), (before[0], after[0])
    painting = Painting(*(np.pad(half(getattr(leaf, c)), around, constant_values=float(c == "shade")) for c in CHANNELS), 0.0, 1.0, 0.0, 1.0)
    return painting, {name: ((one - [leaf.left, leaf.top - up]) / pixel * [1, -1] + before) / size for name, one in corner.items()}


def drawn_area(painting: Painting) -> float:
    """Area of what is drawn, in squares of the leaf's length."""
    pixel = (painting.right - painting.left) * (painting.top - painting.bottom) / painting.coverage.size
    return float((painting.coverage > 0.5).sum() * pixel)


def _rim(leaf: Painting, foot, heading) -> Float[np.ndarray, "point 2"]:
    """Points round all leaves."""
    rows, columns = leaf.coverage.shape
    seen = leaf.coverage > 0.3
    used = np.flatnonzero(seen.any(axis=1))
    first, last = seen[used].argmax(axis=1), columns - 1 - seen[used][:, ::-1].argmax(axis=1)
    x = leaf.left + np.r_[first, last + 1.0] / columns * (leaf.right - leaf.left)
    y = leaf.top + np.tile(used + 0.5, 2) / rows * (leaf.bottom - leaf.top) - foot_of(leaf)
    return np.vstack([placed(np.stack([x, y], axis=1), f, h, 1.0) for f, h in zip(foot, heading, strict=True)])


def _triangle(point: Float[np.ndarray, "point 2"]) -> Float[np.ndarray, "3 2"]:
    """Corners, counter-clockwise."""
    middle = (point[:, 0].max() + point[:, 0].min()) / 2
    x, best = point[:, 0] - middle, None
    for up in (1.0, -1.0):
        y = up * point[:, 1]
        low, high = y.min() - 0.01, y.max() + 0.01
        for apex in high + (high - low) * np.geomspace(0.02, 3.0, 40):
            slope = 1.02 * np.max(np.abs(x) / (apex - y))
            area = slope * (apex - low) ** 2
            if best is None or area < best[0]:
                half = slope * (apex - low)
                best = area, [[middle - up * half, up * low], [middle + up * half, up * low], [middle, up * apex]]
    return np.array(best[1])


def _drawn(leaf: Painting, foot, heading, corner, pixels: int, softened: dict[float, dict]) -> Painting:
    """The leaves drawn into the triangle's box, the first on top. `softened` keeps the leaf blurred to what a pixel sees of it."""
    low, high = corner.min(axis=0), corner.max(axis=0)
    shape = tuple(np.maximum(32, np.round(pixels * (high - low)[::-1] / (high - low).max())).astype(int))
    up, across = ((np.arange(n) + 0.5) / n for n in shape)
    y, x = np.meshgrid(high[1] - up * (high - low)[1], low[0] + across * (high - low)[0], indexing="ij")
    soft = 0.4 * (high - low)[1] / shape[0] * leaf.coverage.shape[0] / (leaf.top - leaf.bottom)
    soft = float(np.round(4 * soft) / 4)
    if soft not in softened:
        softened[soft] = {c: ndimage.gaussian_filter(getattr(leaf, c), soft) for c in CHANNELS}
    own = softened[soft]
    mixed = {c: np.full(shape, float(c == "shade")) for c in CHANNELS}
    for at, turn in reversed(list(zip(foot, heading, strict=True))):
        place = _places(leaf, x - at[0], y - at[1], turn)
        layer = {c: ndimage.map_coordinates(own[c], place, order=1, mode="constant", cval=float(c == "shade")) for c in CHANNELS}
        for c in CHANNELS[1:]:
            mixed[c] += layer["coverage"] * (layer[c] - mixed[c])
        mixed["coverage"] += layer["coverage"] * (1 - mixed["coverage"])
    return Painting(*(mixed[c] for c in CHANNELS), low[0], high[0], low[1], high[1])


def _places(leaf: Painting, x, y, turn: float):
    """Row and column in the leaf's own picture of places about its foot, the leaf turned by `turn`."""
    rows, columns = leaf.coverage.shape
    across, along = x * np.cos(turn) - y * np.sin(turn), y * np.cos(turn) + x * np.sin(turn) + foot_of(leaf)
    return [(along - leaf.top) / (leaf.bottom - leaf.top) * rows - 0.5, (across - leaf.left) / (leaf.right - leaf.left) * columns - 0.5]
