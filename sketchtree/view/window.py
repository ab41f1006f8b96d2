"""A window in which a tree can be turned and looked at closely: left button turns, right button or wheel goes nearer, middle button moves; `q` closes it."""

import os
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from sketchtree.errors import ExportError
from sketchtree.geometry.mesh import Mesh
from sketchtree.view import picture

_OTHERWISE = "Use `--screenshot P.png`, which needs no screen."


def has_screen() -> bool:
    """A window would be seen. Without one VTK draws into memory, and nobody sees it."""
    return not sys.platform.startswith("linux") or bool(os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY"))


def window(meshes: Sequence[Mesh], title: str, *, size: tuple[int, int] = (1200, 900)) -> None:
    """Open a window and wait until it is closed. Raises `ExportError` where none can be opened, or there is nothing to show."""
    meshes = [mesh for mesh in meshes if len(mesh.triangle)]
    if not meshes:
        raise ExportError("No window was opened: there is nothing to show.", remedy="Give a tree that has at least one branch.")
    if not has_screen():
        raise ExportError("No window could be opened: there is no screen here.", remedy=_OTHERWISE)
    request = picture.request_of(meshes, [picture.VIEWS["three-quarter"]], size) | {"title": np.array(title)}
    with tempfile.TemporaryDirectory(prefix="sketchtree-view-") as folder:
        asked = Path(folder) / "request.npz"
        np.savez(asked, **request)
        child = subprocess.run(picture.command(asked, "window"), capture_output=True, text=True, errors="replace")
    if child.returncode == 0:
        return
    reason = picture.reason_of(child)
    why = "there is no OpenGL here" if reason == picture.NO_OPENGL else reason.split(": ", 1)[-1].rstrip(".")
    raise ExportError(f"No window could be opened: {why}.", remedy=_OTHERWISE)
