"""Exemplar, sketch, tree side by side (Chen et al. 2008, Figure 11), for several drawings.

    python -m benchmarks.exemplar_to_tree [SKETCH ...] -o PICTURE.png [--seed 0]

The exemplar is the one that matching chose; it is drawn bare, as it stands in the database.
"""

import argparse
import tempfile
from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw, ImageFont

from sketchtree.keys import root_key
from sketchtree.pipeline import sketch_to_tree
from sketchtree.sketch.formats import read_sketch
from sketchtree.templates.store.database import Database
from sketchtree.templates.seen.thumbnail import thumbnail
from sketchtree.view import preview

EXAMPLES = Path(__file__).parents[1] / "examples"
DRAWINGS = tuple(EXAMPLES / name for name in ("poplar.svg", "spruce.svg", "willow.svg"))
CELL, CAPTION = 400, 26  # pixels


def paper(sketch: Path) -> Image.Image:
    """The strokes as they were drawn."""
    strokes = read_sketch(sketch).strokes
    points = np.concatenate([stroke.points for stroke in strokes])
    low, high = points.min(axis=0), points.max(axis=0)
    scale = 0.88 * CELL / float((high - low).max())
    shift = np.array([CELL / 2 - scale * (low[0] + high[0]) / 2, 0.06 * CELL - scale * low[1]])
    image = Image.new("RGB", (CELL, CELL), (255, 255, 255))
    pen = ImageDraw.Draw(image)
    for stroke in strokes:
        at = stroke.points * scale + shift
        pen.line([(float(x), CELL - float(y)) for x, y in at], fill=(50, 50, 50), width=max(1, round(scale * (stroke.width or 0))))
    return image


def row(sketch: Path, templates: Database, folder: Path, seed: int) -> tuple[list[Image.Image], str]:
    """(exemplar, sketch and tree, the exemplar's title)."""
    tree = sketch_to_tree(sketch, templates, key=root_key(seed))
    drawn, why = preview(tree.meshes, folder / "tree.png", size=(CELL, CELL), view="front")
    if not drawn:
        raise SystemExit(why)
    exemplar = tree.drawn.exemplar
    bare = Image.fromarray(thumbnail(exemplar.skeleton, size=CELL)).convert("RGB")
    return [bare, paper(sketch), Image.open(folder / "tree.png").convert("RGB")], exemplar.title


def main(arguments: list[str] | None = None) -> None:
    """The command line."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.exemplar_to_tree", description=__doc__.splitlines()[0])
    parser.add_argument("sketch", nargs="*", type=Path, default=list(DRAWINGS))
    parser.add_argument("-o", "--out", type=Path, required=True)
    parser.add_argument("--seed", type=int, default=0)
    options = parser.parse_args(arguments)
    sheet = Image.new("RGB", (3 * CELL, len(options.sketch) * (CELL + CAPTION)), (255, 255, 255))
    pen, font = ImageDraw.Draw(sheet), ImageFont.load_default(14)
    with tempfile.TemporaryDirectory() as folder:
        for k, sketch in enumerate(options.sketch):
            pictures, title = row(sketch, Database.open(), Path(folder), options.seed)
            for column, picture in enumerate(pictures):
                sheet.paste(picture, (column * CELL, k * (CELL + CAPTION)))
            pen.text((8, k * (CELL + CAPTION) + CELL + 4), title, fill=(40, 40, 40), font=font)
    sheet.save(options.out)


if __name__ == "__main__":
    main()
