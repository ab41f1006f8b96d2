"""Thin wood of a known place and width, as photos all round show it before an even sky."""

import numpy as np
from ring import camera_at

from sketchtree.multiview.thin.contrasts import Contrasts, contrasts_of

CAMERAS = [camera_at(18.0 * k, size=(160, 160), height=0.5 + 0.4 * (k % 2)) for k in range(20)]
PIXEL = 3.0 / (1.3 * 160)  # metres, at the middle
SKY, BARK = np.array([0.75, 0.8, 0.9]), np.array([0.25, 0.2, 0.15])
_FINE = 3  # samples a side of a pixel


def shown(*ways: tuple[list, float]) -> Contrasts:
    """What photos show of polylines (places in metres, width in pixels)."""
    covered = [_covered(camera, ways) for camera in CAMERAS]
    return contrasts_of(CAMERAS, [(SKY + part[..., None] * (BARK - SKY)).astype(np.float32) for part in covered], [part == 0 for part in covered])


def _covered(camera, ways) -> np.ndarray:
    """How much of each pixel is wood."""
    width, height = camera.size
    at = (np.stack(np.meshgrid(np.arange(width * _FINE), np.arange(height * _FINE)), axis=-1) + 0.5) / _FINE
    wood = np.zeros(at.shape[:2], bool)
    for way, wide in ways:
        pixel, depth = camera.project(np.asarray(way, float))
        for one, other, near in zip(pixel[:-1], pixel[1:], depth[:-1], strict=True):
            along = other - one
            share = np.clip(((at - one) @ along) / max(along @ along, 1e-12), 0.0, 1.0)
            wood |= np.linalg.norm(at - one - share[..., None] * along, axis=-1) < 0.5 * wide * 3.0 / near
    return wood.reshape(height, _FINE, width, _FINE).mean(axis=(1, 3))
