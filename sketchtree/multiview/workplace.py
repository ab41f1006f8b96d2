"""What do the compiled loops need of a view and its partners? One level of the pyramid, in arrays.

A patch on the even ground beside a twig holds the twig's edge, and would take its depth. So a pixel that looks like an even place (within `ALIKE`) no farther
than `NEAR` pixels away belongs to that place, and is not used (ours). Pictures of unlike sizes are put into one block, each in its upper left; `sizes` says how
far each reaches.
"""

from dataclasses import dataclass, field

import numpy as np
from jaxtyping import Bool, Float, Int
from PIL import Image
from scipy.ndimage import distance_transform_edt, uniform_filter

from sketchtree.multiview.cameras import Camera
from sketchtree.multiview.homography import transfer
from sketchtree.multiview.photos import View
from sketchtree.multiview.sky_and_ground import behind, sky
from sketchtree.multiview.sources import Sources

EVEN = 0.012  # standard deviation of brightness over 5 × 5 pixels under which a place has no texture
ALIKE, NEAR = 0.06, 3  # brightness of any channel; pixels


@dataclass(eq=False)
class Level:
    """One view at one size, and the plane found at each of its pixels so far."""

    name: str
    camera: Camera
    rgb: Float[np.ndarray, "row column 3"]
    grey: Float[np.ndarray, "row column"]
    used: Bool[np.ndarray, "row column"]  # u(p) of Eq. 4: seen, not sky, not even
    empty: Bool[np.ndarray, "row column"]  # sky, or even and behind the plant
    sources: Sources
    plane: Float[np.ndarray, "row column 3"]  # (ρ, ∂ρ/∂x, ∂ρ/∂y)
    energy: Float[np.ndarray, "row column"] = field(default=None)  # the integrand of Eq. 2
    segment: Int[np.ndarray, "row column"] = field(default=None)  # `segments`, once they were sought
    likely: Float[np.ndarray, "row column"] = field(default=None)  # Eq. 3
    agreeing: np.ndarray = field(default=None)  # how many other photos agree

    @property
    def shape(self) -> tuple[int, int]:
        """Rows and columns."""
        return self.grey.shape


@dataclass(frozen=True, eq=False)
class Partners:
    """The other photos of one view."""

    transfers: Float[np.ndarray, "source 3 4"]  # of its pixels to theirs
    backs: Float[np.ndarray, "source 3 4"]
    others: Float[np.ndarray, "source row column"]
    sizes: np.ndarray  # width and height of each


def level_of(view: View, sources: Sources, shrink: int, least: int = 96) -> Level:
    """The view so many times smaller, but no smaller than `least` pixels."""
    by = max(1.0 / shrink, min(1.0, least / max(view.camera.size)))
    size = tuple(max(8, round(side * by)) for side in view.camera.size)
    rgb, seen = view.rgb, view.seen
    if size != view.camera.size:
        rgb = np.stack([np.asarray(Image.fromarray(rgb[..., k]).resize(size, Image.Resampling.BOX)) for k in range(3)], axis=2)
        seen = np.asarray(Image.fromarray(seen.astype(np.float32)).resize(size, Image.Resampling.BOX)) > 0.99
    grey = np.ascontiguousarray(rgb @ np.array([0.299, 0.587, 0.114], np.float32), np.float32)
    even = seen & ~textured(grey)
    above = seen & sky(rgb)
    empty = above | behind(rgb, even)
    used = seen & ~above & ~even & ~like_even(rgb, even)
    return Level(view.name, view.camera.resized(size), rgb, grey, used, empty, sources, np.zeros((*grey.shape, 3), np.float32), np.full(grey.shape, 9.0, np.float32))


def textured(grey: Float[np.ndarray, "row column"]) -> Bool[np.ndarray, "row column"]:
    """Whether there is anything to be found again round a pixel."""
    mean = uniform_filter(grey.astype(np.float64), 5)
    return uniform_filter(grey.astype(np.float64) ** 2, 5) - mean**2 > EVEN**2


def like_even(rgb: Float[np.ndarray, "row column 3"], even: Bool[np.ndarray, "row column"]) -> Bool[np.ndarray, "row column"]:
    """Which pixels look like the nearest even place."""
    if not even.any():
        return even
    away, (y, x) = distance_transform_edt(~even, return_indices=True)
    return (away <= NEAR) & (np.abs(rgb - uniform_filter(rgb, (3, 3, 0))[y, x]).max(axis=2) < ALIKE)


def partners(level: Level, levels: list[Level]) -> Partners:
    """The pictures of a view's partners and how pixels go over to them and back."""
    others = [levels[row] for row in level.sources.rows]
    return Partners(
        np.array([transfer(level.camera, other.camera) for other in others], np.float32),
        np.array([transfer(other.camera, level.camera) for other in others], np.float32),
        block([other.grey for other in others]),
        np.array([other.camera.size for other in others], np.int64),
    )


def block(pictures: list[np.ndarray]) -> np.ndarray:
    """Pictures of unlike sizes in one array."""
    shape = np.max([picture.shape for picture in pictures], axis=0)
    found = np.zeros((len(pictures), *shape), pictures[0].dtype)
    for k, picture in enumerate(pictures):
        found[(k, *(slice(side) for side in picture.shape))] = picture
    return found
