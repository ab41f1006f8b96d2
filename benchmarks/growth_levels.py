"""How does a tree grow in between two generations? A picture: one drawing at several levels of growth, in a row.

    python -m benchmarks.growth_levels [SKETCH] [-o PICTURE.png] [--levels .5 1 1.5 2 2.5 4] [--seed 0] [--leaves]

Each tree is the beginning of the next; at a level between two whole ones the last generation has come that share of its way
(`sketchtree build SKETCH -o TREE.glb --generations 2.5`). All are seen from one place.
"""

import argparse
import tempfile
from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw, ImageFont

from sketchtree.keys import root_key
from sketchtree.options import TreeOptions
from sketchtree.pipeline import TreeModel, complete, draw_out
from sketchtree.templates.store.database import Database
from sketchtree.view import preview

SKETCH = Path(__file__).parents[1] / "examples" / "oak.svg"
LEVELS = (0.5, 1.0, 1.5, 2.0, 2.5, 4.0)
_WIDE, _HIGH = 330, 360  # pixels of one tree
_FILLS = 0.8  # of the trees' radius: how much of it the picture shows
_LARGEST = 400_000  # bytes of the picture
_COLOURS = (255, 192, 128, 96, 64)  # tried in this order until the picture is small enough


def grown(sketch: Path, levels: tuple[float, ...], *, seed: int = 0, leaves: bool = False) -> list[TreeModel]:
    """The same drawing at every level."""
    templates, key = Database.open(), root_key(seed)
    drawn = draw_out(sketch, templates, key=key)
    leaf = None if leaves else "none"
    return [complete(drawn, templates, key=key, options=TreeOptions(generations=level, leaf=leaf)) for level in levels]


def picture(trees: list[TreeModel], levels: tuple[float, ...]) -> Image.Image:
    """All trees in a row from one place, each with its level below."""
    points = np.concatenate([mesh.position for tree in trees for mesh in tree.meshes])
    middle = 0.5 * (points.min(axis=0) + points.max(axis=0))
    focus = tuple(middle.tolist()), _FILLS * float(np.linalg.norm(points - middle, axis=1).max())
    row = Image.new("RGB", (_WIDE * len(trees), _HIGH + 26), "white")
    pen, font = ImageDraw.Draw(row), ImageFont.load_default(size=16)
    with tempfile.TemporaryDirectory() as folder:
        for place, (tree, level) in enumerate(zip(trees, levels, strict=True)):
            path = Path(folder) / f"{place}.png"
            drawn, reason = preview(tree.meshes, path, size=(_WIDE, _HIGH), focus=focus)
            if not drawn:
                raise SystemExit(f"No picture: {reason}")
            row.paste(Image.open(path).convert("RGB"), (_WIDE * place, 0))
            pen.text((_WIDE * (place + 0.5), _HIGH + 13), f"{level:g}", fill="black", font=font, anchor="mm")
    return row


def save(image: Image.Image, path: Path) -> None:
    """Write the picture in as many colours as `_LARGEST` bytes allow."""
    for colours in _COLOURS:
        image.quantize(colours, dither=Image.Dither.FLOYDSTEINBERG).save(path, optimize=True)
        if path.stat().st_size <= _LARGEST:
            return


def main(arguments: list[str] | None = None) -> None:
    """Prints the segments of every level and writes the picture."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.growth_levels", description=__doc__.splitlines()[0])
    parser.add_argument("sketch", type=Path, nargs="?", default=SKETCH)
    parser.add_argument("-o", "--output", type=Path, default=Path("growth_levels.png"))
    parser.add_argument("--levels", type=float, nargs="+", default=list(LEVELS))
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--leaves", action="store_true", help="with leaves")
    asked = parser.parse_args(arguments)
    trees = grown(asked.sketch, tuple(asked.levels), seed=asked.seed, leaves=asked.leaves)
    for level, tree in zip(asked.levels, trees, strict=True):
        print(f"level {level:g}: {tree.skeleton.segment_count:,} segments, trunk {1000 * tree.skeleton.radius.max():.0f} mm")
    save(picture(trees, tuple(asked.levels)), asked.output)
    print(f"{asked.output}: {asked.output.stat().st_size / 1000:.0f} kB")


if __name__ == "__main__":
    main()
