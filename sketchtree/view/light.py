"""How much light reaches each vertex of a picture, and what shadow lies on the ground?

A crown is a cloud of small surfaces, so its own shade follows Beer and Lambert's law. The surfaces are
sorted into a grid aligned with a light; summed along the light they give the optical depth before a point:

    T = exp(−τ),   τ = Σ G a / A        over the cells between the point and the light

    a   area of the surfaces in a cell      A   cross-section of a cell      G   mean projection, 1/2
"""

from collections.abc import Sequence

import numpy as np
from jaxtyping import Float
from scipy import ndimage

_CELLS = 44  # along the longest side
_PROJECTION = 0.5
_SKY = [(0.0, 1.0, 0.0)] + [(np.cos(a), 0.55, np.sin(a)) for a in 2 * np.pi * np.arange(5) / 5]  # up and slanting

Points = Float[np.ndarray, "_ 3"]


def baked_light(
    points: list[Points], centroid: Points, area: Float[np.ndarray, " triangle"], sun: Float[np.ndarray, " 3"], *, box: Float[np.ndarray, "2 3"] | None = None
) -> list[Float[np.ndarray, "point 2"]]:
    """For each array of points the light (0-1) from the sun and the openness (0-1) to the sky, read from a
    grid laid over the surfaces (centroids in metres, areas in m²). `box`, which holds all, keeps the grid the same in every picture of a film."""
    low, high = extent_of([*points, centroid]) if box is None else box
    size = np.maximum(high - low, 1e-6)
    cell = size.max() / _CELLS
    shape = np.ceil(size / cell).astype(int) + 1
    flat = np.ravel_multi_index(tuple((np.minimum((centroid - low) / cell, shape - 1)).astype(int).T), tuple(shape))
    held = np.bincount(flat, area, minlength=int(np.prod(shape)))
    grid = low + (np.stack(np.unravel_index(np.arange(len(held)), tuple(shape)), axis=1) + 0.5) * cell
    full = held > 0
    field = [transmittance(grid, grid[full], held[full], np.asarray(direction), box=box) for direction in (sun, *_SKY)]
    volumes = [field[0].reshape(shape), np.mean(field[1:], axis=0).reshape(shape)]
    read = lambda volume, at: ndimage.map_coordinates(volume, at, order=1, mode="nearest")  # noqa: E731
    places = [((p - low) / cell - 0.5).T for p in points]
    return [np.column_stack([read(volume, at) for volume in volumes]) for at in places]


def extent_of(places: Sequence[Points]) -> Float[np.ndarray, "2 3"]:
    """The least and greatest coordinates of all points."""
    held = [points for points in places if len(points)]
    return np.stack([np.min([points.min(axis=0) for points in held], axis=0), np.max([points.max(axis=0) for points in held], axis=0)])


def transmittance(
    point: Points, centroid: Points, area: Float[np.ndarray, " triangle"], towards: Float[np.ndarray, " 3"], *, box: Float[np.ndarray, "2 3"] | None = None
) -> Float[np.ndarray, " point"]:
    """The share (0-1) of the light from direction `towards` that reaches each point through the
    surfaces given by their centroids (metres) and areas (m²), all within the `box` if there is one."""
    axes = aligned(towards)
    place, seen = centroid @ axes.T, point @ axes.T
    corners = [] if box is None else [np.stack(np.meshgrid(*box.T), axis=-1).reshape(-1, 3) @ axes.T]
    low, high = extent_of([seen, *corners] if corners else [place, seen])
    size = np.maximum(high - low, 1e-6)
    cell = size.max() / _CELLS
    shape = np.ceil(size / cell).astype(int) + 1
    index = np.minimum(((place - low) / cell).astype(int), shape - 1)
    flat = np.ravel_multi_index(tuple(index.T), tuple(shape))
    depth = np.bincount(flat, area, minlength=int(np.prod(shape))).reshape(shape) * _PROJECTION / cell**2
    depth = ndimage.gaussian_filter(depth, (0.7, 0.7, 0.0), mode="constant")
    before = np.cumsum(depth[:, :, ::-1], axis=2)[:, :, ::-1] - 0.5 * depth
    at = ((seen - low) / cell - 0.5).T
    return np.exp(-ndimage.map_coordinates(before, at, order=1, mode="nearest"))


def ground_light(
    centroid: Points, area: Float[np.ndarray, " triangle"], sun: Float[np.ndarray, " 3"], reach: float, pixels: int = 256
) -> Float[np.ndarray, "row column"]:
    """The light (0-1) on the ground y = 0 within ±`reach` metres of the origin, rows along +z: the sun's
    shadow, and a soft darkening close to what stands there."""
    slide = centroid - centroid[:, 1:2] / sun[1] * sun
    shadow = _splat(slide, area, reach, pixels)
    contact = _splat(centroid, area * np.exp(-np.abs(centroid[:, 1]) / (0.018 * reach)), reach, pixels)
    sunlit = np.exp(-ndimage.gaussian_filter(shadow, 1.2))
    near = np.exp(-0.9 * ndimage.gaussian_filter(contact, 3.5))
    sky = np.exp(-0.5 * ndimage.gaussian_filter(_splat(centroid, area, reach, pixels), 12.0))
    return (0.52 * sunlit + 0.48 * sky) * near


def aligned(direction: Float[np.ndarray, " 3"]) -> Float[np.ndarray, "3 3"]:
    """A right-handed orthonormal basis, as rows, whose third row is the unit `direction`."""
    w = np.asarray(direction, float) / np.linalg.norm(direction)
    u = np.cross([0.0, 1.0, 0.0] if abs(w[1]) < 0.9 else [1.0, 0.0, 0.0], w)
    u /= np.linalg.norm(u)
    return np.stack([u, np.cross(w, u), w])


def _splat(point, area, reach, pixels):
    """Optical depth of the surfaces projected on the ground."""
    edges = np.linspace(-reach, reach, pixels + 1)
    total = np.histogram2d(point[:, 2], point[:, 0], bins=(edges, edges), weights=area)[0]
    return total * _PROJECTION / (2 * reach / pixels) ** 2
