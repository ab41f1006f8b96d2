"""How well do coarser levels of detail stand for the tree? `python -m benchmarks.levels [-o PICTURE.png]`.

For every example: triangles as a share of LOD0's, overlap (intersection over union) of the silhouettes with LOD0's from eight sides at 512 pixels (mean
and worst), area of the leaves over LOD0's, the share of the screen's height where the level takes over, and what its making takes. `-o` draws a strip of them.
"""

import argparse
import tempfile
import time
from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw

from sketchtree.keys import root_key
from sketchtree.levels.make import make_levels
from sketchtree.levels.outline_error import overlap, views_round
from sketchtree.levels.raster import silhouette
from sketchtree.options import ReadingOptions, TreeOptions
from sketchtree.pipeline import sketch_to_tree
from sketchtree.view import preview

EXAMPLES = Path(__file__).resolve().parents[1] / "examples"
NAMES = ("oak.svg", "apple.json", "poplar.svg", "spruce.svg", "willow.svg", "palm.svg", "curvy.svg")
BARS = (0.96, 0.92, 0.85)
SAMPLES = 4000  # places looked at on every triangle of a leaf


def leaf_area(parts) -> float:
    """Of all leaves, m²: of their triangles the parts that are not cut away by alpha."""
    total, place = 0.0, np.random.default_rng(0).dirichlet([1.0, 1.0, 1.0], SAMPLES)
    for part in parts:
        if not part.name.startswith("leaf"):
            continue
        image = part.material.base_color_texture
        rows, columns = image.shape[:2]
        a, b, c = (part.position[part.triangle[:, k]] for k in range(3))
        size = 0.5 * np.linalg.norm(np.cross(b - a, c - a), axis=1)
        alike, which = np.unique(np.round(part.uv[part.triangle].reshape(-1, 6), 6), axis=0, return_inverse=True)  # few places in the texture
        for begin in range(0, len(alike), 500):
            uv = np.einsum("sk,tkc->tsc", place, alike[begin : begin + 500].reshape(-1, 3, 2))
            alpha = image[(uv[..., 1] * rows).astype(int) % rows, (uv[..., 0] * columns).astype(int) % columns, 3]
            shown = np.bincount(which.ravel(), size, len(alike))[begin : begin + 500]
            total += float((shown * (alpha >= 255 * part.material.alpha_cutoff).mean(axis=1)).sum())
    return total


def measured(levels, sides: int = 8, pixels: int = 512) -> list[dict]:
    """One row a level."""
    full = levels[0]
    views = views_round(full.parts, sides, pixels)
    shown = [silhouette(full.parts, view) for view in views]
    rows = []
    for level in levels:
        over = [overlap(one, silhouette(level.parts, view)) for one, view in zip(shown, views, strict=True)]
        area = leaf_area(level.parts) / max(leaf_area(full.parts), 1e-12)
        wood = sum(part.triangle_count for part in level.parts if part.name.startswith("wood"))
        rows.append({"triangles": level.triangle_count, "wood": wood, "share": level.triangle_count / full.triangle_count, "mean": float(np.mean(over)),
                     "worst": float(np.min(over)), "area": area, "coverage": level.coverage})  # fmt: skip
    return rows


def strip(levels, rows, name: str, size=(300, 340)) -> Image.Image:
    """The levels side by side, with what was measured."""
    sheet = Image.new("RGB", (size[0] * len(levels), size[1] + 44), "white")
    with tempfile.TemporaryDirectory() as folder:
        for k, (level, row) in enumerate(zip(levels, rows, strict=True)):
            path = Path(folder) / "level.png"
            drawn, reason = preview(level.parts, path, size=size, view="front", timeout=120)
            if drawn:
                sheet.paste(Image.open(path), (k * size[0], 0))
            else:
                print(name, k, reason)
            title = "impostor" if level.parts[0].name == "impostor" else f"LOD{k}"
            text = f"{name.split('.')[0]} {title}: {row['triangles']:,} triangles\noverlap {row['mean']:.3f} (worst {row['worst']:.3f})"
            ImageDraw.Draw(sheet).multiline_text((k * size[0] + 6, size[1] + 6), text, fill="black")
    return sheet


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("-o", "--output", type=Path, help="draw a strip of the levels of --pictures")
    parser.add_argument("--names", nargs="+", default=list(NAMES))
    parser.add_argument("--pictures", nargs="+", default=["oak.svg", "poplar.svg", "palm.svg"])
    parser.add_argument("--season", default="summer")
    asked = parser.parse_args()
    strips = []
    print(f"{'tree':<14}{'level':<10}{'triangles':>10}{'wood':>9}{'share':>8}{'overlap':>9}{'worst':>8}{'area':>7}{'from':>7}")
    for name in asked.names:
        model = sketch_to_tree(EXAMPLES / name, key=root_key(0), reading=ReadingOptions(), tree=TreeOptions(season=asked.season))
        began = time.perf_counter()
        levels = make_levels(model)
        took = time.perf_counter() - began
        rows = measured(levels)
        for number, row in enumerate(rows):
            title = "impostor" if levels[number].parts[0].name == "impostor" else f"LOD{number}"
            missed = " missed" if 1 <= number <= 3 and row["worst"] < BARS[number - 1] else ""
            print(f"{name:<14}{title:<10}{row['triangles']:>10,}{row['wood']:>9,}{row['share']:>8.3f}{row['mean']:>9.3f}{row['worst']:>8.3f}"
                  f"{row['area']:>7.2f}{row['coverage']:>7.2f}{missed}", flush=True)  # fmt: skip
        print(f"{name:<14}made in {took:.1f} s", flush=True)
        if asked.output and name in asked.pictures:
            strips.append(strip(levels, rows, name))
    if strips:
        sheet = Image.new("RGB", (strips[0].width, sum(one.height for one in strips)), "white")
        for k, one in enumerate(strips):
            sheet.paste(one, (0, sum(other.height for other in strips[:k])))
        sheet.save(asked.output)


if __name__ == "__main__":
    main()
