"""A world that is known: a trunk and a limb of even thickness before nothing, painted with a texture that lies in space, and cameras in a ring that look at it. Rays meet the cylinders exactly."""

import numpy as np

from sketchtree.multiview.cameras import Camera
from sketchtree.multiview.photos import View

CYLINDERS = (  # foot, top, radius, metres
    (np.array([0.0, -0.4, 0.0]), np.array([0.0, 1.4, 0.0]), 0.22),
    (np.array([0.0, 0.4, 0.0]), np.array([0.75, 1.1, 0.25]), 0.09),
)
_CHANCE = np.random.default_rng(5)
_WAVES = _CHANCE.normal(0, 22.0, (40, 3))
_PHASES = _CHANCE.uniform(0, 2 * np.pi, (40, 3))


def camera_at(azimuth: float, size=(96, 96), distance=3.0, height=0.5, focal=1.3) -> Camera:
    """Looks at (0, 0.5, 0) from that azimuth (degrees)."""
    turn = np.radians(azimuth)
    centre = np.array([distance * np.sin(turn), height, distance * np.cos(turn)])
    ahead = np.array([0.0, 0.5, 0.0]) - centre
    ahead /= np.linalg.norm(ahead)
    right = np.cross(ahead, [0.0, 1.0, 0.0])
    right /= np.linalg.norm(right)
    matrix = np.array([[focal * size[0], 0, size[0] / 2], [0, focal * size[0], size[1] / 2], [0, 0, 1.0]])
    return Camera(matrix, np.array([right, np.cross(ahead, right), ahead]), centre, size)


def colour_of(xyz: np.ndarray) -> np.ndarray:
    """The texture in space, 0-1."""
    waves = xyz @ _WAVES.T
    return 0.5 + 0.5 * np.tanh(np.stack([np.cos(waves + _PHASES[:, k]).sum(axis=1) / 4.0 for k in range(3)], axis=1))


def rendered(camera: Camera) -> tuple[np.ndarray, np.ndarray]:
    """(picture, depth; 0 where there is nothing)."""
    pixel = camera.pixels()
    ray = camera.unproject(pixel, np.ones(len(pixel))) - camera.centre  # of depth 1
    depth = np.full(len(ray), np.inf)
    for foot, top, radius in CYLINDERS:
        axis = (top - foot) / np.linalg.norm(top - foot)
        across, start = ray - np.outer(ray @ axis, axis), camera.centre - foot
        start = start - (start @ axis) * axis
        a, b, c = (across**2).sum(axis=1), across @ start, start @ start - radius**2
        root = b * b - a * c
        t = (-b - np.sqrt(np.maximum(root, 0))) / a
        along = (camera.centre + t[:, None] * ray - foot) @ axis
        hit = (root > 0) & (along > 0) & (along < np.linalg.norm(top - foot)) & (t > 0)
        depth = np.where(hit & (t < depth), t, depth)
    there = np.isfinite(depth)
    rgb = np.full((len(ray), 3), 0.9)
    rgb[there] = colour_of(camera.centre + depth[there, None] * ray[there])
    shape = (camera.size[1], camera.size[0])
    return rgb.reshape(*shape, 3).astype(np.float32), np.where(there, depth, 0.0).reshape(shape)


def painted_room(camera: Camera, ball: bool = True) -> np.ndarray:
    """A textured cave with a textured ball in it: much to be found again, near and far."""
    pixel, start = camera.pixels(), camera.centre - [0, 0.5, 0]
    ray = camera.unproject(pixel, np.ones(len(pixel))) - camera.centre
    rgb = np.zeros((len(ray), 3))
    for radius, side, fine in ((6.0, 1, 0.3), (0.7, -1, 1.2))[: 1 + ball]:
        b, a, c = ray @ start, (ray**2).sum(axis=1), start @ start - radius**2
        hit = b * b > a * c
        t = (-b + side * np.sqrt(np.maximum(b * b - a * c, 0))) / a
        rgb[hit] = colour_of(fine * (camera.centre + t[:, None] * ray)[hit])
    return rgb.reshape(camera.size[1], camera.size[0], 3)


def ring(count: int = 8, step: float = 14.0, **options) -> list[View]:
    """Views from so many cameras, so many degrees apart."""
    views = []
    for k in range(count):
        camera = camera_at(step * k, **options)
        rgb, _ = rendered(camera)
        views.append(View(f"{k:02d}.png", camera, rgb, np.ones(rgb.shape[:2], bool)))
    return views


def distance_to_surface(xyz: np.ndarray) -> np.ndarray:
    """From each point to the nearest bark, metres."""
    found = []
    for foot, top, radius in CYLINDERS:
        way = top - foot
        along = np.clip((xyz - foot) @ way / (way @ way), 0, 1)
        found.append(np.abs(np.linalg.norm(xyz - foot - along[:, None] * way, axis=1) - radius))
    return np.min(found, axis=0)
