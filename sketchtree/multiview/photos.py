"""Which photos are in a folder, which of them are of use, and what does each show? Files → Views.

Black bars that a camera or a program put at the borders are unseen, since their edges stand still when the camera moves. A photo is sharp if its Laplacian is
not much weaker than that of the others: variance of the Laplacian over variance of the picture, both at 800 px, under a fifth of the median is blurred (ours).
"""

import os
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from jaxtyping import Bool, Float
from PIL import Image, ImageOps, UnidentifiedImageError
from scipy.ndimage import laplace

from sketchtree.errors import ViewsError
from sketchtree.multiview.cameras import Camera
from sketchtree.multiview.lenses import undistorted

EXTENSIONS = (".jpg", ".jpeg", ".png", ".tif", ".tiff", ".webp", ".bmp")
_GIVE = f"Give a folder of photos of one plant from many sides ({' '.join(EXTENSIONS)}), 20 or more."
BLURRED = 0.2  # of the median sharpness
BLACK, BESIDE = 0.04, 0.008  # brightness of a bar; how far beyond it pixels are unseen too, of the longer side


@dataclass(frozen=True, eq=False)
class View:
    """One photo as a camera without a lens took it."""

    name: str
    camera: Camera
    rgb: Float[np.ndarray, "row column 3"]  # sRGB, 0-1, 32 bits
    seen: Bool[np.ndarray, "row column"]  # whether the photo shows it, and it is not masked out
    cut_out: bool = False  # whether its alpha channel masks something out: then what is seen is the plant

    @property
    def grey(self) -> Float[np.ndarray, "row column"]:
        """Its brightness, 0-1."""
        return (self.rgb @ np.array([0.299, 0.587, 0.114], np.float32)).astype(np.float32)


def photo_files(folder: str | os.PathLike) -> list[Path]:
    """The photos in a folder by name; its subfolder `images` counts where it has none itself. Raises ViewsError where there are fewer than two."""
    folder = Path(folder)
    if not folder.is_dir():
        what = f"{folder} is a file, not a folder." if folder.exists() else f"There is no folder {folder}."
        raise ViewsError(what, remedy=_GIVE if folder.exists() else "Check the path.")
    most = 0
    for place in (folder, folder / "images"):
        found = sorted(file for file in place.glob("*") if file.suffix.lower() in EXTENSIONS and not file.name.startswith(".")) if place.is_dir() else []
        if len(found) > 1:
            return found
        most = max(most, len(found))
    raise ViewsError(f"{folder} has {'one photo' if most else 'no photos'}.", remedy=_GIVE)


def photo_size(file: Path) -> tuple[int, int]:
    """Width and height of a photo as it is stored, pixels. Raises ViewsError where the file is none."""
    with _named(file), Image.open(file) as picture:
        return picture.size


def read_photo(file: Path) -> Image.Image:
    """A photo as it is stored, not turned. Raises ViewsError where the file is none."""
    with _named(file):
        picture = Image.open(file)
        picture.load()
        return picture


@contextmanager
def _named(file: Path) -> Iterator[None]:
    """Whatever is wrong with a photo is said of it."""
    try:
        yield
    except (UnidentifiedImageError, OSError, Image.DecompressionBombError, SyntaxError, ValueError) as fault:
        raise ViewsError(f"it can't be read ({fault}).", photo=file.name, remedy="Save it again as JPEG or PNG, or take it out of the folder.") from None


def blurred(files: list[Path]) -> list[str]:
    """Names of the photos that are much less sharp than the others."""
    sharpness = np.array([_sharpness(file) for file in files])
    return [file.name for file, value in zip(files, sharpness, strict=True) if value < BLURRED * np.median(sharpness)]


def _sharpness(file: Path) -> float:
    picture = read_photo(file).convert("L")
    picture.thumbnail((800, 800))
    grey = np.asarray(picture, np.float64)
    return float(laplace(grey).var() / (grey.var() + 1e-9))


def views_of(placed: Iterator[tuple[Path, Camera, object]], longest: int) -> Iterator[View]:
    """Photos with their cameras and lenses as views of at most so many pixels a side. An alpha channel says what is seen."""
    for file, camera, lens in placed:
        picture = _as_taken(file, camera)
        camera = camera.resized(picture.size)
        by = min(1.0, longest / max(picture.size))
        if by < 1.0:
            size = tuple(max(1, round(side * by)) for side in picture.size)
            picture, camera = picture.resize(size, Image.Resampling.BOX, reducing_gap=None), camera.resized(size)
        flat, seen = undistorted(np.asarray(picture, np.float32) / 255.0, camera, lens)
        opaque = flat[..., 3] > 0.5
        yield View(file.name, camera, np.ascontiguousarray(flat[..., :3]), seen & opaque & ~bars(flat[..., :3]), bool((seen & ~opaque).any()))


def bars(rgb: Float[np.ndarray, "row column 3"]) -> Bool[np.ndarray, "row column"]:
    """Black bars at the borders, and a little more. A picture that is black all over has none."""
    bright = rgb.max(axis=2)
    found, beside = np.zeros(bright.shape, bool), max(1, round(BESIDE * max(bright.shape)))
    for axis in (0, 1):
        lit = np.flatnonzero(np.quantile(bright, 0.98, axis=1 - axis) > BLACK)
        if len(lit):
            along = np.ones(bright.shape[axis], bool)
            first, last = lit[0] + beside * (lit[0] > 0), lit[-1] + 1 - beside * (lit[-1] + 1 < len(along))
            along[first:last] = False
            found |= along[:, None] if axis == 0 else along[None]
    return found


def _as_taken(file: Path, camera: Camera) -> Image.Image:
    """The picture whose sides are in proportion to the camera's: as it is stored, or turned as its EXIF says."""
    stored = read_photo(file)
    for picture in (stored, ImageOps.exif_transpose(stored)):
        if abs(picture.width * camera.size[1] - picture.height * camera.size[0]) <= 2 * max(camera.size):
            return picture.convert("RGBA")
    raise ViewsError(
        f"it has {stored.width} × {stored.height} pixels, its camera {camera.size[0]} × {camera.size[1]}.",
        photo=file.name, remedy="Give the photo that the pose is of, not cropped or turned.",
    )
