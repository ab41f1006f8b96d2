"""What in the photos is not the plant? Rules for sky, ground and what stands far behind, stated and simple (ours).

Sky, of a photo: what is reached from its upper border over pixels that are even (brightness changes by less than `EVEN` to the next) and either bright (above
0.75 in all channels) or blue (b > r + 0.03, b ≥ g, above 0.35); and within `MIXED` pixels of it what has such a colour, though it is not even, and within
`HOLES` of the picture what has such a colour and that of the nearest sky (to 0.08 in every channel), since sky shines past and between twigs. An even
place lies behind the plant if it reaches the border of the picture, or looks like the nearest that does (to `LIKE` in every channel, in the mean): a smooth leaf is
even too. Behind, of a cloud: what is no nearer to the place looked at than the nearest camera is.

Ground, of a cloud with y up: the level plane (tilted by 15° at most) that most points of the lower third lie on, if at least 3 % of all do, they reach as far across
as 0.4 of the cloud's width, both ways (the outermost 2 % left out), and hardly anything lies under it (no trunk: farther below than 2.4 % of the height, less than a
twentieth of the points on it); all points under it, or less than 1.2 % of the height above it, are ground. A trunk's foot goes with it.
"""

import numpy as np
from jaxtyping import Bool, Float, Key
from scipy.ndimage import binary_dilation, distance_transform_edt, gaussian_gradient_magnitude, label

from sketchtree.clouds.cloud import PointCloud
from sketchtree.clouds.standing.stems import pieces
from sketchtree.keys import numpy_generator, stage_key
from sketchtree.multiview.cameras import Camera
from sketchtree.multiview.sources import looked_at

EVEN = 0.04
MIXED, HOLES = 3, 0.15
LIKE = 0.1
LEVEL = np.cos(np.radians(15.0))
ABOVE = 0.012  # of the cloud's height
SHARE, ACROSS, UNDER = 0.03, 0.4, 0.05
GAP, FEW = 0.05, 0.01
_TRIES, _COUNTED = 500, 20_000


def sky(rgb: Float[np.ndarray, "row column 3"]) -> Bool[np.ndarray, "row column"]:
    """Which pixels are sky."""
    red, green, blue = rgb[..., 0], rgb[..., 1], rgb[..., 2]
    alike = (rgb.min(axis=2) > 0.75) | ((blue > red + 0.03) & (blue >= green) & (blue > 0.35))
    parts, _ = label(alike & (gaussian_gradient_magnitude(rgb.mean(axis=2), 1.0) < EVEN))
    at_top = np.unique(parts[0])
    found = np.isin(parts, at_top[at_top > 0])
    if not found.any():
        return found
    away, (y, x) = distance_transform_edt(~found, return_indices=True)
    hole = (away < HOLES * max(found.shape)) & (np.abs(rgb - rgb[y, x]).max(axis=2) < 0.08)
    return found | alike & (hole | binary_dilation(found, np.ones((3, 3)), MIXED))


def behind(rgb: Float[np.ndarray, "row column 3"], even: Bool[np.ndarray, "row column"]) -> Bool[np.ndarray, "row column"]:
    """Which even places are behind the plant, not on it."""
    part, count = label(even)
    rim = np.concatenate([part[0], part[-1], part[:, 0], part[:, -1]])
    found = even & np.isin(part, rim[rim > 0])
    if not found.any():
        return found
    y, x = distance_transform_edt(~found, return_distances=False, return_indices=True)
    off = np.abs(rgb - rgb[y, x]).max(axis=2)[even]
    mean = np.bincount(part[even], off, count + 1) / np.maximum(np.bincount(part[even], minlength=count + 1), 1)
    return even & (mean[part] < LIKE)


def within(xyz: Float[np.ndarray, "point 3"], cameras: list[Camera]) -> Bool[np.ndarray, " point"]:
    """Which points are nearer to the place looked at than any camera."""
    focus = looked_at(cameras)
    return np.linalg.norm(xyz - focus, axis=1) < min(np.linalg.norm(camera.centre - focus) for camera in cameras)


def ground(cloud: PointCloud, *, key: Key) -> Bool[np.ndarray, " point"]:
    """Which points of a cloud with y up are ground."""
    xyz, height = cloud.xyz, max(cloud.height, 1e-12)
    near = ABOVE / 2 * height
    plane = _level_plane(xyz, height, near, numpy_generator(stage_key(key, "ground")))
    if plane is None:
        return np.zeros(len(xyz), bool)
    above = xyz @ plane[0] - plane[1]
    flat = xyz[np.abs(above) < near][:, [0, 2]]
    few = len(flat) < SHARE * len(xyz) or (_width(flat) < ACROSS * _width(xyz[:, [0, 2]])).any()
    if few or (above < -2 * ABOVE * height).sum() > UNDER * len(flat):
        return np.zeros(len(xyz), bool)
    return above < ABOVE * height


def _level_plane(xyz, height: float, near: float, generator: np.random.Generator) -> tuple[np.ndarray, float] | None:
    """(upward normal, offset) of the level plane with most points of the lower third: through three of about one height, the best of many."""
    low = xyz[xyz[:, 1] < xyz[:, 1].min() + height / 3]
    if len(low) > _COUNTED:
        low = low[generator.choice(len(low), _COUNTED, replace=False)]
    low = low[np.argsort(low[:, 1], kind="stable")]
    first, last = (np.searchsorted(low[:, 1], low[:, 1] + by * height / 10) for by in (-1, 1))
    best, plane = 0, None
    for _ in range(_TRIES if len(low) >= 3 else 0):
        row = int(generator.integers(len(low)))
        a, (b, c) = low[row], low[generator.integers(first[row], last[row], 2)]
        normal = np.cross(b - a, c - a)
        length = np.linalg.norm(normal)
        if length < 1e-12 or abs(normal[1]) / length < LEVEL:
            continue
        normal = normal * np.sign(normal[1]) / length
        count = int((np.abs((low - a) @ normal) < near).sum())
        if count > best:
            best, plane = count, (normal, float(normal @ a))
    return plane


def _width(xz: Float[np.ndarray, "point 2"]) -> Float[np.ndarray, " 2"]:
    """How far points reach, but for the outermost 2 % on either side: strays lie far out."""
    return np.diff(np.quantile(xz, [0.02, 0.98], axis=0), axis=0)[0]


def far_off(xyz: Float[np.ndarray, "point 3"]) -> Bool[np.ndarray, " point"]:
    """Which points are of no plant: pieces of under `FEW` of the largest's points, with `GAP` of the height between them and all that belongs to it. Edges of the ground leave such, and they would be bridged."""
    low, high = np.quantile(xyz[:, 1], [0.001, 0.999])
    piece = pieces(xyz, GAP * float(high - low), 0.0)
    count = np.bincount(piece)
    return (count < FEW * count.max())[piece]
