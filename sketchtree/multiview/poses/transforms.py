"""What does a transforms.json say (NeRF, instant-ngp, nerfstudio)?

Frames hold camera → world matrices whose camera looks along −z with y up (OpenGL); the world is z up. Intrinsics stand once for all or in each frame: `fl_x`,
`fl_y`, or the angle of view `camera_angle_x`; `cx`, `cy`; `w`, `h`; a lens `k1 k2 k3 k4 p1 p2`, a fisheye's where `camera_model` is OPENCV_FISHEYE.
"""

import json
from collections import Counter
from collections.abc import Callable
from pathlib import Path

import numpy as np

from sketchtree.errors import ViewsError
from sketchtree.multiview.cameras import Camera
from sketchtree.multiview.lenses import Lens
from sketchtree.multiview.poses.posed import Posed, Poses

Size = Callable[[str], tuple[str, tuple[int, int]]]
"""A photo's name as a file of poses tells it → its file's name and its width and height."""

_WHOLE = "Give the photo that the pose is of, not cropped or made smaller, or write `w` and `h` of the one that it was."
_FLIP = np.diag([1.0, -1.0, -1.0])  # OpenGL's camera ↔ ours


def read_transforms(path: Path, size: Size) -> Poses:
    """The photos of a transforms.json. Raises ViewsError where it says no camera."""
    try:
        found = json.loads(path.read_text(encoding="utf-8"))
        frames = found["frames"]
        if not isinstance(frames, list) or not frames:
            raise ValueError("no frames")
    except (ValueError, KeyError, TypeError) as fault:
        raise ViewsError(f"{path.name} is no transforms.json ({fault}).", remedy="Give a file with `frames`, each with `file_path` and `transform_matrix`.") from None
    photos = [_posed(found | frame, size) for frame in frames]
    if "fl_x" in found and not {"w", "h"} <= set(found):
        _of_one_camera([photo for photo, frame in zip(photos, frames, strict=True) if not {"fl_x", "w", "h"} & set(frame)])
    return Poses(tuple(sorted(photos, key=lambda photo: photo.name)), up=np.array([0.0, 0.0, 1.0]))


def _posed(frame: dict, size: Size) -> Posed:
    name = str(frame.get("file_path", ""))
    try:
        pose = np.array(frame["transform_matrix"], np.float64)[:3]
        if pose.shape != (3, 4):
            raise ValueError
        name, photo_size = size(name)
        width, height = (int(frame.get(key, other)) for key, other in zip("wh", photo_size, strict=True))
        across = float(frame["fl_x"]) if "fl_x" in frame else 0.5 * width / np.tan(0.5 * float(frame["camera_angle_x"]))
        down = float(frame.get("fl_y", across))
        middle = float(frame.get("cx", 0.5 * width)), float(frame.get("cy", 0.5 * height))
    except (KeyError, ValueError, TypeError):
        raise ViewsError("its frame lacks a `transform_matrix` of 4 × 4 or a focal length.", photo=name, remedy="Give `fl_x` (pixels) or `camera_angle_x` (radians).") from None
    if not (0 < middle[0] < width and 0 < middle[1] < height):
        raise ViewsError(f"it has {width} × {height} pixels, the middle of its lens is at ({middle[0]:g}, {middle[1]:g}).", photo=name, remedy=_WHOLE)
    scale = np.linalg.norm(pose[:, 0])
    matrix = np.array([[across, 0.0, middle[0]], [0.0, down, middle[1]], [0.0, 0.0, 1.0]])
    return Posed(name, Camera(matrix, _FLIP @ (pose[:, :3] / max(scale, 1e-12)).T, pose[:, 3], (width, height)), _lens(frame))


def _of_one_camera(photos: list[Posed]) -> None:
    """Raise ViewsError where photos of one focal length in pixels, whose sizes no one wrote down, differ in size: some are cropped or made smaller."""
    sizes = Counter(photo.camera.size for photo in photos)
    usual = max(sizes, key=sizes.get, default=None)
    for photo in photos:
        if photo.camera.size != usual:
            (width, height), (w, h) = photo.camera.size, usual
            raise ViewsError(f"it has {width} × {height} pixels, others of the same camera {w} × {h}.", photo=photo.name, remedy=_WHOLE)


def _lens(frame: dict) -> Lens:
    radial = tuple(float(frame.get(f"k{n}", 0.0)) for n in range(1, 5))
    if "FISHEYE" in str(frame.get("camera_model", "")) or frame.get("is_fisheye"):
        return Lens(radial, fisheye=True)
    return Lens(radial[:3], (float(frame.get("p1", 0.0)), float(frame.get("p2", 0.0))))
