"""Does one sketch under other templates give other trees (Chen et al. 2008, Figure 9)? A picture, and how alike the crowns are.

    python -m benchmarks.six_templates [SKETCH] [-o PICTURE.png] [--templates NAME ...] [--seed 0]

The drawing has no crown, so the template decides what grows between and beyond its strokes. Every tree is laid back over the page (H = 1,
the drawing's height), its leaves and wood rastered from the front, gaps below 3 % H closed; printed is the intersection over
union of every two silhouettes, which should be at most .85.
"""

import argparse
import tempfile
from itertools import combinations
from pathlib import Path

import numpy as np
from jaxtyping import Bool
from PIL import Image, ImageDraw, ImageFont
from scipy.ndimage import binary_closing, binary_fill_holes

from sketchtree.keys import root_key
from sketchtree.options import ReadingOptions
from sketchtree.pipeline import TreeModel, sketch_to_tree
from sketchtree.templates.store.database import Database
from sketchtree.view import preview

SKETCH = Path(__file__).parent / "data" / "ten_strokes.svg"
SIX = ("english_oak", "lombardy_poplar", "weeping_willow", "norway_spruce", "stone_pine", "windswept_pine")
AT_MOST = 0.85
_CELLS, _GAP = 120, 4  # raster cells per H; radius of the closing, cells
_REACH = 2.0  # H to either side and up


def grown(sketch: Path, template: str, *, seed: int = 0) -> TreeModel:
    """The complete tree under one template."""
    return sketch_to_tree(sketch, Database.open(), key=root_key(seed), reading=ReadingOptions(template=template))


def silhouette(tree: TreeModel) -> Bool[np.ndarray, "row column"]:
    """Which cells the tree covers, seen from the front; the drawing's height is `_CELLS`."""
    height = tree.drawn.skeleton.height
    mask = np.zeros((int(_REACH * _CELLS), int(2 * _REACH * _CELLS)), bool)
    for mesh in tree.meshes:
        corner = mesh.position[mesh.triangle][:, :, :2] / height  # (triangle, corner, xy)
        for weight in np.random.default_rng(0).dirichlet(np.ones(3), 24):
            at = np.einsum("tca,c->ta", corner, weight)
            column, row = ((at[:, 0] + _REACH) * _CELLS).astype(int), (at[:, 1] * _CELLS).astype(int)
            inside = (column >= 0) & (column < mask.shape[1]) & (row >= 0) & (row < mask.shape[0])
            mask[row[inside], column[inside]] = True
    y, x = np.ogrid[-_GAP : _GAP + 1, -_GAP : _GAP + 1]
    return binary_fill_holes(binary_closing(mask, x**2 + y**2 <= _GAP**2))


def overlap(a: Bool[np.ndarray, "row column"], b: Bool[np.ndarray, "row column"]) -> float:
    """Intersection over union."""
    return float((a & b).sum() / max((a | b).sum(), 1))


def main(arguments: list[str] | None = None) -> None:
    """The command line."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.six_templates", description=__doc__.splitlines()[0])
    parser.add_argument("sketch", nargs="?", type=Path, default=SKETCH)
    parser.add_argument("-o", "--out", type=Path)
    parser.add_argument("--templates", nargs="+", default=list(SIX))
    parser.add_argument("--seed", type=int, default=0)
    options = parser.parse_args(arguments)
    trees = {name: grown(options.sketch, name, seed=options.seed) for name in options.templates}
    masks = {name: silhouette(tree) for name, tree in trees.items()}
    pairs = {(a, b): overlap(masks[a], masks[b]) for a, b in combinations(masks, 2)}
    for (a, b), value in sorted(pairs.items(), key=lambda pair: -pair[1]):
        print(f"{a:20s} {b:20s} {value:.3f}{'  above the bar' if value > AT_MOST else ''}")
    for name, tree in trees.items():
        print(f"{name:20s} {len(tree.skeleton):6d} segments {len(tree.leaves.position):6d} leaves")
    if options.out:
        picture(trees).save(options.out)


def picture(trees: dict[str, TreeModel], *, cell: int = 420, caption: int = 26, columns: int = 3) -> Image.Image:
    """All trees from the front."""
    rows = -(-len(trees) // columns)
    sheet = Image.new("RGB", (columns * cell, rows * (cell + caption)), (255, 255, 255))
    pen, font = ImageDraw.Draw(sheet), ImageFont.load_default(14)
    with tempfile.TemporaryDirectory() as folder:
        for k, (name, tree) in enumerate(trees.items()):
            x, y = k % columns * cell, k // columns * (cell + caption)
            drawn, why = preview(tree.meshes, Path(folder) / "tree.png", size=(cell, cell), view="front")
            if not drawn:
                raise SystemExit(why)
            sheet.paste(Image.open(Path(folder) / "tree.png").convert("RGB"), (x, y))
            pen.text((x + 8, y + cell + 4), name, fill=(40, 40, 40), font=font)
    return sheet


if __name__ == "__main__":
    main()
