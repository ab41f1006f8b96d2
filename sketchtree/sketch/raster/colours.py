"""Which painted areas are no wood? Green foliage, and the grey shadow under a brown tree.

Paint is even: an area that is rougher than EVEN is foliage in a photograph, and no paint. What lies along most of the
picture's edge is its paper. Areas are solid where a disc of SOLID of the picture fits in; thin green or grey lines stay lines.
Solid green is foliage: its outline, limbs that lie over it included, is a crown. Solid grey is a shadow, in a picture whose
wood is brown.
"""

from dataclasses import dataclass

import numpy as np
import shapely
from jaxtyping import Bool, Float, UInt8
from PIL import Image
from scipy.ndimage import binary_fill_holes, distance_transform_edt, gaussian_filter, label, zoom
from skimage.measure import find_contours
from skimage.morphology import convex_hull_image

from sketchtree.sketch.raster.lines_of import Traced

LOOK = 0.5  # megapixels at which colours are looked at
GREEN = (65.0, 175.0)  # hue, degrees
BROWN = (0.0, 55.0)
TINT = 0.25  # least saturation of a colour
GREYEST = 0.15  # greatest saturation of a grey
SOLID = 0.012  # of the picture's larger side: radius of the disc that fits into an area
FRINGE = 0.004  # of the same: how far the blended edge of an area reaches
LARGE = 0.01  # of the picture: a smaller area is no crown
EDGING = 0.5  # of the picture's edge: an area along more of it is the paper
EVEN = 0.035  # of full lightness: standard deviation of the tones within an area, from pixel to pixel
EDGE = 0.03  # of the foliage's size: a line that keeps as near to its outline …
ALONG = 0.8  # … over so much of its length is its edge
WOOD = 0.003  # of the picture: less brown is no wood


@dataclass(frozen=True, eq=False)
class Painted:
    """What a coloured picture's areas are."""

    ground: Bool[np.ndarray, "row col"]  # foliage and shadow: no ink
    crowns: tuple[Float[np.ndarray, "point 2"], ...]  # outlines of foliage, pixels of the picture, (x, y), y DOWN
    shadow: bool


def painted_areas(rgb: UInt8[np.ndarray, "row col 3"]) -> Painted | None:
    """Foliage and shadows of a coloured picture; None where it has neither."""
    factor = max(1, round(np.sqrt(rgb.shape[0] * rgb.shape[1] / (LOOK * 1e6))))
    small = np.asarray(Image.fromarray(rgb).reduce(factor)) if factor > 1 else rgb
    hue, saturation, light = _hues(small)
    side = max(small.shape[:2])
    green = _solid((hue >= GREEN[0]) & (hue <= GREEN[1]) & (saturation >= TINT), SOLID * side)
    brown = (hue >= BROWN[0]) & (hue <= BROWN[1]) & (saturation >= TINT) & (light < 0.75)
    grey = np.zeros_like(green)
    if brown.mean() >= WOOD:
        grey = _solid((saturation <= GREYEST) & (light < 0.9), SOLID * side)
    green, grey = (np.zeros_like(part) if _is_paper(part) else part for part in (green, grey))
    green, grey = (part if _is_even(rgb, part, factor) else np.zeros_like(part) for part in (green, grey))
    if green.mean() < LARGE and not grey.any():
        return None
    crowns = tuple((p + 0.0) * factor for p in _outlines(green, brown, side)) if green.mean() >= LARGE else ()
    area = (green if crowns else np.zeros_like(green)) | grey
    near = (distance_transform_edt(~area) <= max(1.5, FRINGE * side)) & ~brown
    ground = zoom(area | near, factor, order=0) if factor > 1 else area | near
    ground = np.pad(ground, [(0, max(0, n - m)) for n, m in zip(rgb.shape, ground.shape, strict=False)])[: rgb.shape[0], : rgb.shape[1]]
    return Painted(ground, crowns, bool(grey.any()))


def _hues(rgb: UInt8[np.ndarray, "row col 3"]):
    """(hue in degrees, saturation, lightness of the brightest channel) of every pixel."""
    r, g, b = np.moveaxis(rgb.astype(np.float32) / 255.0, 2, 0)
    high, low = rgb.max(2) / np.float32(255.0), rgb.min(2) / np.float32(255.0)
    span = np.maximum(high - low, np.float32(1e-6))
    hue = np.where(high == r, (g - b) / span % 6, np.where(high == g, (b - r) / span + 2, (r - g) / span + 4)) * 60.0
    return hue, (high - low) / np.maximum(high, np.float32(1e-6)), high


def without_edges(lines: list[Traced], outlines: list[Float[np.ndarray, "point 2"]], pen: float) -> list[Traced]:
    """The lines without those that only draw the edge of the foliage (all in pixels of the ink)."""
    edges = shapely.union_all([shapely.LinearRing(outline) for outline in outlines])
    size = max(float(np.ptp(outline, axis=0).max()) for outline in outlines)
    reach = max(EDGE * size, 2 * pen)
    kept = []
    for line in lines:
        along = float(np.mean(shapely.distance(edges, shapely.points(line.points)) <= reach))
        if along < ALONG or line.length < 2 * reach:
            kept.append(line)
    return kept or lines


def _is_paper(area: Bool[np.ndarray, "row col"]) -> bool:
    """Whether an area lies along most of the picture's edge."""
    return float(np.concatenate([area[0], area[-1], area[:, 0], area[:, -1]]).mean()) > EDGING


def _is_even(rgb: UInt8[np.ndarray, "row col 3"], area: Bool[np.ndarray, "small_row small_col"], factor: int) -> bool:
    """Whether neighbouring pixels of an area (seen `factor` times smaller) are of one tone."""
    if not area.any():
        return True
    tone = rgb[::factor, :, 1].astype(np.int16)
    inside = np.repeat(area[: len(tone)], factor, 1)[:, : tone.shape[1]]
    step = np.abs(tone[:, 2:] - tone[:, :-2])[: len(inside)][inside[:, 2:] & inside[:, :-2]]
    return float(np.median(step)) / (255 * 0.6745 * np.sqrt(2)) <= EVEN


def _solid(mask: Bool[np.ndarray, "row col"], radius: float) -> Bool[np.ndarray, "row col"]:
    """The parts of a mask into which a disc fits, to where the disc reaches."""
    core = distance_transform_edt(np.pad(mask, 1))[1:-1, 1:-1] > radius
    if not core.any():
        return np.zeros_like(mask)
    return mask & (distance_transform_edt(~core) <= 1.5 * radius)


def _opened(mask: Bool[np.ndarray, "row col"], radius: float) -> Bool[np.ndarray, "row col"]:
    """The union of all discs of a radius that fit into a mask."""
    core = distance_transform_edt(np.pad(mask, 1))[1:-1, 1:-1] > radius
    return distance_transform_edt(~core) <= radius if core.any() else core


def _outlines(green, brown, side: int) -> list[Float[np.ndarray, "point 2"]]:
    """The outlines of the foliage, the wood that lies over it included, the largest first."""
    reach = SOLID * side
    green = green | (brown & convex_hull_image(green))
    closed = distance_transform_edt(~np.pad(green, 2 * int(reach) + 2)) <= 2 * reach
    closed = distance_transform_edt(closed) > 2 * reach
    pad = 2 * int(reach) + 2
    closed = binary_fill_holes(closed[pad:-pad, pad:-pad])
    closed = _opened(closed, 3 * reach)  # the trunk below is none of it
    labels, count = label(closed)
    found = []
    for k in range(1, count + 1):
        part = labels == k
        if part.mean() < LARGE:
            continue
        soft = gaussian_filter(np.pad(part, 3).astype(np.float32), 1.5)
        line = max(find_contours(soft, 0.5), key=len)
        found.append((float(part.sum()), line[:-1, ::-1] - 2.5))
    return [line for _, line in sorted(found, key=lambda item: -item[0])]
