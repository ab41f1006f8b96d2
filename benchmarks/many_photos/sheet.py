"""What do clouds look like, side by side, as in Guo et al. 2018, Figure 10? Above the whole tree from where the first photo was taken, below a part of it."""

from pathlib import Path
from typing import NamedTuple

import numpy as np
from PIL import Image, ImageDraw, ImageFont

from sketchtree.multiview.cameras import Camera
from sketchtree.multiview.fuse import LEAST
from sketchtree.multiview.workplace import Level

SIDE, GAP, LINE = 400, 8, 30  # pixels of the sheet: a picture, between two, a line of text
PART = (0.27, 0.40, 0.24)  # middle across, middle down and width of the part shown below, of the picture
_INK = (40, 44, 40)


class Shown(NamedTuple):
    """One column."""

    words: str
    xyz: np.ndarray
    colour: np.ndarray
    dot: int = 1  # pixels


def depth_picture(level: Level) -> np.ndarray:
    """Near places warm, far ones cool, white where there is no depth that others confirm."""
    sure = level.used & (level.likely >= LEAST) & (level.agreeing >= 2)
    if not sure.any():
        return np.full((*level.shape, 3), 255, np.uint8)
    low, high = np.quantile(level.plane[..., 0][sure], [0.02, 0.98])
    near = np.clip((level.plane[..., 0] - low) / max(high - low, 1e-12), 0.0, 1.0)[..., None]
    colour = (1 - near) * np.array([40, 60, 160]) + near * np.array([210, 70, 30]) + 4 * near * (1 - near) * np.array([20, 90, 20])
    return np.where(sure[..., None], np.clip(colour, 0, 255), 255).astype(np.uint8)


def points_picture(xyz: np.ndarray, colour: np.ndarray, camera: Camera, dot: int = 1) -> np.ndarray:
    """A cloud as the camera sees it, the near over the far, every point so many pixels wide."""
    picture = np.full((camera.size[1], camera.size[0], 3), 255, np.uint8)
    pixel, depth = camera.project(xyz) if len(xyz) else (np.zeros((0, 2)), np.zeros(0))
    held = np.flatnonzero(camera.holds(pixel, depth))
    held = held[np.argsort(-depth[held], kind="stable")]
    x, y = pixel[held].astype(int).T
    own = np.round(255 * colour[held]).astype(np.uint8)
    for across in range(dot):
        for down in range(dot):
            picture[np.minimum(y + down, camera.size[1] - 1), np.minimum(x + across, camera.size[0] - 1)] = own
    return picture


def of_part(camera: Camera, side: int) -> Camera:
    """The camera with the part alone in a picture of so many pixels."""
    across, down, width = PART
    by = side / (width * camera.size[0])
    move = np.array([[by, 0.0, -by * (across - width / 2) * camera.size[0]], [0.0, by, -by * (down - width / 2) * camera.size[1]], [0.0, 0.0, 1.0]])
    return Camera(move @ camera.matrix, camera.rotation, camera.centre, (side, side))


def sheet(photo: np.ndarray, camera: Camera, columns: list[Shown]) -> Image.Image:
    """The photo, then a column for every cloud."""
    paper = Image.new("RGB", ((SIDE + GAP) * (len(columns) + 1) + GAP, 2 * (SIDE + GAP) + LINE + GAP), "white")
    pen, font = ImageDraw.Draw(paper), ImageFont.load_default(size=17)
    across, down, width = PART
    corner = [(side - width / 2) * photo.shape[1] for side in (across, down)]
    picture = Image.fromarray(photo)
    part = picture.crop((*map(round, corner), *(round(side + width * photo.shape[1]) for side in corner)))
    rows = [("photo", picture.resize((SIDE, SIDE), Image.Resampling.LANCZOS), part.resize((SIDE, SIDE), Image.Resampling.BICUBIC))]
    for words, xyz, colour, dot in columns:
        rows.append((words, *(Image.fromarray(points_picture(xyz, colour, one, dot * by)) for one, by in ((camera.resized((SIDE, SIDE)), 1), (of_part(camera, SIDE), 3)))))
    for k, (words, whole, piece) in enumerate(rows):
        left = GAP + k * (SIDE + GAP)
        pen.text((left + 2, GAP), words, _INK, font)
        paper.paste(whole, (left, LINE + GAP))
        paper.paste(piece, (left, LINE + 2 * GAP + SIDE))
        corner = (left + (across - width / 2) * SIDE, LINE + GAP + (down - width / 2) * SIDE)
        pen.rectangle((*corner, corner[0] + width * SIDE, corner[1] + width * SIDE), outline=(190, 90, 40))
    return paper


def save(picture: Image.Image, path: Path) -> None:
    """As PNG, of few colours."""
    path.parent.mkdir(parents=True, exist_ok=True)
    picture.quantize(128, dither=Image.Dither.NONE).save(path, optimize=True)
