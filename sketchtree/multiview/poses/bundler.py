"""What does a Bundler file say (Snavely's bundle.out, v0.3)? Cameras in the order of list.txt beside it, or else of the photos' names.

    P = R X + t,   p = −(P_x, P_y) / P_z,   pixel = f (1 + k₁|p|² + k₂|p|⁴) p    from the picture's middle, y up; the camera looks along −z
"""

from pathlib import Path

import numpy as np

from sketchtree.errors import ViewsError
from sketchtree.multiview.cameras import Camera
from sketchtree.multiview.lenses import Lens
from sketchtree.multiview.poses.posed import Posed, Poses
from sketchtree.multiview.poses.transforms import Size

_FLIP = np.diag([1.0, -1.0, -1.0])


def read_bundler(path: Path, size: Size, names: list[str]) -> Poses:
    """The photos of a Bundler file that it could place; `names`: of the photos, for files without a list.txt."""
    listed = path.with_name("list.txt")
    if listed.exists():
        names = [line.split()[0] for line in listed.read_text(encoding="utf-8").splitlines() if line.strip()]
    try:
        words = path.read_text(encoding="utf-8").split("\n", 1)[1].split()
        cameras, points = int(words[0]), int(words[1])
        numbers = np.array(words[2 : 2 + 15 * cameras], np.float64).reshape(cameras, 5, 3)
        xyz, seen_by = _points(words[2 + 15 * cameras :], points)
    except (ValueError, IndexError) as fault:
        raise ViewsError(f"{path.name} is no Bundler file ({fault}).", remedy="Give a bundle.out of version 0.3.") from None
    if len(names) != cameras:
        raise ViewsError(f"{path.name} has {cameras} cameras, but there are {len(names)} photos.", remedy="Put Bundler's list.txt beside it.")
    photos = []
    for k, (name, block) in enumerate(zip(names, numbers, strict=True)):
        if block[0, 0] > 0:  # Bundler writes zeros for a photo that it could not place
            file, (width, height) = size(name)
            matrix = np.array([[block[0, 0], 0.0, width / 2], [0.0, block[0, 0], height / 2], [0.0, 0.0, 1.0]])
            camera = Camera(matrix, _FLIP @ block[1:4], -block[1:4].T @ block[4], (width, height))
            photos.append(Posed(file, camera, Lens(tuple(block[0, 1:])), np.array(seen_by.get(k, []), np.int64)))
    return Poses(tuple(sorted(photos, key=lambda photo: photo.name)), xyz)


def _points(words: list[str], count: int) -> tuple[np.ndarray, dict[int, list[int]]]:
    """Places, and which of them each camera sees."""
    xyz, seen_by, at = np.zeros((count, 3)), {}, 0
    for row in range(count):
        xyz[row] = [float(word) for word in words[at : at + 3]]
        views = int(words[at + 6])
        for k in range(views):
            seen_by.setdefault(int(words[at + 7 + 4 * k]), []).append(row)
        at += 7 + 4 * views
    return xyz, seen_by
