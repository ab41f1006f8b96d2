"""What becomes of photos? One row a photo, as in Tan et al. 2008, Figure 7: photo | mask and trace | wood | the tree at the photo's view | from another side.

    python -m benchmarks.photo_sheet [--photos DIR] [--only NAME]... [--cell PIXELS] -o SHEET.png
"""

import argparse
import tempfile
from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw

from benchmarks.photo import made, photos
from sketchtree.photo_tree import PhotoModel
from sketchtree.view.beside import beside

CELL = 420  # pixels, of either side
_INK = {"crown": (230, 60, 50), "trunk": (40, 90, 230), "traced": (255, 170, 0)}


def row_of(model: PhotoModel) -> Image.Image:
    """The five pictures of one photo."""
    wood = [mesh for tree in model.trees for mesh in tree.model.meshes if not mesh.name.startswith("leaf")]
    whole = [mesh for tree in model.trees for mesh in tree.model.meshes]
    bare, full = _panels(model, wood), _panels(model, whole)
    cells = [Image.fromarray(model.photo.rgb), marked(model), *bare[:1], *full]
    row = Image.new("RGB", (CELL * len(cells), CELL), "white")
    for k, cell in enumerate(cells):
        cell = cell.convert("RGB")
        cell.thumbnail((CELL - 6, CELL - 6))
        row.paste(cell, (k * CELL + (CELL - cell.width) // 2, (CELL - cell.height) // 2))
    return row


def marked(model: PhotoModel) -> Image.Image:
    """The photo with the foliage tinted, the strokes and the traced limbs."""
    rgb = model.photo.rgb.astype(float)
    mask = np.any([tree.foliage.mask for tree in model.trees], axis=0)
    rgb = np.where(mask[..., None], 0.55 * rgb + 0.45 * np.array([60, 200, 90]), 0.8 * rgb + 50)
    image = Image.fromarray(np.clip(rgb, 0, 255).astype(np.uint8))
    pen, width = ImageDraw.Draw(image), max(model.photo.width // 250, 1)
    for tree in model.trees:
        pen.line([tuple(point) for point in [*tree.marked.crown, tree.marked.crown[0]]], fill=_INK["crown"], width=width)
        for stroke in tree.marked.branches:
            pen.line([tuple(point) for point in stroke], fill=_INK["trunk"], width=3 * width)
        traced = tree.traced
        for row in np.flatnonzero(traced.parent >= 0):
            pen.line([tuple(traced.xy[traced.parent[row]]), tuple(traced.xy[row])], fill=_INK["traced"], width=width)
    return image


def _panels(model: PhotoModel, meshes) -> list[Image.Image]:
    """Meshes at the photo's view, and from the right."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "panels.png"
        drawn, reason = beside(model.photo.rgb, meshes, model.frame, path)
        if not drawn:
            raise SystemExit(reason)
        sheet = Image.open(path).convert("RGB")
    third = sheet.width // 3
    return [sheet.crop((k * third, 0, (k + 1) * third, sheet.height)) for k in (1, 2)]


def main(argv=None) -> None:
    """Draws the sheet."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--photos", type=Path)
    parser.add_argument("--only", action="append")
    parser.add_argument("--cell", type=int, default=CELL, help="pixels, of either side of a picture")
    parser.add_argument("-o", "--output", type=Path, required=True)
    asked = parser.parse_args(argv)
    rows = []
    for name, photo, strokes in photos(asked.photos, asked.only):
        rows.append(row_of(made(photo, strokes)[0]))
        print(name, flush=True)
    sheet = Image.new("RGB", (rows[0].width, CELL * len(rows)), "white")
    for k, row in enumerate(rows):
        sheet.paste(row, (0, k * CELL))
    sheet.resize((round(sheet.width * asked.cell / CELL), round(sheet.height * asked.cell / CELL)), Image.Resampling.LANCZOS).save(asked.output, optimize=True)


if __name__ == "__main__":
    main()
