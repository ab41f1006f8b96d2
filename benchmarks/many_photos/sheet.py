"""What do depth maps and clouds look like, side by side? Pictures in a row."""

from pathlib import Path

import numpy as np
from PIL import Image

from sketchtree.multiview.cameras import Camera
from sketchtree.multiview.fuse import LEAST
from sketchtree.multiview.workplace import Level


def depth_picture(level: Level) -> np.ndarray:
    """Near places warm, far ones cool, white where there is no depth that others confirm."""
    sure = level.used & (level.likely >= LEAST) & (level.agreeing >= 2)
    if not sure.any():
        return np.full((*level.shape, 3), 255, np.uint8)
    low, high = np.quantile(level.plane[..., 0][sure], [0.02, 0.98])
    near = np.clip((level.plane[..., 0] - low) / max(high - low, 1e-12), 0.0, 1.0)[..., None]
    colour = (1 - near) * np.array([40, 60, 160]) + near * np.array([210, 70, 30]) + 4 * near * (1 - near) * np.array([20, 90, 20])
    return np.where(sure[..., None], np.clip(colour, 0, 255), 255).astype(np.uint8)


def points_picture(xyz: np.ndarray, colour: np.ndarray, camera: Camera) -> np.ndarray:
    """A cloud as the camera sees it, the near over the far."""
    picture = np.full((camera.size[1], camera.size[0], 3), 255, np.uint8)
    pixel, depth = camera.project(xyz) if len(xyz) else (np.zeros((0, 2)), np.zeros(0))
    held = np.flatnonzero(camera.holds(pixel, depth))
    held = held[np.argsort(-depth[held])]
    x, y = pixel[held].astype(int).T
    picture[y, x] = np.round(255 * colour[held])
    return picture


def save(pictures: list[np.ndarray], path: Path) -> None:
    """All in a row."""
    path.parent.mkdir(parents=True, exist_ok=True)
    Image.fromarray(np.concatenate(pictures, axis=1)).save(path)
