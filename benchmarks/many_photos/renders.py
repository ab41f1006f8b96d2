"""Photos of a tree that is known: pyvista draws it from a ring of cameras whose poses are told, with its bark, light and ground."""

from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from jaxtyping import Float
from PIL import Image

from sketchtree.export.gltf import read_glb
from sketchtree.multiview.cameras import Camera
from sketchtree.multiview.photos import View
from sketchtree.multiview.poses.posed import Posed, Poses
from sketchtree.view.picture import draw_in_child, footing, request_of


@dataclass(frozen=True, eq=False)
class Rendered:
    """Views of a tree with its true surface, in metres, y up, the foot of the tree at the origin."""

    views: list[View]
    corner: Float[np.ndarray, "triangle 3 3"]  # of every triangle

    @property
    def cameras(self) -> list[Camera]:
        """All cameras."""
        return [view.camera for view in self.views]

    @property
    def poses(self) -> Poses:
        """Where the pictures were taken from."""
        return Poses(tuple(Posed(view.name, view.camera) for view in self.views), up=np.array([0.0, 1.0, 0.0]))

    @property
    def height(self) -> float:
        """Of the tree, metres."""
        return float(np.ptp(self.corner[..., 1]))

    def smaller(self, pixels: int) -> "Rendered":
        """The same pictures, `pixels` high and as wide."""
        views = []
        for view in self.views:
            rgb = np.stack([np.asarray(Image.fromarray(view.rgb[..., k]).resize((pixels, pixels), Image.Resampling.BOX)) for k in range(3)], axis=2)
            views.append(replace(view, camera=view.camera.resized((pixels, pixels)), rgb=rgb, seen=np.ones((pixels, pixels), bool)))
        return replace(self, views=views)

    def save(self, folder: Path) -> Path:
        """The pictures as PNG."""
        folder.mkdir(parents=True, exist_ok=True)
        for view in self.views:
            Image.fromarray(np.round(255 * view.rgb).astype(np.uint8)).save(folder / view.name)
        return folder


PRINT = 4096  # texels across the printed ground


def rendered(
    glb: Path, place: Path, *, count: int = 24, pixels: int = 400, arc: float = 360.0, elevation: float = 8.0, ground: bool = True, printed: bool = False
) -> Rendered:
    """`count` pictures of a GLB, evenly over so many degrees, `pixels` high and as wide; drawn in the folder `place`. `printed`: the ground has a print, for structure from motion to hold on to."""
    meshes = [mesh for mesh in read_glb(glb) if len(mesh.triangle)]
    points = np.vstack([mesh.position[np.unique(mesh.triangle)] for mesh in meshes])
    shift = footing(points)
    corner = np.concatenate([mesh.position[mesh.triangle] for mesh in meshes]) - shift
    middle, reach = 0.5 * (points.min(axis=0) + points.max(axis=0)), 0.5 * float(np.linalg.norm(np.ptp(points, axis=0)))
    around = middle + reach * np.array([[x, y, z] for x in (-0.42, 0.42) for y in (-0.42, 0.42) for z in (-0.42, 0.42)])  # the same frame from every side
    place.mkdir(parents=True, exist_ok=True)
    angles = [(arc * k / count, elevation + 6.0 * (k % 2)) for k in range(count)]
    request = request_of(meshes, angles, (pixels, pixels), around=around, ground=ground, supersample=2)
    if ground and printed:
        request["ground"] = _printed(request["ground"])
    drawn, why = draw_in_child(request, place / "sheet.png", 600.0)
    if not drawn:
        raise RuntimeError(why)
    sheet, columns = np.asarray(Image.open(place / "sheet.png").convert("RGB"), np.float32) / 255.0, int(request["columns"])
    views = []
    for k, pose in enumerate(request["camera"]):
        y, x = pixels * (k // columns), pixels * (k % columns)
        rgb = np.ascontiguousarray(sheet[y : y + pixels, x : x + pixels])
        views.append(View(f"{k:03d}.png", camera_of(pose, pixels), rgb, np.ones((pixels, pixels), bool)))
    return Rendered(views, corner)


def _printed(light: np.ndarray) -> np.ndarray:
    """The light on the ground times a print: flecks of every size from two texels to a sixteenth of the page, by chance."""
    chance, ink = np.random.default_rng(8), np.zeros((PRINT, PRINT), np.float32)
    for cells in (32, 64, 128, 256, 512, 1024, 2048):
        flecks = Image.fromarray(chance.uniform(-1, 1, (cells, cells)).astype(np.float32))
        ink += np.asarray(flecks.resize((PRINT, PRINT), Image.Resampling.BICUBIC))
    paper = 0.62 + 0.38 * np.tanh(1.2 * ink)
    own = np.asarray(Image.fromarray(light[..., 0]).resize((PRINT, PRINT), Image.Resampling.BILINEAR), np.float32)
    return np.repeat(np.round(own * paper).astype(np.uint8)[..., None], 3, axis=2)


def camera_of(pose: Float[np.ndarray, " 10"], pixels: int) -> Camera:
    """Eye, target, up and angle of view of a picture as a camera."""
    ahead = (pose[3:6] - pose[:3]) / np.linalg.norm(pose[3:6] - pose[:3])
    right = np.cross(ahead, pose[6:9])
    right /= np.linalg.norm(right)
    focal = 0.5 * pixels / np.tan(0.5 * np.radians(pose[9]))
    return Camera(np.array([[focal, 0, pixels / 2], [0, focal, pixels / 2], [0, 0, 1.0]]), np.array([right, np.cross(ahead, right), ahead]), pose[:3], (pixels, pixels))
