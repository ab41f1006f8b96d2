"""How does a sheet look? Points, wood and leaves are drawn alike: one light, one ground, one frame a row, captions below.

Points are little solids among the other meshes, so that they stand in the same light. Their normals look to the sun: their colours are what they were, but for what shades them.
"""

import tempfile
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from jaxtyping import Float
from PIL import Image, ImageDraw, ImageFont

from sketchtree.geometry.mesh import Material, Mesh
from sketchtree.geometry.wood import wood_mesh
from sketchtree.keys import root_key
from sketchtree.skeleton import TreeSkeleton
from sketchtree.view.picture import preview, sun_of

WIDE, HIGH, CAPTION = 300, 340, 26  # pixels
INK, PAPER = (40, 40, 36), (250, 250, 247)
SEEN_FROM = 32.0  # degrees: azimuth of the camera

_CORNER = np.array([[1.0, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]]) / np.sqrt(3.0)
_SIDE = np.array([[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]])

Panel = tuple[str, Image.Image]


def points_mesh(xyz: Float[np.ndarray, "point 3"], size: float, colour) -> Mesh:
    """A little solid of that size, metres, at each point. `colour`: sRGB 0-1, of all or of each."""
    count = len(xyz)
    position = (xyz[:, None] + 0.5 * size * _CORNER).reshape(-1, 3)
    triangle = (4 * np.arange(count)[:, None, None] + _SIDE).reshape(-1, 3)
    tint = np.c_[np.broadcast_to(linear(np.asarray(colour, float)), (count, 3)), np.ones(count)]
    normal = np.broadcast_to(sun_of(SEEN_FROM), position.shape)
    return Mesh("wood points", position, normal, np.zeros((4 * count, 2)), triangle, Material("wood points"), np.repeat(tint, 4, axis=0))


def wood_of(tree: TreeSkeleton, colour=None) -> Mesh:
    """The wood of a tree, light tubes; `colour`: sRGB 0-1, of all, instead of bark."""
    mesh = wood_mesh(tree, bark="oak", key=root_key(0), wood="tubes")
    return mesh if colour is None else tinted(mesh, np.broadcast_to(np.asarray(colour, float), (len(mesh.position), 3)))


def tinted(mesh: Mesh, colour: Float[np.ndarray, "vertex 3"]) -> Mesh:
    """The same without its texture, in other colours."""
    tint = np.c_[linear(colour), np.ones(len(colour))]
    return Mesh(mesh.name, mesh.position, mesh.normal, np.zeros_like(mesh.uv), mesh.triangle, Material(mesh.material.name), tint)


def ramp(share: Float[np.ndarray, " row"], stops: Sequence[str]) -> Float[np.ndarray, "row 3"]:
    """sRGB 0-1 between colours given as #rrggbb, 0 the first and 1 the last."""
    known = np.array([[int(stop[k : k + 2], 16) / 255 for k in (1, 3, 5)] for stop in stops])
    at = np.linspace(0, 1, len(stops))
    return np.stack([np.interp(np.clip(share, 0, 1), at, axis) for axis in known.T], axis=1)


def linear(colour: Float[np.ndarray, "*row 3"]) -> Float[np.ndarray, "*row 3"]:
    """Of sRGB."""
    return np.where(colour <= 0.04045, colour / 12.92, ((colour + 0.055) / 1.055) ** 2.4)


def around(xyz: Float[np.ndarray, "point 3"], azimuth: float = SEEN_FROM, close: float = 0.5) -> tuple[tuple[float, float, float], float]:
    """A focus for pictures that are to be compared: the plant fills the panel, seen from there."""
    low, high = xyz.min(axis=0), xyz.max(axis=0)
    across = xyz @ np.array([np.cos(np.radians(azimuth)), 0.0, -np.sin(np.radians(azimuth))])
    return tuple((0.5 * (low + high)).tolist()), close * float(max(np.ptp(across), WIDE / HIGH * (high[1] - low[1])))


def shot(meshes: Sequence[Mesh], focus, azimuth: float = SEEN_FROM, elevation: float = 7.0, size: tuple[int, int] = (WIDE, HIGH)) -> Image.Image:
    """What the camera sees."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "shot.png"
        drawn, reason = preview(meshes, path, size=size, azimuth=azimuth, elevation=elevation, focus=focus, timeout=600)
        if not drawn:
            raise SystemExit(reason)
        return Image.open(path).convert("RGB")


def save(path: Path, rows: Sequence[Sequence[Panel]], gap: int = 4) -> None:
    """Rows of panels of one size each, with captions, in few colours."""
    across = max(sum(image.width + gap for _, image in row) for row in rows) - gap
    sheet = Image.new("RGB", (across, sum(max(image.height for _, image in row) + CAPTION for row in rows)), PAPER)
    pen, font, y = ImageDraw.Draw(sheet), ImageFont.load_default(15), 0
    for row in rows:
        x, high = 0, max(image.height for _, image in row)
        for title, image in row:
            sheet.paste(image, (x, y))
            pen.text((x + image.width / 2, y + high + CAPTION / 2), title, fill=INK, font=font, anchor="mm")
            x += image.width + gap
        y += high + CAPTION
    path.parent.mkdir(parents=True, exist_ok=True)
    sheet.quantize(palette=sheet.quantize(256, kmeans=1), dither=Image.Dither.FLOYDSTEINBERG).save(path, optimize=True)  # or the ground's shade shows as rings
