"""What does the background look like, here? Learnt from what lies around the crown, near by.

What shows through a crown is what stands beside it: sky above, a hedge below. So the colours of a ring around the region are a mixture N_j, and the share of each differs from
place to place: r_j(x) is its share among the ring's pixels, weighted by a Gaussian of their distance to x (σ = REACH of the crown's size).

    b(I | x) = Σ_j r_j(x) N_j(I)

A colour that is no rarer inside the crown than around it, and green or dark as leaves are, tells of other leaves, not of background: it is left out. Beside a bare tree it tells of a
hedge or of other trees: it is background again where it is the most of what is near by (`with_neighbours`).
"""

from dataclasses import dataclass, replace

import numpy as np
from jaxtyping import Array, Bool, Float, Int, Key
from scipy import ndimage
from scipy.special import logsumexp

from sketchtree.keys import stage_key
from sketchtree.photo.appearance import Mixture, fit_mixture
from sketchtree.photo.pixels import Pixels

REACH = 0.22  # σ of what is near by, of the crown's size (√area)
WIDTH = 0.25  # of the ring, of the crown's size
COMPONENTS = 8
_WIDER = 3.0  # added to the standard deviation of its colours: blur and JPEG at the leaves' edges, levels of 255
_AS_COMMON = 0.7  # share inside / share around it, from which a leafy colour is no background
_GREEN = 0.06  # excess of green of a leafy colour, of its R + G + B
_DARK = 0.5  # or its lightness, of that of the ring's brightest tenth
_COMMON = 0.08  # share of a colour that is common
_MOST = 0.3  # share of a place's surroundings from which left-out colours are its background
_NEVER = -200.0  # a logarithm of densities under which a pixel is of none of the colours
_FAR = 1e-6  # weight of the whole ring at a place that has nothing near by


@dataclass(frozen=True, eq=False)
class Surroundings:
    """Colours around the crown."""

    colours: Mixture  # N_j, weights equal
    share: Float[np.ndarray, "component cell_row cell_column"]  # r_j; 0 where a colour is left out
    cell: int  # pixels
    leafy: Bool[np.ndarray, " component"]  # left out
    of_all: Float[np.ndarray, "component cell_row cell_column"]  # r_j with nothing left out

    def common(self) -> Float[np.ndarray, "some 3"]:
        """The colours that are common near the crown."""
        return self.colours.mean[self.share.mean(axis=(1, 2)) > _COMMON]

    def with_neighbours(self, shape: tuple[int, int]) -> tuple["Surroundings", Bool[np.ndarray, "row column"]]:
        """(the same, leafy colours no more left out where they are the most of what is near by; the pixels of a picture of that shape where that is so)."""
        theirs = self.of_all[self.leafy].sum(axis=0) > _MOST
        pixels = np.repeat(np.repeat(theirs, self.cell, axis=0), self.cell, axis=1)[: shape[0], : shape[1]]
        return replace(self, share=np.where(theirs, self.of_all, self.share), leafy=np.zeros_like(self.leafy)), pixels

    def log_density(self, pixels: Pixels) -> Float[np.ndarray, " pixel"]:
        """log b(I | x) of every pixel."""
        parts = np.exp(self.colours.log_parts(pixels.colour)) * len(self.colours)
        row, column = np.divmod(pixels.at.astype(np.int32), pixels.width)
        cell, density = row // self.cell * self.share.shape[2] + column // self.cell, np.zeros(len(pixels))
        for part, share in zip(np.ascontiguousarray(parts.T), self.share.reshape(len(self.share), -1), strict=True):
            if share.any():
                density += part[pixels.which] * share[cell]
        return np.log(density + 1e-300)

    def are_leaves(self, pixels: Pixels) -> Bool[np.ndarray, " pixel"]:
        """Which pixels are likelier of a colour that is left out than of all others together."""
        return (_parts(self.colours, self.colours.weight, pixels) @ self.leafy) > 0.5


def learn_surroundings(inside: Pixels, ring: Pixels, shape: tuple[int, int], size: float, *, key: Key[Array, ""]) -> Surroundings:
    """What is around a crown of this size (√area, pixels)."""
    fitted = fit_mixture(ring.colours(), COMPONENTS, key=stage_key(key, "ring"))
    wide = Mixture(np.full(len(fitted), 1 / len(fitted)), fitted.mean, fitted.covariance + _WIDER**2 * np.eye(3))
    share, cell = _shares(_parts(wide, fitted.weight, ring), ring, shape, REACH * size)
    leafy = _is_leafy(wide, fitted.weight, share, cell, inside, ring)
    return Surroundings(wide, share * ~leafy[:, None, None], cell, leafy, share)


def _parts(colours: Mixture, weight, pixels: Pixels) -> Float[np.ndarray, "pixel component"]:
    """To which component each pixel belongs, and how surely."""
    parts = colours.log_parts(pixels.colour) + np.log(weight)
    return np.exp(parts - logsumexp(parts, axis=1, keepdims=True))[pixels.which]


def _shares(part: Float[np.ndarray, "pixel component"], ring: Pixels, shape: tuple[int, int], sigma: float):
    """(r_j in cells, pixels of a cell)."""
    cell = max(1, int(sigma / 4))
    rows, columns = -(-shape[0] // cell), -(-shape[1] // cell)
    row, column = np.divmod(ring.at, ring.width)
    place = row // cell * columns + column // cell
    summed = np.stack([np.bincount(place, each, rows * columns).reshape(rows, columns) for each in part.T])
    near = ndimage.gaussian_filter(summed, (0, sigma / cell, sigma / cell), mode="constant", truncate=6)
    near += _FAR * summed.mean(axis=(1, 2), keepdims=True)
    return near / near.sum(axis=0), cell


def _is_leafy(colours: Mixture, weight, share, cell: int, inside: Pixels, ring: Pixels) -> Bool[np.ndarray, " component"]:
    """Components that are as common inside the crown as around it, and green or dark."""
    usual = np.quantile(colours.log_parts(ring.colour).max(axis=1)[ring.which], 0.01)  # a pixel rarer than this in the ring is of none of them
    alike = colours.log_parts(inside.colour).max(axis=1)[inside.which] > usual
    common = (_parts(colours, weight, inside) * alike[:, None]).mean(axis=0)
    row, column = np.divmod(inside.at, inside.width)
    around = share[:, row // cell, column // cell].mean(axis=1)
    red, green, blue = colours.mean.T
    lightness = colours.mean.mean(axis=1)
    leafy = (2 * green - red - blue > _GREEN * (red + green + blue)) | (lightness < _DARK * np.quantile(lightness, 0.9))
    return leafy & (common > _AS_COMMON * np.maximum(around, 1e-3))


def ring_around(region: Bool[np.ndarray, "row column"], size: float) -> Bool[np.ndarray, "row column"]:
    """The pixels around a region, up to WIDTH of the crown's size away."""
    away = ndimage.distance_transform_edt(~region)
    return (away > 0.01 * size) & (away <= max(WIDTH * size, 4.0))


def rarely_around(surroundings: Surroundings, inside: Pixels, ring: Pixels, tail: float) -> Int[np.ndarray, " pixel"]:
    """The pixels inside whose colour is rarer around the crown than that of a share `tail` of the ring is, other leaves there left out: what is sure to be no background."""
    usual = surroundings.log_density(ring)[~surroundings.are_leaves(ring)]
    known = usual[usual > _NEVER]
    found = surroundings.log_density(inside)
    return np.flatnonzero(found < np.quantile(known, tail)) if len(known) else np.arange(len(found))
