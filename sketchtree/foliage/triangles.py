"""How does one triangle hold a whole picture? The drawing, moved into the smallest triangle round it whose axis is upright.

    half width at height y:  k (Y − y),   k = max h(y) / (Y − y),   Y the apex that makes the triangle smallest;   or upside down

Several such pictures stand side by side in one texture, a `Strip`; the first shows one leaf, the second two, and so on.
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
_PIXELS = 256  # along the longer side of a picture


@dataclass(frozen=True, eq=False)
class Strip:
    """Pictures in triangles, side by side in one texture."""

    painting: Painting
    corner: Float[np.ndarray, "picture 3 2"]  # of each triangle, in its picture's own coordinates: leaf lengths
    uv: Float[np.ndarray, "picture 3 2"]
    covered: Float[np.ndarray, " picture"]  # area drawn, in squares of the leaf's length


def strip(leaf: Painting, pictures: list[tuple[Float[np.ndarray, "leaf 2"], Float[np.ndarray, " leaf"]]]) -> Strip:
    """A strip of the pictures; each is given by its leaves' feet and headings (radians from upright, positive to the right)."""
    corner = [_triangle(_rim(leaf, *stand)) for stand in pictures]
    drawn = [_drawn(leaf, *stand, box) for stand, box in zip(pictures, corner, strict=True)]
    tall = max(one.coverage.shape[0] for one in drawn)
    wide = [one.coverage.shape[1] for one in drawn]
    fill = lambda image, channel: np.pad(image, ((0, tall - len(image)), (0, 0)), constant_values=float(channel == "shade"))  # noqa: E731
    painting = Painting(*(np.hstack([fill(getattr(one, c), c) for one in drawn]) for c in CHANNELS), 0.0, 1.0, 0.0, 1.0)
    uv, covered = [], []
    for k, one in enumerate(drawn):
        place = (corner[k] - [one.left, one.top]) / [one.right - one.left, one.bottom - one.top]
        uv.append((place * [wide[k], len(one.coverage)] + [sum(wide[:k]), 0]) / [sum(wide), tall])
        covered.append(drawn_area(one))
    return Strip(painting, np.array(corner), np.array(uv), np.array(covered))


def single(leaf: Painting) -> Strip:
    """The leaf's own picture at half its resolution, in the triangle round it. Its pixels are means of four of the leaf's, and stand
    at multiples of `_ALIGNED`: graphics cards average both textures to the same smaller ones, so both are seen alike from afar."""
    return _aligned(leaf, _triangle(_rim(leaf, np.zeros((1, 2)), np.zeros(1))))


def diamond(leaf: Painting, waist: float) -> Strip:
    """The same in the smallest diamond whose sides' corners are at the height `waist` (leaf lengths from the foot). Its corners: foot, right, tip, left."""
    rim = _rim(leaf, np.zeros((1, 2)), np.zeros(1))
    x, y = np.abs(rim[:, 0]), rim[:, 1]
    above, below = y > waist, y < waist
    best = None
    for wide in x.max() * np.geomspace(1.03, 2.5, 60):
        reach = (wide * y - x * waist) / (wide - x)  # where a side through (wide, waist) and the point meets the midrib
        tip, foot = np.max(reach[above], initial=y.max()), np.min(reach[below], initial=y.min())
        if best is None or wide * (tip - foot) < best[0]:
            best = wide * (tip - foot), [[0.0, foot], [wide, waist], [0.0, tip], [-wide, waist]]
    return _aligned(leaf, np.array(best[1]))


def _aligned(leaf: Painting, corner: Float[np.ndarray, "corner 2"]) -> Strip:
    """The leaf's picture at half its resolution, with as much clear space round it as the polygon of the corners needs."""
    rows, columns = leaf.coverage.shape
    pixel = np.array([2 * (leaf.right - leaf.left) / columns, 2 * (leaf.top - leaf.bottom) / rows])
    up = foot_of(leaf)
    before = np.array([leaf.left - corner[:, 0].min(), corner[:, 1].max() - (leaf.top - up)])
    before = _ALIGNED * np.ceil(np.maximum(before / pixel, 0) / _ALIGNED).astype(int)
    end = np.array([corner[:, 0].max() - leaf.left, (leaf.top - up) - corner[:, 1].min()]) / pixel
    size = before + _ALIGNED * np.ceil(np.maximum(end, [columns // 2, rows // 2]) / _ALIGNED).astype(int)
    after = size - before - [columns // 2, rows // 2]
    half = lambda image: image.reshape(rows // 2, 2, columns // 2, 2).mean(axis=(1, 3))  # noqa: E731
    around = (before[1], after[1]), (before[0], after[0])
    painting = Painting(*(np.pad(half(getattr(leaf, c)), around, constant_values=float(c == "shade")) for c in CHANNELS), 0.0, 1.0, 0.0, 1.0)
    uv = ((corner - [leaf.left, leaf.top - up]) / pixel * [1, -1] + before) / size
    return Strip(painting, corner[None], uv[None], np.array([drawn_area(leaf)]))


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


def _drawn(leaf: Painting, foot, heading, corner) -> Painting:
    """The leaves drawn into the triangle's box, the first on top."""
    low, high = corner.min(axis=0), corner.max(axis=0)
    shape = tuple(np.maximum(32, np.round(_PIXELS * (high - low)[::-1] / (high - low).max())).astype(int))
    up, across = ((np.arange(n) + 0.5) / n for n in shape)
    y, x = np.meshgrid(high[1] - up * (high - low)[1], low[0] + across * (high - low)[0], indexing="ij")
    soft = 0.4 * (high - low)[1] / shape[0] * leaf.coverage.shape[0] / (leaf.top - leaf.bottom)
    own = {c: ndimage.gaussian_filter(getattr(leaf, c), soft) for c in CHANNELS}
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
