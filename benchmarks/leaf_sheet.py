"""What does every leaf model look like: its texture, and on a twig in spring, summer and autumn?

    python -m benchmarks.leaf_sheet -o LEAVES.png [NAME ...] [--cell 150]
    python -m benchmarks.leaf_sheet --seasons -o SEASONS.png [EXEMPLAR ...]

The second form draws whole exemplars in the four seasons instead. Both are lit flat and need no OpenGL.
"""

import argparse
from dataclasses import replace
from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw, ImageFont

from sketchtree import keys
from sketchtree.foliage.blossom import blossom
from sketchtree.foliage.cards import leaf_mesh
from sketchtree.foliage.leaf_materials import leaf_material
from sketchtree.foliage.leaves import select
from sketchtree.foliage.models import leaf_model, leaf_names
from sketchtree.foliage.painting import to_srgb
from sketchtree.foliage.populate import populate
from sketchtree.foliage.seasons import SEASONS
from sketchtree.geometry.wood import wood_meshes
from sketchtree.levels.raster import View, render
from sketchtree.parameters import Habit
from sketchtree.skeleton import TreeSkeleton

PAPER, INK = (246, 245, 240), (60, 60, 56)
SUN = np.array([0.45, 0.75, 0.48]) / np.linalg.norm([0.45, 0.75, 0.48])
FINER, COLUMNS = 3, 3  # each picture is drawn so many times larger, and averaged; models a row
TREES = ("wild_cherry", "horse_chestnut", "silver_birch", "european_larch", "norway_spruce", "staghorn_sumac")
KEY = keys.root_key(5)


def twig(name: str) -> tuple[TreeSkeleton, Habit]:
    """A twig on a stump, as long as shows the model's arrangement."""
    model = leaf_model(name)
    size, spacing = model.size / model.needle, model.spacing * model.bundle
    length = 2.0 if model.arrangement == "frond" else float(np.clip(5 * spacing, 1.1 * size, 5.0 * size))
    count, rise = 12, np.radians(90 if name == "dragon_tree" else 38)
    t = np.linspace(0, 1, count + 1)[1:, None]
    tips = t * length * [np.cos(rise), np.sin(rise), 0.0] + [0, -0.12 * length, 0] * t**2
    radius = np.interp(t[:, 0], [0, 1], [0.022, 0.016]) * (0.1 * length if model.arrangement == "frond" else size) ** 1.0
    parent = np.r_[-1, np.arange(count + 1)]
    tips = np.vstack([[[0, -0.5, 0]], [[0, 0, 0]], tips]) + [0, 0.5, 0]
    radii = np.r_[[8.5 * radius[-1]] * 2, radius]
    tree = TreeSkeleton.from_columns(parent, tips, radii, limb=np.r_[1, 1, np.full(count, 11)], order=np.r_[0, 0, np.ones(count, int)])
    habit = Habit(leaf=name, leaf_arrangement=model.arrangement, leaf_size=model.size, leaf_spacing=model.spacing, twig_radius=float(radius[-1]),
                  twig_length=length, height=5.0)  # fmt: skip
    return tree, habit


def picture(meshes, width: int, height: int, *, azimuth: float = 0.0, tilt: float = 0.0) -> Image.Image:
    """Meshes in parallel view, lit by one sun and the sky, on paper."""
    points = np.vstack([m.position for m in meshes if len(m.position)])
    side = FINER * max(width, height)
    view = View.round(azimuth, np.zeros(3), 1.0, side)
    up, towards = np.array([0.0, np.cos(tilt), 0.0]) - np.sin(tilt) * view.towards, view.towards
    seen = np.stack([points @ view.right, points @ up, points @ towards], axis=1)
    low, high = seen.min(axis=0), seen.max(axis=0)
    middle = (low + high) / 2
    half = 0.54 * max((high - low)[0] * side / (FINER * width), (high - low)[1] * side / (FINER * height))
    view = View(view.right, up / np.linalg.norm(up), middle[0] * view.right + middle[1] * up / (up @ up) + middle[2] * 0 * towards, half, side)
    found = render(meshes, view)
    lit = np.clip(found.normal @ SUN, -1, 1)
    light = 0.62 + 0.55 * np.maximum(lit, 0) + 0.30 * np.maximum(-lit, 0) + 0.06 * found.normal[..., 1]  # some passes through
    color = to_srgb(np.clip(found.color * light[..., None], 0, 1)) * 255
    color = np.where(np.isfinite(found.depth)[..., None], color, PAPER)
    image = Image.fromarray(np.round(color).astype(np.uint8))
    cut = [(side - FINER * n) // 2 for n in (width, height)]
    return image.crop((cut[0], cut[1], cut[0] + FINER * width, cut[1] + FINER * height)).resize((width, height), Image.Resampling.BOX)


def texture(name: str, cell: int) -> Image.Image:
    """The summer texture on paper."""
    image = Image.fromarray(leaf_material(name).base_color_texture)
    image.thumbnail((cell - 8, cell - 8))
    sheet = Image.new("RGB", (cell, cell), PAPER if not leaf_model(name).flower else (124, 138, 120))
    sheet.paste(image, ((cell - image.width) // 2, (cell - image.height) // 2), image)
    return sheet


def leaf_row(name: str, cell: int) -> Image.Image:
    """One model: texture, and the twig in three seasons."""
    row = Image.new("RGB", (4 * cell, cell + 16), PAPER)
    row.paste(texture(name, cell), (0, 16))
    tree, habit = twig(name)
    old = leaf_model(name).blossom_on == "old wood"  # such blossoms stand on what bears the twig, so some of that is drawn
    low, clear = (0.5 - 0.6 * habit.twig_length, 0.0) if old else (0.5, 8.7 * habit.twig_radius if name != "dragon_tree" else 0.0)
    for k, season in enumerate(("spring", "summer", "autumn")):
        wood = [_above(mesh, low, clear) for mesh in wood_meshes(tree, bark="oak", habit=habit, key=KEY)]
        worn = [populate(tree, habit, key=KEY, season=season), blossom(tree, habit, key=KEY, season=season)]
        worn = [select(one, one.position[:, 1] > low) for one in worn if one is not None and len(one)]
        meshes = [*wood, *(leaf_mesh(one, season=season) for one in worn if len(one))]
        row.paste(picture(meshes, cell - 4, cell - 4, azimuth=0.25, tilt=0.6), ((k + 1) * cell + 2, 18))
    ImageDraw.Draw(row).text((4, 2), name.replace("_", " "), fill=INK, font=ImageFont.load_default(12))
    return row


def _above(mesh, height: float, clear: float):
    """What of a mesh stands above a height and so far from the axis, metres."""
    corner = mesh.position[mesh.triangle]
    keep = (corner[..., 1].min(axis=1) > height) & (np.hypot(corner[..., 0], corner[..., 2]).min(axis=1) >= clear)
    used, triangle = np.unique(mesh.triangle[keep], return_inverse=True)
    return replace(mesh, position=mesh.position[used], normal=mesh.normal[used], uv=mesh.uv[used], triangle=triangle.reshape(-1, 3))


def leaf_sheet(names, cell: int) -> Image.Image:
    """All models, `COLUMNS` a row."""
    rows = -(-len(names) // COLUMNS)
    sheet = Image.new("RGB", (COLUMNS * (4 * cell + 10), rows * (cell + 20)), PAPER)
    for k, name in enumerate(names):
        sheet.paste(leaf_row(name, cell), ((k % COLUMNS) * (4 * cell + 10), (k // COLUMNS) * (cell + 20)))
        print(name, flush=True)
    return sheet


def season_sheet(names, cell: int) -> Image.Image:
    """Exemplars, a row each, in the four seasons."""
    from sketchtree.templates.store.database import Database

    db, sheet = Database.open(), Image.new("RGB", (4 * cell, len(names) * (cell + 4)), PAPER)
    for row, name in enumerate(names):
        one = db.exemplar(name)
        for k, season in enumerate(SEASONS):
            worn = [populate(one.skeleton, one.habit, key=KEY, season=season), blossom(one.skeleton, one.habit, key=KEY, season=season)]
            meshes = [*wood_meshes(one.skeleton, bark=one.habit.bark, habit=one.habit, key=KEY)]
            meshes += [leaf_mesh(leaves, season=season) for leaves in worn if leaves is not None and len(leaves)]
            sheet.paste(picture(meshes, cell - 6, cell - 6), (k * cell + 3, row * (cell + 4) + 2))
            ImageDraw.Draw(sheet).text((k * cell + 6, row * (cell + 4) + 4), f"{name.replace('_', ' ')}, {season}", fill=INK, font=ImageFont.load_default(12))
        print(name, flush=True)
    return sheet


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("names", nargs="*")
    parser.add_argument("-o", "--out", type=Path, required=True)
    parser.add_argument("--cell", type=int)
    parser.add_argument("--seasons", action="store_true")
    options = parser.parse_args()
    if options.seasons:
        sheet = season_sheet(options.names or TREES, options.cell or 300)
    else:
        sheet = leaf_sheet(options.names or leaf_names(), options.cell or 130)
    sheet.quantize(200, dither=Image.Dither.NONE).save(options.out, optimize=True)


if __name__ == "__main__":
    main()
