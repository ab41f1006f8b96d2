"""What does a tree look like? One call draws a picture of its meshes with pyvista, off screen.

VTK ends the whole process where no OpenGL can be had, so the drawing happens in a child process
(`child.py`): the caller learns whether there is a picture and, if not, why, and goes on.
"""

import subprocess
import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from jaxtyping import Float

from sketchtree.errors import OptionError
from sketchtree.export.files import check_writable, write_whole
from sketchtree.geometry.mesh import Mesh
from sketchtree.view.light import baked_light, ground_light

VIEWS = {"front": (0.0, 4.0), "side": (90.0, 4.0), "back": (180.0, 4.0), "top": (0.0, 89.0), "three-quarter": (32.0, 9.0)}
"""Azimuth and elevation of the camera, degrees; azimuth 0 looks from +z, 90 from +x."""

NO_OPENGL = (
    "No picture could be drawn: there is no OpenGL on this machine. Install Mesa's software renderer, "
    "for example `apt install libgl1 libegl1 libgl1-mesa-dri`."
)

REFUSED = "No picture could be drawn: this machine's OpenGL is too old for our shaders (3.2 is needed). Install a newer graphics driver or Mesa."

_FIELD = 26.0  # degrees, vertical
_MARGIN = 0.06  # of the picture, free on every side
_CHILD = Path(__file__).with_name("child.py")
_FRAGMENTS = 4e8  # surface pixels drawn on top of each other, at most, before a picture is drawn less smoothly
SKY = {"horizon": (0.925, 0.930, 0.915), "zenith": (0.690, 0.775, 0.850), "earth": (0.700, 0.690, 0.630)}  # sRGB


def preview(
    meshes: Sequence[Mesh] | str | Path,
    png_path: str | Path,
    *,
    size: tuple[int, int] = (1200, 900),
    view: str | Sequence[str] = "three-quarter",
    azimuth: float | None = None,
    elevation: float | None = None,
    focus: tuple[tuple[float, float, float], float] | None = None,
    ground: bool = True,
    supersample: int = 2,
    timeout: float = 180.0,
) -> tuple[bool, str]:
    """Draw meshes, or a GLB file, to a PNG. Returns (True, "") or (False, one line that says why not).

    `view` is one of `VIEWS`, or several for a sheet of pictures of that `size` (pixels) each; `azimuth` and
    `elevation` (degrees) override it. `focus` is a place and a radius (metres) to fill the picture instead of the
    whole tree. `supersample` (1 or more) smooths edges; where many leaves stand before the camera it falls to what can be
    drawn in time. Raises OptionError for an unknown view, ExportError for a file that is no GLB or a place that can't be written.
    """
    angles = [_angles(name, azimuth, elevation) for name in ([view] if isinstance(view, str) else view)]
    if isinstance(meshes, (str, Path)):
        from sketchtree.export.gltf import read_glb

        meshes = read_glb(meshes)
    meshes = [mesh for mesh in meshes if len(mesh.triangle)]
    if not meshes:
        return False, "No picture was drawn: there is nothing to show."
    return draw_in_child(request_of(meshes, angles, size, focus=focus, ground=ground, supersample=supersample), Path(png_path), timeout)


def _angles(view: str, azimuth, elevation) -> tuple[float, float]:
    if view not in VIEWS:
        raise OptionError(f"There is no view called {view!r}.", remedy=f"Choose one of: {', '.join(VIEWS)}.")
    return VIEWS[view][0] if azimuth is None else azimuth, VIEWS[view][1] if elevation is None else elevation


def request_of(
    meshes: Sequence[Mesh], angles: Sequence[tuple[float, float]], size: tuple[int, int], *,
    focus=None, ground: bool = True, supersample: int = 1, around: Float[np.ndarray, "point 3"] | None = None,
) -> dict[str, np.ndarray]:
    """What the child is to draw: one picture of `size` pixels for each azimuth and elevation (degrees). Each shows all meshes, or the
    ball of a `focus` (place and radius, metres), or the points `around` (metres)."""
    points = np.vstack([mesh.position[np.unique(mesh.triangle)] for mesh in meshes])
    centroid, area = (np.concatenate(column) for column in zip(*map(surfaces, meshes), strict=True))
    shift = footing(points)
    sun = sun_of(angles[0][0])
    request = {"size": np.array(size), "meshes": np.array(len(meshes)), "sun": sun}
    request |= {name: np.array(colour) for name, colour in SKY.items()}
    request["columns"] = np.array(int(np.ceil(np.sqrt(len(angles)))))
    if around is None:
        around = points if focus is None else np.asarray(focus[0]) + focus[1] * _ball()
    around = around - shift
    request["camera"] = np.array([frame_camera(around, *angle, size[0] / size[1]) for angle in angles])
    drawn = max(fragments(centroid - shift, area, camera, size) for camera in request["camera"])
    request["supersample"] = np.array(affordable(supersample, drawn))
    lights = baked_light([lifted(mesh) for mesh in meshes], centroid, area, sun)
    for k, (mesh, light) in enumerate(zip(meshes, lights, strict=True)):
        request |= {f"{k}.{name}": value for name, value in (moved_part(mesh, light, shift) | _still_part(mesh)).items()}
    if ground:
        request["reach"] = np.array(reach_of(points))
        request["ground"] = ground_picture(centroid - shift, area, sun, float(request["reach"]))
    return request


def footing(points: Float[np.ndarray, "point 3"]) -> Float[np.ndarray, " 3"]:
    """The place on the ground under the middle of all: the origin of what is drawn."""
    low, high = points.min(axis=0), points.max(axis=0)
    return np.array([0.5 * (low[0] + high[0]), low[1], 0.5 * (low[2] + high[2])])


def sun_of(azimuth: float) -> Float[np.ndarray, " 3"]:
    """Where the sun stands for a camera at that azimuth: to its left, above."""
    return direction(azimuth - 48.0, 47.0)


def reach_of(points: Float[np.ndarray, "point 3"]) -> float:
    """How far the ground is drawn, metres."""
    return 2.2 * float(np.linalg.norm(np.ptp(points, axis=0)))


def ground_picture(centroid, area, sun, reach: float) -> np.ndarray:
    """The light on the ground, for the child."""
    light = ground_light(centroid, area, sun, reach, pixels=512)
    return np.repeat(np.round(255 * light).astype(np.uint8)[..., None], 3, axis=2)


def frame_camera(points: Float[np.ndarray, "point 3"], azimuth: float, elevation: float, aspect: float) -> Float[np.ndarray, " 10"]:
    """Eye, target, up and field of view (degrees) of the nearest camera in that direction that sees all points
    with a margin."""
    back = direction(azimuth, elevation)
    right = np.array([np.cos(np.radians(azimuth)), 0.0, -np.sin(np.radians(azimuth))])
    up = np.cross(back, right)
    across, along, depth = points @ right, points @ up, points @ back
    high = np.tan(np.radians(_FIELD / 2)) * (1 - 2 * _MARGIN)
    wide = high * aspect
    x, y = (across.min() + across.max()) / 2, (along.min() + along.max()) / 2
    for _ in range(12):
        distance = max(np.max(depth + np.abs(across - x) / wide), np.max(depth + np.abs(along - y) / high)) + 1e-9
        x += _middle((across - x) / (distance - depth)) * (distance - depth.max())
        y += _middle((along - y) / (distance - depth)) * (distance - depth.max())
    distance = max(np.max(depth + np.abs(across - x) / wide), np.max(depth + np.abs(along - y) / high)) + 1e-9
    at = x * right + y * up
    return np.concatenate([at + distance * back, at + depth.mean() * back, up, [_FIELD]])


def fragments(
    centroid: Float[np.ndarray, "triangle 3"], area: Float[np.ndarray, " triangle"], camera: Float[np.ndarray, " 10"], size: tuple[int, int]
) -> float:
    """About how many pixels all triangles in sight of a camera cover, one upon the other: the cost of a picture.

    Areas in m²; a triangle nearer than it is wide counts as a whole picture at most.
    """
    ahead = camera[3:6] - camera[:3]
    ahead = ahead / np.linalg.norm(ahead)
    away = centroid - camera[:3]
    depth = away @ ahead
    beside = np.linalg.norm(away - depth[:, None] * ahead, axis=1)
    reach = np.tan(np.radians(camera[9]) / 2)
    wide = depth * reach * np.hypot(1.0, size[0] / size[1]) + np.sqrt(area)
    seen = (depth > 0) & (beside < wide)
    pixel = 2 * reach * np.maximum(depth[seen], 1e-6) / size[1]
    return float(np.minimum(0.5 * area[seen] / pixel**2, size[0] * size[1]).sum())


def affordable(supersample: int, drawn: float) -> int:
    """The supersampling (1 or more) up to the one wanted that keeps within `_FRAGMENTS`."""
    return max(1, min(supersample, int(np.sqrt(_FRAGMENTS / max(drawn, 1.0)))))


def _middle(value) -> float:
    return float(value.min() + value.max()) / 2


def surfaces(mesh: Mesh) -> tuple[Float[np.ndarray, "triangle 3"], Float[np.ndarray, " triangle"]]:
    """Centroid and area (m²; a leaf card counts as the part its drawing fills) of every triangle."""
    a, b, c = (mesh.position[mesh.triangle[:, i]] for i in range(3))
    area = np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2
    texture = mesh.material.base_color_texture
    if mesh.material.alpha_cutoff is not None and texture is not None and texture.shape[2] == 4:
        area = area * max(0.2, float(np.mean(texture[..., 3] > 127)))
    else:
        area = area * 0.5
    return (a + b + c) / 3, area


def lifted(mesh: Mesh) -> Float[np.ndarray, "vertex 3"]:
    """Where a mesh's light is read: wood a little above its surface, so as not to lie in its own shade."""
    return mesh.position + (0.0 if mesh.material.alpha_cutoff is not None else 0.02) * mesh.normal


def moved_part(mesh: Mesh, light, shift) -> dict[str, np.ndarray]:
    """What of a mesh is another in every picture of a film."""
    return {
        "position": (mesh.position - shift).astype(np.float32),
        "normal": mesh.normal.astype(np.float32),
        "triangle": mesh.triangle.astype(np.int64),
        "light": light.astype(np.float32),
    }


def _still_part(mesh: Mesh) -> dict[str, np.ndarray]:
    material = mesh.material
    tint = np.ones((len(mesh.position), 3)) if mesh.color is None else mesh.color[:, :3]
    leaf = material.alpha_cutoff is not None
    return {
        "uv": mesh.uv.astype(np.float32),
        "tint": (tint * material.base_color[:3]).astype(np.float32),
        "albedo": _four(material.base_color_texture),
        "normal_map": np.full((2, 2, 3), (128, 128, 255), np.uint8) if material.normal_texture is None else material.normal_texture,
        "look": np.array([material.alpha_cutoff or 0.0, float(leaf), 0.25 * (1 - material.roughness)]),
    }


def _four(texture):
    if texture is None:
        return np.full((2, 2, 4), 255, np.uint8)
    return texture if texture.shape[2] == 4 else np.dstack([texture, np.full(texture.shape[:2], 255, np.uint8)])


def draw_in_child(request: dict[str, np.ndarray], png_path: Path, timeout: float) -> tuple[bool, str]:
    """Have the child draw the request into a PNG, within `timeout` seconds. (True, "") or (False, one line that says why not)."""
    check_writable(png_path)
    with tempfile.TemporaryDirectory(prefix="sketchtree-view-") as folder:
        asked, drawn = Path(folder) / "request.npz", Path(folder) / "picture.png"
        np.savez(asked, **request)
        try:
            child = subprocess.run(command(asked, drawn), capture_output=True, text=True, errors="replace", timeout=timeout)
        except subprocess.TimeoutExpired:
            return False, f"No picture was drawn: it took longer than {timeout:g} s. Ask for a smaller one, or for fewer leaves."
        if child.returncode or not drawn.exists():
            return False, reason_of(child)
        if "vtkShaderProgram" in child.stderr:
            return False, REFUSED
        write_whole(png_path, drawn.read_bytes())
    return True, ""


def command(asked: Path, drawn: Path | str) -> list[str]:
    """The child's command line."""
    return [sys.executable, "-P", str(_CHILD), str(asked), str(drawn)]


def reason_of(child: subprocess.CompletedProcess) -> str:
    """One line: VTK ended the process, the driver refused the shaders, or what Python said last."""
    if child.returncode < 0 or child.returncode > 128 or "OpenGL" in child.stdout + child.stderr:
        return NO_OPENGL
    lines = [line.strip() for line in child.stderr.splitlines() if line.strip()]
    return f"No picture could be drawn: {lines[-1] if lines else f'the drawing process ended with status {child.returncode}'}."


def direction(azimuth: float, elevation: float) -> Float[np.ndarray, " 3"]:
    a, e = np.radians(azimuth), np.radians(elevation)
    return np.array([np.sin(a) * np.cos(e), np.sin(e), np.cos(a) * np.cos(e)])


def _ball() -> Float[np.ndarray, "point 3"]:
    signs = np.array([[x, y, z] for x in (-1, 0, 1) for y in (-1, 0, 1) for z in (-1, 0, 1) if x or y or z], float)
    return signs / np.linalg.norm(signs, axis=1, keepdims=True)
