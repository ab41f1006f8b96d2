"""How does a tree look beside the picture it was made of? The picture, the tree in the very same frame without perspective, and the tree from its right side."""

import io
import tempfile
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from jaxtyping import Float, UInt8
from PIL import Image

from sketchtree.export.files import check_writable, write_whole
from sketchtree.geometry.mesh import Mesh
from sketchtree.view.picture import draw_in_child, request_of

_LARGEST = 900  # pixels, the longer side of a panel at most


def beside(
    picture: UInt8[np.ndarray, "row column 3"], meshes: Sequence[Mesh], frame: tuple[float, float, float, float], png_path: str | Path, *, timeout: float = 180.0
) -> tuple[bool, str]:
    """Draw the three panels. `frame`: left, bottom, right and top of the picture in the world, metres. (True, "") or (False, one line that says why not).

    Raises ExportError for a place that can't be written."""
    png_path = Path(png_path)
    check_writable(png_path)
    meshes = [mesh for mesh in meshes if len(mesh.triangle)]
    if not meshes:
        return False, "No picture was drawn: there is nothing to show."
    whole = Image.fromarray(picture)
    whole.thumbnail((_LARGEST, _LARGEST))
    panels = [whole]
    for azimuth in (0.0, 90.0):
        drawn, reason = _panel(meshes, frame, azimuth, whole.size, timeout)
        if drawn is None:
            return False, reason
        panels.append(drawn)
    sheet = Image.new("RGB", (sum(panel.width for panel in panels), whole.height))
    for k, panel in enumerate(panels):
        sheet.paste(panel, (k * whole.width, 0))
    bytes_ = io.BytesIO()
    sheet.save(bytes_, "PNG")
    write_whole(png_path, bytes_.getvalue())
    return True, ""


def _panel(meshes: Sequence[Mesh], frame, azimuth: float, size: tuple[int, int], timeout: float) -> tuple[Image.Image | None, str]:
    """The meshes in a frame, seen without perspective; turned about the middle of what there is."""
    request = request_of(meshes, [(azimuth, 0.0)], size, ground=False, supersample=2)
    request["camera"] = _camera(meshes, frame, azimuth)[None]
    request["parallel"] = np.array(frame[3] - frame[1])
    with tempfile.TemporaryDirectory(prefix="sketchtree-beside-") as folder:
        path = Path(folder) / "panel.png"
        drawn, reason = draw_in_child(request, path, timeout)
        if not drawn:
            return None, reason
        with Image.open(path) as image:
            return image.convert("RGB"), ""


def _camera(meshes: Sequence[Mesh], frame, azimuth: float) -> Float[np.ndarray, " 10"]:
    """Eye, target, up and an unused field of view, in the axes that `request_of` draws in (moved so that the meshes' middle stands at 0)."""
    points = np.vstack([mesh.position[np.unique(mesh.triangle)] for mesh in meshes])
    low, high = points.min(axis=0), points.max(axis=0)
    middle = np.array([0.5 * (low[0] + high[0]), low[1], 0.5 * (low[2] + high[2])])
    turn = np.radians(azimuth)
    back, right = np.array([np.sin(turn), 0.0, np.cos(turn)]), np.array([np.cos(turn), 0.0, -np.sin(turn)])
    aside = (0.5 * (frame[0] + frame[2]) - middle[0]) * right if azimuth == 0.0 else np.zeros(3)
    target = aside + np.array([0.0, 0.5 * (frame[1] + frame[3]) - middle[1], 0.0])
    far = 2.0 * float(np.linalg.norm(high - low)) + (frame[3] - frame[1])
    return np.concatenate([target + far * back, target, [0.0, 1.0, 0.0], [30.0]])
