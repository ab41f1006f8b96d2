"""A tree from a sketch with all that games want of it, and pictures of numbers at its vertices."""

import dataclasses
import tempfile
from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw

import sketchtree as st
from sketchtree.geometry.mesh import Material, Mesh
from sketchtree.keys import root_key
from sketchtree.rig.rigging import Rigging
from sketchtree.templates.store.database import Database

SIZE = (430, 470)


def dressed(sketch: Path) -> tuple[Rigging, list[Mesh]]:
    """The rigging of the tree that grows from a sketch, and its meshes with all columns."""
    model = st.sketch_to_tree(sketch, Database.open(None), key=root_key(0))
    rigging = Rigging.of(model.skeleton)
    return rigging, [rigging.leaves(mesh, model.leaves) if mesh.name.startswith("leaf") else rigging.wood(mesh) for mesh in model.meshes]


def ramp(value: np.ndarray) -> np.ndarray:
    """Colours (linear) from dark blue at 0 over green to yellow at 1."""
    stops = np.array([[0.02, 0.03, 0.18], [0.03, 0.22, 0.35], [0.05, 0.50, 0.22], [0.55, 0.75, 0.05], [1.0, 0.93, 0.25]])
    return np.column_stack([np.interp(value, np.linspace(0, 1, len(stops)), stops[:, k]) for k in range(3)])


def hue(value: np.ndarray) -> np.ndarray:
    """Colours (linear) round the colour wheel; grey at 0 itself."""
    turn = np.abs((value[:, None] * 6.0 + np.array([0.0, 4.0, 2.0])) % 6.0 - 3.0) - 1.0
    return np.where((value == 0)[:, None], 0.25, 0.05 + 0.75 * np.clip(turn, 0.0, 1.0))


def false_colour(mesh: Mesh, colour: np.ndarray) -> Mesh:
    """The mesh in these colours; leaves keep their outlines."""
    texture = mesh.material.base_color_texture
    cut = mesh.material.alpha_cutoff
    plain = None if cut is None or texture is None else np.dstack([np.full(texture.shape[:2] + (3,), 255, np.uint8), texture[..., 3]])
    material = Material(mesh.material.name, base_color_texture=plain, alpha_cutoff=cut, double_sided=True)
    return dataclasses.replace(mesh, material=material, color=np.column_stack([colour, np.ones(len(colour))]))


def sheet(panes, titles, *, columns: int, output: Path, parser, around, azimuth: float = 0.0) -> None:
    """All panes on one picture, each a list of meshes, all seen by one camera: that which sees the meshes `around` whole."""
    first = np.vstack([mesh.position for mesh in around])
    low, high = first.min(axis=0), first.max(axis=0)
    focus = (tuple(0.5 * (low + high)), 0.52 * max(high[1] - low[1], high[0] - low[0], high[2] - low[2]))
    pictures = [_picture(meshes, azimuth, focus, parser) for meshes in panes]
    rows = -(-len(pictures) // columns)
    whole = Image.new("RGB", (columns * SIZE[0], rows * SIZE[1]), "white")
    for k, (picture, title) in enumerate(zip(pictures, titles, strict=True)):
        ImageDraw.Draw(picture).text((12, 10), title, fill=(30, 34, 40), font_size=20)
        whole.paste(picture, ((k % columns) * SIZE[0], (k // columns) * SIZE[1]))
    whole.quantize(256, dither=Image.Dither.NONE).save(output, optimize=True)


def _picture(meshes, azimuth: float, focus, parser) -> Image.Image:
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "view.png"
        drawn, reason = st.preview(meshes, path, size=SIZE, azimuth=azimuth, elevation=5.0, focus=focus)
        if not drawn:
            parser.exit(1, f"{reason}\n")
        return Image.open(path).convert("RGB")
