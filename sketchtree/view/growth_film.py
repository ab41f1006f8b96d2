"""What does a tree look like while it grows? A film from the bare ground to the final tree, its leaves unfolding.

One process draws all pictures, each as it comes; they lie on the disk until the film is put together. Camera, ground and the grid that shade is read from
are set once, round everything that is seen at any time: nothing is cropped, nothing jumps. Where the camera turns, it ends at the front.
"""

import subprocess
import tempfile
import threading
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Protocol

import numpy as np
from jaxtyping import Float
from PIL import Image
from scipy.spatial.transform import Rotation

from sketchtree.errors import OptionError
from sketchtree.geometry.mesh import Mesh
from sketchtree.view import picture
from sketchtree.view.film import check_film, check_length, write_film
from sketchtree.view.light import baked_light, extent_of
from sketchtree.view.turntable import ELEVATION, whirled

_SEEN_AT = (0.25, 0.5, 0.75, 0.9, 1.0)  # times at which the extent is looked at: bent branches may reach out farther than in the end
_SUPERSAMPLE = 2
_PER_FRAME = 60.0  # seconds that a picture may take
_MOST_TURN = 3600.0  # degrees
_DRAWN = 0.95  # of a film, that its pictures are


class Grows(Protocol):
    """What can be filmed: `animation.growing.Growing` is one."""

    def at(self, time: float) -> Sequence[Mesh]:
        """The meshes at a time, 0-1: always the same ones with the same vertices; what is not there yet has no triangles."""


def growth_film(
    growing: Grows, path: str | Path, *, size: tuple[int, int] = (640, 640), frames: int = 72, seconds: float = 6.0, turn: float = 0.0, hold: float = 1.5,
    timeout: float | None = None, part: Callable[[float], None] = lambda done: None,
) -> tuple[bool, str]:
    """Draw a tree that grows, in `frames` pictures of `size` pixels; the last stays `hold` seconds longer. (True, "") or (False, one line that says why not).

    `turn`: degrees by which the camera goes round meanwhile. `timeout`: seconds that any one picture may take; `part` is told how much is
    done, 0-1, at every picture, and what it raises ends the work. Raises `ExportError` for another extension than those of
    `film.FILMS`, a place that can't be written, or `.mp4` without an ffmpeg that has H.264, `OptionError` for frames, seconds, a hold or a turn out of range.
    """
    path = Path(path)
    check_film(path)
    check_length(frames, seconds, hold)
    if not abs(turn) <= _MOST_TURN:
        raise OptionError(f"A camera can't turn by {turn:g} degrees.", remedy=f"Ask for {-_MOST_TURN:g} to {_MOST_TURN:g}.")
    final = growing.at(1.0)
    if not any(mesh.triangle_count for mesh in final):
        return False, "No film was drawn: there is nothing to show."
    scene = _Scene(final, [growing.at(time) for time in _SEEN_AT[:-1]], size, turn)
    with tempfile.TemporaryDirectory(prefix="sketchtree-film-") as folder:
        place = Path(folder)
        reason = _drawn(growing, scene, place, frames, _PER_FRAME if timeout is None else timeout, part)
        if reason:
            return False, reason
        part(_DRAWN)
        write_film(path, _Pictures(place, frames), seconds, hold=hold)
    return True, ""


class _Pictures(Sequence):
    """The pictures of a folder, each read when it is asked for."""

    def __init__(self, folder: Path, count: int):
        self.folder, self.count = folder, count

    def __len__(self) -> int:
        return self.count

    def __getitem__(self, k: int) -> Image.Image:
        with Image.open(_named(self.folder, k)) as image:
            return image.convert("RGB")


class _Scene:
    """What stays while the tree grows."""

    def __init__(self, final: Sequence[Mesh], younger: Sequence[Sequence[Mesh]], size: tuple[int, int], turn: float):
        self.turn = turn
        self.rows = [k for k, mesh in enumerate(final) if len(mesh.position)]  # those that the process knows
        shown = [_with_a_triangle(final[k]) for k in self.rows]
        points = _points(shown)
        self.shift, self.reach, self.sun = picture.footing(points), picture.reach_of(points), picture.sun_of(0.0)
        everything = np.vstack([points, *map(_points, younger)])
        self.box = extent_of([everything, *(picture.lifted(mesh) for mesh in final)])
        self.box = self.box + 0.05 * np.ptp(self.box, axis=0) * [[-1.0], [1.0]]
        self.middle = extent_of([everything]).mean(axis=0) - self.shift
        around = whirled(everything) if turn else everything
        self.request = picture.request_of(shown, [(0.0, ELEVATION)], size, supersample=_SUPERSAMPLE, around=around)
        self.camera = self.request["camera"][0]

    def changes(self, meshes: Sequence[Mesh], time: float) -> dict[str, np.ndarray]:
        """What is another at that time."""
        meshes = [meshes[k] for k in self.rows]
        centroid, area = (np.concatenate(column) for column in zip(*map(picture.surfaces, meshes), strict=True))
        there = [mesh for mesh in meshes if mesh.triangle_count]
        lights = iter(baked_light([self._within(picture.lifted(mesh)) for mesh in there], self._within(centroid), area, self.sun, box=self.box) if there else [])
        changes = {"camera": self._camera_at(time)}
        changes["ground"] = picture.ground_picture(centroid - self.shift, area, self.sun, self.reach)
        for k, mesh in enumerate(meshes):
            light = next(lights) if mesh.triangle_count else np.ones((len(mesh.position), 2))
            changes |= {f"{k}.{name}": value for name, value in picture.moved_part(mesh, light, self.shift).items()}
        return changes

    def _camera_at(self, time: float):
        """The camera gone round the middle."""
        about = Rotation.from_euler("y", -self.turn * (1.0 - time), degrees=True)
        eye, target = (about.apply(self.camera[k : k + 3] - self.middle) + self.middle for k in (0, 3))
        return np.concatenate([eye, target, about.apply(self.camera[6:9]), self.camera[9:]])

    def _within(self, points):
        return np.clip(points, *self.box)


def _with_a_triangle(mesh: Mesh) -> Mesh:
    """The mesh itself; one that is not there in the end, as leaves that are shed, with a triangle that nobody sees."""
    return mesh if mesh.triangle_count else replace(mesh, triangle=np.zeros((1, 3), mesh.triangle.dtype))


def _points(meshes: Sequence[Mesh]) -> Float[np.ndarray, "point 3"]:
    return np.vstack([mesh.position[np.unique(mesh.triangle)] for mesh in meshes if mesh.triangle_count] or [np.zeros((0, 3))])


def _named(folder: Path, k: int) -> Path:
    return folder / f"{k:04d}.png"


def _drawn(growing: Grows, scene: _Scene, folder: Path, frames: int, timeout: float, part: Callable[[float], None]) -> str:
    """Draw all pictures into the folder; "" or one line that says why not."""
    asked = folder / "request.npz"
    np.savez(asked, **scene.request)
    with (folder / "said").open("w+") as said:
        child = subprocess.Popen(picture.command(asked, "film"), stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=said, text=True)
        watch = _Watch(child, timeout)
        try:
            for k in range(frames):
                part(_DRAWN * k / frames)
                changed = folder / f"changes_{k % 2}.npz"  # the next picture is prepared while one is drawn
                np.savez(changed, **scene.changes(growing.at(k / (frames - 1)), k / (frames - 1)))
                watch.answered()
                watch.ask(f"{changed}\t{_named(folder, k)}\n")
            watch.answered()
        except BrokenPipeError:  # it has ended; what it said tells why
            pass
        finally:
            watch.end()
        if watch.late:
            return f"No film was drawn: a picture took longer than {timeout:g} s. Ask for a smaller one, or for fewer leaves."
        said.seek(0)
        run = subprocess.CompletedProcess(child.args, child.returncode, "", said.read())
    if "vtkShaderProgram" in run.stderr:
        return picture.REFUSED
    return "" if _named(folder, frames - 1).exists() else picture.reason_of(run)


class _Watch:
    """The process that draws: it is told a line, answers with the same, and is ended if that takes too long."""

    def __init__(self, child: subprocess.Popen, timeout: float):
        self.child, self.timeout = child, timeout
        self.late, self.line = False, ""

    def ask(self, line: str) -> None:
        """Have a picture drawn. Raises BrokenPipeError where the process has ended."""
        self.child.stdin.write(line)
        self.child.stdin.flush()
        self.line = line

    def answered(self) -> None:
        """Wait for what was asked. Raises BrokenPipeError where there will be no answer."""
        if not self.line:
            return
        clock = threading.Timer(self.timeout, self._too_late)
        clock.start()
        try:
            while (answer := self.child.stdout.readline()) != self.line:
                if not answer:
                    raise BrokenPipeError
        finally:
            clock.cancel()
        self.line = ""

    def end(self) -> None:
        """Whatever happened, it is gone afterwards."""
        if self.line:
            self.child.kill()
        try:
            self.child.stdin.close()
        except BrokenPipeError:
            pass
        self.child.wait()
        self.child.stdout.close()

    def _too_late(self) -> None:
        self.late = True
        self.child.kill()
