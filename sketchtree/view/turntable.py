"""What does a tree look like from all sides? A film in which it turns once.

The camera keeps its distance and its height: it is framed once, round everything that comes into view in a whole turn.
"""

import tempfile
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from PIL import Image

from sketchtree.geometry.mesh import Mesh
from sketchtree.view.film import FILMS, check_film, check_length, write_film
from sketchtree.view.picture import draw_in_child, request_of

__all__ = ["ELEVATION", "FILMS", "check_film", "turntable", "whirled", "write_film"]

ELEVATION = 6.0
"""Of the camera, degrees."""
_ROUND = np.radians(np.arange(0, 360, 15))
_LEVELS = 24  # heights at which the tree's reach is looked at
_PER_FRAME = 20.0  # seconds that a picture may take


def turntable(
    meshes: Sequence[Mesh], path: str | Path, *, size: tuple[int, int] = (640, 640), frames: int = 48, seconds: float = 6.0, timeout: float | None = None
) -> tuple[bool, str]:
    """Draw the tree turning once, in `frames` pictures of `size` pixels and so many `seconds`. (True, "") or (False, one line that says why not).

    Raises `ExportError` for another extension than those of `FILMS`, a place that can't be written, or `.mp4` without an ffmpeg that has H.264, `OptionError` for
    fewer than 2 or more than 720 frames, or a time that is none.
    """
    path = Path(path)
    check_film(path)
    check_length(frames, seconds)
    meshes = [mesh for mesh in meshes if len(mesh.triangle)]
    if not meshes:
        return False, "No film was drawn: there is nothing to show."
    angles = [(360.0 * k / frames, ELEVATION) for k in range(frames)]
    request = request_of(meshes, angles, size, around=whirled(np.vstack([mesh.position[np.unique(mesh.triangle)] for mesh in meshes])))
    with tempfile.TemporaryDirectory(prefix="sketchtree-film-") as folder:
        sheet = Path(folder) / "sheet.png"
        drawn, reason = draw_in_child(request, sheet, 60.0 + _PER_FRAME * frames if timeout is None else timeout)
        if not drawn:
            return False, reason
        with Image.open(sheet) as whole:
            write_film(path, _cut(whole, size, frames), seconds)
    return True, ""


def whirled(points) -> np.ndarray:
    """Circles round the tree's middle that hold it in every turn, at some heights."""
    low, high = points.min(axis=0), points.max(axis=0)
    centre = 0.5 * (low + high)
    reach = np.hypot(points[:, 0] - centre[0], points[:, 2] - centre[2])
    level = np.minimum(((points[:, 1] - low[1]) / max(high[1] - low[1], 1e-9) * _LEVELS).astype(int), _LEVELS - 1)
    widest = np.zeros(_LEVELS)
    np.maximum.at(widest, level, reach)
    edge = low[1] + (high[1] - low[1]) * np.arange(_LEVELS + 1) / _LEVELS
    ring = np.stack([np.sin(_ROUND), np.cos(_ROUND)], axis=1)
    circles = [np.column_stack([centre[0] + r * ring[:, 0], np.full(len(ring), y), centre[2] + r * ring[:, 1]]) for r, y in zip(np.r_[widest, widest], np.r_[edge[:-1], edge[1:]])]
    return np.concatenate(circles)


def _cut(sheet: Image.Image, size: tuple[int, int], frames: int) -> list[Image.Image]:
    columns = sheet.width // size[0]
    place = [((k % columns) * size[0], (k // columns) * size[1]) for k in range(frames)]
    return [sheet.crop((x, y, x + size[0], y + size[1])) for x, y in place]
