"""What do the numbers of a COLMAP camera mean? Model and numbers → matrix and lens."""

import numpy as np

from sketchtree.errors import ViewsError
from sketchtree.multiview.lenses import Lens

MODELS = {  # number in binary files, how many numbers a camera has
    "SIMPLE_PINHOLE": (0, 3),
    "PINHOLE": (1, 4),
    "SIMPLE_RADIAL": (2, 4),
    "RADIAL": (3, 5),
    "OPENCV": (4, 8),
    "OPENCV_FISHEYE": (5, 8),
    "FULL_OPENCV": (6, 12),
    "SIMPLE_RADIAL_FISHEYE": (8, 4),
    "RADIAL_FISHEYE": (9, 5),
}
_OTHER = {7: "FOV", 10: "THIN_PRISM_FISHEYE"}
NAME_OF = {number: name for name, (number, _) in MODELS.items()} | _OTHER
_ONE_FOCAL = ("SIMPLE_PINHOLE", "SIMPLE_RADIAL", "RADIAL", "SIMPLE_RADIAL_FISHEYE", "RADIAL_FISHEYE")


def counted(model: str) -> int:
    """How many numbers a camera of that model has."""
    if model not in MODELS:
        raise ViewsError(
            f"COLMAP's camera model {model} is not read.",
            remedy=f"Let COLMAP undistort the photos, or use one of: {', '.join(MODELS)}.",
        )
    return MODELS[model][1]


def matrix_and_lens(model: str, numbers: list[float]) -> tuple[np.ndarray, Lens]:
    """Intrinsic matrix and lens of a COLMAP camera."""
    if len(numbers) != counted(model):
        raise ViewsError(f"A camera of COLMAP's model {model} has {len(numbers)} numbers, not {counted(model)}.", remedy="Export the cameras again.")
    across, down, x, y = (numbers[0], *numbers[:3]) if model in _ONE_FOCAL else numbers[:4]
    rest = tuple(float(k) for k in numbers[3 if model in _ONE_FOCAL else 4 :])
    matrix = np.array([[across, 0.0, x], [0.0, down, y], [0.0, 0.0, 1.0]])
    if model.endswith("FISHEYE"):
        return matrix, Lens(rest, fisheye=True)
    if model in ("OPENCV", "FULL_OPENCV"):
        return matrix, Lens(rest[:2] + rest[4:], (rest[2], rest[3]))
    return matrix, Lens(rest)


def turned(quaternion: list[float]) -> np.ndarray:
    """The rotation of a quaternion w x y z."""
    w, x, y, z = np.asarray(quaternion, np.float64) / np.linalg.norm(quaternion)
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )
