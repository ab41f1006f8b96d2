"""What does a tree look like from all sides? A film in which it turns once.

The camera keeps its distance and its height: it is framed once, round everything that comes into view in a whole turn. GIF, WebP and APNG are
written by Pillow; MP4 by the program `ffmpeg`, where it is installed.
"""

import io
import shutil
import subprocess
import tempfile
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from PIL import Image

from sketchtree.errors import ExportError, OptionError
from sketchtree.export.files import check_extension, check_writable, write_whole
from sketchtree.geometry.mesh import Mesh
from sketchtree.view.picture import draw_in_child, request_of

FILMS = (".gif", ".webp", ".apng", ".mp4")
"""Extensions of films."""

_ELEVATION = 6.0  # degrees, of the camera
_ROUND = np.radians(np.arange(0, 360, 15))
_LEVELS = 24  # heights at which the tree's reach is looked at
_PER_FRAME = 20.0  # seconds that a picture may take


def turntable(
    meshes: Sequence[Mesh], path: str | Path, *, size: tuple[int, int] = (640, 640), frames: int = 48, seconds: float = 6.0, timeout: float | None = None
) -> tuple[bool, str]:
    """Draw the tree turning once, in `frames` pictures of `size` pixels and so many `seconds`. (True, "") or (False, one line that says why not).

    Raises `ExportError` for another extension than those of `FILMS`, a place that can't be written, or `.mp4` without ffmpeg, `OptionError` for
    fewer than 2 or more than 720 frames, or a time that is none.
    """
    path = Path(path)
    check_film(path)
    if not 2 <= frames <= 720:
        raise OptionError(f"A film of {frames} frames can't be made.", remedy="Ask for 2 to 720.")
    if not 0.1 <= seconds <= 600:
        raise OptionError(f"A film of {seconds:g} seconds can't be made.", remedy="Ask for 0.1 to 600.")
    meshes = [mesh for mesh in meshes if len(mesh.triangle)]
    if not meshes:
        return False, "No film was drawn: there is nothing to show."
    angles = [(360.0 * k / frames, _ELEVATION) for k in range(frames)]
    request = request_of(meshes, angles, size, around=_whirled(np.vstack([mesh.position[np.unique(mesh.triangle)] for mesh in meshes])))
    with tempfile.TemporaryDirectory(prefix="sketchtree-film-") as folder:
        sheet = Path(folder) / "sheet.png"
        drawn, reason = draw_in_child(request, sheet, 60.0 + _PER_FRAME * frames if timeout is None else timeout)
        if not drawn:
            return False, reason
        with Image.open(sheet) as whole:
            write_film(path, _cut(whole, size, frames), seconds)
    return True, ""


def check_film(path: str | Path) -> None:
    """Refuse, before the work, a film that can't be written. Raises `ExportError`."""
    suffix = check_extension(path, FILMS)
    check_writable(path)
    if suffix == ".mp4" and shutil.which("ffmpeg") is None:
        raise ExportError(f"Can't write {path}: the program `ffmpeg` was not found.", remedy="Install it, or ask for a .gif, .webp or .apng.")


def write_film(path: str | Path, pictures: Sequence[Image.Image], seconds: float) -> None:
    """Write pictures of one size as a film that runs for so many seconds, and again and again. Whole or not at all."""
    path = Path(path)
    suffix = check_extension(path, FILMS)
    if suffix == ".mp4":
        write_whole(path, _mp4(pictures, len(pictures) / seconds))
        return
    film, each = io.BytesIO(), max(round(1000 * seconds / len(pictures)), 10)
    kind, how = {
        ".gif": ("GIF", {"optimize": False, "disposal": 1}),
        ".webp": ("WEBP", {"quality": 85, "method": 4}),
        ".apng": ("PNG", {}),
    }[suffix]
    shown = _palettes(pictures) if suffix == ".gif" else list(pictures)
    shown[0].save(film, kind, save_all=True, append_images=shown[1:], duration=each, loop=0, **how)
    write_whole(path, film.getvalue())


def _whirled(points) -> np.ndarray:
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


def _palettes(pictures) -> list[Image.Image]:
    """All in one palette, so that colours do not flicker."""
    step = max(len(pictures) // 6, 1)
    few = pictures[::step]
    strip = Image.new("RGB", (few[0].width * len(few), few[0].height))
    for k, picture in enumerate(few):
        strip.paste(picture, (k * picture.width, 0))
    palette = strip.quantize(255, method=Image.Quantize.MEDIANCUT)
    return [picture.quantize(palette=palette, dither=Image.Dither.FLOYDSTEINBERG) for picture in pictures]


def _mp4(pictures: Sequence[Image.Image], rate: float) -> bytes:
    """H.264 where ffmpeg has it, else MPEG-4; sides are made even."""
    width, height = (n - n % 2 for n in pictures[0].size)
    raw = b"".join(picture.convert("RGB").crop((0, 0, width, height)).tobytes() for picture in pictures)
    with tempfile.TemporaryDirectory(prefix="sketchtree-film-") as folder:
        film, said = Path(folder) / "film.mp4", ""
        source = ["-f", "rawvideo", "-pix_fmt", "rgb24", "-s", f"{width}x{height}", "-r", f"{rate:.6f}", "-i", "-"]
        exact = ["-fflags", "+bitexact", "-flags:v", "+bitexact", "-map_metadata", "-1", "-movflags", "+faststart"]
        for codec in (["-c:v", "libx264", "-crf", "18", "-threads", "1"], ["-c:v", "mpeg4", "-q:v", "3"]):
            command = ["ffmpeg", "-loglevel", "error", "-y", *source, *codec, "-pix_fmt", "yuv420p", *exact, str(film)]
            run = subprocess.run(command, input=raw, capture_output=True)
            if run.returncode == 0 and film.exists():
                return film.read_bytes()
            said = run.stderr.decode(errors="replace").strip().splitlines()[-1:]
        raise ExportError(f"ffmpeg made no film: {said[0] if said else 'it gave no reason'}.", remedy="Ask for a .gif, .webp or .apng.")
