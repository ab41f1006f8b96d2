"""What do the exemplars look like, bare and in leaf? One picture of all, or of those named.

    python -m benchmarks.template_sheet -o SHEET.png [NAME ...] [--recipes FOLDER] [--azimuth 0] [--seed-shift 0] [--no-leaves] [--scale 1]

Each is grown from its recipe as it stands (no database needed) and drawn flat: bare on the left, with its leaf model's summer
leaves on the right. A caption names the growth habit, rows and height; the terminal gets the seconds each took to grow.
"""

import argparse
import time
from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw, ImageFont

from sketchtree import keys
from sketchtree.foliage.models import leaf_model
from sketchtree.foliage.populate import populate
from sketchtree.templates.seen.footprint import project
from sketchtree.templates.growing.procedural import grow
from sketchtree.templates.growing.recipe import GROWTH_HABITS, Recipe, read_recipe
from sketchtree.templates.making.regenerate import recipe_folder

CELL, CAPTION, FINER = 300, 34, 2  # pixels; drawn finer, then averaged
LEAVES = 14_000  # a tree, at most
PAPER, WOOD = (255, 255, 255), (62, 50, 42)


class Paper:
    """One view of a tree, on a square of `CELL`."""

    def __init__(self, tree, azimuth: float):
        self.azimuth = azimuth
        seen = project(np.concatenate([tree.start, tree.tip]), azimuth)
        low, high = seen.min(axis=0), seen.max(axis=0)
        self.pixels = CELL * FINER
        self.scale = 0.9 * self.pixels / max(float((high - low).max()), 1e-9)
        self.shift = np.array([self.pixels / 2 - self.scale * (low[0] + high[0]) / 2, 0.05 * self.pixels - self.scale * low[1]])
        self.image = Image.new("RGB", (self.pixels, self.pixels), PAPER)
        self.pen = ImageDraw.Draw(self.image)

    def at(self, points) -> np.ndarray:
        """Pixels of world points."""
        seen = project(points, self.azimuth) * self.scale + self.shift
        return np.stack([seen[:, 0], self.pixels - seen[:, 1]], axis=1)

    def wood(self, tree) -> list[tuple[float, tuple]]:
        """(depth, line) of every segment."""
        a, b, depth = self.at(tree.start), self.at(tree.tip), self.depth(tree.tip)
        width = np.maximum(1, np.round(2 * tree.radius * self.scale)).astype(int)
        return [(d, (tuple(p), tuple(q), int(w))) for d, p, q, w in zip(depth, a, b, width, strict=True)]

    def depth(self, points) -> np.ndarray:
        """Metres towards the viewer."""
        angle = np.radians(self.azimuth)
        return points[:, 0] * np.sin(angle) + points[:, 2] * np.cos(angle)

    def blades(self, leaves) -> list[tuple[float, tuple]]:
        """(depth, polygon) of every leaf: a lozenge in its own plane, shaded by its face."""
        across = np.cross(leaves.normal, leaves.direction)
        slim = 0.12 if leaves.model == "palm" else 0.16 if leaves.model == "willow" else 0.55 if leaf_model(leaves.model).planes else 0.36
        size = leaves.size[:, None]
        tip, middle = leaves.position + size * leaves.direction, leaves.position + 0.5 * size * leaves.direction
        corners = np.stack([self.at(p) for p in (leaves.position, middle + slim * size * across, tip, middle - slim * size * across)], 1)
        palette = leaf_model(leaves.model).palettes["summer"]
        low, high = (np.array([int(c[i : i + 2], 16) for i in (1, 3, 5)]) for c in (palette.blade_from, palette.blade_to))
        light = 0.75 + 0.35 * np.abs(leaves.normal[:, 1])
        colour = (low + leaves.tint[:, None] * (high - low)) * light[:, None]
        colour = np.clip(colour, 0, 255).astype(int)
        depth = self.depth(middle)
        return [(d, (tuple(map(tuple, c)), tuple(rgb))) for d, c, rgb in zip(depth, corners.tolist(), colour.tolist(), strict=True)]

    def draw(self, things) -> Image.Image:
        """Paints the farthest first."""
        for _, thing in sorted(things, key=lambda pair: pair[0]):
            if len(thing) == 2:
                self.pen.polygon(thing[0], fill=thing[1])
                continue
            a, b, width = thing
            self.pen.line([a, b], fill=WOOD, width=width)
            if width > 3:
                half = width / 2
                self.pen.ellipse([b[0] - half, b[1] - half, b[0] + half, b[1] + half], fill=WOOD)
        return self.image.resize((CELL, CELL), Image.Resampling.BOX)


def cell(recipe: Recipe, azimuth: float, shift: int, leafy: bool) -> Image.Image:
    """The bare tree, and the tree in leaf beside it."""
    began = time.process_time()
    tree = grow(recipe, recipe.seed + shift)
    took = time.process_time() - began
    bare = Paper(tree, azimuth)
    pictures = [bare.draw(bare.wood(tree))]
    if leafy:
        leaves = populate(tree, recipe.habit, key=keys.stage_key(keys.root_key(1), "foliage"), max_leaves=LEAVES)
        full = Paper(tree, azimuth)
        pictures.append(full.draw(full.wood(tree) + full.blades(leaves)))
    print(f"{recipe.name:22} {recipe.growth_habit:12} {len(tree):6} rows  {tree.height:6.1f} m  {took:5.2f} s", flush=True)
    picture = Image.new("RGB", (CELL * len(pictures), CELL + CAPTION), PAPER)
    for k, half in enumerate(pictures):
        picture.paste(half, (CELL * k, 0))
    pen, font = ImageDraw.Draw(picture), ImageFont.load_default(15)
    pen.text((8, CELL + 6), f"{recipe.name} · {recipe.growth_habit} · {len(tree)} rows · {tree.height:.1f} m", (40, 40, 40), font)
    return picture


def main() -> None:
    """Draw the sheet."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("names", nargs="*", help="recipes; all where none is named")
    parser.add_argument("-o", "--output", type=Path, required=True, help="the picture to write (.png)")
    parser.add_argument("--recipes", type=Path, default=recipe_folder())
    parser.add_argument("--azimuth", type=float, default=0.0, help="degrees")
    parser.add_argument("--seed-shift", type=int, default=0, help="added to every recipe's seed")
    parser.add_argument("--columns", type=int, default=3)
    parser.add_argument("--no-leaves", action="store_true")
    parser.add_argument("--scale", type=float, default=1.0, help="of the picture; below 1 it is saved in few colours")
    wanted = parser.parse_args()
    files = [wanted.recipes / f"{name}.toml" for name in wanted.names] or sorted(wanted.recipes.glob("*.toml"))
    recipes = [read_recipe(path) for path in files]
    if not wanted.names:
        recipes.sort(key=lambda recipe: (*GROWTH_HABITS, "").index(recipe.growth_habit))
    cells = [cell(recipe, wanted.azimuth, wanted.seed_shift, not wanted.no_leaves) for recipe in recipes]
    wide, high = cells[0].size
    sheet = Image.new("RGB", (wanted.columns * wide, -(-len(cells) // wanted.columns) * high), PAPER)
    for k, picture in enumerate(cells):
        sheet.paste(picture, (k % wanted.columns * wide, k // wanted.columns * high))
    if wanted.scale < 1:
        small = sheet.resize((round(sheet.width * wanted.scale), round(sheet.height * wanted.scale)), Image.Resampling.LANCZOS)
        sheet = small.quantize(48)
    sheet.save(wanted.output, optimize=True)


if __name__ == "__main__":
    main()
