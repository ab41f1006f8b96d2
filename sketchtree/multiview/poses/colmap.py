"""What does a COLMAP model say? A folder with cameras, images and points3D, as text or binary → Poses.

Both kinds are read into the same rows: a camera is (model, width, height, numbers), an image (quaternion, translation, camera, name, ids of its points), and
x_camera = R X + t.
"""

import struct
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from sketchtree.errors import ViewsError
from sketchtree.multiview.cameras import Camera
from sketchtree.multiview.poses.colmap_models import NAME_OF, counted, matrix_and_lens, turned
from sketchtree.multiview.poses.posed import Posed, Poses


def read_colmap(folder: Path) -> Poses:
    """The photos of a COLMAP model. Raises ViewsError for files that are missing, cut short or contradict each other."""
    read = _binary if (folder / "cameras.bin").exists() else _text
    try:
        cameras, images, points, error = read(folder)
    except (ValueError, IndexError, struct.error, UnicodeDecodeError) as fault:
        raise ViewsError(f"The COLMAP model in {folder} can't be read ({fault}).", remedy="Export it from COLMAP again, as text or binary.") from None
    row_of = {number: row for row, number in enumerate(points)}
    photos = [_posed(image, cameras, row_of) for image in images]
    xyz = np.array(list(points.values()), np.float64).reshape(-1, 3)
    return Poses(tuple(sorted(photos, key=lambda photo: photo.name)), xyz, error=error)


def _posed(image, cameras, row_of) -> Posed:
    quaternion, translation, number, name, ids = image
    if number not in cameras:
        raise ViewsError(f"its camera {number} is not in the COLMAP model.", photo=name, remedy="Export cameras and images together.")
    model, width, height, numbers = cameras[number]
    matrix, lens = matrix_and_lens(model, numbers)
    rotation = turned(quaternion)
    camera = Camera(matrix, rotation, -rotation.T @ np.asarray(translation), (width, height))
    return Posed(name, camera, lens, np.array([row_of[k] for k in ids if k in row_of], np.int64))


def _lines(path: Path) -> Iterator[str]:
    """Lines that are not comments; an empty one is an image without points."""
    if not path.exists():
        raise ViewsError(f"The COLMAP model has no {path.name}.", remedy=f"Put {path.name} beside the other files of the model in {path.parent}.")
    with path.open(encoding="utf-8") as file:
        yield from (line.strip() for line in file if not line.startswith("#"))


def _text(folder: Path):
    cameras = {}
    for words in (line.split() for line in _lines(folder / "cameras.txt") if line):
        cameras[int(words[0])] = (words[1], int(words[2]), int(words[3]), [float(word) for word in words[4:]])
    images, lines = [], _lines(folder / "images.txt")
    for line in lines:
        if not line:
            continue
        words = line.split(maxsplit=9)
        pose = [float(word) for word in words[1:8]]
        images.append((pose[:4], pose[4:], int(words[8]), words[9], [int(word) for word in next(lines, "").split()[2::3]]))
    points, errors = {}, []
    if (folder / "points3D.txt").exists():
        for words in (line.split(maxsplit=8) for line in _lines(folder / "points3D.txt") if line):
            points[int(words[0])] = [float(word) for word in words[1:4]]
            errors.append(float(words[7]))
    return cameras, images, points, float(np.mean(errors)) if errors else None


class _Bytes:
    """A binary file read number by number."""

    def __init__(self, path: Path):
        if not path.exists():
            raise ViewsError(f"The COLMAP model has no {path.name}.", remedy=f"Put {path.name} beside the other files of the model in {path.parent}.")
        self.data, self.at = path.read_bytes(), 0

    def take(self, form: str) -> tuple:
        """The next numbers, little-endian."""
        found = struct.unpack_from("<" + form, self.data, self.at)
        self.at += struct.calcsize("<" + form)
        return found

    def name(self) -> str:
        """Text up to a zero byte."""
        end = self.data.index(b"\0", self.at)
        text, self.at = self.data[self.at : end].decode(), end + 1
        return text

    def column(self, kind: np.dtype, count: int) -> np.ndarray:
        """So many records."""
        found = np.frombuffer(self.data, kind, count, self.at)
        self.at += found.nbytes
        return found


_SEEN = np.dtype([("xy", "<f8", 2), ("point", "<i8")])


def _binary(folder: Path):
    file, cameras, images, points, errors = _Bytes(folder / "cameras.bin"), {}, [], {}, []
    for _ in range(file.take("Q")[0]):
        number, model, width, height = file.take("iiQQ")
        name = NAME_OF.get(model, str(model))
        cameras[number] = (name, width, height, list(file.take(f"{counted(name)}d")))
    file = _Bytes(folder / "images.bin")
    for _ in range(file.take("Q")[0]):
        pose = file.take("i7di")
        name = file.name()
        images.append((list(pose[1:5]), list(pose[5:8]), pose[8], name, file.column(_SEEN, file.take("Q")[0])["point"].tolist()))
    if (folder / "points3D.bin").exists():
        file = _Bytes(folder / "points3D.bin")
        for _ in range(file.take("Q")[0]):
            found = file.take("Q3d3BdQ")
            points[found[0]] = list(found[1:4])
            errors.append(found[7])
            file.at += 8 * found[8]
    return cameras, images, points, float(np.mean(errors)) if errors else None
