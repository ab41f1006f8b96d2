"""What does every bark look like, flat and lit on a stem, at arm's length and from 10 m?

    python -m benchmarks.bark_sheet -o BARKS.png [NAME ...] [--cell 170]

For each: one tile (0.5 m), half a metre of a stem 0.4 m thick, and the same stem from about 10 m. Needs no OpenGL.
"""

import argparse
from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw, ImageFont

from sketchtree.foliage.painting import to_linear, to_srgb
from sketchtree.geometry.bark import bark_material, bark_names
from sketchtree.geometry.bark.relief import TILE

PAPER, INK = (246, 245, 240), (60, 60, 56)
SUN = np.array([-0.55, 0.45, 0.70]) / np.linalg.norm([-0.55, 0.45, 0.70])  # x right, y up, z to the viewer
RADIUS, COLUMNS = 0.2, 4  # metres; barks a row


def stem(name: str, width: int, height: int, metres: float) -> Image.Image:
    """A stem `metres` of which are `height` pixels high, its bark lit by its normals."""
    material, finer = bark_material(name), 3
    y, x = np.mgrid[: finer * height, : finer * width].astype(float)
    scale = metres / (finer * height)
    across = (x - finer * width / 2) * scale / RADIUS
    on = np.abs(across) < 1
    angle = np.arcsin(np.clip(across, -1, 1))
    size = len(material.base_color_texture)
    column = (angle * RADIUS / TILE * size).astype(int) % size
    row = (y * scale / TILE * size).astype(int) % size
    bump = material.normal_texture[row, column] / 127.5 - 1
    right = np.stack([np.cos(angle), np.zeros_like(angle), -np.sin(angle)], axis=-1)
    out = np.stack([np.sin(angle), np.zeros_like(angle), np.cos(angle)], axis=-1)
    normal = bump[..., :1] * right + bump[..., 1:2] * np.array([0.0, 1.0, 0.0]) + bump[..., 2:] * out
    lit = np.maximum(normal @ SUN, 0)
    gloss = (1 - material.roughness_texture[row, column] / 255.0) * np.maximum(normal @ _half(), 0) ** 30
    light = 0.34 + 0.10 * normal[..., 1] + 0.85 * lit
    color = to_linear(material.base_color_texture[row, column] / 255.0) * light[..., None] + 0.25 * gloss[..., None]
    color = np.where(on[..., None], 255 * to_srgb(np.clip(color, 0, 1)), PAPER)
    return Image.fromarray(np.round(color).astype(np.uint8)).resize((width, height), Image.Resampling.BOX)


def _half():
    between = SUN + np.array([0.0, 0.0, 1.0])
    return between / np.linalg.norm(between)


def bark_cell(name: str, cell: int) -> Image.Image:
    """One bark: flat, near, far."""
    sheet = Image.new("RGB", (int(2.45 * cell), cell + 18), PAPER)
    sheet.paste(Image.fromarray(bark_material(name).base_color_texture).resize((cell - 4, cell - 4), Image.Resampling.BOX), (2, 18))
    sheet.paste(stem(name, cell - 4, cell - 4, 0.5), (cell + 2, 18))
    sheet.paste(stem(name, int(0.4 * cell), cell - 4, 2.2), (2 * cell + 2, 18))
    ImageDraw.Draw(sheet).text((4, 2), name.replace("_", " "), fill=INK, font=ImageFont.load_default(12))
    return sheet


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("names", nargs="*")
    parser.add_argument("-o", "--out", type=Path, required=True)
    parser.add_argument("--cell", type=int, default=130)
    options = parser.parse_args()
    cells = [bark_cell(name, options.cell) for name in options.names or bark_names()]
    wide, high = cells[0].size
    sheet = Image.new("RGB", (COLUMNS * wide, -(-len(cells) // COLUMNS) * (high + 4)), PAPER)
    for k, cell in enumerate(cells):
        sheet.paste(cell, (k % COLUMNS * wide, k // COLUMNS * (high + 4)))
    sheet.quantize(256, dither=Image.Dither.NONE).save(options.out, optimize=True)


if __name__ == "__main__":
    main()
